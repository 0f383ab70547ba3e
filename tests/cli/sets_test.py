"""`rockfold sets`: joint sets of a survey, end to end, against statistics that numpy computes by itself."""
import math
import re
import unittest
from xml.etree import ElementTree

import numpy as np

from program import ProgramTest

# Dip, dip direction, kappa and joints of three sets; the second is upright.
SETS = [(70, 40, 50, 90), (88, 310, 80, 75), (15, 200, 30, 60)]
MODEL = """[[material]]
density = 2600
[[joint_material]]
friction_angle = 35
[[solid]]
name = "rock"
shape = "box"
min = [0, 0, 0]
max = [10, 10, 10]
"""


def normals(dip, direction):
    dip, direction = np.radians(dip), np.radians(direction)
    return np.stack([np.sin(dip) * np.sin(direction), np.sin(dip) * np.cos(direction), np.cos(dip)], axis=-1)


def planes(vectors):
    up = np.where(vectors[:, 2:] < 0, -vectors, vectors)
    return np.degrees(np.arccos(up[:, 2])), np.degrees(np.arctan2(up[:, 0], up[:, 1])) % 360


def drawn(seed=4):
    """Dips, dip directions and the numbers of their sets, -1 of uniform poles, in any order."""
    random = np.random.default_rng(seed)
    poles, numbers = [], []
    for number, (dip, direction, kappa, count) in enumerate(SETS):
        mean = normals(dip, direction)
        cosine = 1 + np.log1p(random.random(count) * np.expm1(-2 * kappa)) / kappa
        beside = np.cross(mean, random.normal(size=(count, 3)))
        beside /= np.linalg.norm(beside, axis=1)[:, None]
        poles.append(cosine[:, None] * mean + np.sqrt(1 - cosine ** 2)[:, None] * beside)
        numbers += [number] * count
    uniform = random.normal(size=(25, 3))
    poles.append(uniform / np.linalg.norm(uniform, axis=1)[:, None])
    order = random.permutation(len(numbers) + 25)
    dips, directions = planes(np.concatenate(poles))
    return dips[order], directions[order], np.array(numbers + [-1] * 25)[order]


def fisher(poles):
    """Mean, kappa and cone of confidence (deg) of poles that all lie within 90 deg of the first eigenvector."""
    axis = np.linalg.eigh(poles.T @ poles)[1][:, 2]
    total = (poles * np.sign(poles @ axis)[:, None]).sum(axis=0)
    n, r = len(poles), np.linalg.norm(total)
    return total / r, (n - 1) / (n - r), math.degrees(math.acos(1 - (n - r) / r * (20 ** (1 / (n - 1)) - 1)))


