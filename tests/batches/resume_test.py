"""Interrupted and killed runs go on to the end that they would have come to, bit by bit."""
import filecmp
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import time
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "cli"))
from program import BINARY, ProgramTest  # noqa: E402

# Blocks with contact, in two stages of which the second counts displacements anew; each step is stored.
STACK = """
[[material]]
name = "rock"
density = 2500
young_modulus = 5e9
poisson_ratio = 0.2
[[joint_material]]
name = "rough"
friction_angle = 20
[[solid]]
name = "rock"
shape = "box"
min = [0, 0, 0]
max = [1, 1, 3]
[[joint]]
name = "low"
dip = 0
dip_direction = 0
point = [0, 0, 1]
[[joint]]
name = "high"
dip = 25
dip_direction = 90
point = [0.5, 0.5, 2]
[cover]
lattice = "block"
[[fixed]]
where = {block_at = [0.5, 0.5, 0.5]}
[analysis]
time_step = 0.005
[[step]]
name = "settle"
type = "quasi_static"
time_step = 0.01
steps = 10
[[step]]
name = "slide"
type = "dynamic"
steps = 40
reset_displacement = true
[[monitor]]
name = "top"
point = [0.5, 0.5, 2.9]
[[monitor]]
name = "bed"
joint = "high"
point = [0.5, 0.5, 2]
[output]
every = 1
checkpoint_every = 0.02
"""

# What the stack stands on is dug away, all but what is held.
DUG = """
[[excavation]]
name = "pit"
shape = "box"
min = [0.6, -1, -1]
max = [2, 2, 1]
[[step]]
name = "dig"
type = "dynamic"
steps = 40
excavate = 1
"""


