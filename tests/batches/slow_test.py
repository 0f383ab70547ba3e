"""Endurance: runs killed at random moments, and a large sweep that is killed with failures planted in it."""
import csv
import filecmp
import json
import os
import random
import signal
import subprocess
import sys
import time
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "cli"))
from program import BINARY, ProgramTest  # noqa: E402
from resume_test import STACK  # noqa: E402

KILLS = int(os.environ.get("ROCKFOLD_KILLS", "200"))
RUNS = int(os.environ.get("ROCKFOLD_SWEEP_RUNS", "1000"))

PLANTED = """
model = "cube.toml"
command = "cut"
[[parameter]]
key = "material.rock.density"
values = [{values}]
[[result]]
name = "blocks"
path = "totals.blocks"
"""


class Endurance(ProgramTest):
    def test_runs_killed_at_random_moments_come_to_the_same_end(self):
        self.write("stack.toml", STACK)
        began = time.monotonic()
        self.run_program("run", "stack.toml", "-o", "whole.vtkhdf")
        lasted = time.monotonic() - began
        draw = random.Random(20)
        for kill in range(KILLS):
            process = subprocess.Popen([BINARY, "run", "stack.toml", "-o", "part.vtkhdf"], cwd=self.folder,
                                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            time.sleep(draw.uniform(0, lasted))
            process.send_signal(signal.SIGKILL)
            process.wait()
            left = subprocess.run([BINARY, "info", "part.vtkhdf", "--json"], cwd=self.folder, capture_output=True, text=True, check=False)
            if left.returncode == 0:
                states = json.loads(left.stdout)["states"]["step"]
                self.assertEqual(states, list(range(len(states))))
            else:  # killed before it began
                self.assertEqual((left.returncode, (self.folder / "part.vtkhdf").exists()), (3, False))
                self.run_program("run", "stack.toml", "-o", "part.vtkhdf")
            self.run_program("resume", "part.vtkhdf")
            self.assertTrue(filecmp.cmp(self.folder / "whole.vtkhdf", self.folder / "part.vtkhdf", shallow=False), kill)
            self.assertEqual([name for name in self.files() if name.startswith("part.vtkhdf.")], [])
            (self.folder / "part.vtkhdf").unlink()

    def test_a_sweep_killed_twice_has_each_run_once(self):
        self.copy_case("cube")
        text = (self.folder / "cube.toml").read_text(encoding="utf-8")
        self.assertIn("[[material]]", text)
        name = text.split("[[material]]")[1].split('name = "')[1].split('"')[0]
        values = [str(2000 + run) for run in range(RUNS)]
        planted = list(range(37, RUNS, 100))
        for run in planted:
            values[run] = "-1"
        self.write("sweep.toml", PLANTED.format(values=", ".join(values)).replace("material.rock", f"material.{name}"))
        journal = self.folder / "sweep" / "sweep.journal"
        for share in (0.3, 0.6):
            process = subprocess.Popen([BINARY, "sweep", "sweep.toml"], cwd=self.folder, stdout=subprocess.DEVNULL,
                                       stderr=subprocess.DEVNULL)
            while process.poll() is None and not (journal.exists() and journal.read_bytes().count(b"\n") > share * RUNS):
                time.sleep(0.02)
            self.assertIsNone(process.poll())
            process.kill()
            process.wait()
            time.sleep(0.5)
        began, used = time.monotonic(), os.times()
        document = self.json_of("sweep", "sweep.toml", status=1)
        seconds, now = time.monotonic() - began, os.times()
        busy = now.children_user + now.children_system - used.children_user - used.children_system
        print(f"cores busy: {100 * busy / seconds / os.cpu_count():.0f} %", file=sys.stderr)
        self.assertEqual(document["totals"], {"runs": RUNS, "done": RUNS - len(planted), "failed": len(planted), "limit": 0})
        self.assertEqual([row["run"] for row in document["failed"]], [run + 1 for run in planted])
        with open(self.folder / "sweep" / "sweep.csv", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([int(row["run"]) for row in rows], list(range(1, RUNS + 1)))
        self.assertEqual(journal.read_bytes().count(b"\n"), RUNS + 1)


if __name__ == "__main__":
    unittest.main()
