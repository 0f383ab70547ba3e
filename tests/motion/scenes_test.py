"""Random scenes of blocks that hit, slide and rest: none breaks a rule. throws.py runs as many as you like."""
import os
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from throws import NotSettled, broken_rules, differences, draw_scene, run  # noqa: E402

SEEDS = range(1, 4 if os.environ.get("ROCKFOLD_SANITIZE") == "1" else 13)


class Scenes(unittest.TestCase):
    def test_of_thrown_and_jointed_blocks_break_no_rule(self):
        for seed in SEEDS:
            with self.subTest(seed=seed):
                scene = draw_scene(seed)
                try:
                    motion, document = run(scene.model())
                except NotSettled as error:
                    self.fail(str(error))
                found = broken_rules(scene, motion)
                if seed % 4 == 0:
                    found += differences(scene, motion, document)
                self.assertEqual(found, [])


if __name__ == "__main__":
    unittest.main()
