"""`rockfold theory`: joint sets alone, and the loads of block theory, end to end."""
import math
import re
import unittest

from program import ProgramTest

THEORY = """title = "Adit"
[[material]]
name = "granite"
density = 2700
[[joint_material]]
name = "clean"
friction_angle = 20
"""
for number, direction in enumerate((30, 150, 270), 1):
    THEORY += f'[[joint_set]]\nname = "J{number}"\ndip = 60\ndip_direction = {direction}\nspacing = 1.5\n'
    THEORY += "" if number > 1 else "origin = [0, 0, 0]\n"
THEORY += """[block_theory]
[[block_theory.tunnel]]
name = "adit"
trend = 20
plunge = 10
section = "circle"
radius = 2
[[block_theory.slope]]
name = "portal"
dip = 75
dip_direction = 200
height = 8
[block_theory.scan]
step = 30
[block_theory.monte_carlo]
realisations = 200
"""

CUBE_ON_A_FLOOR = """gravity = [0, 0, -10]
[[material]]
density = 2000
[[joint_material]]
name = "rough"
friction_angle = 45
normal_stiffness = 1e9
shear_stiffness = 1e9
[[solid]]
name = "rock"
shape = "box"
min = [0, 0, -1]
max = [2, 3, 4]
continues = ["zmin"]
[[joint]]
name = "floor"
dip = 0
dip_direction = 0
point = [0, 0, 0]
"""

DESIGN = """[[bolt_pattern]]
on = "rock.xmax"
spacing = 1
length = 2
force_capacity = 1e5
displacement_capacity = 0.02
[[drawing]]
output = "net.svg"
kind = "stereonet"
[[table]]
output = "keys.csv"
kind = "keyblocks"
"""


