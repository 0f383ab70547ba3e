"""Sweeps: many runs of one model, whatever becomes of some of them."""
import csv
import io
import signal
import subprocess
import sys
import time
import unittest
from pathlib import Path

import h5py

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "cli"))
from program import BINARY, ProgramTest  # noqa: E402
from report_test import HOSTILE, Report  # noqa: E402

CUBE = """
[[material]]
name = "rock"
density = 2600
[[solid]]
name = "rock"
shape = "box"
min = [0, 0, 0]
max = [4, 1, 1]
[[joint_set]]
name = "J"
dip = 90
dip_direction = 90
spacing = 1
origin = [0.5, 0, 0]
"""

SWEEP = """
model = "cube.toml"
command = "cut"
[[parameter]]
key = "joint_set.J.spacing"
values = [0.5, 1, 2]
[[parameter]]
key = "material.rock.density"
values = [2000, -1]
[[result]]
name = "blocks"
path = "totals.blocks"
[[result]]
name = "last volume"
path = "blocks.-1.volume"
[[event]]
name = "many"
when = "blocks > 4"
"""

# The second of its runs does not end.
ENDLESS = """
model = "free_fall.toml"
command = "run"
[[parameter]]
key = "analysis.end_time"
values = [0.1, 1e6]
"""

DRAWN = """
model = "cube.toml"
command = "cut"
sampling = "{sampling}"
runs = {runs}
seed = 7
workers = {workers}
[[parameter]]
key = "joint_set.J.spacing"
distribution = "normal"
mean = 1.0
standard_deviation = 0.3
min = 0.5
max = 2.0
[[parameter]]
key = "joint_set.J.dip"
values = [80, 90]
[[result]]
name = "blocks"
path = "totals.blocks"
"""


