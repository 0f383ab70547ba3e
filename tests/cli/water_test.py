"""[[water]] in joints that drain, from the model to the factor of safety, against limit equilibrium by hand."""
import math
import unittest

from program import ProgramTest

G, GAMMA = 9.81, 9810.0
DENSITY, PHI, DIP, HEIGHT = 2650, math.radians(40), math.radians(35), 15.0
CREST = HEIGHT / math.sqrt(3)  # of a face of 60°
TOP = HEIGHT / math.tan(DIP)   # where the plane through the toe comes out

# A slice of 1 m of a slope: its ends y = 0 and 1 are not where water goes.
SLOPE = f"""[[material]]
density = {DENSITY}
[[joint_material]]
friction_angle = 40
[[solid]]
name = "rock"
shape = "prism"
base = [[-10, 0, -10], [-10, 0, 0], [0, 0, 0], [{CREST}, 0, {HEIGHT}], [40, 0, {HEIGHT}], [40, 0, -10]]
extrude = [0, 1, 0]
continues = ["0", "4", "5"]
[support]
rotation = false
"""


def joint(name, points):
    return f"[[joint]]\nname = '{name}'\npolygon = {points}\n" + {
        "plane": "dip = 35\ndip_direction = 270\npoint = [0, 0, 0]\n",
        "crack": f"dip = 90\ndip_direction = 270\npoint = [{points[0][0]}, 0, 0]\n"}[name]


def strip(x, z, u, w):
    return [[x, -1, z], [x, 2, z], [u, 2, w], [u, -1, w]]


def plane_to(x):
    return joint("plane", strip(-0.01, -0.01 * math.tan(DIP), x, x * math.tan(DIP)))


def safety(area, uplift, push=0.0):
    """Hoek & Bray: a plane of dip ψ under W, with U normal to it and V level, out of the slope."""
    weight = DENSITY * G * area
    normal = weight * math.cos(DIP) - uplift - push * math.sin(DIP)
    return normal * math.tan(PHI) / (weight * math.sin(DIP) + push * math.cos(DIP))


class Slope(ProgramTest):
    def block(self, more):
        self.write("slope.toml", SLOPE + more)
        document = self.json_of("support", "slope.toml")
        (block,) = document["keyblocks"] + document["stable"]
        return block

    def factor(self, more):
        return self.block(more)["factor_of_safety"]

    def test_without_a_crack_has_its_peak_at_mid_height(self):
        area, whole = HEIGHT * (TOP - CREST) / 2, plane_to(TOP + 1)
        self.assertAlmostEqual(self.factor(whole), safety(area, 0), delta=1e-6)
        for head in (5, 10, 15):
            uplift = GAMMA * head ** 2 / (4 * math.sin(DIP))
            self.assertAlmostEqual(self.factor(whole + f"[[water]]\nhead = {head}\n"), safety(area, uplift), delta=1e-6)
        uplift = GAMMA * HEIGHT ** 2 / (2 * math.sin(DIP))
        for full in ("drains = false", "law = 'hydrostatic'"):
            self.assertAlmostEqual(self.factor(whole + f"[[water]]\nhead = 15\n{full}\n"), safety(area, uplift), delta=1e-6)

    def test_with_a_crack_has_the_triangles_of_hoek_and_bray(self):
        x = CREST + 4
        foot = x * math.tan(DIP)
        area = (x * foot / 2) + (HEIGHT - foot) * x - CREST * HEIGHT / 2
        joints = plane_to(x + 0.1) + joint("crack", strip(x, foot - 0.1, x, HEIGHT + 1))
        depth = HEIGHT - foot
        for water in (0.0, 0.4 * depth, depth):
            uplift, push = GAMMA * water * foot / math.sin(DIP) / 2, GAMMA * water ** 2 / 2
            found = self.factor(joints + f"[[water]]\nhead = {foot + water}\nlaw = 'drained'\n")
            self.assertAlmostEqual(found, safety(area, uplift, push), delta=1e-6)

    def test_under_a_reservoir_has_no_edge_that_drains(self):
        """Water of one level in the joint and before the face: what is left is buoyancy."""
        level = 30
        ponds = "".join(f"[[traction]]\nwhere = {{face = 'rock.{face}'}}\nhead = {level}\n" for face in (2, 3))
        found = self.factor(plane_to(TOP + 1) + f"[[water]]\nhead = {level}\n" + ponds)
        self.assertAlmostEqual(found, math.tan(PHI) / math.tan(DIP), delta=1e-9)

    def test_gets_no_safer_as_water_rises(self):
        for law in ("mid_height", "hydrostatic", "drained"):
            factors = [self.factor(plane_to(TOP + 1) + f"[[water]]\nhead = {head}\nlaw = '{law}'\n") for head in range(0, 16, 3)]
            self.assertEqual(factors, sorted(factors, reverse=True))


# Hoek & Bray's wedge in a slope of 40 m: joints 45/105 and 70/235, face 65/185, ground 12/195.
PLANES = {"A": (45, 105), "B": (70, 235)}
WEDGE = "".join(f"[[joint_material]]\nname = '{name}'\nfriction_angle = 30\ncohesion = 20e3\n"
                f"[[joint_set]]\nname = '{name}'\ndip = {dip}\ndip_direction = {direction}\nspacing = 9\nmaterial = '{name}'\n"
                for name, (dip, direction) in PLANES.items())
WEDGE = "[[material]]\ndensity = 2562\n" + WEDGE + """[[block_theory.slope]]
dip = 65
dip_direction = 185
height = 40
upper_dip = 12
upper_dip_direction = 195
"""


def upward(dip, direction):
    dip, direction = math.radians(dip), math.radians(direction)
    return (math.sin(dip) * math.sin(direction), math.sin(dip) * math.cos(direction), math.cos(dip))


def cross(a, b):
    return tuple(a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2] for i in range(3))


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


class Wedge(ProgramTest):
    def factor(self, water):
        self.write("wedge.toml", WEDGE + water)
        return self.json_of("theory", "wedge.toml")["slopes"][0]["blocks"][0]["factor_of_safety"]

    def test_full_of_water_has_a_sixth_of_its_head_on_each_plane(self):
        line = cross(*(upward(*plane) for plane in PLANES.values()))
        face, ground = upward(65, 185), upward(12, 195)
        up_face = [(0, 0, 1)[i] - face[2] * face[i] for i in range(3)]  # from the toe to the crest, 40 m higher
        crest = [40 / up_face[2] * x for x in up_face]
        height = dot(ground, crest) / dot(ground, line) * line[2]
        mean = self.factor(f"[[water]]\npressure = {GAMMA * height / 6}\n")
        for law in ("", "law = 'mid_height'\n", "law = 'drained'\n", "drains = true\n"):
            self.assertAlmostEqual(self.factor(f"[[water]]\nhead = {height}\n" + law), mean, delta=1e-9)
        self.assertLess(self.factor(f"[[water]]\nhead = {height}\nlaw = 'hydrostatic'\n"), mean - 0.1)

    def test_gets_no_safer_as_water_rises(self):
        factors = [self.factor(f"[[water]]\nhead = {head}\n") for head in range(0, 50, 5)]
        self.assertEqual(factors, sorted(factors, reverse=True))


if __name__ == "__main__":
    unittest.main()
