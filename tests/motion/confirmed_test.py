"""Block theory meets motion: beside each key block how it began to move, and which blocks moved without being one."""
import json
import math
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "cli"))
from program import ProgramTest  # noqa: E402

# Two blocks: rock that is held, and what is in or on it, parted by the joint around the solid.
HEAD = """
[[material]]
density = 2500
young_modulus = 1e10
poisson_ratio = 0.25
[[joint_material]]
name = "clean"
friction_angle = {friction}
[support]
[cover]
lattice = "block"
"""
DYNAMIC = '[analysis]\ntype = "dynamic"\ntime_step = 0.002\nend_time = {}\n'
ROOF = """
[[solid]]
name = "rock"
shape = "box"
min = [-4, -4, -1]
max = [4, 4, 4]
continues = ["xmin", "xmax", "ymin", "ymax", "zmax"]
[[solid]]
name = "roof"
shape = "pyramid"
base = [[-1, -1, -1], [1, -1, -1], [1.2, 1, -1], [-1, 1, -1]]
apex = [0.1, 0.2, 1.5]
interface = "clean"
[[fixed]]
where = {face = "rock.zmax"}
"""
FLOOR = """
[[solid]]
name = "floor"
shape = "box"
min = [-2, -2, -1]
max = [4, 3, 0]
continues = ["zmin"]
[[fixed]]
where = {face = "floor.zmin"}
[[solid]]
name = "leaning"
shape = "prism"
base = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
interface = "clean"
"""
STEPS = """
[[step]]
type = "quasi_static"
time_step = 0.1
steps = {}
[[step]]
type = "dynamic"
time_step = 0.002
end_time = {}
reset_displacement = true
"""
G = 9.81


def brittle_slab(residual):
    """Gravity is turned: the plane is z = 0."""
    a = math.radians(50)
    text = HEAD.format(friction=30) + FLOOR.replace("[1, 1, 0], [0, 1, 0]]", "[1, 1, 0], [0, 1, 0]]\nextrude = [0, 0, 0.2]")
    law = f"cohesion = 2200\nresidual_cohesion = {residual}\nnormal_stiffness = 1e9\nshear_stiffness = 1e9\n[support]\nrotation = false\n"
    gravity = f"gravity = [{G * math.sin(a)!r}, 0, {-G * math.cos(a)!r}]\n"
    return gravity + text.replace("[support]\n", law) + STEPS.format(20, 0.5).replace("time_step = 0.1", "time_step = 0.01")


def length(vector):
    return math.sqrt(sum(x * x for x in vector))


def degrees_between(a, b):
    return math.degrees(math.acos(min(1, sum(x * y for x, y in zip(a, b)) / length(a) / length(b))))


class ConfirmedTest(ProgramTest):
    def run_text(self, text):
        self.write("model.toml", text)
        done = self.run_program("run", "model.toml", "--force", "--json-file", "model.json")
        return done.stdout, json.loads((self.folder / "model.json").read_text(encoding="utf-8"))

    def run_wedge(self, friction, edit=lambda text: text):
        self.copy_case("sliding_wedge")
        text = edit((self.folder / "sliding_wedge.toml").read_text(encoding="utf-8"))
        return self.run_text(text.replace("friction_angle = 20.0", f"friction_angle = {friction}"))


