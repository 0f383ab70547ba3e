"""Block covers that [[fixed]] leaves nothing of: `check` and `run` say so."""
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
        for name, model in (("foot", HEADING + foot), ("whole", HEADING + HELD + whole), ("lattice", lattice)):
            with self.subTest(name):
                self.assertEqual(self.warnings("check", model), [])


if __name__ == "__main__":
    unittest.main()
