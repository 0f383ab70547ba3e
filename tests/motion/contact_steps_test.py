"""Time steps that are long for contact: what the program says before it runs, by the blocks that move and not by the mean of all."""
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "cli"))
from program import ProgramTest  # noqa: E402

# By height: a slab of 2 m x 2 m x 2 cm, a rock of (4 m)³ beside it and a stone of (10 cm)³ 5 m above the slab; the last two may rest
# on nothing, since steps are few.
SLAB, ROCK, STONE = [0, 0, -0.01], [12, 12, 2], [0, 0, 5.05]
BLOCKS = """
[[material]]
density = 2700
young_modulus = 30e9
poisson_ratio = 0.25
[[joint_material]]
friction_angle = 30
[[solid]]
shape = "box"
min = [-1, -1, -0.02]
max = [1, 1, 0]
[[solid]]
shape = "box"
min = [10, 10, 0]
max = [14, 14, 4]
[[solid]]
shape = "box"
min = [-0.05, -0.05, 5]
max = [0.05, 0.05, 5.1]
[cover]
lattice = "block"
"""
WEIGHTLESS = "gravity = [0, 0, 0]\n" + BLOCKS


def held(*points):
    return "".join(f"[[fixed]]\nwhere = {{block_at = {point}}}\n" for point in points)


def thrown(point, speed=10):
    return f"[[initial_velocity]]\nwhere = {{block_at = {point}}}\nvelocity = [0, 0, -{speed}]\n"


def analysed(time_step, steps=1):
    return f'[analysis]\ntype = "dynamic"\ntime_step = {time_step}\nsteps = {steps}\n'


class ContactSteps(ProgramTest):
    def warnings(self, text):
        self.write("m.toml", text)
        return [w for w in self.json_of("run", "m.toml", "--no-result")["warnings"] if "long for contact" in w]

    def warned(self, text, *words):
        (warning,) = self.warnings(text)
        for word in words:
            self.assertIn(word, warning)

    def test_of_a_small_block_that_is_thrown(self):
        model = WEIGHTLESS + held(SLAB)
        line = model.count("\n") + 1
        # From 6 cm on, half of both thicknesses, its centre is behind the slab's after a step; contact finds its way through 1.2 mm.
        self.warned(model + analysed(0.01) + thrown(STONE), f"m.toml:{line}:1: analysis.time_step: is 0.01 s, long for contact: "
                    "block 3 (0.1 m thick) starts at 10 m/s and moves by 0.1 m in a step; a step that would take it through rock like block 1 (0.02 m thick) is divided. "
                    "0.0001 s is a good start")
        self.warned(model + analysed(0.005) + thrown(STONE), "an impact on rock like block 1 (0.02 m thick) takes many iterations, or the step is divided")
        self.assertEqual(self.warnings(model + analysed(0.001) + thrown(STONE)), [])

    def test_not_of_a_large_block_among_the_same_ones(self):
        self.assertEqual(self.warnings(WEIGHTLESS + held(SLAB) + analysed(0.01) + thrown(ROCK)), [])

    def test_not_of_a_block_that_is_held(self):
        model = WEIGHTLESS + held(SLAB, STONE)
        self.assertEqual(self.warnings(model + analysed(0.01) + thrown(STONE)), [])
        self.warned(model + 'components = ["y"]\n' + analysed(0.01) + thrown(STONE), "block 3 (0.1 m thick) starts at 10 m/s")

    def test_not_where_all_blocks_move_alike(self):
        self.assertEqual(self.warnings(WEIGHTLESS + analysed(0.01) + "[[initial_velocity]]\nwhere = {all = true}\nvelocity = [0, 0, -10]\n"), [])

    def test_of_a_thin_plate_by_what_it_shows_to_its_way(self):
        """The slab moves along its plane: 2 m long, not 2 cm."""
        sideways = thrown(SLAB).replace("[0, 0, -10]", "[10, 0, 0]")
        self.assertEqual(self.warnings(WEIGHTLESS + held(STONE) + analysed(0.01) + sideways), [])
        self.warned(WEIGHTLESS + held(STONE) + analysed(0.01) + thrown(SLAB), "block 1 (0.02 m thick) starts at 10 m/s")

    def test_of_a_small_block_that_falls(self):
        """By 5 m: at 9.9 m/s, and no faster than 9.81 m/s² for as long as the analysis takes."""
        model = BLOCKS + held(SLAB, ROCK)
        self.warned(model + analysed(0.01, 102), "block 3 (0.1 m thick) may fall at 9.9 m/s and moves by 0.099 m in a step; a step that would take it through rock like block 1")
        self.assertEqual(self.warnings(model + analysed(0.01, 12)), [])  # 1.2 m/s: 12 mm
        self.warned(model + analysed(0.01, 13), "may fall at 1.3 m/s and moves by 0.013 m", "an impact on rock like block 1")
        self.assertEqual(self.warnings(BLOCKS + held(SLAB, ROCK, STONE) + analysed(0.01, 102)), [])

    def test_of_blocks_at_rest_by_those_that_may_move(self):
        """Two stones of (10 cm)³ on the rock fall by their size in 0.14 s: the mean of all blocks, 2.5 m, says nothing of them."""
        stones = "".join(f'[[solid]]\nshape = "box"\nmin = [{x}, 10, 4]\nmax = [{x + 0.1}, 10.1, 4.1]\n' for x in (10, 11))
        joint = "[[joint]]\ndip = 0\ndip_direction = 0\npoint = [12, 12, 4]\n"
        model = BLOCKS[:BLOCKS.rindex("[[solid]]")] + stones + joint + BLOCKS[BLOCKS.index("[cover]"):]
        self.warned(model + held(SLAB, ROCK) + analysed(0.02), "blocks of 0.1 m at 1.4 m/s (a fall by their size) move by 0.28 of their size in a step")
        self.assertEqual(self.warnings(model + held(SLAB, ROCK) + analysed(0.01)), [])

    def test_of_the_step_that_is_longest(self):
        steps = "".join(f'[[step]]\ntype = "{kind}"\ntime_step = {step}\nsteps = 1\n' for kind, step in (("dynamic", 0.001), ("quasi_static", 0.1), ("dynamic", 0.01)))
        self.warned(WEIGHTLESS + held(SLAB) + steps + thrown(STONE), "step[3].time_step: is 0.01 s, long for contact")


if __name__ == "__main__":
    unittest.main()