class Sets(ProgramTest):
    def write_table(self, heading, *columns):
        lines = [",".join(map(str, row)) for row in zip(*columns)]
        return self.write("survey.csv", "\n".join([heading, *lines]) + "\n")

    def test_are_found_among_poles(self):
        dips, directions, numbers = drawn()
        self.write_table("dip,dip_direction", dips.round(3), directions.round(3))
        document = self.json_of("sets", "survey.csv")
        self.assertEqual((document["command"], document["grouping"], document["table"]), ("sets", "poles", "survey.csv"))
        self.assertEqual([document["totals"][key] for key in ("joints", "sets")], [250, 3])
        self.assertLess(document["criteria"][3], min(document["criteria"][:3]))
        of_name = {}
        for number, (dip, direction, kappa, count) in enumerate(SETS):
            found = max(document["sets"], key=lambda s: abs(np.dot(s["normal"], normals(dip, direction))))
            of_name[found["name"]] = number
            off = math.degrees(math.acos(min(1, abs(np.dot(found["normal"], normals(dip, direction))))))
            self.assertLess(off, found["confidence_cone"])
            self.assertLess(abs(found["kappa"] - kappa), 2 * kappa / math.sqrt(count))
            self.assertAlmostEqual(found["count"], count, delta=6)
            self.assertAlmostEqual(abs(np.dot(found["normal"], normals(found["dip"], found["dip_direction"]))), 1, places=9)
            self.assertAlmostEqual(found["pole"]["plunge"], 90 - found["dip"], places=9)
        names = [row["set"] for row in document["rows"]]
        right = [of_name.get(name) == number for name, number in zip(names, numbers) if number >= 0]
        self.assertGreater(np.mean(right), 0.95)
        self.assertEqual(names.count(None), document["totals"]["of_no_set"])
        self.assertEqual(self.json_of("sets", "survey.csv"), document)

    def test_of_a_column_have_fishers_statistics(self):
        dips, directions, numbers = drawn()
        self.write_table("dip,dip_direction,set", dips, directions, ["" if n < 0 else f"J{n}" for n in numbers])
        document = self.json_of("sets", "survey.csv")
        self.assertEqual((document["grouping"], document["column"], document["totals"]["of_no_set"]), ("column", "set", 25))
        for found in document["sets"]:
            poles = normals(dips, directions)[numbers == int(found["name"][1:])]
            mean, kappa, cone = fisher(poles)
            self.assertAlmostEqual(abs(np.dot(found["normal"], mean)), 1, places=9)
            self.assertAlmostEqual(found["kappa"] / kappa, 1, places=6)
            self.assertAlmostEqual(found["confidence_cone"], cone, places=6)
            eigenvalues = np.linalg.eigvalsh(poles.T @ poles / len(poles))[::-1]
            np.testing.assert_allclose(found["eigenvalues"], eigenvalues, atol=1e-9)
            for share, key in ((0.5, "half_cone"), (0.95, "cone_of_95")):
                within = (1 - math.exp(-kappa * (1 - math.cos(math.radians(found[key]))))) / (1 - math.exp(-2 * kappa))
                self.assertAlmostEqual(within, share, places=6)
        self.assertEqual(self.json_of("sets", "survey.csv", "--sets", "auto")["grouping"], "poles")
        self.assertEqual(self.json_of("sets", "survey.csv", "--sets", "2")["totals"]["sets"], 2)

    def test_along_a_scanline_are_weighed_and_spaced(self):
        """Planes 2 m apart on a line at 60 deg to their normal, and planes across it 1 m apart."""
        self.write_table("set,dip,dip_direction,distance", ["askew"] * 6 + ["across"] * 20, [90] * 26, [30] * 6 + [90] * 20,
                         [4 * k for k in range(6)] + list(range(20)))
        document = self.json_of("sets", "survey.csv", "--scanline", "090/0")
        askew, across = document["sets"]
        self.assertAlmostEqual(askew["spacing"]["along_line"], 4)
        self.assertAlmostEqual(askew["spacing"]["normal"], 2)
        self.assertAlmostEqual(across["spacing"]["normal"], 1)
        self.assertAlmostEqual(askew["share"], 12 / 32)
        self.assertAlmostEqual(document["rows"][5]["weight"], 2)
        self.assertAlmostEqual(document["rows"][6]["weight"], 1)
        said = self.run_program("sets", "survey.csv", "--scanline", "030/0", "--blind-zone", "25")
        self.assertNotIn("warning", said.stderr)
        said = self.run_program("sets", "survey.csv", "--scanline", "120/0")
        self.assertIn("warning: 6 of 26 joints make less than 15 deg with their scanline", said.stderr)

    def test_are_a_part_of_a_model_that_the_program_reads(self):
        dips, directions, numbers = drawn()
        chosen = np.flatnonzero(numbers == 2)
        self.write_table("set,dip,dip_direction,distance", ["flat #1"] * len(chosen), dips[chosen], directions[chosen],
                         [1.5 * k for k in range(len(chosen))])
        self.run_program("sets", "survey.csv", "--scanline", "0/90", "-o", "sets.toml")
        text = (self.folder / "sets.toml").read_text(encoding="utf-8")
        self.assertTrue(text.startswith("# Joint sets of survey.csv: 60 of 60 joints"))
        self.write("model.toml", MODEL + text)
        self.assertEqual(self.json_of("check", "model.toml")["totals"]["joint_sets"], 1)
        document = self.json_of("sets", "survey.csv", "--scanline", "0/90", "-o", "sets.toml")  # replaces its own
        spacing = document["sets"][0]["spacing"]["normal"]
        self.assertIn(f"mean = {spacing:.4g}", text)
        self.assertIn(f"fisher_kappa = {document['sets'][0]['kappa']:.4g}", text)
        self.assertGreater(self.json_of("cut", "model.toml")["totals"]["blocks"], 3)
        self.run_program("sets", "survey.csv", "-o", "sets.toml")
        self.write("model.toml", MODEL + (self.folder / "sets.toml").read_text(encoding="utf-8"))
        self.assertIn("spacing", self.run_program("check", "model.toml", status=2).stderr)  # the line's direction is not known

    def test_are_drawn(self):
        dips, directions, numbers = drawn()
        self.write_table("dip,dip_direction,set", dips, directions, ["" if n < 0 else f"J<{n}>" for n in numbers])
        self.run_program("sets", "survey.csv", "--picture", "net.svg")
        text = (self.folder / "net.svg").read_text(encoding="utf-8")
        words = ["".join(element.itertext()) for element in ElementTree.fromstring(text).iter("{http://www.w3.org/2000/svg}text")]
        for found in self.json_of("sets", "survey.csv")["sets"]:
            plane = f"{found['dip']:02.0f}/{found['dip_direction']:03.0f}"
            self.assertIn(plane, words)  # on its circle
            self.assertTrue(any(line.startswith(f"{found['name']}  {plane}") for line in words))
        for word in ("N", "E", "S", "W", "Lower hemisphere, equal area", "dots: poles of 250 joints", "of no set"):
            self.assertIn(word, words)
        radii = [float(r) for r in re.findall(r'<circle [^>]*r="([0-9.]+)"', text)]
        self.assertEqual(radii.count(3.2), 250)

    def test_replace_no_model(self):
        self.write_table("dip,dip_direction", [30], [40])
        self.write("model.toml", MODEL)
        said = self.run_program("sets", "survey.csv", "-o", "model.toml", status=2).stderr
        self.assertIn("model.toml: is there, and no list of joint sets that could be replaced", said)
        self.assertEqual((self.folder / "model.toml").read_text(encoding="utf-8"), MODEL)

    def test_of_few_joints_are_none(self):
        self.write_table("dip,dip_direction", [30, 31, 30], [40, 42, 44])
        said = self.run_program("sets", "survey.csv").stdout
        self.assertRegex(said, r"sets +0, found among the poles")
        document = self.json_of("sets", "survey.csv")
        self.assertEqual((document["sets"], document["totals"]["of_no_set"]), ([], 3))

    def test_what_is_wrong_is_said(self):
        self.write_table("dip,dip_direction", [95], [40])
        said = self.run_program("sets", "survey.csv", status=2).stderr
        self.assertIn("survey.csv:2:1: dip must be 0 to 90 (deg), is 95", said)
        self.run_program("sets", "none.csv", status=3)
        for arguments, words in ((["--scanline", "45"], "'45' is no trend and plunge as 045/10"),
                                 (["--scanline", "45/100"], "'45/100' is no trend and plunge"),
                                 (["--blind-zone", "0"], "'0' is no angle above 0 and below 90"),
                                 (["--sets", "many"], "'many' is no whole number from 1 to 12"),
                                 (["-o", "sets.csv"], "--output: 'sets.csv' must be the name of a file that ends in .toml"),
                                 (["--picture", "net.png"], "--picture: 'net.png' must be the name of a file that ends in .svg")):
            self.assertIn(words, self.run_program("sets", "survey.csv", *arguments, status=2).stderr)


if __name__ == "__main__":
    unittest.main()
