"""What of a model a command does not use is told; loads that it does not take stop it. Documents in files; results of runs stay."""
import json
import math
import unittest

from program import PRESSED, ProgramTest

SLOPE = """[[material]]
density = 2600
young_modulus = 1e10
poisson_ratio = 0.25
[[joint_material]]
friction_angle = 30
[[joint_set]]
name = "A"
dip = 45
dip_direction = 105
spacing = 5
[[joint_set]]
name = "B"
dip = 70
dip_direction = 235
spacing = 5
[[block_theory.slope]]
name = "face"
dip = 65
dip_direction = 185
height = 40
"""
LOAD = "[[point_load]]\npoint = [0, 0, 0]\nforce = [0, 0, -1e6]\n"

# A slab of 10 m x 10 m x 2 m on a bed that dips by 30 degrees.
SLAB = """[[material]]
density = 2600
young_modulus = 1e10
poisson_ratio = 0.25
[[joint_material]]
friction_angle = 40
[[solid]]
name = "rock"
shape = "box"
min = [0, 0, 0]
max = [10, 10, 10]
continues = ["xmin", "ymin", "ymax", "zmin"]
[[joint]]
name = "bed"
dip = 30
dip_direction = 90
point = [0, 0, 9]
[support]
"""


class KeyUse(ProgramTest):
    def test_keys_of_other_commands_are_told(self):
        self.write("slope.toml", SLOPE)
        unused = self.json_of("theory", "slope.toml")["unused"]
        self.assertEqual(unused, ["material.young_modulus", "material.poisson_ratio"])
        self.assertIn("not used here", self.run_program("theory", "slope.toml").stdout)
        self.write("pressed.toml", PRESSED)
        unused = self.json_of("cut", "pressed.toml")["unused"]
        for section in ("[cover]", "[[fixed]]", "[[traction]]", "[analysis]", "[[monitor]]", "material.young_modulus"):
            self.assertIn(section, unused)
        self.assertEqual(self.json_of("run", "pressed.toml")["unused"], [])

    def test_a_load_that_does_not_act_stops_the_command(self):
        self.write("slope.toml", SLOPE + LOAD)
        error = self.json_of("theory", "slope.toml", status=2)["error"]
        self.assertEqual((error["key"], error["kind"]), ("point_load", "model"))
        for words in ("[[point_load]] does not act in `theory`", "--ignore point_load"):
            self.assertIn(words, error["message"])
        self.assertIn("[[point_load]]", self.json_of("theory", "slope.toml", "--ignore", "point_load")["unused"])
        self.assertIn("no load", self.run_program("theory", "slope.toml", "--ignore", "pointload", status=2).stderr)

    def test_a_shaken_base_is_no_load_of_key_blocks(self):
        self.write("slab.toml", SLAB + "[base_acceleration]\ntable = [[0, 0, 0, 0], [1, 1, 0, 0]]\n")
        said = self.run_program("support", "slab.toml", status=2).stderr
        self.assertIn("seismic_coefficient", said)
        self.run_program("support", "slab.toml", "--ignore", "base_acceleration")

    def test_what_acts_on_key_blocks_alone_is_told_of_a_run(self):
        analysis = "[cover]\nspacing = 5\njoints = 'welded'\n[analysis]\ntype = 'static'\n[[fixed]]\nwhere = {face = 'rock.zmin'}\n"
        self.write("slab.toml", SLAB + analysis + "[[water]]\nhead = 2\n")
        warnings = self.json_of("run", "slab.toml")["warnings"]
        self.assertIn("[[water]] acts on key blocks alone, not on the analysis", warnings)


# A gravity dam, 30 m high and 24 m wide at its base, on rock.
DAM = """[[material]]
name = "rock"
density = 2650
[[material]]
name = "concrete"
density = 2400
[[joint_material]]
friction_angle = 40
cohesion = 200e3
[[solid]]
name = "foundation"
shape = "box"
min = [-50, 0, -30]
max = [70, 15, 0]
continues = ["xmin", "xmax", "ymin", "ymax", "zmin"]
[[solid]]
name = "dam"
shape = "prism"
base = [[0, 0, 0], [24, 0, 0], [5, 0, 25], [5, 0, 30], [0, 0, 30]]
extrude = [0, 15, 0]
material = "concrete"
interface = "joint_material1"
[support]
rotation = false
"""
G, WEIGHT, BASE = 9.81, 9.81 * 2400 * 387.5 * 15, 24 * 15


