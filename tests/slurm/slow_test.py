"""A sweep as a job array of Slurm: its own controller and node daemon, on this machine."""
import csv
import sys
import unittest
from pathlib import Path

for folder in ("cli", "batches"):
    sys.path.insert(0, str(Path(__file__).resolve().parent.parent / folder))
import cluster  # noqa: E402
from program import ProgramTest  # noqa: E402
from sweep_test import CUBE, DRAWN  # noqa: E402


class Slurm(ProgramTest):
    def setUp(self):
        super().setUp()
        if cluster.missing():
            self.skipTest(cluster.missing())
        self.write("cube.toml", CUBE)

    def table(self, folder):
        with open(self.folder / folder / "sweep.csv", encoding="utf-8") as file:
            return [{key: value for key, value in row.items() if key != "seconds"} for row in csv.DictReader(file)]

    def submit(self, slurm, folder):
        done = slurm.run(self.folder / folder / "submit.sh")
        self.assertEqual(done.returncode, 0, done.stderr)
        slurm.wait_until_done(300)

    def logs(self, folder):
        return "\n".join(path.read_text(encoding="utf-8") for path in sorted((self.folder / folder / "logs").iterdir()))

    def test_has_the_table_of_local_workers(self):
        self.write("drawn.toml", DRAWN.format(sampling="latin_hypercube", runs=24, workers=1))
        self.run_program("sweep", "drawn.toml", "-o", "local")
        scripts = self.json_of("sweep", "drawn.toml", "-o", "it's a folder", "--slurm", "5")
        self.assertEqual(scripts["totals"], {"runs": 24, "tasks": 5})
        with cluster.Cluster(self.folder / "slurm") as slurm:
            self.submit(slurm, "it's a folder")
        self.assertEqual(self.table("it's a folder"), self.table("local"), self.logs("it's a folder"))

    def test_submitted_again_computes_what_is_missing(self):
        self.write("drawn.toml", DRAWN.format(sampling="monte_carlo", runs=20, workers=1))
        self.run_program("sweep", "drawn.toml", "-o", "local")
        self.run_program("sweep", "drawn.toml", "-o", "array", "--slurm", "2")
        self.run_program("sweep", "drawn.toml", "-o", "array", "--part", "1/2")  # as if the second task had been lost
        self.run_program("sweep", "drawn.toml", "-o", "array", "--gather", status=1)
        self.assertEqual(len(self.table("array")), 10)
        parts = self.folder / "array" / "parts"
        before = (parts / "000001" / "sweep.journal").read_bytes()
        with cluster.Cluster(self.folder / "slurm") as slurm:
            self.submit(slurm, "array")
        self.assertEqual(self.table("array"), self.table("local"), self.logs("array"))
        self.assertEqual((parts / "000001" / "sweep.journal").read_bytes(), before)


if __name__ == "__main__":
    unittest.main()
