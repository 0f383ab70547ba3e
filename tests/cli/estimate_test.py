"""`check --estimate`: what a run takes, from its beginning."""
import os
import subprocess
import time
import unittest

from program import BINARY, ProgramTest


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

    def test_of_a_model_without_analysis_is_that_of_what_it_has(self):
        self.copy_case("cube")
        made = self.json_of("check", "cube.toml", "--estimate")["estimate"]
        self.assertEqual((made["command"], made["steps"]), ("cut", 0))
        self.assertNotIn("estimate", self.json_of("check", "cube.toml"))


if __name__ == "__main__":
    unittest.main()
