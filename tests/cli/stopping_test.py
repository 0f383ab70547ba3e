"""Runs that a limit or a signal ends: what there is is printed, and kept."""
import json
import shutil
import signal
import subprocess
import time
import unittest

from program import BINARY, ProgramTest

ENDLESS = ("--set", "analysis.end_time=5e5")

# A cube that slides down a plane of 30°. With more than its strength it stands, in a trial that does not end.
SLIDING = """
gravity = [4.905, 0, -8.496]
[[material]]
density = 2500
young_modulus = 1e10
poisson_ratio = 0.25
[[joint_material]]
name = "plane"
friction_angle = 20
normal_stiffness = 1e9
shear_stiffness = 1e9
[[solid]]
name = "base"
shape = "box"
min = [-2, -2, -1]
max = [9, 2, 0]
[[solid]]
name = "cube"
shape = "box"
min = [-0.5, -0.5, 0]
max = [0.5, 0.5, 1]
interface = "plane"
[cover]
lattice = "block"
[[fixed]]
where = {block_at = [0, 0, -0.5]}
[[step]]
type = "dynamic"
time_step = 0.01
end_time = 1e6
[reduction]
factors = [0.3, 2]
"""


class Stopping(ProgramTest):
    def setUp(self):
        super().setUp()
        self.copy_case("free_fall")

    def limit(self):
        """s, enough for the first steps of a run, however busy the machine is."""
        began = time.monotonic()
        self.run_program("run", "free_fall.toml", "--no-result")
        return f"{1 + 3 * (time.monotonic() - began):.1f}"

    def states(self):
        return self.json_of("info", "free_fall.vtkhdf")["states"]["step"]

    def test_a_limit_of_time_prints_the_summary_then_the_error(self):
        limit = self.limit()
        done = self.run_program("run", "free_fall.toml", *ENDLESS, "--max-time", limit, status=1)
        self.assertRegex(done.stdout, r"steps +[\d,]+ of [\d,]+ \(interrupted\) to t = ")
        self.assertIn("largest displacement", done.stdout)
        self.assertRegex(done.stderr, r"--max-time: the program needs more than [\d.]+ s: stopped after \d+ of \d+ steps.*`rockfold resume free_fall.vtkhdf` goes on")
        self.assertGreaterEqual(len(self.states()), 1)

    def test_a_limit_of_time_is_an_error_in_a_document_that_tells_what_there_is(self):
        document = self.json_of("run", "free_fall.toml", *ENDLESS, "--max-time", self.limit(), "--json-file", "kept.json", status=1)
        self.assertTrue(document["totals"]["interrupted"])
        self.assertGreater(document["totals"]["steps"], 0)
        self.assertEqual(len(document["monitors"][0]["time"]), document["totals"]["steps"] + 1)
        self.assertEqual((document["error"]["kind"], document["error"]["key"]), ("analysis", "--max-time"))
        self.assertEqual(self.states()[-1], document["totals"]["steps"])
        self.assertEqual(json.loads((self.folder / "kept.json").read_text(encoding="utf-8"))["error"], document["error"])

    def test_without_a_result_the_answer_is_there(self):
        document = self.json_of("run", "free_fall.toml", *ENDLESS, "--max-time", self.limit(), "--no-result", status=1)
        self.assertGreater(document["totals"]["steps"], 0)
        self.assertIn("nothing is stored", document["error"]["message"])

    def test_an_end_in_time_is_none_by_the_limit(self):
        document = self.json_of("run", "free_fall.toml", "--max-time", "1000")
        self.assertFalse(document["totals"]["interrupted"])
        self.assertNotIn("error", document)

    def answered(self, stop):
        """What stop() returns: out, err. On a machine so busy that the second after two signals is over first there is no answer: then again."""
        for _ in range(5):
            for name in self.files():
                if name.startswith("free_fall.vtkhdf"):
                    (self.folder / name).unlink()
            out, err = stop()
            self.assertFalse([name for name in self.files() if "partial" in name])
            self.assertGreaterEqual(len(self.states()), 1)
            if "interrupted again" not in err:
                break
        return out

    @unittest.skipUnless(shutil.which("timeout"), "needs timeout")
    def test_timeout_leaves_states_and_the_answer(self):
        limit = self.limit()

        def stop(*options):
            done = subprocess.run(["timeout", limit, BINARY, "run", "free_fall.toml", *ENDLESS, *options], cwd=self.folder, text=True,
                                  capture_output=True, timeout=280, check=False)
            self.assertEqual(done.returncode, 124, done.stderr)
            return done.stdout, done.stderr

        self.assertIn("(interrupted) to t = ", self.answered(stop))
        document = json.loads(self.answered(lambda: stop("--json")))
        self.assertTrue(document["totals"]["interrupted"])
        self.assertEqual(self.states()[-1], document["totals"]["steps"])

    def running(self):
        """A run that has stored its first states."""
        process = subprocess.Popen([BINARY, "run", "free_fall.toml", *ENDLESS, "--json"], cwd=self.folder, stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, text=True)
        stored = 0
        while process.poll() is None and stored < 3:
            done = subprocess.run([BINARY, "info", "free_fall.vtkhdf", "--json"], cwd=self.folder, capture_output=True, text=True, check=False)
            stored = len(json.loads(done.stdout)["states"]["step"]) if done.returncode == 0 else 0
        return process

    def test_two_signals_in_a_row_are_one_request(self):
        for first, second in ((signal.SIGTERM, signal.SIGTERM), (signal.SIGINT, signal.SIGTERM)):
            with self.subTest(first=first, second=second):
                def stop():
                    process = self.running()
                    process.send_signal(first)
                    time.sleep(0.001)
                    process.send_signal(second)
                    out, err = process.communicate(timeout=280)
                    self.assertIn(process.returncode, (128 + first, 128 + second), err)
                    return out, err

                document = json.loads(self.answered(stop))
                self.assertTrue(document["totals"]["interrupted"])
                self.assertEqual(self.states()[-1], document["totals"]["steps"])

    def test_a_search_for_a_reduction_tells_its_trials(self):
        self.write("slide.toml", SLIDING)
        limit = self.limit()
        document = self.json_of("run", "slide.toml", "--max-time", limit, status=1)
        found = document["reduction"]
        self.assertIsNone(found["factor"])
        # The factor is tan 20° / tan 30° = 0.63: it fails with 1 and 0.65, half way between 0.3 and 1.
        self.assertEqual((found["stands"], found["fails"]), (None, 0.65))
        self.assertEqual([(trial["factor"], trial["stands"]) for trial in found["trials"]], [(1, False), (0.65, False)])
        self.assertRegex(document["error"]["message"], r"stopped in the search for the factor of \[reduction\], which is below 0.65;")
        told = self.run_program("run", "slide.toml", "--max-time", limit, status=1)
        self.assertIn("the search was not finished: it is below 0.65 (2 trials)", told.stdout)
        self.assertIn("--max-time", told.stderr)


if __name__ == "__main__":
    unittest.main()
