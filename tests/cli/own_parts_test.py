"""Contact is between blocks: what a block's own parts cannot do `run` says beforehand."""
import unittest

from program import ProgramTest

# A box that a bed cuts in two; the upper half has a notch.
ROCK = """
[[material]]
density = 2600
young_modulus = 10e9
poisson_ratio = 0.25
[[joint_material]]
friction_angle = 40
[[solid]]
name = "rock"
shape = "box"
min = [0, 0, 0]
max = [4, 4, 4]
[[joint]]
name = "bed"
dip = 0
dip_direction = 0
point = [2, 2, 2]
[[fixed]]
where = {face = "rock.zmin"}
[cover]
spacing = 2
[analysis]
type = "quasi_static"
time_step = 0.01
steps = 1
"""
CRACK = """[[joint]]
name = "crack"
dip = 90
dip_direction = 90
point = [2, 2, 4]
radius = 1
"""
NOTCH = """[[solid]]
operation = "subtract"
shape = "box"
min = [1, -1, 3]
max = [3, 5, 5]
"""


class OwnParts(ProgramTest):
    def warnings(self, text):
        self.write("m.toml", text)
        return self.run_program("run", "m.toml", "--no-result").stderr

    def test_joints_that_end_in_a_block_are_told_with_their_area(self):
        self.assertNotIn("end inside", self.warnings(ROCK))
        # Half of a regular polygon of 16 sides: 8 sin(22.5 deg) m2.
        self.assertRegex(self.warnings(ROCK + CRACK), r"1\.531 m2 of joints end inside block 2: .* intact rock, which neither opens nor slips")

    def test_joints_that_end_in_rock_without_contact_are_open_cracks(self):
        alone = ROCK.replace('type = "quasi_static"\ntime_step = 0.01\nsteps = 1', 'type = "static"').split("[[joint]]")
        text = alone[0] + "[[fixed]]" + alone[1].split("[[fixed]]")[1]
        self.assertRegex(self.warnings(text + CRACK), "open cracks, whose sides pass through each other where they close")

    def test_blocks_that_might_fold_are_told(self):
        self.assertNotIn("is not convex", self.warnings(ROCK))
        self.assertRegex(self.warnings(ROCK + NOTCH), "block 2 is not convex, and nothing holds it: where rock of one block folds, its parts pass through each other")
        self.assertNotIn("is not convex", self.warnings((ROCK + NOTCH).replace("spacing = 2", 'lattice = "block"')))
        self.assertNotIn("is not convex", self.warnings(ROCK + NOTCH + '[[fixed]]\nwhere = {face = "rock.zmax"}\n'))


if __name__ == "__main__":
    unittest.main()
