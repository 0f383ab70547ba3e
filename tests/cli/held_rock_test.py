"""Block covers that [[fixed]] leaves nothing of, and rock that goes on and that none holds: `check` and `run` say so."""
import unittest

from program import ProgramTest

# Rock round a heading with one joint above it, which cuts off some 8 % of it.
HEADING = """
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
max = [20, 10, 20]
[[excavation]]
shape = "box"
min = [8, 0, 8]
max = [12, 10, 12]
[[joint]]
dip = 45
dip_direction = 90
point = [16, 5, 16]
[cover]
lattice = "block"
[analysis]
type = "quasi_static"
time_step = 0.02
steps = 2
"""
HELD = "".join(f'[[fixed]]\nwhere = {{face = "rock.{side}"}}\n' for side in ("xmin", "xmax", "ymin", "ymax", "zmin"))
WORDS = "it neither moves nor strains"


# Above a bed that dips south a slab; behind a crack rock that goes on, parted by the bed too. Two of the four blocks are held.
SLAB = """
[[material]]
density = 2650
young_modulus = 20e9
poisson_ratio = 0.25
[[joint_material]]
friction_angle = 38
[[solid]]
name = "rock"
shape = "box"
min = [0, 0, 0]
max = [4, 16, 10]
continues = ["ymax", "zmin"]
[[joint]]
dip = 30
dip_direction = 180
point = [0, 3, 2]
[[joint]]
dip = 90
dip_direction = 180
point = [0, 10, 2]
[cover]
lattice = "block"
[analysis]
type = "quasi_static"
time_step = 0.02
steps = 2
[[fixed]]
where = {block_at = [2, 8, 1]}
[[fixed]]
where = {block_at = [2, 14, 9.5]}
"""


class HeldRock(ProgramTest):
    def warnings(self, command, model, *arguments):
        self.write("m.toml", model)
        return [w for w in self.json_of(command, "m.toml", *arguments)["warnings"] if WORDS in w]

    def test_is_told_with_its_share_and_the_way_out(self):
        for command, arguments in (("check", ()), ("check", ("--estimate",)), ("run", ("--no-result",))):
            with self.subTest(command=command, arguments=arguments):
                told = self.warnings(command, HEADING + HELD, *arguments)
                self.assertEqual(len(told), 1)
                self.assertIn("cover.lattice", told[0])
                self.assertIn("all of its 12 unknowns", told[0])
                self.assertIn('"tet6"', told[0])

    def test_is_not_told_where_the_rock_may_deform(self):
        foot = '[[fixed]]\nwhere = {face = "rock.zmin"}\n'
        whole = "[[fixed]]\nwhere = {block_at = [2, 2, 2]}\n"  # is meant
        lattice = (HEADING + HELD).replace('lattice = "block"', "spacing = 5")
        for name, model in (("foot", HEADING + foot), ("whole", HEADING + whole), ("lattice", lattice)):
            with self.subTest(name):
                self.assertEqual(self.warnings("check", model), [])


class NothingCanMove(ProgramTest):
    """HEADING's two blocks: the one that the joint cuts off, and the rest of the rock."""
    NAMED = "[[fixed]]\nwhere = {block_at = [2, 2, 2]}\n[[fixed]]\nwhere = {block_at = [19, 5, 18]}\n"

    def warnings(self, model):
        self.write("m.toml", model)
        return [w for w in self.json_of("run", "m.toml", "--no-result")["warnings"] if WORDS in w]

    def test_is_told_once_instead_of_what_the_largest_block_does(self):
        told, = self.warnings(HEADING + self.NAMED)
        self.assertIn('"block" gives each block one cover, and [[fixed]] holds all of its 12 unknowns', told)
        self.assertIn("nothing can move", told)
        self.assertIn("cover.lattice", told)

    def test_is_not_told_where_a_block_is_free_or_led(self):
        free = self.NAMED.split("[[fixed]]")[1]
        led = self.NAMED + "value = [0, 0, 0.001]\n"
        for name, model in (("free", "[[fixed]]" + free), ("led", led)):
            with self.subTest(name):
                self.assertEqual(self.warnings(HEADING + model), [])


class UnheldRock(ProgramTest):
    def warnings(self, command, model, *arguments):
        self.write("m.toml", model)
        return [w for w in self.json_of(command, "m.toml", *arguments)["warnings"] if "nothing stops" in w]

    def test_that_goes_on_below_is_told(self):
        for command, arguments in (("check", ()), ("run", ("--no-result",))):
            with self.subTest(command=command):
                told, = self.warnings(command, SLAB, *arguments)
                self.assertRegex(told, r"^m\.toml:\d+:1: fixed: holds no point of block 2, .* nothing stops its fall\. "
                                 r"Hold it, as in where = \{block_at = \[2, 13\.\d+, \d\.\d+\]\}$")
        told, = self.warnings("check", SLAB.replace("[2, 8, 1]", "[2, 5, 6]"))
        self.assertIn("of blocks 2, 1, the rock", told)

    def test_that_is_held_or_lies_on_rock_is_not(self):
        foot = SLAB + "[[fixed]]\nwhere = {face = 'rock.zmin'}\n"
        above = foot.replace("where = {block_at = [2, 14, 9.5]}", "where = {block_at = [2, 8, 1]}")  # lies on the bed
        for name, model in (("foot", foot), ("above", above), ("weightless", "gravity = [0, 0, 0]\n" + SLAB),
                            ("welded", SLAB.replace('"block"', '"tet6"\njoints = "welded"\nspacing = 4'))):
            with self.subTest(name):
                self.assertEqual(self.warnings("check", model), [])


if __name__ == "__main__":
    unittest.main()