class KeyBlocks(ConfirmedTest):
    def test_slide_down_the_line_of_two_joints(self):
        text, document = self.run_wedge(20)
        wedge, = document["confirmed"]
        key, = document["support"]["keyblocks"]
        self.assertEqual((wedge["block"], wedge["blocks"], wedge["batch"]), (key["block"], [4], 1))
        told = ("direction", "factor_of_safety", "residual_factor_of_safety")
        self.assertEqual(wedge["predicted"], {"mode": "two_planes", **{name: key[name] for name in told}})
        self.assertEqual(key["residual_factor_of_safety"], key["factor_of_safety"])
        seen = wedge["seen"]
        self.assertEqual(seen["mode"], "sliding")
        self.assertTrue(wedge["agree"])
        self.assertIsNone(wedge["reason"])
        self.assertLess(degrees_between(seen["direction"], key["direction"]), 0.1)
        self.assertAlmostEqual(seen["off_direction"], degrees_between(seen["direction"], key["direction"]), 4)
        self.assertAlmostEqual(length(seen["direction"]), 1, 12)
        a, t = 2.643227, 0.3
        self.assertAlmostEqual(seen["moved"] / (0.5 * a * t * t), 1, 2)
        for one, other in zip(seen["displacement"], document["blocks"][3]["displacement"]):
            self.assertAlmostEqual(one, other, delta=1e-14)  # two sums of the same numbers
        # After the first step of 2 ms that has moved it by a hundredth of its size.
        began = math.sqrt(2 * 0.01 * key["volume"]**(1 / 3) / a)
        self.assertTrue(began < seen["began"] < began + 0.003, (began, seen["began"]))
        self.assertRegex(text, r"key blocks that move +1 of 1 .*, 1 as predicted")

    def test_fall_from_a_roof(self):
        _, document = self.run_text(HEAD.format(friction=10) + ROOF + DYNAMIC.format(0.2))
        block, = document["confirmed"]
        self.assertEqual(block["predicted"]["mode"], "lifting")
        self.assertEqual(block["seen"]["mode"], "falling")
        self.assertTrue(block["agree"])
        self.assertAlmostEqual(block["seen"]["moved"], 0.5 * G * 0.2**2, 6)

    def test_fall_into_an_excavation(self):
        """Excavated rock is gone before the analysis begins: it touches nothing."""
        room = '[[excavation]]\nname = "room"\nshape = "box"\nmin = [-2, -2, -3]\nmax = [2, 2, -1]\n'
        for cover in ('lattice = "block"', 'lattice = "tet6"\nspacing = 3'):
            text = (HEAD.format(friction=10) + ROOF.replace("min = [-4, -4, -1]", "min = [-4, -4, -3]") + room + DYNAMIC.format(0.2))
            _, document = self.run_text(text.replace('lattice = "block"', cover))
            block, = document["confirmed"]
            self.assertEqual((block["seen"]["mode"], block["agree"]), ("falling", True))
            self.assertAlmostEqual(block["seen"]["moved"], 0.5 * G * 0.2**2, 4)

    def test_turn_about_an_edge(self):
        _, document = self.run_text(HEAD.format(friction=30) + FLOOR + "extrude = [1.5, 0.2, 2]\n" + DYNAMIC.format(0.4))
        block, = document["confirmed"]
        self.assertEqual(block["predicted"]["mode"], "rotation")
        self.assertEqual(block["seen"]["mode"], "rotation")
        self.assertTrue(block["agree"])
        self.assertGreater(block["seen"]["rotation"], 0.5)

    def test_that_are_thrown_upwards_do_not_agree(self):
        push = '[[initial_velocity]]\nwhere = {block_at = [2.5, -2.5, 2.5]}\nvelocity = [0, 0, 3]\n'
        _, document = self.run_wedge(20, lambda text: text + push)
        wedge, = document["confirmed"]
        self.assertFalse(wedge["agree"])
        self.assertEqual(wedge["reason"], "loads")
        self.assertGreater(wedge["seen"]["off_direction"], 90)

    def test_that_stay_are_listed(self):
        hold = '[[fixed]]\nwhere = {block_at = [2.5, -2.5, 2.5]}\n'
        text, document = self.run_wedge(20, lambda text: text + hold)
        wedge, = document["confirmed"]
        self.assertEqual(wedge["predicted"]["mode"], "two_planes")
        self.assertEqual((wedge["seen"]["mode"], wedge["seen"]["direction"], wedge["seen"]["began"]), ("none", [0, 0, 0], None))
        self.assertFalse(wedge["agree"])
        self.assertEqual(wedge["reason"], "held")
        self.assertRegex(text, r"slides on two +two, one +0.55 +stays .* no: held")

    def test_that_had_no_time_to_move(self):
        """A hundredth of 66.6 m3 ** 1/3 takes 0.175 s; quasi-static steps of 20 ms begin at rest."""
        short = [lambda text: text.replace("end_time = 0.3", "end_time = 0.15"),
                 lambda text: text.replace('"dynamic"', '"quasi_static"').replace("time_step = 0.002", "time_step = 0.02")]
        for edit in short:
            _, document = self.run_wedge(20, edit)
            wedge, = document["confirmed"]
            self.assertEqual((wedge["seen"]["mode"], wedge["reason"]), ("none", "time"))

    def test_that_an_earthquake_of_block_theory_alone_would_move(self):
        _, document = self.run_wedge(35, lambda text: text.replace("[support]", "[support]\nseismic_coefficient = [0.3, -0.3, 0]"))
        wedge, = document["confirmed"]
        self.assertEqual((wedge["seen"]["mode"], wedge["reason"]), ("none", "loads"))


