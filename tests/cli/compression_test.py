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

# A heap that falls apart: the number of its contact points is another in each state.
HEAP = """
gravity = [6, 0, -8]
[[material]]
density = 2500
young_modulus = 1e9
poisson_ratio = 0.2
[[joint_material]]
name = "smooth"
friction_angle = 10
[[solid]]
name = "heap"
shape = "box"
min = [0, 0, 0]
max = [5, 5, 5]
[[joint_set]]
dip = 0
dip_direction = 0
spacing = 1
origin = [0, 0, 0]
[[joint_set]]
dip = 90
dip_direction = 0
spacing = 1
origin = [0, 0, 0]
[[joint_set]]
dip = 90
dip_direction = 90
spacing = 1
origin = [0, 0, 0]
[cover]
lattice = "block"
[[fixed]]
where = {face = "heap.zmin"}
[analysis]
type = "dynamic"
time_step = 0.01
steps = 8
[output]
every = 1
"""


def arrays_of(path):
    found = {}
    with h5py.File(path) as file:
        file["VTKHDF"].visititems(lambda name, item: found.update({name: item[()]}) if isinstance(item, h5py.Dataset) else None)
        for name in ("displacement", "velocity", "hash", "time"):
            found["states/" + name] = file["rockfold/states/" + name][()]
        if "contacts" in file["rockfold"]:
            found |= {"contacts/" + name: array[()] for name, array in file["rockfold/contacts"].items()}
            found["contact_count"] = file["rockfold/states/contact_count"][()]
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

    def test_may_have_any_number_of_contact_points(self):
        self.write("heap.toml", HEAP)
        for level in (0, 1):
            self.run_program("run", "heap.toml", "-q", "-o", f"{level}.vtkhdf", "--set", f"output.compression={level}")
        plain, packed = (arrays_of(self.folder / f"{level}.vtkhdf") for level in (0, 1))
        self.assertGreater(len(set(plain["contact_count"])), 3, "numbers that are all the same show nothing")
        self.assertGreater(min(plain["contact_count"]) * 24, 32 * 1024, "one chunk shows nothing")
        self.assertEqual(packed.keys(), plain.keys())
        for name, values in plain.items():
            numpy.testing.assert_array_equal(packed[name], values, name)

    def test_are_the_same_bytes_on_any_number_of_threads(self):
        self.write("bar.toml", BAR)
        chunks = {}
        for threads in (1, 2, 3):
            name = f"on_{threads}.vtkhdf"
            self.run_program("run", "bar.toml", "-q", "-o", name, "--threads", str(threads), "--set", "output.compression=1",
                             "--set", "cover.spacing=0.2")
            with h5py.File(self.folder / name) as file:
                velocity = file["rockfold/states/velocity"]
                self.assertGreater(velocity[0].nbytes, 32 * 1024, "one chunk shows nothing")
                places = [velocity.id.get_chunk_info(n).chunk_offset for n in range(velocity.id.get_num_chunks())]
                chunks[threads] = [velocity.id.read_direct_chunk(place) for place in places]
        self.assertTrue(any(mask == 0 for mask, _ in chunks[1]), "no chunk is deflated")
        self.assertEqual(chunks[2], chunks[1])
        self.assertEqual(chunks[3], chunks[1])

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
