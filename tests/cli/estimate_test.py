"""`check --estimate`: what a run takes, from its beginning."""
import os
import subprocess
import time
import unittest

from program import BINARY, ProgramTest


# A cube on a slab that sinks from t = 1 s on, a hundred steps later.
SINKING = """
[[material]]
density = 2500
young_modulus = 1e9
poisson_ratio = 0.2
[[joint_material]]
name = "dry"
friction_angle = 30
[[solid]]
name = "slab"
shape = "box"
min = [0, 0, 0]
max = [2, 2, 0.5]
[[solid]]
name = "cube"
shape = "box"
min = [0.5, 0.5, 0.5]
max = [1.5, 1.5, 1.5]
interface = "dry"
[cover]
lattice = "block"
[[fixed]]
where = {block_at = [1, 1, 0.2]}
value_table = [[0, 0, 0, 0], [1, 0, 0, 0], [3, 0, 0, -0.01]]
[analysis]
type = "quasi_static"
time_step = 0.01
steps = 150
"""


class Estimate(ProgramTest):
    def measured(self, *arguments):
        """Wall time in s and memory at the highest in bytes."""
        began = time.monotonic()
        process = subprocess.Popen([BINARY, *arguments], cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        self.assertEqual(process.returncode, 0)
        return time.monotonic() - began, 1024 * usage.ru_maxrss

    def test_tells_memory_and_steps_of_a_run_and_leaves_nothing(self):
        self.copy_case("stacked_blocks")
        before = self.files()
        made = self.json_of("check", "stacked_blocks.toml", "--estimate")["estimate"]
        self.assertEqual(self.files(), before)
        self.assertEqual(made["command"], "run")
        self.assertEqual((made["steps"], made["steps_tried"]), (10, 10))  # so few that all are tried
        seconds, memory = self.measured("run", "stacked_blocks.toml")
        self.assertTrue(memory / 2 < made["memory"] < 2 * memory, (memory, made))
        self.assertTrue(seconds / 10 < made["seconds"] < 10 * seconds, (seconds, made))  # other programs run beside

    def test_tries_each_stage_of_a_long_run(self):
        self.copy_case("jointed_slope")
        began = time.monotonic()
        made = self.json_of("check", "jointed_slope.toml", "--estimate")["estimate"]
        self.assertEqual(made["steps"], 60 + 1000)
        self.assertGreaterEqual(made["steps_tried"], 2 * 3)
        self.assertLess(made["steps_tried"], made["steps"])
        self.assertGreater(made["seconds"], time.monotonic() - began)  # of which it has done a part

    def test_sees_steps_with_motion_that_begins_late(self):
        self.write("sinking.toml", SINKING)
        made = self.json_of("check", "sinking.toml", "--estimate")["estimate"]
        self.assertEqual(made["steps"], 150)
        self.assertGreaterEqual(made["steps_tried"], 10 + 3)  # of the hundred before it ten
        self.assertLessEqual(made["steps_tried"], 10 + 50)
        self.assertNotIn("not_tried_from", made)
        never = self.json_of("check", "sinking.toml", "--estimate", "--set", "analysis.steps=90")["estimate"]
        self.assertNotIn("not_tried_from", never)

    def test_of_a_model_without_analysis_is_that_of_what_it_has(self):
        self.copy_case("cube")
        made = self.json_of("check", "cube.toml", "--estimate")["estimate"]
        self.assertEqual((made["command"], made["steps"]), ("cut", 0))
        self.assertNotIn("estimate", self.json_of("check", "cube.toml"))


if __name__ == "__main__":
    unittest.main()