class Theory(ProgramTest):
    def test_tells_all_tables(self):
        self.write("adit.toml", THEORY)
        document = self.json_of("theory", "adit.toml")
        self.assertEqual([p["code"] for p in document["pyramids"]],
                         ["000", "001", "010", "011", "100", "101", "110", "111"])
        held = [p["code"] for p in document["pyramids"] if "adit" not in p["removable_from"]]
        self.assertEqual(held, ["011", "100"])
        falling = document["pyramids"][7]
        self.assertEqual((falling["mode"], falling["factor_of_safety"]), ("lifting", None))
        self.assertAlmostEqual(document["pyramids"][3]["sliding_force"], 0.68404, delta=5e-6)
        (tunnel,), (slope,) = document["tunnels"], document["slopes"]
        self.assertEqual(len(tunnel["blocks"]), 6)
        self.assertEqual(len(tunnel["scan"]["entries"]), 12)
        self.assertIn("dip_direction", slope["scan"]["best"])
        simulation = tunnel["monte_carlo"]
        chance = simulation["probability_of_key_block"]
        self.assertTrue(0 <= chance["low"] <= chance["value"] <= chance["high"] <= 1)
        largest = {block["code"]: block["volume"] for block in tunnel["blocks"]}
        for pyramid in simulation["pyramids"]:
            self.assertLessEqual(pyramid["volume"]["greatest"], largest[pyramid["code"]] * (1 + 1e-9))
        self.assertEqual(self.files(), ["adit.toml"])  # no result file

    def test_is_the_same_on_any_number_of_threads_and_goes_by_the_seed(self):
        self.write("adit.toml", THEORY)
        answers = []
        for more in (("--threads", 1), ("--threads", 3), ("--threads", 1, "--seed", 5)):
            document = self.json_of("theory", "adit.toml", *more)
            del document["seconds"]
            answers.append(document)
        self.assertEqual(answers[0], answers[1])
        self.assertEqual(answers[2]["tunnels"][0]["monte_carlo"]["seed"], 5)
        self.assertNotEqual(answers[0]["tunnels"][0]["monte_carlo"]["largest_volume"],
                            answers[2]["tunnels"][0]["monte_carlo"]["largest_volume"])

    def test_is_told_in_words(self):
        self.write("adit.toml", THEORY)
        text = self.run_program("theory", "adit.toml").stdout
        for words in ("Tunnel adit", "Slope portal", "worst direction", "key block in", "falls"):
            self.assertIn(words, text)

    def test_leaves_blocks_without_volume_out_and_tells_small_ones(self):
        text = THEORY.split("[block_theory]")[0]
        for dip, direction, old in ((45, 40, 30), (55, 160, 150), (65, 280, 270)):
            text = text.replace(f"dip = 60\ndip_direction = {old}\n", f"dip = {dip}\ndip_direction = {direction}\n")
        tunnel = "[[block_theory.tunnel]]\ntrend = 0\nsection = 'rectangle'\nwidth = {0}\nheight = {0}\n"
        rows = {}
        for width in (4, 0.04):
            self.write("drift.toml", text + tunnel.format(width))
            said = self.run_program("theory", "drift.toml").stdout
            rows[width] = dict(re.findall(r"(?m)^  ([01]{3}) +(\S+ +\S+) ", said.partition("Tunnel")[2]))
            self.assertRegex(said, "no volume +011, 100")
        self.assertEqual(list(rows[4]), ["000", "001", "110", "111"])
        self.assertEqual((rows[4]["001"].split(), rows[0.04]["001"].split()), (["1.66", "43.9"], ["1.66e-06", "4.4e-05"]))

    def test_calls_motions_as_support_does(self):
        head = "[[water]]\nhead = 60\n"
        slope = THEORY.split("[[block_theory.tunnel]]")[0]
        self.write("wet.toml", slope + THEORY[THEORY.index("[[block_theory.slope]]"):].split("[block_theory.scan]")[0] + head)
        block = self.json_of("theory", "wet.toml")["slopes"][0]["blocks"][0]
        self.assertEqual(block["mode"], "lifting")
        self.assertAlmostEqual(sum(x * x for x in block["direction"]), 1)
        self.assertTrue(0 < block["direction"][2] < 0.5)  # below 30 degrees: out, more than up
        self.assertIn("pushed out", self.run_program("theory", "wet.toml").stdout)

    def test_of_a_model_without_it_is_an_error(self):
        self.write("bare.toml", THEORY.split("[block_theory]")[0])
        done = self.run_program("theory", "bare.toml", status=2)
        self.assertIn("the model has no [block_theory]", done.stderr)

    def test_of_a_section_with_inward_corners_is_an_error_with_its_place(self):
        notched = "section = [[-2, 0], [2, 0], [2, 3], [0, 1], [-2, 3]]"
        self.write("adit.toml", THEORY.replace('section = "circle"\nradius = 2', notched))
        error = self.json_of("theory", "adit.toml", status=2)["error"]
        self.assertEqual(error["key"], "block_theory.tunnel[1].section")
        self.assertGreater(error["line"], 0)