class OtherBlocks(ConfirmedTest):
    def test_that_friction_holds_are_not_listed(self):
        _, document = self.run_wedge(35)
        self.assertEqual(document["confirmed"], [])
        self.assertEqual(document["rest"]["moved_blocks"], 0)

    def test_that_move_without_being_key_have_no_prediction(self):
        push = '[[initial_velocity]]\nwhere = {block_at = [2.5, -2.5, 2.5]}\nvelocity = [0, 0, 3]\n'
        text, document = self.run_wedge(35, lambda text: text + push)
        self.assertEqual(document["support"]["keyblocks"], [])
        wedge, = document["confirmed"]
        self.assertEqual((wedge["block"], wedge["batch"], wedge["predicted"], wedge["agree"]), (4, None, None, False))
        self.assertIsNone(wedge["seen"]["off_direction"])
        self.assertNotEqual(wedge["seen"]["mode"], "none")
        self.assertRegex(text, r"others that move +4 \w+ \(loads\)")

    def test_move_where_slip_takes_the_cohesion_that_block_theory_counts(self):
        """A slab on a plane of 50 degrees. Its upper edge, pressed least, breaks, and what it loses comes upon the rest."""
        for residual, moves in ((2200, False), (0, True)):
            text, document = self.run_text(brittle_slab(residual))
            slab, = document["support"]["stable"]
            # (c A + N tan φ) / (W sin θ)
            w, a = 2500 * G * 0.2, math.radians(50)
            self.assertAlmostEqual(slab["factor_of_safety"], (2200 + w * math.cos(a) * math.tan(math.radians(30))) / (w * math.sin(a)), delta=1e-9)
            self.assertEqual([block["block"] for block in document["confirmed"]], [slab["block"]] if moves else [])
            if moves:
                self.assertAlmostEqual(slab["residual_factor_of_safety"], math.tan(math.radians(30)) / math.tan(math.radians(50)), delta=1e-9)
                self.assertEqual(document["confirmed"][0]["reason"], "strength")
                self.assertIn("  strength lost by slip  clean (cohesion 2.2 kPa, then 0)\n", text)
                self.assertRegex(text, r"\n +block +volume +weight +motion +on +safety +slipped +net +support +pressure\n")
            else:
                self.assertNotIn("slip ", text.replace("largest slip ", ""))

    def test_move_where_rock_beside_them_is_not_held(self):
        def loosen(text):
            begin = text.index("[[fixed]]\nwhere = {block_at = [-2.9, -2.9, -2.9]}")
            return text[:begin] + text[text.index("[analysis]"):]
        _, document = self.run_wedge(35, lambda text: loosen(text).replace("end_time = 0.3", "end_time = 0.6"))
        self.assertEqual([(entry["block"], entry["predicted"], entry["reason"]) for entry in document["confirmed"]], [(4, None, "rock")])

    def test_that_are_not_finite_are_not_listed(self):
        _, document = self.run_text(HEAD.format(friction=10) + ROOF[:ROOF.index("[[fixed]]")] + DYNAMIC.format(0.2))
        self.assertEqual([entry["block"] for entry in document["confirmed"]], [1])
        self.assertEqual(document["rest"]["moved_blocks"], 2)


class Resetting(ConfirmedTest):
    def test_of_displacements_leaves_what_has_moved(self):
        """What slid while gravity was put on has moved, though the last step is too short to move it again."""
        steps = STEPS.format(10, 0.02)
        _, document = self.run_wedge(20, lambda text: text[:text.index("[analysis]")] + steps)
        wedge, = document["confirmed"]
        a, dt = 2.643227, 0.1  # quasi-static steps begin at rest
        self.assertGreater(wedge["seen"]["moved"], 10 * 0.25 * a * dt * dt)
        self.assertTrue(wedge["agree"])
        self.assertLess(length(document["blocks"][3]["displacement"]), 0.01)
        self.assertEqual(document["rest"]["moved_blocks"], 0)


class Resuming(ConfirmedTest):
    def test_gives_the_same(self):
        _, whole = self.run_wedge(20)
        self.run_program("run", "model.toml", "--force", "--max-time", "0.05", status=1)
        resumed = self.json_of("resume", "model.vtkhdf")
        self.assertEqual(resumed["confirmed"], whole["confirmed"])


class WithoutContactOrBlockTheory(ConfirmedTest):
    def test_there_is_nothing_to_confirm(self):
        _, document = self.run_wedge(20, lambda text: text.replace("[support]", ""))
        self.assertNotIn("confirmed", document)
        _, document = self.run_wedge(20, lambda text: text.replace('lattice = "block"', 'joints = "welded"\nspacing = 3'))
        self.assertNotIn("confirmed", document)


if __name__ == "__main__":
    unittest.main()
