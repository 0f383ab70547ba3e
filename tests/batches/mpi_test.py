"""`mpirun rockfold sweep`: several processes take runs from one queue."""
import csv
import os
import shutil
import signal
import subprocess
import sys
import time
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "cli"))
from program import BINARY, ProgramTest  # noqa: E402
from sweep_test import CUBE, DRAWN, SWEEP  # noqa: E402

MPIRUN = shutil.which("mpirun") or shutil.which("mpiexec")
MODULE = Path(BINARY).parent / "rockfold_mpi.so"
ROOT = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}


class Alone(ProgramTest):
    def test_a_program_without_the_module_refuses_several_processes(self):
        """Each of them would do the whole sweep. A copy has no module beside it."""
        self.write("cube.toml", CUBE)
        self.write("sweep.toml", SWEEP)
        copy = shutil.copy(BINARY, self.folder / "rockfold")
        done = subprocess.run([copy, "sweep", "sweep.toml"], cwd=self.folder, env=dict(os.environ, OMPI_COMM_WORLD_SIZE="2"),
                              capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("was started several times by MPI", done.stderr)

    def test_the_program_itself_does_not_link_mpi(self):
        done = subprocess.run(["ldd", BINARY], capture_output=True, text=True, check=False)
        self.assertNotIn("libmpi", done.stdout)


@unittest.skipUnless(MPIRUN and MODULE.exists(), "no mpirun, or the program was built without MPI")
class Mpi(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("cube.toml", CUBE)

    def table(self, folder):
        with open(self.folder / folder / "sweep.csv", encoding="utf-8") as file:
            return [{key: value for key, value in row.items() if key != "seconds"} for row in csv.DictReader(file)]

    def mpirun(self, *arguments):
        command = [MPIRUN, "-n", "2", "--oversubscribe", BINARY, *arguments]
        return subprocess.Popen(command, cwd=self.folder, env=dict(os.environ, **ROOT), stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                text=True)

    def test_two_ranks_have_the_table_of_local_workers(self):
        self.write("drawn.toml", DRAWN.format(sampling="latin_hypercube", runs=16, workers=1))
        self.run_program("sweep", "drawn.toml", "-o", "local")
        process = self.mpirun("sweep", "drawn.toml", "-o", "two")
        out, err = process.communicate(timeout=250)
        self.assertEqual(process.returncode, 0, out + err)
        self.assertEqual(self.table("two"), self.table("local"))
        self.assertEqual(out.count("16 of 16 done"), 1, out)
        self.assertEqual((self.folder / "two" / "sweep.journal").read_bytes().count(b"\n"), 17)

    def test_failed_runs_of_all_ranks_are_named(self):
        self.write("sweep.toml", SWEEP)
        process = self.mpirun("sweep", "sweep.toml", "-o", "two")
        out, err = process.communicate(timeout=250)
        self.assertEqual(process.returncode, 1, out + err)
        self.assertEqual([row["status"] for row in self.table("two")], ["done", "failed"] * 3)

    def test_killed_it_goes_on_and_runs_nothing_twice(self):
        self.write("drawn.toml", DRAWN.format(sampling="monte_carlo", runs=40, workers=1))
        process = self.mpirun("sweep", "drawn.toml", "-o", "two")
        journal = self.folder / "two" / "sweep.journal"
        end = time.monotonic() + 100
        while process.poll() is None and time.monotonic() < end and not (journal.exists() and journal.read_bytes().count(b"\n") > 5):
            time.sleep(0.01)
        process.send_signal(signal.SIGTERM)
        process.communicate(timeout=100)
        time.sleep(0.5)
        before = journal.read_text(encoding="utf-8").splitlines()
        self.run_program("sweep", "drawn.toml", "-o", "two")
        after = journal.read_text(encoding="utf-8").splitlines()
        self.assertEqual(after[:len(before)], before)
        self.assertEqual(len(after), 41)


if __name__ == "__main__":
    unittest.main()