class Dam(ProgramTest):
    def factor(self, loads):
        self.write("dam.toml", DAM + loads)
        document = self.json_of("support", "dam.toml")
        (block,) = document["keyblocks"] + document["stable"]
        return block["factor_of_safety"]

    def test_slides_on_its_base_under_the_water_before_it(self):
        push = 0.5 * 1000 * G * 30 ** 2 * 15
        dry = (WEIGHT * math.tan(math.radians(40)) + 200e3 * BASE) / push
        self.assertAlmostEqual(dry, 2.8215, delta=1e-4)
        self.assertAlmostEqual(self.factor("[[traction]]\nwhere = {face = 'dam.4'}\nhead = 30\n"), dry, delta=1e-9)
        strips = "".join(f"[[traction]]\nwhere = {{box = [[0, 0, {z}], [0, 15, {z + 3}]]}}\npressure = {1000 * G * (30 - z - 1.5)}\n"
                         for z in range(0, 30, 3))
        self.assertAlmostEqual(self.factor(strips), dry, delta=1e-9)

    def test_is_lifted_by_water_in_its_joint(self):
        """By a triangle from 10 m upstream, under the reservoir, to nothing downstream; the ends of its 15 m do not drain."""
        push, uplift = 0.5 * 1000 * G * 30 ** 2 * 15, 0.5 * 1000 * G * 10 * BASE
        wet = ((WEIGHT - uplift) * math.tan(math.radians(40)) + 200e3 * BASE) / push
        water = "[[water]]\njoints = ['dam.interface']\nhead = 10\n"
        self.assertAlmostEqual(self.factor("[[traction]]\nwhere = {face = 'dam.4'}\nhead = 30\n" + water), wet, delta=1e-9)


# A plank along x, clamped at one end, in water up to half its height at its far end.
class WaterBeforeAFace(ProgramTest):
    def test_presses_exactly_below_its_head_on_every_lattice(self):
        model = """gravity = [0, 0, -9.81]
[[material]]
density = 1e-9
young_modulus = 1e9
poisson_ratio = 0
[[solid]]
name = "plank"
shape = "box"
min = [0, 0, 0]
max = [4, 1, 2]
[cover]
spacing = {}
order = {}
[[fixed]]
where = {{face = "plank.xmin"}}
[[traction]]
where = {{face = "plank.xmax"}}
head = 1.3
[analysis]
type = "static"
"""
        for spacing, order in ((0.7, 0), (0.9, 1)):
            self.write("plank.toml", model.format(spacing, order))
            (reaction,) = self.json_of("run", "plank.toml")["reactions"]
            push = 0.5 * 1000 * G * 1.3 ** 2
            self.assertAlmostEqual(reaction["force"][0], push, delta=1e-5 * push)
            self.assertAlmostEqual(reaction["moment"][1], push * 1.3 / 3, delta=1e-5 * push)  # about the origin


class Outputs(ProgramTest):
    def test_the_document_goes_to_a_file_beside_the_summary(self):
        self.write("slab.toml", SLAB)
        done = self.run_program("support", "slab.toml", "--json-file", "slab.json")
        self.assertIn("key blocks", done.stdout)
        document = json.loads((self.folder / "slab.json").read_text(encoding="utf-8"))
        self.assertEqual(document["command"], "support")
        said = self.run_program("support", "slab.toml", "--json-file", "slab.toml", status=2).stderr
        self.assertIn("would overwrite", said)

    def test_states_of_a_run_are_not_replaced_by_a_cut(self):
        self.write("pressed.toml", PRESSED)
        self.run_program("run", "pressed.toml")
        for command in ("cut", "support"):
            said = self.run_program(command, "pressed.toml", "--ignore", "traction", status=2).stderr
            self.assertIn("--force", said)
        self.run_program("cut", "pressed.toml", "--force")
        self.run_program("cut", "pressed.toml")  # no states any more


if __name__ == "__main__":
    unittest.main()
