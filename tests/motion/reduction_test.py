"""[reduction]: the factor by which a mass's strength may be divided is what statics says."""
import math
import signal
import subprocess
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "cli"))
from program import BINARY, SANITIZED, ProgramTest  # noqa: E402


def block_on_plane(dip, law, reduction="", analysis=""):
    """A cube on a plane: the model is turned, the plane is z = 0."""
    a = math.radians(dip)
    return f"""
gravity = [{9.81 * math.sin(a)!r}, 0, {-9.81 * math.cos(a)!r}]
[[material]]
density = 2500
young_modulus = 1e10
poisson_ratio = 0.25
[[joint_material]]
name = "plane"
normal_stiffness = 1e9
shear_stiffness = 1e9
{law}
[[solid]]
name = "base"
shape = "box"
min = [-2, -2, -1]
max = [9, 2, 0]
[[solid]]
name = "cube"
shape = "box"
min = [-0.5, -0.5, 0]
max = [0.5, 0.5, 1]
interface = "plane"
[cover]
lattice = "block"
[[fixed]]
where = {{block_at = [0, 0, -0.5]}}
[[step]]
type = "quasi_static"
time_step = 0.01
steps = 20
[[step]]
type = "dynamic"
time_step = 0.01
end_time = 1.0
{analysis}
[reduction]
{reduction}
"""


# A wedge on two planes, as in the limits of block theory: 3DEC's Sliding_Wedge has the same two.
WEDGE = """
[[material]]
density = 2600
young_modulus = 1e10
poisson_ratio = 0.25
[[joint_material]]
name = "joint"
friction_angle = 40
normal_stiffness = 1e9
shear_stiffness = 1e9
[[solid]]
name = "slope"
shape = "halfspaces"
continues = ["2", "3", "4", "5"]
planes = [{dip = 65, dip_direction = 180, point = [0, 0, 0], keep = "below"},
          {normal = [0, 0, 1], point = [0, 0, 10], keep = "below"},
          {normal = [0, 0, 1], point = [0, 0, -10], keep = "above"},
          {normal = [0, 1, 0], point = [0, 30, 0], keep = "below"},
          {normal = [1, 0, 0], point = [-20, 0, 0], keep = "above"},
          {normal = [1, 0, 0], point = [20, 0, 0], keep = "below"}]
[[joint]]
name = "left"
dip = 50
dip_direction = 120
point = [0, 1, 2]
[[joint]]
name = "right"
dip = 55
dip_direction = 230
point = [0, 1, 2]
[cover]
lattice = "block"
[support]
rotation = false
"""