class Resume(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("stack.toml", STACK)

    def whole_run(self, name="whole.vtkhdf", *options):
        document = self.json_of("run", "stack.toml", "-o", name, *options)
        document.pop("seconds")
        return document

    def stopped(self, number, steps, name="part.vtkhdf", *options):
        """A run that a signal ended once `steps` states were there; its exit status. One that was through before the signal came is run again."""
        journal = self.folder / (name + ".journal")
        for _ in range(20):
            process = subprocess.Popen([BINARY, "run", "stack.toml", "-o", name, *options], cwd=self.folder,
                                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            while process.poll() is None:
                try:
                    if journal.stat().st_size > 3700 * steps + 3000:  # bytes of a state, and of the beginning
                        break
                except FileNotFoundError:
                    pass
                time.sleep(0.001)
            process.send_signal(number)
            status = process.wait()
            if status != 0:
                return status
            (self.folder / name).unlink()
        self.fail("no signal came in time")
        return None

    def states(self, name):
        done = subprocess.run([BINARY, "info", name, "--json"], cwd=self.folder, capture_output=True, text=True, check=False)
        return json.loads(done.stdout)["states"]["step"] if done.returncode == 0 else []

    def resumed(self, name="part.vtkhdf", *options):
        document = self.json_of("resume", name, *options)
        document.pop("seconds", None)  # a finished run is not computed again
        return document

    def test_interrupted_runs_end_as_whole_ones_byte_by_byte(self):
        whole = self.whole_run()
        for number, status, steps in ((signal.SIGINT, 130, 3), (signal.SIGTERM, 143, 30)):
            self.assertEqual(self.stopped(number, steps), status)
            left = self.json_of("info", "part.vtkhdf")
            self.assertEqual(left["unfinished"]["checkpoint"]["step"], left["states"]["step"][-1])
            self.assertEqual(self.resumed(), whole)
            self.assertTrue(filecmp.cmp(self.folder / "whole.vtkhdf", self.folder / "part.vtkhdf", shallow=False))
            self.assertNotIn("part.vtkhdf.journal", self.files())
            (self.folder / "part.vtkhdf").unlink()

    def test_rock_that_was_excavated_on_the_way_stays_away(self):
        self.write("stack.toml", STACK + DUG)
        whole = self.whole_run()
        self.assertEqual([block["excavated"] for block in whole["blocks"]].count(True), 1)
        self.assertEqual(len(whole["excavation"]["settled"]), 1)
        # While rock settles before the step goes on, and in the step.
        for steps in (82, 83, 98):
            self.assertEqual(self.stopped(signal.SIGINT, steps), 130)
            last = self.json_of("info", "part.vtkhdf")["states"]["step"][-1]
            self.assertEqual(self.resumed(), whole)
            self.assertTrue(filecmp.cmp(self.folder / "whole.vtkhdf", self.folder / "part.vtkhdf", shallow=False))
            (self.folder / "part.vtkhdf").unlink()
        self.assertGreater(last, 50)

    def test_killed_runs_too_with_all_states_that_were_stored(self):
        whole = self.whole_run()
        for steps in (1, 12, 35):
            self.assertEqual(self.stopped(signal.SIGKILL, steps), -signal.SIGKILL)
            left = self.states("part.vtkhdf")
            self.assertEqual(left, list(range(len(left))))
            self.assertGreaterEqual(len(left), steps)
            self.assertEqual(self.resumed(), whole)
            self.assertTrue(filecmp.cmp(self.folder / "whole.vtkhdf", self.folder / "part.vtkhdf", shallow=False))
            self.assertFalse([name for name in self.files() if "partial" in name or "checkpoint" in name])
            (self.folder / "part.vtkhdf").unlink()

    def test_hashes_of_states_are_those_of_any_number_of_threads(self):
        self.whole_run()
        hashes = self.json_of("info", "whole.vtkhdf", "--hashes")["states"]["hash"]
        self.assertEqual(len(set(hashes)), len(hashes))
        self.whole_run("two.vtkhdf", "--threads", "2")
        self.assertEqual(self.json_of("info", "two.vtkhdf")["states"]["hash"], hashes)
        self.stopped(signal.SIGKILL, 20, "part.vtkhdf", "--threads", "1")
        self.resumed("part.vtkhdf", "--threads", "4")
        self.assertEqual(self.json_of("info", "part.vtkhdf")["states"]["hash"], hashes)
        self.assertIn(f"step 50       {hashes[-1]}", self.run_program("info", "part.vtkhdf", "--hashes").stdout)

    def test_explicit_steps_too_have_the_same_states_on_any_number_of_threads(self):
        explicit = ("--set", "step.slide.scheme=explicit")
        whole = self.whole_run("whole.vtkhdf", "--threads", "1", *explicit)
        (substeps,) = whole["substeps"]
        self.assertEqual((substeps["step"], substeps["first"], substeps["steps"]), ("slide", 11, 40))
        self.assertGreater(substeps["substeps"], 40)
        hashes = self.json_of("info", "whole.vtkhdf", "--hashes")["states"]["hash"]
        for threads in ("2", "4"):
            self.whole_run(f"{threads}.vtkhdf", "--threads", threads, *explicit)
            self.assertEqual(self.json_of("info", f"{threads}.vtkhdf", "--hashes")["states"]["hash"], hashes)
        self.stopped(signal.SIGKILL, 20, "part.vtkhdf", "--threads", "1", *explicit)
        self.resumed("part.vtkhdf", "--threads", "4")
        self.assertEqual(self.json_of("info", "part.vtkhdf")["states"]["hash"], hashes)

    def test_a_finished_run_is_told_again_and_goes_on_to_another_end(self):
        whole = self.whole_run()
        self.assertEqual(self.resumed("whole.vtkhdf"), whole)
        longer = self.whole_run("longer.vtkhdf", "--set", "step.slide.steps=50")
        self.assertEqual(self.resumed("whole.vtkhdf", "--set", "step.slide.steps=50"), longer)
        self.assertNotEqual(longer, whole)

    def test_table_and_report_asked_for_on_the_command_line_are_written_again(self):
        self.write("stack.toml", STACK + "[support]\n")
        self.assertEqual(self.stopped(signal.SIGINT, 10, "part.vtkhdf", "--table", "keys.csv", "--report"), 130)
        table = (self.folder / "keys.csv").read_text()
        told = re.compile(r"<td>(\d+ steps to [0-9.]+ s)(, interrupted)?</td>")
        self.assertTrue(told.search((self.folder / "part.report.html").read_text()).group(2))
        (self.folder / "keys.csv").unlink()
        self.resumed()
        self.assertEqual((self.folder / "keys.csv").read_text(), table)
        self.assertEqual(told.search((self.folder / "part.report.html").read_text()).groups(), ("50 steps to 0.3 s", None))

    def test_an_interrupted_run_goes_on_to_another_end(self):
        longer = self.whole_run("longer.vtkhdf", "--set", "step.slide.steps=50")
        self.stopped(signal.SIGKILL, 25)
        self.assertEqual(self.resumed("part.vtkhdf", "--set", "step.slide.steps=50"), longer)

    def test_the_end_cannot_be_before_what_is_done(self):
        self.stopped(signal.SIGINT, 25)
        error = self.json_of("resume", "part.vtkhdf", "--set", "step.slide.steps=5", status=2)["error"]
        self.assertRegex(error["message"], r"has 5 steps, but \d+ are done already")
        error = self.json_of("resume", "part.vtkhdf", "--set", "step.settle.steps=5", status=2)["error"]
        self.assertIn("is over, its length cannot change", error["message"])

    def test_what_would_change_the_past_is_refused(self):
        self.stopped(signal.SIGINT, 10)
        error = self.json_of("resume", "part.vtkhdf", "--set", "material.rock.density=1", status=2)["error"]
        self.assertEqual((error["kind"], error["key"]), ("usage", "material.rock.density"))
        self.json_of("resume", "part.vtkhdf", "--seed", "3", status=2)

    def test_a_changed_model_is_refused_with_the_line(self):
        self.stopped(signal.SIGINT, 10)
        self.write("stack.toml", STACK.replace("density = 2500", "density = 2600"))
        error = self.json_of("resume", "part.vtkhdf", status=2)["error"]
        self.assertEqual((error["kind"], error["file"], error["line"]), ("model", "stack.toml", 4))
        self.assertIn("found 'density = 2600', was 'density = 2500'", error["message"])
        self.write("stack.toml", STACK + "# more\n")
        self.assertEqual(self.json_of("resume", "part.vtkhdf", status=2)["error"]["line"], STACK.count("\n") + 1)

    def test_a_model_that_is_gone_is_not_needed(self):
        whole = self.whole_run()
        self.stopped(signal.SIGINT, 10)
        (self.folder / "stack.toml").unlink()
        self.assertEqual(self.resumed(), whole)

    def test_changed_files_of_the_model_are_named(self):
        (self.folder / "joints.csv").write_text("x,y,z,dip,dip_direction,radius\n9,9,9,90,10,1\n")
        self.write("stack.toml", STACK + '[[joint_table]]\nfile = "joints.csv"\n')
        self.stopped(signal.SIGINT, 10)
        (self.folder / "joints.csv").write_text("x,y,z,dip,dip_direction,radius\n9,9,9,90,20,1\n")
        error = self.json_of("resume", "part.vtkhdf", status=2)["error"]
        self.assertTrue(error["file"].endswith("joints.csv"))
        self.assertIn("has changed since the run was started", error["message"])

    def test_a_state_cut_short_is_no_state(self):
        whole = self.whole_run()
        self.stopped(signal.SIGKILL, 30)
        journal = self.folder / "part.vtkhdf.journal"
        states = len(self.states("part.vtkhdf"))
        with open(journal, "ab") as file:
            file.write(b"half a record")
        self.assertEqual(len(self.states("part.vtkhdf")), states)
        self.assertEqual(self.resumed(), whole)

    def test_two_cannot_go_on_with_one_run(self):
        process = subprocess.Popen([BINARY, "run", "stack.toml", "-o", "part.vtkhdf", "--set", "step.slide.steps=100000"],
                                   cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        while not (self.folder / "part.vtkhdf.journal").exists():
            time.sleep(0.01)
        time.sleep(0.1)
        error = self.json_of("resume", "part.vtkhdf", status=3)["error"]
        self.assertIn("still under way", error["message"])
        process.kill()
        process.wait()

    def test_what_is_no_run_is_refused_in_words(self):
        self.copy_case("cube")
        self.run_program("cut", "cube.toml")
        error = self.json_of("resume", "cube.vtkhdf", status=3)["error"]
        self.assertIn("holds no run that came to its end", error["message"])
        self.assertIn("no such file", self.json_of("resume", "none.vtkhdf", status=3)["error"]["message"])
        self.write("text.vtkhdf", "no result")
        self.assertIn("is no HDF5 file", self.json_of("resume", "text.vtkhdf", status=3)["error"]["message"])
        self.write("other.vtkhdf.journal", "no journal at all")
        self.assertIn("is no journal", self.json_of("resume", "other.vtkhdf", status=3)["error"]["message"])

    def test_a_damaged_checkpoint_is_told(self):
        self.stopped(signal.SIGINT, 10)
        path = self.folder / "part.vtkhdf.checkpoint"
        data = bytearray(path.read_bytes())
        data[-5] ^= 1
        path.write_bytes(data)
        self.assertIn("is damaged", self.json_of("resume", "part.vtkhdf", status=3)["error"]["message"])

    def test_a_run_stops_after_its_time_and_goes_on(self):
        endless = ("--set", "step.slide.steps=1000000")
        error = self.json_of("run", "stack.toml", "-o", "part.vtkhdf", *endless, "--max-time", "1500 ms", status=1)["error"]
        self.assertEqual((error["kind"], error["key"]), ("analysis", "--max-time"))
        self.assertRegex(error["message"], r"needs more than 1.5 s: stopped after \d+ of 1000010 steps.*`rockfold resume part.vtkhdf` goes on")
        last = self.json_of("info", "part.vtkhdf")
        self.assertEqual(last["unfinished"]["checkpoint"]["step"], last["states"]["step"][-1])
        steps = last["states"]["step"][-1] + 10
        longer = self.whole_run("longer.vtkhdf", "--set", f"step.slide.steps={steps}")
        self.assertEqual(self.resumed("part.vtkhdf", "--set", f"step.slide.steps={steps}"), longer)

    def test_a_run_stops_before_it_needs_too_much_memory_and_goes_on(self):
        whole = self.whole_run()
        done = self.run_program("run", "stack.toml", "-o", "part.vtkhdf", "--max-memory", "1 MB", status=1)
        self.assertIn("--max-memory: the program needs more than 1 MB", done.stderr)
        # It may have had nothing to keep yet: no journal, or an empty one.
        journal = self.folder / "part.vtkhdf.journal"
        kept = journal.exists() and any(journal.read_bytes()[8:16])  # of the first record, whose head is written last
        go_on = self.resumed if kept else self.whole_run
        self.assertEqual(go_on("part.vtkhdf", "--max-memory", "20 GB"), whole)

    def test_what_was_stopped_before_it_had_kept_anything_is_to_be_run_again(self):
        for kept in (b"", b"RFJRNL01", b"RFJRNL01" + bytes(24)):
            with self.subTest(kept=kept):
                (self.folder / "part.vtkhdf.journal").write_bytes(kept)
                error = self.json_of("resume", "part.vtkhdf", status=3)["error"]
                self.assertIn("stopped before it had kept anything: run its model again", error["message"])

    def test_limits_of_the_program_are_amounts(self):
        for option, value in (("--max-time", "soon"), ("--max-time", "-1"), ("--max-time", "3 GB"), ("--max-memory", "0"),
                              ("--max-memory", "nan")):
            error = self.json_of("run", "stack.toml", f"{option}={value}", status=2)["error"]
            self.assertIn(f"{option}: '{value}' is no number of ", error["message"])

    @unittest.skipUnless(os.geteuid() == 0 and shutil.which("mount"), "mounting needs root")
    def test_a_full_disk_leaves_the_last_state_intact(self):
        disk = self.folder / "disk"
        disk.mkdir()
        if subprocess.run(["mount", "-t", "tmpfs", "-o", "size=2m", "none", disk], capture_output=True, check=False).returncode:
            self.skipTest("no mounting here")
        self.addCleanup(subprocess.run, ["umount", disk], check=False)
        whole = self.whole_run()
        self.json_of("run", "stack.toml", "-o", "disk/part.vtkhdf", status=3)
        states = self.states("disk/part.vtkhdf")
        self.assertGreater(len(states), 5)
        subprocess.run(["mount", "-o", "remount,size=50m", disk], check=True)
        self.assertEqual(self.resumed("disk/part.vtkhdf"), whole)


if __name__ == "__main__":
    unittest.main()