class Loads(ProgramTest):
    """A box of 2 × 3 × 4 m, 480 kN, on a rough floor."""

    def keys(self, more):
        self.write("cube.toml", CUBE_ON_A_FLOOR + more)
        return self.json_of("support", "cube.toml")["keyblocks"]

    def test_stands_without_any(self):
        self.assertEqual(self.keys(""), [])

    def test_an_earthquake_turns_it_before_it_slides(self):
        (key,) = self.keys("[support]\nseismic_coefficient = [0.6, 0, 0]\n")
        self.assertEqual((key["mode"], key["planes"]), ("rotation", ["floor"]))
        self.assertAlmostEqual(key["factor_of_safety"], (480 * 1) / (0.6 * 480 * 2), delta=1e-9)
        self.assertEqual(key["rotation"]["about"], "edge")

    def test_a_point_load_pushes_it(self):
        (key,) = self.keys("[[point_load]]\npoint = [2, 1.5, 0.5]\nforce = [-500e3, 0, 0]\n")
        self.assertEqual(key["mode"], "single_plane")
        self.assertAlmostEqual(key["driving_force"], 500e3, delta=1e-6)
        self.assertAlmostEqual(key["resisting_force"], 480e3, delta=1e-6)

    def test_water_under_it_carries_a_part(self):
        water = "[[water]]\njoints = ['floor']\nhead = 5\n[support]\nrotation = false\nseismic_coefficient = [0.5, 0, 0]\n"
        (key,) = self.keys(water)
        self.assertAlmostEqual(key["normal_forces"][0], 480e3 - 1000 * 10 * 5 * 6, delta=1e-6)

    def test_a_point_load_beside_the_rock_is_an_error(self):
        self.write("cube.toml", CUBE_ON_A_FLOOR + "[[point_load]]\npoint = [5, 5, 5]\nforce = [1, 0, 0]\n")
        error = self.json_of("support", "cube.toml", status=2)["error"]
        self.assertEqual(error["key"], "point_load[1].point")
        self.assertIn("is not in the rock", error["message"])

    def nothing_moves(self, text, why):
        """Exit status 0 and a whole document, whose lists are empty; the same in words."""
        self.write("still.toml", text)
        document = self.json_of("support", "still.toml")
        self.assertEqual((document["keyblocks"], document["stable"], document["totals"]["batches"]), ([], [], []))
        self.assertEqual((document["totals"]["keyblocks"], document["totals"]["support_force"]), (0, 0))
        self.assertEqual(len(document["blocks"]), document["totals"]["blocks"])
        self.assertIn("no block can move: " + why, document["warnings"][0])
        told = self.run_program("support", "still.toml")
        self.assertIn("none: no block can move", told.stdout)
        self.assertIn(why, told.stderr)
        return document

    def test_without_a_finite_block_nothing_moves(self):
        sides = CUBE_ON_A_FLOOR.replace('["zmin"]', '["xmin", "zmin"]')
        self.nothing_moves(sides, "none is finite")
        document = self.nothing_moves(sides.split("[[joint]]")[0] + DESIGN, "none is finite")
        self.assertEqual(document["bolting"]["adequate"], 0)
        self.assertLess({"keys.csv", "net.svg", "still.vtkhdf"}, set(self.files()))

    def test_without_a_free_face_nothing_moves(self):
        text = CUBE_ON_A_FLOOR.replace('["zmin"]', '["xmin", "xmax", "ymin", "ymax", "zmin", "zmax"]')
        text = text.split("[[joint]]")[0]
        for axis, (dip, direction) in enumerate(((90, 90), (90, 0), (0, 0))):
            for at in (0.5, 1.5):
                point = [1, 1, 1]
                point[axis] = at
                text += f"[[joint]]\ndip = {dip}\ndip_direction = {direction}\npoint = {point}\n"
        document = self.nothing_moves(text, "every finite one is enclosed")
        self.assertEqual([b["class"] for b in document["blocks"]].count("tapered"), 1)

    def test_a_block_that_nothing_lets_out_cannot_move(self):
        """Finite, with a free face, but wider behind it than in it."""
        text = CUBE_ON_A_FLOOR.split("[[joint]]")[0].replace('["zmin"]', '["xmin", "xmax", "ymin", "ymax", "zmin"]')
        for dip, direction, point in ((80, 90, [0.9, 1, 4]), (80, 270, [1.1, 1, 4]), (80, 0, [1, 0.9, 4]), (80, 180, [1, 1.1, 4])):
            text += f"[[joint]]\ndip = {dip}\ndip_direction = {(direction + 180) % 360}\npoint = {point}\n"
        text += "[[joint]]\ndip = 0\ndip_direction = 0\npoint = [1, 1, 3]\n"
        self.write("plug.toml", text)
        self.assertIn("none: no block can move", self.run_program("support", "plug.toml").stdout)

    def test_without_three_sets_no_block_of_a_tunnel_can_move(self):
        first, _, rest = THEORY.partition('[[joint_set]]\nname = "J2"')
        self.write("adit.toml", first + "[block_theory]" + rest.partition("[block_theory]")[2])
        document = self.json_of("theory", "adit.toml")
        self.assertEqual((document["tunnels"][0]["blocks"], document["slopes"][0]["blocks"]), ([], []))
        self.assertEqual(document["tunnels"][0]["monte_carlo"]["pyramids"], [])
        self.assertIn("no block can move", self.run_program("theory", "adit.toml").stdout)