class Sweep(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("cube.toml", CUBE)

    def table(self, folder="sweep"):
        return list(csv.DictReader(io.StringIO((self.folder / folder / "sweep.csv").read_text(encoding="utf-8"))))

    def test_all_combinations_with_failed_ones_named(self):
        self.write("sweep.toml", SWEEP)
        done = self.run_program("sweep", "sweep.toml", status=1)
        rows = self.table()
        self.assertEqual(list(rows[0]), ["run", "status", "seconds", "error", "joint_set.J.spacing", "material.rock.density",
                                         "blocks", "last volume", "many"])
        self.assertEqual([row["run"] for row in rows], ["1", "2", "3", "4", "5", "6"])
        self.assertEqual([row["joint_set.J.spacing"] for row in rows], ["0.5", "0.5", "1", "1", "2", "2"])
        self.assertEqual([row["status"] for row in rows], ["done", "failed"] * 3)
        self.assertEqual([(row["blocks"], row["many"]) for row in rows[::2]], [("8", "true"), ("5", "true"), ("3", "false")])
        self.assertEqual(float(rows[4]["last volume"]), 1.5)
        self.assertEqual((rows[1]["blocks"], rows[1]["many"]), ("", ""))
        self.assertIn("found -1, must be > 0", rows[1]["error"])
        self.assertRegex(done.stdout, r"3 of 6 done, 3 failed")
        self.assertIn("run 2 ", done.stdout)
        self.assertFalse([path for path in (self.folder / "sweep" / "runs").iterdir() if "vtkhdf" in path.name])

    def test_tables_of_a_model_are_each_runs_own(self):
        self.copy_case("wedge")
        with open(self.folder / "wedge.toml", "a", encoding="utf-8") as file:
            file.write('\n[[table]]\noutput = "keys.csv"\nkind = "keyblocks"\n')
        self.write("sweep.toml", 'model = "wedge.toml"\ncommand = "support"\nworkers = 4\n[[parameter]]\n'
                   'key = "support.target_factor_of_safety"\nvalues = [1, 1.5, -1, 2]\n'
                   '[[result]]\nname = "force"\npath = "totals.support_force"\n')
        self.run_program("sweep", "sweep.toml", status=1)
        self.assertEqual([row["status"] for row in self.table()], ["done", "done", "failed", "done"])
        self.assertEqual(sorted(path.name for path in (self.folder / "sweep" / "runs").iterdir()), ["000003.json", "000003.log"])
        self.assertNotIn("keys.csv", self.files())

    def test_document_and_hdf5_tell_the_same(self):
        self.write("sweep.toml", SWEEP.replace("2000, -1", "2000"))
        document = self.json_of("sweep", "sweep.toml", "-o", "out")
        self.assertEqual(document["totals"], {"runs": 3, "done": 3, "failed": 0, "limit": 0})
        blocks = document["results"][0]
        self.assertEqual((blocks["count"], blocks["min"], blocks["p50"], blocks["max"]), (3, 3, 5, 8))
        self.assertAlmostEqual(blocks["mean"], 16 / 3)
        self.assertAlmostEqual(blocks["standard_deviation"] ** 2, (64 + 25 + 9 - 256 / 3) / 2)
        self.assertEqual(blocks["rank_correlation"]["joint_set.J.spacing"], -1)
        event = document["events"][0]
        self.assertEqual((event["met"], event["count"]), (2, 3))
        self.assertLess(event["low"], 2 / 3)
        self.assertLess(2 / 3, event["high"])
        with h5py.File(self.folder / "out" / "sweep.h5") as file:
            self.assertEqual(list(file["run"]), [1, 2, 3])
            self.assertEqual(list(file["results/value"][0]), [8, 5, 3])
            self.assertEqual(list(file["parameters/value"][0]), [0.5, 1, 2])
            self.assertEqual(list(file["events/value"][0]), [1, 1, 0])

    def test_runs_without_a_number_count_as_the_event_says(self):
        # Joints 0.5, 1 and 2 m apart leave 8, 5 and 3 blocks: the last run has no fifth one.
        event = '[[event]]\nname = "{}"\nwhen = "fifth > 0.2"\nnull = "{}"\n'
        sweep = SWEEP.replace("2000, -1", "2000").replace('path = "blocks.-1.volume"', 'path = "blocks.4.volume"').replace('"last volume"', '"fifth"')
        self.write("sweep.toml", sweep + event.format("of all", "false") + event.format("given one", "exclude"))
        done = self.run_program("sweep", "sweep.toml", "--report")
        rows = self.table()
        self.assertEqual([(row["fifth"] != "", row["of all"], row["given one"]) for row in rows],
                         [(True, "true", "true"), (True, "true", "true"), (False, "false", "")])
        note = "1 of 3 runs have no number there (null): "
        for text in (done.stdout, (self.folder / "sweep" / "sweep.html").read_text(encoding="utf-8").replace("&quot;", '"')):
            self.assertIn(note + 'counted as not happened (null = "false")', text)
            self.assertIn(note + 'left out (null = "exclude")', text)
        self.assertRegex(done.stdout, r"of all +fifth > 0.2 +2 of 3 +66.7 %")
        self.assertRegex(done.stdout, r"given one +fifth > 0.2 +2 of 2 +100 %")
        events = self.json_of("sweep", "sweep.toml")["events"]
        self.assertEqual([(e["met"], e["count"], e["null"], e["null_runs"]) for e in events],
                         [(2, 3, "false", 0), (2, 3, "false", 1), (2, 2, "exclude", 1)])
        self.assertAlmostEqual(events[2]["clopper_pearson"]["low"], 0.025 ** 0.5)
        with h5py.File(self.folder / "sweep" / "sweep.h5") as file:
            self.assertEqual([list(column) for column in file["events/value"][1:]], [[1, 1, 0], [1, 1, -1]])

    def test_an_event_on_a_misspelt_path_is_not_counted(self):
        self.write("sweep.toml", SWEEP.replace("2000, -1", "2000").replace('"totals.blocks"', '"totals.block"'))
        done = self.run_program("sweep", "sweep.toml")
        self.assertIn("no run's document has a number at totals.block", done.stderr)
        self.assertRegex(done.stdout, r"many +blocks > 4 +0 of 0 +-")
        self.assertEqual({row["many"] for row in self.table()}, {""})

    def test_samples_depend_on_the_seed_alone(self):
        tables = []
        for sampling, workers in (("latin_hypercube", 1), ("latin_hypercube", 3), ("monte_carlo", 2)):
            self.write("drawn.toml", DRAWN.format(sampling=sampling, runs=8, workers=workers))
            self.run_program("sweep", "drawn.toml", "-o", f"{sampling}{workers}")
            tables.append([{key: value for key, value in row.items() if key != "seconds"} for row in self.table(f"{sampling}{workers}")])
        self.assertEqual(tables[0], tables[1])
        self.assertNotEqual(tables[0], tables[2])
        drawn = sorted(float(row["joint_set.J.spacing"]) for row in tables[0])
        self.assertTrue(0.5 <= drawn[0] and drawn[-1] <= 2)
        self.assertTrue(drawn[3] <= 1.0083 and drawn[4] >= 0.99, drawn)  # one value in each eighth of the distribution
        self.assertEqual(sorted(row["joint_set.J.dip"] for row in tables[0]), ["80"] * 4 + ["90"] * 4)

    def test_a_killed_sweep_goes_on_and_runs_nothing_twice(self):
        self.write("drawn.toml", DRAWN.format(sampling="monte_carlo", runs=30, workers=2))
        process = subprocess.Popen([BINARY, "sweep", "drawn.toml"], cwd=self.folder, stdout=subprocess.DEVNULL,
                                   stderr=subprocess.DEVNULL)
        journal = self.folder / "drawn" / "sweep.journal"
        while process.poll() is None and not (journal.exists() and journal.read_bytes().count(b"\n") > 5):
            time.sleep(0.01)
        process.kill()
        process.wait()
        time.sleep(0.2)  # for its runs to end with it
        before = journal.read_text(encoding="utf-8").splitlines()
        self.run_program("sweep", "drawn.toml")
        after = journal.read_text(encoding="utf-8").splitlines()
        self.assertEqual(after[:len(before)], before)
        self.assertEqual(len(after), 31)
        self.assertEqual([row["run"] for row in self.table("drawn")], [str(run) for run in range(1, 31)])
        self.run_program("sweep", "drawn.toml")
        self.assertEqual(journal.read_text(encoding="utf-8").splitlines(), after)

    def table_after(self, number):
        self.write("drawn.toml", DRAWN.format(sampling="monte_carlo", runs=400, workers=2))
        process = subprocess.Popen([BINARY, "sweep", "drawn.toml"], cwd=self.folder, stdout=subprocess.DEVNULL,
                                   stderr=subprocess.PIPE, text=True)
        journal = self.folder / "drawn" / "sweep.journal"
        while not (journal.exists() and journal.read_bytes().count(b"\n") > 4):
            time.sleep(0.01)
        process.send_signal(number)
        return process, process.communicate()[1]

    def test_ctrl_c_keeps_what_has_ended(self):
        process, error = self.table_after(signal.SIGINT)
        self.assertEqual(process.returncode, 130)
        self.assertIn("the same command goes on", error)
        self.assertGreaterEqual(len(self.table("drawn")), 4)
        self.assertEqual({row["status"] for row in self.table("drawn")}, {"done"})

    def test_a_run_beyond_its_time_is_ended_and_named(self):
        self.copy_case("free_fall")
        began = time.monotonic()
        self.run_program("run", "free_fall.toml", "--set", "analysis.end_time=0.1")
        limit = 1 + 5 * (time.monotonic() - began)  # for slow builds too
        self.write("slow.toml", ENDLESS + f"[limits]\ntime = {limit}\n")
        self.run_program("sweep", "slow.toml", status=1)
        self.assertEqual([row["status"] for row in self.table("slow")], ["done", "limit"])
        self.assertIn("longer than limits.time", self.table("slow")[1]["error"])

    def test_a_run_with_more_memory_than_it_may_have_is_ended_and_named(self):
        self.write("fat.toml", SWEEP.replace("[0.5, 1, 2]", "[1, 0.00001]").replace("2000, -1", "2000")
                   + "[limits]\nmemory = \"500 MB\"\n")
        self.run_program("sweep", "fat.toml", status=1)
        self.assertEqual([row["status"] for row in self.table("fat")], ["done", "limit"])
        self.assertIn("more than limits.memory", self.table("fat")[1]["error"])

    def test_the_report_shows_all_runs_and_what_results_depend_on(self):
        name = HOSTILE.replace("\\", "").replace('"', "")
        self.write("sweep.toml", SWEEP.replace('"last volume"', f"'{name}'"))
        self.run_program("sweep", "sweep.toml", "--report", status=1)
        text = (self.folder / "sweep" / "sweep.html").read_text(encoding="utf-8")
        page = Report(text)
        self.assertFalse([tag for tag, _ in page.tags if tag in ("script", "img", "link", "iframe")])
        self.assertIn(name, page.headings)
        (blocks,) = [row for row in page.table("Mean") if row["Result"] == "blocks"]
        self.assertEqual((blocks["Runs"], blocks["Mean"], blocks["Least"], blocks["Greatest"]), ("3", "5.333", "3", "8"))
        (event,) = page.table("Event")
        self.assertEqual((event["Event"], event["Runs"], event["Probability%"]), ("many", "2 of 3", "66.7"))
        self.assertEqual([row["Run"] for row in page.table("Times")], ["1", "2", "3", "4", "5", "6"])
        self.assertEqual([row["Run"] for row in page.table("Error")], ["2", "4", "6"])
        self.assertEqual(page.text.count("r -1.00"), 1)  # of the blocks with the spacing of joints

    def test_parts_give_the_table_of_the_whole(self):
        self.write("drawn.toml", DRAWN.format(sampling="monte_carlo", runs=7, workers=2))
        self.run_program("sweep", "drawn.toml", "-o", "whole")
        for part in (1, 3, 2):
            self.run_program("sweep", "drawn.toml", "-o", "parts", "--part", f"{part}/3", "--workers", "1")
            done = self.run_program("sweep", "drawn.toml", "-o", "parts", "--gather", status=0 if part == 2 else 1)
        self.assertIn("7 of 7 done", done.stdout)
        same = [[{**row, "seconds": ""} for row in self.table(folder)] for folder in ("whole", "parts")]
        self.assertEqual(same[0], same[1])
        error = self.json_of("sweep", "drawn.toml", "--part", "4/3", status=2)["error"]
        self.assertIn("'4' is no whole number from 1 to 3", error["message"])
        self.json_of("sweep", "drawn.toml", "--part", "1/3", "--gather", status=2)

    def test_another_sweep_in_the_same_folder_is_refused_with_what_differs(self):
        self.write("sweep.toml", SWEEP)
        self.run_program("sweep", "sweep.toml", status=1)
        self.write("sweep.toml", SWEEP.replace("[0.5, 1, 2]", "[0.5, 1]"))
        self.assertIn("other runs: 6 there, 4 here", self.json_of("sweep", "sweep.toml", status=2)["error"]["message"])
        self.write("sweep.toml", SWEEP.replace("[0.5, 1, 2]", "[0.5, 1, 3]"))
        self.assertIn("other values", self.json_of("sweep", "sweep.toml", status=2)["error"]["message"])
        self.write("sweep.toml", SWEEP)
        self.write("cube.toml", CUBE + "# changed\n")
        self.assertIn("other model", self.json_of("sweep", "sweep.toml", status=2)["error"]["message"])

    def test_one_value_for_several_keys_of_the_whole_mass(self):
        self.copy_case("driving_wedge")
        self.write("sweep.toml", """
model = "driving_wedge.toml"
command = "stability"
[[parameter]]
name = "g"
keys = ["support.seismic_coefficient"]
values = [[0, 0, 0], [-0.1, 0, 0], [0.1, 0, 0]]
[[result]]
name = "factor"
path = "stability.sliding.factor"
""")
        self.run_program("sweep", "sweep.toml")
        rows = self.table()
        self.assertEqual([row["g"] for row in rows], ["[0, 0, 0]", "[-0.1, 0, 0]", "[0.1, 0, 0]"])
        still, one_way, other_way = (float(row["factor"]) for row in rows)
        self.assertLess(min(one_way, other_way), still)
        self.assertGreater(max(one_way, other_way), still)

    def test_whole_numbers_are_drawn_as_such(self):
        sweep = ('model = "cube.toml"\ncommand = "cut"\nsampling = "monte_carlo"\nruns = 2\n[[parameter]]\nkey = "joint_set.J.random.seed"\n'
                 'distribution = "uniform"\nmin = 1\nmax = 9\n')
        self.write("cube.toml", CUBE.replace("spacing = 1\norigin = [0.5, 0, 0]\n", "random = {seed = 1, spacing = 2}\n"))
        self.write("sweep.toml", sweep)
        message = self.json_of("sweep", "sweep.toml", status=2)["error"]["message"]
        self.assertRegex(message, r"found \d\.\d+, must be an integer .*integer = true in its \[\[parameter\]\]")
        self.write("sweep.toml", sweep + "integer = true\n")
        self.run_program("sweep", "sweep.toml")

    def test_seeds_of_all_sets_are_those_of_the_option(self):
        disc = '[[joint_set]]\nname = "{}"\ndip = {}\ndip_direction = 90\nrandom = {{count = 5, radius = 3}}\n'
        self.write("cube.toml", CUBE + disc.format("A", 40) + disc.format("B", 80))
        self.write("sweep.toml", 'model = "cube.toml"\ncommand = "cut"\nsampling = "monte_carlo"\nruns = 3\n[[parameter]]\n'
                   'key = "--seed"\ndistribution = "uniform"\nmin = 1\nmax = 100000\ninteger = true\n'
                   '[[result]]\nname = "blocks"\npath = "totals.blocks"\n')
        self.run_program("sweep", "sweep.toml")
        rows = self.table()
        self.assertEqual(len({row["--seed"] for row in rows}), 3)
        for row in rows:
            document = self.json_of("cut", "cube.toml", "--seed", row["--seed"])
            self.assertEqual(row["blocks"], str(document["totals"]["blocks"]))
        self.write("wrong.toml", 'model = "cube.toml"\ncommand = "cut"\n[[parameter]]\nkey = "--seed"\nvalues = [1, 2.5]\n')
        self.assertIn("found '2.5', seeds are whole numbers", self.json_of("sweep", "wrong.toml", status=2)["error"]["message"])

    def test_two_sets_of_one_seed_are_told(self):
        disc = '[[joint_set]]\nname = "{}"\ndip = {}\ndip_direction = 90\nrandom = {{seed = 4, count = 5, radius = 3}}\n'
        self.write("cube.toml", CUBE + disc.format("A", 40) + disc.format("B", 80))
        self.assertIn("joint_set[3].random.seed: is 4, that of joint set 'A' too", self.run_program("check", "cube.toml").stderr)
        self.assertNotIn("that of joint set", self.run_program("check", "cube.toml", "--seed", "4").stderr)

    def test_mistakes_are_told_all_at_once_with_their_places(self):
        self.write("sweep.toml", SWEEP.replace("sampling", "samplin").replace('"cut"', '"cute"').replace('"blocks > 4"', '"block > 4"')
                   + '[limits]\nmemory = "much"\n')
        errors = self.json_of("sweep", "sweep.toml", status=2)["error"]["errors"]
        self.assertEqual([(error["line"], error["key"]) for error in errors],
                         [(3, "command"), (18, "event[1].when"), (20, "limits.memory")])
        self.assertIn('did you mean "blocks"', errors[1]["message"])
        self.write("sweep.toml", SWEEP.replace("joint_set.J.", "joint_set.K."))
        self.assertIn('no entry named "K"', self.json_of("sweep", "sweep.toml", status=2)["error"]["message"])
        self.write("sweep.toml", SWEEP.replace("J.spacing", "J.spcing"))
        error = self.json_of("sweep", "sweep.toml", status=2)["error"]
        self.assertEqual(error["key"], "joint_set[1].spcing")
        self.assertIn('unknown key "spcing", did you mean "spacing"?', error["message"])
        self.assertNotIn("sweep", self.files())
        self.assertEqual(self.json_of("sweep", "none.toml", status=3)["error"]["kind"], "io")


if __name__ == "__main__":
    unittest.main()
