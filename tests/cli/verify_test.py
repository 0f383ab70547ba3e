"""Certificates that are checked: of a block that hangs from the roof, 27 kN held by 40 kPa on 1 m2, factor 40 / 27."""
import json
import unittest

from program import ProgramTest

FACTOR = 40 / 27
GAP = 1e-6


def hanging_block():
    pulls = [[0.0, 0.0, 0.0]] * 4 + [[0.0, 0.0, 27e3 / 4]] * 4  # corners, then triangles
    falls = [[0.0, 0.0, -1.0, 0.0, 0.0, 0.0]]
    below = FACTOR * (1 - GAP)
    whole = {"rockfold": "certificate/1",
             "bodies": [{"block": 5, "centre": [0.5, 0.5, 0.5], "force": [0.0, 0.0, -27e3], "moment": [0.0, 0.0, 0.0]}],
             "contacts": [{"bodies": [1, 0], "joint": "roof", "normal": [0, 0, -1],
                           "corners": [[0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]],
                           "friction": 0.7, "cohesion": 100e3, "tension": 40e3}],
             "bound": {"below": {"factor": below, "forces": pulls},
                       "above": {"factor": FACTOR * (1 + GAP), "velocities": falls}},
             "sliding": {"factor": below, "forces": pulls, "velocities": falls}}
    return json.loads(json.dumps(whole))  # no list twice, so that one may be spoiled


class Verify(ProgramTest):
    def given(self, certificate):
        return self.write("roof.json", json.dumps(certificate)).name

    def refused(self, certificate, message, status=1):
        name = self.given(certificate)
        done = self.run_program("verify", name, status=status)
        self.assertEqual(done.stdout, "")
        self.assertIn(f"{name}: {message}", done.stderr)
        error = self.json_of("verify", name, status=status)["error"]
        self.assertEqual((error["kind"], error["file"]), ({1: "analysis", 3: "io"}[status], name))
        return error

    def test_holds(self):
        for quiet in ((), ("--quiet",)):  # what was asked for is the answer
            lines = self.run_program("verify", self.given(hanging_block()), *quiet).stdout.splitlines()
            self.assertEqual(lines[0], "certificate of 1 block and 1 contact area")
            self.assertRegex(lines[1], r"^  bound +1\.48147 <= F <= 1\.48149  \(proved: ")  # 1.4814800 and 1.4814830
            self.assertRegex(lines[2], r"^  sliding +1\.48148  \(a state of collapse without dilation\)$")
            self.assertRegex(lines[3], r"^  residual +0\.0e\+00 of the forces on a block, at most$")
            self.assertEqual(len(lines), 4)
        self.assertEqual(self.files(), ["roof.json"])

    def test_holds_as_json(self):
        document = self.json_of("verify", self.given(hanging_block()))
        self.assertEqual([document[key] for key in ("schema", "command", "holds", "residual", "warnings")],
                         ["rockfold/1", "verify", True, 0, []])
        self.assertEqual(document["bound"], {"below": FACTOR * (1 - GAP), "above": FACTOR * (1 + GAP)})
        self.assertEqual(document["sliding"], FACTOR * (1 - GAP))
        self.run_program("verify", "roof.json", "--json-file", "told.json")
        self.assertTrue(json.loads((self.folder / "told.json").read_text(encoding="utf-8"))["holds"])

    def test_holds_without_sliding(self):
        certificate = hanging_block()
        certificate["sliding"] = None
        self.assertIsNone(self.json_of("verify", self.given(certificate))["sliding"])
        self.assertRegex(self.run_program("verify", "roof.json").stdout, r"(?m)^  sliding +none is given$")

    def test_spoiled(self):
        certificate = hanging_block()
        certificate["bound"]["below"]["factor"] *= 1 + 2 * GAP
        self.refused(certificate, "does not hold: bound from below: contact 1 (roof), triangle 1: the force pulls more than the "
                                  "tensile strength, by 1e-06 of it")
        certificate = hanging_block()
        certificate["bound"]["below"]["forces"][5][2] *= 1 + 1e-6
        self.refused(certificate, "does not hold: bound from below: block 5: the forces do not balance")
        certificate = hanging_block()
        certificate["bound"]["above"]["factor"] *= 1 - 2 * GAP
        self.refused(certificate, "does not hold: bound from above: the power of the loads, 27000 W, is not over the")
        certificate = hanging_block()
        certificate["sliding"]["velocities"][0][2] = 0
        self.refused(certificate, "does not hold: sliding: no body moves")

    def test_no_certificate(self):
        self.assertEqual(self.refused({"rockfold": "model/1"}, "is no certificate", status=3)["key"], "")
        certificate = hanging_block()
        certificate["contacts"][0]["normal"] = [0, -1]
        error = self.refused(certificate, "contacts[1].normal: three numbers are wanted", status=3)
        self.assertEqual(error["key"], "contacts[1].normal")
        self.write("half.json", json.dumps(certificate)[:-9])
        self.assertIn("half.json: is no JSON document", self.run_program("verify", "half.json", status=3).stderr)
        self.write("empty.json", "")
        self.assertIn("empty.json: is empty", self.run_program("verify", "empty.json", status=3).stderr)

    def test_no_file(self):
        self.assertIn("none.json: cannot be opened", self.run_program("verify", "none.json", status=3).stderr)
        self.assertIn("it is a folder", self.run_program("verify", ".", status=3).stderr)
        self.assertIn("no file given: rockfold verify CERTIFICATE", self.run_program("verify", status=2).stderr)

    def test_is_the_same_on_any_number_of_threads(self):
        name = self.given(hanging_block())
        self.assertEqual(len({self.run_program("verify", name, "--threads", threads).stdout for threads in (1, 2, 4)}), 1)


if __name__ == "__main__":
    unittest.main()