# The wedge of two joints whose line comes out at the toe of a slope, as joint sets alone and as rock that is cut.
WEDGE = """[[material]]
density = 2562
[[joint_material]]
name = "A"
friction_angle = 30
cohesion = 20e3
[[joint_material]]
name = "B"
friction_angle = 35
cohesion = 40e3
"""
A, B = 'name = "A"\ndip = 45\ndip_direction = 105\nmaterial = "A"\n', 'name = "B"\ndip = 70\ndip_direction = 235\nmaterial = "B"\n'
FACE, UPPER, HEIGHT = (65, 185), (12, 195), 40


class WetWedge(ProgramTest):
    def in_theory(self, water):
        self.write("theory.toml", WEDGE + f"[[joint_set]]\nspacing = 9\n{A}[[joint_set]]\nspacing = 9\n{B}"
                   f"[[block_theory.slope]]\ndip = {FACE[0]}\ndip_direction = {FACE[1]}\nheight = {HEIGHT}\n"
                   f"upper_dip = {UPPER[0]}\nupper_dip_direction = {UPPER[1]}\n" + water)
        (block,) = [b for b in self.json_of("theory", "theory.toml")["slopes"][0]["blocks"]]
        return block

    def in_rock(self, water):
        x, y = (-HEIGHT / math.tan(math.radians(FACE[0])) * f(math.radians(FACE[1])) for f in (math.sin, math.cos))
        plane = "{{dip = {}, dip_direction = {}, point = [{}, {}, {}], keep = '{}'}}"
        planes = [plane.format(*FACE, 0, 0, 0, "below"), plane.format(*UPPER, x, y, HEIGHT, "below"),
                  plane.format(0, 0, 0, 0, -50, "above")]
        for direction in (0, 90, 180, 270):
            dx, dy = 300 * math.sin(math.radians(direction)), 300 * math.cos(math.radians(direction))
            planes.append(plane.format(90, direction, dx, dy, 0, "below"))
        self.write("rock.toml", WEDGE + "[[solid]]\nname = 'rock'\nshape = 'halfspaces'\ncontinues = ['2', '3', '4', '5', '6']\n"
                   f"planes = [{', '.join(planes)}]\n[[joint]]\npoint = [0, 0, 0]\n{A}[[joint]]\npoint = [0, 0, 0]\n{B}"
                   "[support]\nrotation = false\n" + water)
        document = self.json_of("support", "rock.toml")
        (block,) = document["keyblocks"] + document["stable"]
        return block

    def test_is_that_of_the_cut_rock_at_every_head(self):
        factors = []
        for water in ("", "[[water]]\nhead = 15\n", "[[water]]\nhead = 30\njoints = ['A']\n",
                      "[[water]]\ntable = {point = [0, 0, 5], dip = 20, dip_direction = 185}\n", "[[water]]\npressure = 5e4\n"):
            theory, rock = self.in_theory(water), self.in_rock(water)
            self.assertAlmostEqual(theory["volume"], rock["volume"], delta=1e-9 * rock["volume"])
            self.assertAlmostEqual(theory["factor_of_safety"], rock["factor_of_safety"], delta=1e-9)
            factors.append(round(theory["factor_of_safety"], 6))
        self.assertEqual(len(set(factors)), len(factors))
        self.assertEqual(max(factors), factors[0])

    def test_head_above_the_crest_is_told_and_one_of_a_tunnel_refused(self):
        self.in_theory("[[water]]\nhead = 45\n")
        self.assertIn("above the crest", self.run_program("theory", "theory.toml").stderr)
        self.write("adit.toml", THEORY + "[[water]]\nhead = 45\n")
        self.assertIn("no head or table", self.run_program("theory", "adit.toml", status=2).stderr)


if __name__ == "__main__":
    unittest.main()