class StrengthReduction(ProgramTest):
    def factor_of(self, model, *more):
        self.write("model.toml", model)
        return self.json_of("run", "model.toml", *more)

    def test_of_a_block_on_a_plane_is_the_ratio_of_tangents(self):
        document = self.factor_of(block_on_plane(30, "friction_angle = 38"))
        found = document["reduction"]
        self.assertAlmostEqual(found["factor"], math.tan(math.radians(38)) / math.tan(math.radians(30)), delta=0.01)
        self.assertLessEqual(found["fails"] - found["stands"], 0.01)
        self.assertEqual(found["blocks"], [2])
        self.assertEqual(found["shown"], found["fails"])
        self.assertGreater(document["rest"]["speed"], 0)
        # What it says of each trial agrees.
        for trial in found["trials"]:
            self.assertEqual(trial["stands"], trial["factor"] <= found["stands"])

    def on_rock(self, law, height, reduction=""):
        """The block on a plane of 50 degrees, on rock that goes on below, with what block theory says of it."""
        model = block_on_plane(50, f"friction_angle = 30\ncohesion = 3000\n{law}", reduction)
        model = model.replace("max = [0.5, 0.5, 1]", f"max = [0.5, 0.5, {height}]")
        return model.replace("max = [9, 2, 0]", 'max = [9, 2, 0]\ncontinues = ["zmin"]') + "[support]\nrotation = false\n"

    def slab(self, law):
        """So low that all of its joint is pressed."""
        document = self.factor_of(self.on_rock(law, 0.2))
        (key,) = document["support"]["keyblocks"] + document["support"]["stable"]
        return document["reduction"], key

    def test_is_block_theorys_factor_with_cohesion_which_slip_does_not_take(self):
        # F = (c A + N tan φ) / (W sin θ)
        a, weight = math.radians(50), 2500 * 9.81 * 0.2
        expected = (3000 + weight * math.cos(a) * math.tan(math.radians(30))) / (weight * math.sin(a))
        found, key = self.slab("")
        self.assertAlmostEqual(key["factor_of_safety"], expected, delta=1e-9)
        self.assertEqual(key["residual_factor_of_safety"], key["factor_of_safety"])
        self.assertAlmostEqual(found["factor"], expected, delta=0.01)
        self.assertEqual(found["loses_strength"], [])

    def test_is_lower_where_slip_takes_cohesion(self):
        # The upper edge, pressed least, breaks first, and what it loses comes upon the rest: between the factors before and after slip.
        found, key = self.slab("residual_cohesion = 0")
        self.assertAlmostEqual(key["residual_factor_of_safety"], math.tan(math.radians(30)) / math.tan(math.radians(50)), delta=1e-9)
        self.assertGreater(found["factor"], key["residual_factor_of_safety"] - 0.01)
        self.assertLess(found["factor"], key["factor_of_safety"] - 0.1)  # ten times the tolerance
        self.assertEqual(found["loses_strength"], ["plane"])

    def test_tells_in_its_summary_with_which_strength_it_was_found(self):
        for law, words in (("", "found with joints that keep their strength as they slip"),
                           ("residual_cohesion = 1e3\nresidual_friction_angle = 20",
                            "found with joints that lose strength at the first slip: plane (cohesion 3 kPa, then 1; friction 30 deg, then 20)")):
            with self.subTest(law=law):
                self.write("model.toml", self.on_rock(law, 1, "tolerance = 1"))
                text = self.run_program("run", "model.toml").stdout
                self.assertIn(words, text)
                self.assertRegex(text, r"block theory has 0\.\d\d for block 2" + (r", 0\.\d\d on joints that have slipped" if law else r"\n"))

    def test_says_where_the_factor_lies_outside(self):
        for factors, stands, fails in (("[0.3, 0.5]", True, False), ("[2, 3]", False, True)):
            with self.subTest(factors=factors):
                found = self.factor_of(block_on_plane(30, "friction_angle = 38", f"factors = {factors}\ntolerance = 0.1"))["reduction"]
                self.assertIsNone(found["factor"])
                self.assertEqual(found["stands"] is not None, stands)
                self.assertEqual(found["fails"] is not None, fails)

    def test_takes_what_fell_and_came_to_rest_for_failed(self):
        # Restrained by a step 0.4 m further on, the cube comes to rest there.
        stop = '[[solid]]\nname = "stop"\nshape = "box"\nmin = [0.9, -2, 0]\nmax = [1.9, 2, 2]\n[[fixed]]\nwhere = {block_at = [1.5, 0, 1]}\n'
        model = block_on_plane(30, "friction_angle = 20", "factors = [0.3, 2]\ntolerance = 0.02", stop).replace("end_time = 1.0", "end_time = 2.0")
        found = self.factor_of(model)["reduction"]
        self.assertAlmostEqual(found["factor"], math.tan(math.radians(20)) / math.tan(math.radians(30)), delta=0.02)

    def test_is_block_theorys_factor_of_a_wedge(self):
        steps = "".join(f'[[fixed]]\nwhere = {{face = "slope.{face}"}}\n' for face in (2, 3, 4, 5))
        model = WEDGE + steps + ('[[step]]\ntype = "quasi_static"\ntime_step = 0.02\nsteps = 10\n[[step]]\ntype = "dynamic"\n'
                                 "time_step = 0.02\nend_time = 2.0\n[reduction]\nfactors = [0.5, 2.5]\n")
        document = self.factor_of(model)
        self.assertNotIn("confirmed", document)
        key, found = document["support"]["stable"][0], document["reduction"]
        self.assertAlmostEqual(found["factor"], key["factor_of_safety"], delta=0.01)
        self.assertEqual(found["blocks"], key["blocks"])

    @unittest.skipIf(SANITIZED, "the same code, with more blocks")
    def test_of_a_slope_that_topples_is_limit_equilibriums(self):
        # Goodman & Bray (1976): tan φ = 0.785544. That has each force at the edge about which a block turns; blocks that have not turned yet lean on
        # whole faces and stand with less. A slope that was steeper for a while, without inertia, has them where they turn.
        self.copy_case("toppling_slope")
        text = (self.folder / "toppling_slope.toml").read_text(encoding="utf-8")
        steps = ('[[step]]\ntype = "quasi_static"\ntime_step = 0.1\nsteps = 30\n[[step]]\ntype = "dynamic"\ntime_step = 0.02\nend_time = 6.0\n'
                 "reset_displacement = true\n[reduction]\nfactors = [1.24, 1.32]\ntolerance = 0.01\n")
        tilt = "table = [[0, 0, 0, 0], [0.3, 0, 0, 0], [0.4, 0.5, 0, 0], [0.7, 0.5, 0, 0], [1.7, 0, 0, 0]]"
        rock = text[: text.index("[[step]]")].replace("friction_angle = 37.97", "friction_angle = 45").replace("table = [[0, 0.5, 0, 0], [0.3, 0.5, 0, 0], [1.3, 0, 0, 0]]", tilt)
        self.assertIn(tilt, rock)
        found = self.factor_of(rock + steps)["reduction"]
        self.assertAlmostEqual(found["factor"], 1 / 0.785544, delta=0.01)

    def test_goes_on_from_where_a_run_was_killed(self):
        model = block_on_plane(30, "friction_angle = 38", "factors = [1, 1.5]\ntolerance = 0.05").replace("end_time = 1.0", "end_time = 3.0")
        whole = self.factor_of(model, "-o", "whole.vtkhdf")
        for sent in (signal.SIGINT, signal.SIGKILL):
            with self.subTest(sent=sent):
                process = subprocess.Popen([BINARY, "run", "model.toml", "-o", "cut.vtkhdf", "-q", "--set", "output.every=1", "--set",
                                            "output.checkpoint_every=0"], cwd=self.folder)
                while process.poll() is None and not (Path(self.folder) / "cut.vtkhdf.checkpoint").exists():
                    pass
                process.send_signal(sent)
                process.wait()
                document = self.json_of("resume", "cut.vtkhdf")
                self.assertEqual(document["reduction"], whole["reduction"])
                self.assertEqual(document["blocks"], whole["blocks"])


