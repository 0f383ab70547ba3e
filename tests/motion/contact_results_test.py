"""Contact points in result files, read back by h5py, against values worked out by hand; and since when blocks are at rest."""
import math
import sys
import unittest
from pathlib import Path

import h5py
import numpy

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "cli"))
from program import ProgramTest  # noqa: E402

G = 9.81
OPEN, STICK, SLIDE = 0, 1, 2
# Three blocks of 1 m x 2 m, 1, 1.5 and 0.5 m high, on joints of 2 and 4 GPa/m.
COLUMN = """
[[material]]
density = 2500
young_modulus = 1e10
poisson_ratio = 0.25
[[joint_material]]
name = "soft"
friction_angle = 30
normal_stiffness = 2e9
shear_stiffness = 1e9
[[joint_material]]
name = "stiff"
friction_angle = 30
normal_stiffness = 4e9
shear_stiffness = 1e9
[[solid]]
name = "column"
shape = "box"
min = [0, 0, 0]
max = [1, 2, 3]
[[joint]]
name = "low"
dip = 0
dip_direction = 0
point = [0, 0, 1]
material = "soft"
[[joint]]
name = "high"
dip = 0
dip_direction = 0
point = [0, 0, 2.5]
material = "stiff"
[cover]
lattice = "block"
[[fixed]]
where = {block_at = [0.5, 1, 0.5]}
[output]
every = 0
[analysis]
type = "quasi_static"
time_step = 0.05
steps = 20
"""


class ContactResults(ProgramTest):
    def last_contacts(self, name):
        """Of the last state."""
        with h5py.File(self.folder / name) as file:
            root = file["rockfold"]
            counts = root["states/contact_count"][:]
            stored = {key: values[:] for key, values in root["contacts"].items()}
            names = [text.decode() for text in root["origins/name"][:]]
        self.assertTrue(all(len(values) == counts.sum() for values in stored.values()))
        last = {key: values[counts.sum() - counts[-1]:] for key, values in stored.items()}
        last["joint"] = numpy.array([names[joint] for joint in last["joint"]])
        return last

    def test_of_a_column_bear_the_weight_above_them(self):
        self.write("column.toml", COLUMN)
        document = self.json_of("run", "column.toml")
        contacts = self.last_contacts("column.vtkhdf")
        for joint, z, stiffness, above, blocks in (("low", 1, 2e9, 2.0, (1, 2)), ("high", 2.5, 4e9, 0.5, (2, 3))):
            here = {key: values[contacts["joint"] == joint] for key, values in contacts.items()}
            stress = 2500 * G * above
            self.assertEqual(set(here["state"]), {STICK})
            self.assertEqual(set(zip(here["first_block"], here["second_block"])), {blocks})
            self.assertAlmostEqual(here["area"].sum(), 2, 5)
            numpy.testing.assert_allclose(here["normal_stress"], -stress, rtol=1e-6)
            numpy.testing.assert_allclose(here["gap"], -stress / stiffness, rtol=1e-6)
            numpy.testing.assert_array_equal(here["slip"], 0)
            # Blocks that are pressed bulge and pull at each other along the joint, but in sum along no way.
            numpy.testing.assert_allclose(here["area"] @ here["shear_stress"], 0, atol=1e-6 * 2 * stress)
            numpy.testing.assert_allclose(here["area"] @ here["place"] / 2, [0.5, 1, z], atol=1e-4)
            numpy.testing.assert_allclose(numpy.abs(here["normal"]), [[0, 0, 1]] * len(here["gap"]), atol=1e-12)
        self.assertEqual((document["contacts"]["open"], document["contacts"]["stick"], document["contacts"]["slide"]), (0, len(contacts["gap"]), 0))
        self.assertAlmostEqual(document["contacts"]["max_penetration"] / (2500 * G * 2 / 2e9), 1, 6)

    def test_of_a_block_that_slides_bear_friction_against_its_way(self):
        self.copy_case("sliding_block")
        angle, friction = math.radians(30), math.radians(20)
        document = self.json_of("run", "sliding_block.toml", "--set", f"gravity=[{G * math.sin(angle)}, 0, {-G * math.cos(angle)}]",
                                "--set", "joint_material.1.friction_angle=20", "--set", "analysis.end_time=0.4")
        contacts = self.last_contacts("sliding_block.vtkhdf")
        touching = contacts["state"] != OPEN
        area, normal, shear = contacts["area"][touching], contacts["normal_stress"][touching], contacts["shear_stress"][touching]
        self.assertEqual(set(contacts["state"][touching]), {SLIDE})
        self.assertEqual(set(contacts["joint"]), {"block.interface"})
        block = max(range(2), key=lambda b: document["blocks"][b]["displacement"][0])
        weight = G * 2500 * document["blocks"][block]["volume"]
        # The rock below is the side that friction drags along, or the block the one that it holds back.
        side = numpy.where(contacts["first_block"][touching] == block + 1, -1, 1)
        self.assertAlmostEqual(-(area @ normal) / (weight * math.cos(angle)), 1, 2)
        force = (area * side) @ shear
        numpy.testing.assert_allclose(force, [-(area @ normal) * math.tan(friction), 0, 0], atol=1e-3 * weight)
        numpy.testing.assert_allclose(numpy.linalg.norm(shear, axis=1), -normal * math.tan(friction), rtol=1e-6)
        way = 0.5 * G * (math.sin(angle) - math.cos(angle) * math.tan(friction)) * 0.4**2
        self.assertAlmostEqual(document["blocks"][block]["displacement"][0] / way, 1, 2)
        # Those that have been there from the start; others live since the edges of the two passed over each other.
        self.assertAlmostEqual(contacts["slip"].max() / way, 1, 2)
        self.assertFalse(document["rest"]["at_rest"])
        self.assertIsNone(document["rest"]["since"])


class Rest(ProgramTest):
    def test_begins_when_friction_has_stopped_a_block(self):
        """From 1 m/s on a level plane with friction 0.5."""
        model = self.copy_case("sliding_block")
        start = '[[initial_velocity]]\nwhere = {block_at = [0.5, 0.5, 0.1]}\nvelocity = [1, 0, 0]\n'
        model.write_text(model.read_text(encoding="utf-8") + start, encoding="utf-8")
        arguments = ["run", "sliding_block.toml", "--force", "--json-file", "slide.json", "--set", f"gravity=[0, 0, {-G}]",
                     "--set", f"joint_material.1.friction_angle={math.degrees(math.atan(0.5))}", "--set", "analysis.end_time=0.3"]
        text = self.run_program(*arguments).stdout
        rest = self.json_of(*arguments[:3], *arguments[5:])["rest"]
        stops = 1 / (0.5 * G)
        self.assertTrue(rest["at_rest"])
        self.assertTrue(stops - 0.005 < rest["since"] < stops + 0.02, (stops, rest["since"]))
        self.assertIn(f"all at rest since t = {rest['since']:.4g} s", text)

    def test_is_there_from_the_start_where_nothing_moves(self):
        self.write("column.toml", COLUMN)
        rest = self.json_of("run", "column.toml")["rest"]
        self.assertEqual((rest["at_rest"], rest["since"]), (True, 0))


if __name__ == "__main__":
    unittest.main()
