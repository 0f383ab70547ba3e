"""Wrong input of block theory and support: an exit status of 2 and an error with its file, line and key."""
import unittest

from program import ProgramTest

ROCK = """[[material]]
density = 2000
[[joint_material]]
friction_angle = 30
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
AFTER = ROCK.count("\n") + 1  # the line in which what is added starts
BOLT = 'displacement_capacity = 0.02\ncollar = [0, 1, 1]\ndirection = [1, 0, 0]\nlength = 1\n'
PATTERN = "force_capacity = 1e5\ndisplacement_capacity = 0.02\nlength = 2\nspacing = 1\n"
Q = "[classification.q]\njr = {jr}\nja = {ja}\njw = 1\nsrf = {srf}\n"
RMR = "[classification.rmr]\nuniaxial_strength = 1e8\njoint_condition = {}\ngroundwater = 'dry'\norientation = 'fair'\n"


class BadSupport(ProgramTest):
    def refused(self, text, line, key, *words):
        """The same in words and as JSON."""
        self.write("bad.toml", text)
        error = self.json_of("support", "bad.toml", status=2)["error"]
        self.assertEqual((error["kind"], error["line"], error["key"]), ("model", line, key), error)
        self.assertTrue(error["file"].endswith("bad.toml"))
        said = self.run_program("support", "bad.toml", status=2).stderr
        self.assertIn(f"bad.toml:{line}:", said)
        for word in (key, *words):
            self.assertIn(word, said)
        self.assertEqual(self.files(), ["bad.toml"])  # no result file

    def test_without_gravity(self):
        self.refused("gravity = [0, 0, 0]\n" + ROCK, 1, "gravity", "nothing")

    def test_of_bolts_on_a_wall_that_is_not_there(self):
        for wall, words in (("tunnel", 'the model has: rock'), ("rock.top", 'unknown face "top"')):
            self.refused(ROCK + f"[[bolt_pattern]]\n{PATTERN}on = '{wall}'\n", AFTER + 5, "bolt_pattern[1].on", words)
        # A face that the model has and the cut rock does not show.
        hidden = "[[solid]]\nname = 'hidden'\nshape = 'box'\nmin = [0.5, 0.5, 1]\nmax = [1, 1, 2]\n"
        self.refused(ROCK + hidden + f"[[bolt_pattern]]\n{PATTERN}on = 'hidden'\n", AFTER + 5, "bolt_pattern[1].on", "hidden")

    def test_of_capacities_that_are_none(self):
        for value in ("0", "-5e3"):
            self.refused(ROCK + f"[[bolt]]\nforce_capacity = {value}\n{BOLT}", AFTER + 1, "bolt[1].force_capacity", "must be > 0 (N)")
        for key in ("bond_strength", "stiffness", "mass_per_metre"):
            self.refused(ROCK + f"[[bolt]]\nforce_capacity = 1e5\n{key} = 0\n{BOLT}", AFTER + 2, f"bolt[1].{key}", "must be > 0")
        self.refused(ROCK + "[shotcrete]\non = 'rock'\nthickness = 0.1\nshear_strength = 0\n", AFTER + 3,
                     "shotcrete.shear_strength", "must be > 0 (Pa)")
        self.refused(ROCK + "[support]\ntarget_factor_of_safety = 0\n", AFTER + 1, "support.target_factor_of_safety", "must be > 0")

    def test_of_ratings_outside_the_published_tables(self):
        good = {"jr": 1, "ja": 1, "srf": 1}
        for line, key, value in ((1, "jr", 6), (2, "ja", 0.5), (4, "srf", 401)):
            self.refused(ROCK + Q.format(**{**good, key: value}), AFTER + line, f"classification.q.{key}", f"found {value}")
        self.refused(ROCK + RMR.format(31), AFTER + 2, "classification.rmr.joint_condition", "must be 0 to 30")
        self.refused(ROCK + RMR.format("'smooth'"), AFTER + 2, "classification.rmr.joint_condition", "very_rough")


if __name__ == "__main__":
    unittest.main()
