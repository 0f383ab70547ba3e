"""output.compression: smaller files that hold the same numbers."""
import unittest

import h5py
import numpy

from program import ProgramTest

# A bar that springs: its covers, elements and blocks move in every state.
BAR = """
[[material]]
density = 2500
young_modulus = 1e8
poisson_ratio = 0.25
[[solid]]
name = "bar"
shape = "box"
min = [0, 0, 0]
max = [12, 2, 2]
[cover]
spacing = 0.25
[[fixed]]
where = {face = "bar.zmin"}
[analysis]
type = "dynamic"
time_step = 0.002
steps = 6
[output]
every = 2
"""


def arrays_of(path):
    found = {}
    with h5py.File(path) as file:
        file["VTKHDF"].visititems(lambda name, item: found.update({name: item[()]}) if isinstance(item, h5py.Dataset) else None)
        for name in ("displacement", "velocity", "hash", "time"):
            found["states/" + name] = file["rockfold/states/" + name][()]
    return found


class CompressedStates(ProgramTest):
    def test_hold_the_same_numbers_in_less_room(self):
        self.write("bar.toml", BAR)
        for level in (0, 1, 9):
            self.run_program("run", "bar.toml", "-q", "-o", f"{level}.vtkhdf", "--set", f"output.compression={level}")
        plain = arrays_of(self.folder / "0.vtkhdf")
        size = {level: (self.folder / f"{level}.vtkhdf").stat().st_size for level in (0, 1, 9)}
        for level in (1, 9):
            packed = arrays_of(self.folder / f"{level}.vtkhdf")
            self.assertEqual(packed.keys(), plain.keys())
            for name, values in plain.items():
                numpy.testing.assert_array_equal(packed[name], values, name)
        self.assertLess(size[1], 0.8 * size[0])
        self.assertLessEqual(size[9], size[1])

    def test_are_read_by_pages_and_resumed(self):
        self.write("bar.toml", BAR)
        self.run_program("run", "bar.toml", "-q", "--set", "output.compression=6")
        longer = self.json_of("resume", "bar.vtkhdf", "--set", "analysis.steps=8")
        self.assertEqual(longer["totals"]["steps"], 8)
        self.run_program("report", "bar.vtkhdf", "-q")

    def test_refuses_levels_that_deflate_has_not(self):
        self.write("bar.toml", BAR)
        for level in (-1, 10, 1.5):
            done = self.run_program("run", "bar.toml", "--set", f"output.compression={level}", status=2)
            self.assertIn("output.compression", done.stderr)


if __name__ == "__main__":
    unittest.main()
