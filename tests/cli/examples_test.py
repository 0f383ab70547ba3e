"""Every example of tests/cases: it cuts, no rock is lost, and it gives the numbers of its expected.json.

expected.json holds numbers of the document of `rockfold cut --json`:

    blocks, faces, solid_volume, joint_area, dangling_joint_area   as under "totals"
    convex, finite                   how many blocks are
    shells, genus                    the largest of any block
    smallest, largest                block volumes
    stages                           {"1": [blocks, volume, new_free_area], …}
    planes_identified, vertices_identified, near_decisions         as under "intent"; 0 where left out
    flagged                          as the key of this name
    keyblocks                        key blocks of each batch, from `rockfold support`
    stability                        {"bound": factor, "sliding": factor}, to 1e-3
    run                              {"a path in the document of `rockfold run`": [value, relative tolerance], …}; lists by number
                                     (from 0, -1 is the last) or by the name of an entry
    warnings                         how many `cut` gives; 0 where left out

Only blocks and solid_volume must be there. Numbers of blocks must be met exactly, areas and volumes to 1e-9, the volume of the
rock to 1e-12.
"""
import json
import math
import shutil
import unittest

from program import CASES, ProgramTest

CASES_BY_NAME = {path.parent.name: path.parent for path in sorted(CASES.glob("*/model.toml"))}
INTENT = ("planes_identified", "vertices_identified", "near_decisions")
KEYS = {"blocks", "faces", "solid_volume", "joint_area", "dangling_joint_area", "convex", "finite", "shells", "genus",
        "smallest", "largest", "stages", "flagged", "keyblocks", "stability", "run", "warnings", *INTENT}


def at_path(value, path):
    for key in path.split("."):
        if isinstance(value, dict):
            value = value[key]
        elif key.lstrip("-").isdigit():
            value = value[int(key)]
        else:
            (value,) = [entry for entry in value if entry["name"] == key]
    return value


class Examples(ProgramTest):
    def close(self, found, expected, what, share=1e-9):
        self.assertLessEqual(abs(found - expected), share * abs(expected), f"{what}: {found!r}, must be {expected!r}")

    def cut(self, name):
        """The document of `cut` and what must be, for a copy of the example."""
        shutil.copytree(CASES_BY_NAME[name], self.folder / name)
        expected = json.loads((CASES_BY_NAME[name] / "expected.json").read_text(encoding="utf-8"))
        self.assertEqual(set(expected) - KEYS, set(), "unknown keys")
        return self.json_of("cut", f"{name}/model.toml", "-q"), expected

    def check(self, document, expected):
        totals, blocks = document["totals"], document["blocks"]
        volumes = [block["volume"] for block in blocks]
        self.assertEqual(totals["blocks"], len(blocks))
        self.assertGreater(min(volumes), 0)
        self.close(math.fsum(volumes), totals["solid_volume"], "sum of the blocks' volumes", 1e-12)
        self.close(totals["solid_volume"], expected["solid_volume"], "solid_volume", 1e-12)

        found = {"convex": sum(block["convex"] for block in blocks), "finite": sum(block["finite"] for block in blocks),
                 "shells": max(block["shells"] for block in blocks), "genus": max(block["genus"] for block in blocks),
                 "blocks": totals["blocks"], "faces": totals["faces"], "flagged": document["flagged"]}
        for key in found.keys() & expected.keys():
            self.assertEqual(found[key], expected[key], key)
        for key in INTENT:
            self.assertEqual(document["intent"][key], expected.get(key, 0), key)
        self.assertEqual(len(document["warnings"]), expected.get("warnings", 0), document["warnings"])

        measured = {"smallest": min(volumes), "largest": max(volumes), **totals}
        for key in ("joint_area", "dangling_joint_area", "smallest", "largest"):
            if key in expected:
                self.close(measured[key], expected[key], key)
        self.check_stages(document["stages"], expected.get("stages", {}))

    def check_stages(self, found, expected):
        self.assertEqual([str(stage["stage"]) for stage in found], list(expected))
        for stage in found:
            blocks, volume, area = expected[str(stage["stage"])]
            self.assertEqual(stage["blocks"], blocks, stage)
            self.close(stage["volume"], volume, f"volume of stage {stage['stage']}")
            self.close(stage["new_free_area"], area, f"new_free_area of stage {stage['stage']}")

    def test_has_what_it_must_give(self):
        for name in CASES_BY_NAME:
            with self.subTest(example=name):
                self.check(*self.cut(name))

    def test_has_the_key_blocks_that_it_must_give(self):
        for name, folder in CASES_BY_NAME.items():
            expected = json.loads((folder / "expected.json").read_text(encoding="utf-8"))
            if "keyblocks" in expected:
                with self.subTest(example=name):
                    shutil.copytree(folder, self.folder / f"{name}-support")
                    document = self.json_of("support", f"{name}-support/model.toml", "-q")
                    self.assertEqual(document["totals"]["batches"], expected["keyblocks"])

    def test_fails_at_the_factors_that_it_must_give(self):
        for name, folder in CASES_BY_NAME.items():
            expected = json.loads((folder / "expected.json").read_text(encoding="utf-8"))
            if "stability" in expected:
                with self.subTest(example=name):
                    shutil.copytree(folder, self.folder / f"{name}-stability")
                    document = self.json_of("stability", f"{name}-stability/model.toml", "-q")
                    for key, factor in expected["stability"].items():
                        self.close(document["stability"][key]["factor"], factor, key, 1e-3)
                    beside = self.json_of("support", f"{name}-stability/model.toml", "-q")
                    self.assertEqual(beside["stability"], document["stability"])

    def test_moves_as_it_must(self):
        for name, folder in CASES_BY_NAME.items():
            expected = json.loads((folder / "expected.json").read_text(encoding="utf-8"))
            if "run" in expected:
                with self.subTest(example=name):
                    shutil.copytree(folder, self.folder / f"{name}-run")
                    document = self.json_of("run", f"{name}-run/model.toml", "-q")
                    for path, (value, tolerance) in expected["run"].items():
                        found = at_path(document, path)
                        if isinstance(value, (bool, str)):
                            self.assertEqual(found, value, path)
                        else:
                            self.close(found, value, path, tolerance)


if __name__ == "__main__":
    unittest.main()