class Refused(ProgramTest):
    def test_is_what_no_reduction_can_be_made_of(self):
        good = block_on_plane(30, "friction_angle = 38")
        for change, key, said in ((("[reduction]\n", "[reduction]\nfactors = [2, 1]\n"), "reduction.factors", "must be [smallest, largest]"),
                                  (("[reduction]\n", "[reduction]\nfactors = [2]\n"), "reduction.factors", "2 factors"),
                                  (("[reduction]\n", "[reduction]\ntolerance = 0\n"), "reduction.tolerance", "must be > 0"),
                                  (("[reduction]\n", "[reduction]\nmax_displacment = 1\n"), "reduction.max_displacment", "max_displacement"),
                                  (('type = "dynamic"', 'type = "quasi_static"'), "reduction", "ends dynamically"),
                                  (("friction_angle = 38", "friction_angle = 0"), "reduction", "no [[joint_material]] has any"),
                                  (('lattice = "block"', 'lattice = "block"\njoints = "welded"'), "reduction", "joints in contact")):
            with self.subTest(said=said):
                self.write("model.toml", good.replace(*change, 1))
                told = self.run_program("run", "model.toml", status=2).stderr
                self.assertIn(f": {key}", told)
                self.assertIn(said, told)


if __name__ == "__main__":
    unittest.main()
