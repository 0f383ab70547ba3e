"""Interruptions, readers that go away, and progress on a terminal."""
import json
import os
import pty
import re
import signal
import subprocess
import sys
import time
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "cli"))
from program import BINARY, ProgramTest  # noqa: E402


class Signals(ProgramTest):
    def interrupted(self, number, *arguments, after):
        """Sends a signal once `after()` says so; returns the finished process."""
        self.process = process = subprocess.Popen([BINARY, *arguments], cwd=self.folder, stdout=subprocess.PIPE,
                                                  stderr=subprocess.PIPE, text=True)
        end = time.monotonic() + 3000
        while not after() and process.poll() is None and time.monotonic() < end:
            time.sleep(0.02)
        process.send_signal(number)
        process.out, process.err = process.communicate()
        return process

    def states(self, name):
        """How many states a result holds, also one under way."""
        done = subprocess.run([BINARY, "info", name, "--json"], cwd=self.folder, capture_output=True, text=True, check=False)
        return len(json.loads(done.stdout)["states"]["step"]) if done.returncode == 0 else 0

    def minds_signals(self):
        """Whether the program catches SIGINT by now."""
        caught = re.search(r"SigCgt:\s*([0-9a-f]+)", Path(f"/proc/{self.process.pid}/status").read_text(encoding="ascii"))
        return int(caught.group(1), 16) >> (signal.SIGINT - 1) & 1

    def test_during_a_run_keep_the_states_so_far(self):
        self.copy_case("free_fall")
        for number, status in ((signal.SIGINT, 130), (signal.SIGTERM, 143)):
            partial = lambda: [name for name in self.files() if "partial" in name]
            process = self.interrupted(number, "run", "free_fall.toml", "--set", "analysis.end_time=5e5", after=partial)
            self.assertEqual(process.returncode, status, process.err)
            self.assertGreaterEqual(len(self.json_of("info", "free_fall.vtkhdf")["states"]["step"]), 1)
            self.assertFalse(partial())
            self.assertIn(" (interrupted) to t = ", process.out)
            self.assertRegex(process.err, r"warning: interrupted after \d+ of \d+ steps: the result ends at t = ")
            (self.folder / "free_fall.vtkhdf").unlink()

    def test_three_times_during_a_run_end_it_at_once_and_leave_no_partial_file(self):
        self.copy_case("free_fall")
        process = subprocess.Popen([BINARY, "run", "free_fall.toml", "--set", "analysis.end_time=5e5"], cwd=self.folder,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        partial = lambda: [path for path in self.folder.iterdir() if "partial" in path.name]
        while process.poll() is None and self.states("free_fall.vtkhdf") < 3:
            time.sleep(0.01)
        process.send_signal(signal.SIGINT)
        process.send_signal(signal.SIGTERM)  # a second SIGINT could come before the first is seen, and be one with it
        process.send_signal(signal.SIGINT)
        error = process.communicate()[1]
        self.assertIn(process.returncode, (130, 143), error)
        self.assertFalse(partial())
        self.assertGreaterEqual(len(self.json_of("info", "free_fall.vtkhdf")["states"]["step"]), 1)

    def test_during_cutting_leave_nothing(self):
        self.copy_case("cube")
        process = self.interrupted(signal.SIGINT, "cut", "cube.toml", "--set", "joint_set.1.spacing=0.02",
                                   "--set", "joint_set.2.spacing=0.02",
                                   after=self.minds_signals)
        self.assertEqual(process.returncode, 130)
        self.assertEqual(self.files(), ["cube.toml"])

    def test_a_reader_that_goes_away_is_no_news(self):
        self.copy_case("cube")
        process = subprocess.Popen([BINARY, "cut", "cube.toml", "--json"], cwd=self.folder, stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE)
        process.stdout.close()
        self.assertEqual(process.wait(), 3)
        self.assertEqual(process.stderr.read(), b"")
        process.stderr.close()
        self.assertIn("cube.vtkhdf", self.files())


class Progress(ProgramTest):
    def on_a_terminal(self, *arguments, **environment):
        """What the program writes to a terminal as its stderr."""
        controller, terminal = pty.openpty()
        settings = {key: value for key, value in os.environ.items() if key not in ("NO_COLOR", "LC_CTYPE", "LANG")}
        process = subprocess.Popen([BINARY, *arguments], cwd=self.folder, stdout=subprocess.DEVNULL, stderr=terminal,
                                   env=dict(settings, TERM="xterm", **{"LC_ALL": "C.UTF-8", **environment}))
        os.close(terminal)
        text = b""
        while True:
            try:
                chunk = os.read(controller, 4096)
            except OSError:  # the terminal's last user is gone
                break
            if not chunk:
                break
            text += chunk
        os.close(controller)
        self.assertEqual(process.wait(), 0)
        return text.decode()

    def fall(self, *options, **environment):
        """A fall of 500 steps."""
        self.copy_case("free_fall")
        return self.on_a_terminal("run", "free_fall.toml", "--set", "analysis.time_step=0.002", *options, **environment)

    def test_is_a_bar_that_ends_in_one_line_a_phase(self):
        text = self.fall()
        self.assertRegex(text, "\r[^\r]*━[^\r]* steps/s[^\r]* left")
        self.assertRegex(text, r"500 steps +[\d.]+ s")

    def test_needs_neither_colour_nor_unicode(self):
        text = self.fall(NO_COLOR="1", LC_ALL="C")
        self.assertIn("[#", text)
        self.assertFalse(re.search("\033\\[\\d*m", text))
        self.assertTrue(text.isascii())

    def test_is_absent_when_quiet_and_elsewhere(self):
        self.assertEqual(self.fall("--quiet"), "")
        self.copy_case("wedge")
        self.assertEqual(self.run_program("cut", "wedge.toml").stderr, "")


if __name__ == "__main__":
    unittest.main()
