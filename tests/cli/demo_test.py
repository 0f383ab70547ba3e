"""The demo: what it prints, what it writes."""
import unittest

from program import ProgramTest


class Demo(ProgramTest):
    def test_goes_from_blocks_to_motion(self):
        text = self.run_program("demo", "--threads", "2").stdout
        self.assertRegex(text, r"blocks +5\d\d ")
        self.assertRegex(text, r"batches +[2-9] ")
        self.assertRegex(text, r"largest displacement +\S+ m, in block \d+ at \(")
        self.assertEqual(len([line for line in text.splitlines() if " slides " in line or " falls " in line]), 10 + 10)  # and of those that stay
        self.assertIn("rockfold_demo.vtkhdf", text)
        self.assertIn("rockfold_demo.vtkhdf", self.files())

    def test_is_the_example_called_slope(self):
        self.copy_case("slope")
        short = ("--set", "analysis.end_time=0.02")
        demo, run = self.json_of("demo", *short), self.json_of("run", "slope.toml", *short)
        self.assertEqual((demo.pop("command"), run.pop("command")), ("demo", "run"))
        del demo["seconds"], run["seconds"]
        self.assertEqual(demo, run)


if __name__ == "__main__":
    unittest.main()
