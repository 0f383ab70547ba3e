"""Block theory meets motion: beside each key block whether it moved, and how far off the way that was predicted."""
import json
import unittest

from program import ProgramTest


class KeyblockMotion(ProgramTest):
    def run_wedge(self, friction):
        self.copy_case("sliding_wedge")
        return self.run_program("run", "sliding_wedge.toml", "--force", "--json-file", "wedge.json", "--set", "analysis.end_time=0.3",
                                "--set", f"joint_material.1.friction_angle={friction}").stdout, json.loads((self.folder / "wedge.json").read_text(encoding="utf-8"))

    def test_of_a_wedge_that_slides_is_the_mode_predicted(self):
        text, document = self.run_wedge(20)
        wedge, = document["keyblock_motion"]
        self.assertEqual(wedge["mode"], "two_planes")
        self.assertTrue(wedge["moved"])
        self.assertLess(wedge["off_direction"], 2)
        self.assertLess(wedge["rotation"], 0.1)
        a, t = 2.643227, 0.3  # REFERENCES D8
        self.assertAlmostEqual(sum(x * x for x in wedge["displacement"])**0.5 / (0.5 * a * t * t), 1, 1)
        self.assertRegex(text, r"two_planes|slides on two")

    def test_of_a_wedge_that_friction_holds_there_is_no_key_block(self):
        _, document = self.run_wedge(35)
        self.assertEqual(document["keyblock_motion"], [])
        self.assertEqual(document["rest"]["moved_blocks"], 0)


if __name__ == "__main__":
    unittest.main()
