"""What a run records at every step: in the result file and in tables the same numbers as in its document."""
import csv
import unittest

import h5py
import numpy

from program import ProgramTest

TABLES = """
[[table]]
output = "monitors.csv"
kind = "monitors"
[[table]]
output = "energy.csv"
kind = "energy"
"""
WORDS = ["open", "stick", "slide"]


class Histories(ProgramTest):
    def run_case(self, name, *more):
        model = self.copy_case(name)
        model.write_text(model.read_text(encoding="utf-8") + TABLES, encoding="utf-8")
        return self.json_of("run", f"{name}.toml", *more)

    def rows_of(self, name):
        with open(self.folder / name, newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def test_of_a_point_are_those_of_the_document(self):
        document = self.run_case("free_fall")
        told = document["monitors"][0]
        with h5py.File(self.folder / "free_fall.vtkhdf") as file:
            stored = file["rockfold/monitors/1"]
            self.assertEqual(stored.attrs["name"].decode(), told["name"])
            self.assertNotIn("joint", stored.attrs)
            self.assertEqual(stored["stress"].attrs["unit"].decode(), "Pa")
            for name in ("time", "displacement", "velocity", "acceleration", "stress"):
                numpy.testing.assert_array_equal(stored[name][:], told[name])
            self.assertEqual(len(file["rockfold/monitors"]), len(document["monitors"]))
            numpy.testing.assert_array_equal(file["rockfold/energy/kinetic"][:], document["energy_history"]["kinetic"])
            self.assertNotIn("contacts_history", file["rockfold"])  # one block touches no other
        rows = [row for row in self.rows_of("monitors.csv") if row["monitor"] == told["name"]]
        self.assertEqual([float(row["time s"]) for row in rows], told["time"])
        self.assertEqual([float(row["velocity z m/s"]) for row in rows], [v[2] for v in told["velocity"]])
        energy = self.rows_of("energy.csv")
        self.assertEqual([float(row["kinetic J"]) for row in energy], document["energy_history"]["kinetic"])
        self.assertNotIn("slide", energy[0])

    def test_of_joints_and_contacts_are_those_of_the_document(self):
        model = self.copy_case("sliding_block")
        watch = '[[monitor]]\nname = "bed"\npoint = [0.5, 0.5, 0]\njoint = "block.interface"\n'
        model.write_text(model.read_text(encoding="utf-8") + watch + TABLES, encoding="utf-8")
        document = self.json_of("run", "sliding_block.toml", "--set", "analysis.end_time=0.2")
        told = next(m for m in document["monitors"] if "joint" in m)
        number = 1 + document["monitors"].index(told)
        with h5py.File(self.folder / "sliding_block.vtkhdf") as file:
            stored = file[f"rockfold/monitors/{number}"]
            self.assertEqual(stored.attrs["joint"].decode(), told["joint"])
            for name in ("time", "normal_stress", "shear_stress", "opening", "slip"):
                numpy.testing.assert_array_equal(stored[name][:], told[name])
            self.assertEqual([WORDS[int(s)] for s in stored["state"]], told["state"])
            for name, values in document["contacts_history"].items():
                numpy.testing.assert_array_equal(file[f"rockfold/contacts_history/{name}"][:], values)
        rows = [row for row in self.rows_of("monitors.csv") if row["monitor"] == told["name"]]
        self.assertEqual([row["state"] for row in rows], told["state"])
        self.assertEqual([float(row["slip m"]) for row in rows], told["slip"])
        self.assertEqual({row["displacement x m"] for row in rows}, {""})
        self.assertEqual([float(row["slide"]) for row in self.rows_of("energy.csv")], document["contacts_history"]["slide"])

    def test_tables_are_told_where_nothing_moves(self):
        model = self.copy_case("free_fall")
        model.write_text(model.read_text(encoding="utf-8") + TABLES, encoding="utf-8")
        self.run_program("cut", "free_fall.toml", "-q")
        self.assertNotIn("energy.csv", self.files())
        self.assertIn("[[table]]", self.json_of("cut", "free_fall.toml")["unused"])


if __name__ == "__main__":
    unittest.main()
