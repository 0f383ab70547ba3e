"""The demo: what it prints, what it writes, and what slides."""
import importlib.util
import json
import re
import unittest

from program import SOURCE, ProgramTest

TIME, STEP, STEPS = 0.8, 0.02, 10  # s of motion; quasi-static steps before


def guide_quotes():
    """What docs/quote_demo.py has written into the guide."""
    found = importlib.util.spec_from_file_location("quote_demo", SOURCE / "docs" / "quote_demo.py")
    module = importlib.util.module_from_spec(found)
    found.loader.exec_module(module)
    return module.quoted(module.GUIDE.read_text(encoding="utf-8"))[0]


def words(text):
    """Without what another compiler, or machine, may have otherwise: numbers of motion, seconds, folders."""
    kept = [line for line in text.splitlines() if line.split()[:1] not in ([], ["time"], ["page"], ["energy"])]
    return [re.sub(r" +", " ", re.sub(r"-?\d[\d,.e+-]*", "#", line)) for line in kept]


class Demo(ProgramTest):
    def test_goes_from_blocks_to_motion(self):
        text = self.run_program("demo", "--threads", "2", "--json-file", "demo.json").stdout
        self.assertRegex(text, r"blocks +100 ")
        self.assertRegex(text, r"batches +2 \(7 \+ 1\)")
        self.assertRegex(text, r"largest displacement +\S+ m, in block \d+ at \(")
        self.assertRegex(text, r"key blocks that move +7 of 8 ")
        rows = [line for line in text.splitlines() if line[:7].strip().isdigit()]
        self.assertEqual(len(rows), 7 + 6 + 8)  # the first batch, what stays, and key blocks beside their motion
        self.assertIn("rockfold_demo.vtkhdf", text)
        self.assertIn("rockfold_demo.vtkhdf", self.files())
        self.assertEqual(words(text), words(guide_quotes()))
        before_motion = [part.split("\n  covers ")[0] for part in (text, guide_quotes())]
        self.assertEqual(*before_motion)
        self.slide_as_by_hand(json.loads((self.folder / "demo.json").read_text(encoding="utf-8")))

    def slide_as_by_hand(self, document):
        """Wedges that nothing presses: net force over mass for 0.8 s, and a dt2/4 in each quasi-static step."""
        keys = {key["block"]: key for key in document["support"]["keyblocks"]}
        # One lies under a heavier block that slides over it, one is pressed aside.
        free = [c for c in document["confirmed"] if c["agree"] and c["predicted"]["mode"] == "two_planes" and c["seen"]["off_direction"] < 2]
        self.assertEqual(len(free), 3)
        for wedge in free:
            key = keys[wedge["block"]]
            a = key["sliding_force"] / (key["weight"] / 9.81)
            way = 0.5 * a * TIME**2 + STEPS * a * STEP**2 / 4
            self.assertAlmostEqual(wedge["seen"]["moved"] / way, 1, delta=0.01)

    def test_is_the_example_called_slope(self):
        self.copy_case("slope")
        short = ("--set", "step.1.steps=1", "--set", "step.2.end_time=0.01")
        demo, run = self.json_of("demo", *short), self.json_of("run", "slope.toml", *short)
        self.assertEqual((demo.pop("command"), run.pop("command")), ("demo", "run"))
        del demo["seconds"], run["seconds"]
        self.assertEqual(demo, run)


if __name__ == "__main__":
    unittest.main()
