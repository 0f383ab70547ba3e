"""--export: the files that other programs read, and what is refused."""
import json
import unittest

from program import ProgramTest

FORMATS = ["vtp", "obj", "stl", "3ddat", "json"]


class Export(ProgramTest):
    def test_writes_each_format_beside_the_result(self):
        self.copy_case("wedge")
        options = [word for suffix in FORMATS for word in ("--export", f"blocks.{suffix}")]
        for command in ("cut", "support"):
            text = self.run_program(command, "wedge.toml", *options).stdout
            for suffix in FORMATS:
                self.assertIn(f"blocks.{suffix}", text)
                path = self.folder / f"blocks.{suffix}"
                self.assertGreater(path.stat().st_size, 500)
                path.unlink()
        self.assertEqual(self.files(), ["wedge.toml", "wedge.vtkhdf", "wedge.xdmf"])

    def test_has_the_blocks_of_the_report(self):
        self.copy_case("wedge")
        document = self.json_of("cut", "wedge.toml", "--export", "blocks.json")
        exported = json.loads((self.folder / "blocks.json").read_text(encoding="utf-8"))
        self.assertEqual([(block["id"], block["volume"], len(block["faces"])) for block in exported["blocks"]],
                         [(block["id"], block["volume"], block["faces"]) for block in document["blocks"]])

    def test_is_the_same_on_any_number_of_threads(self):
        self.copy_case("slope")
        for suffix in FORMATS:
            answers = set()
            for threads in (1, 3):
                self.run_program("cut", "slope.toml", "-q", "--threads", threads, "--export", f"a.{suffix}")
                answers.add((self.folder / f"a.{suffix}").read_bytes())
            self.assertEqual(len(answers), 1, suffix)

    def test_refuses_other_formats_and_names_the_known_ones(self):
        self.copy_case("wedge")
        for name in ("blocks.dxf", "blocks", ".vtp"):
            message = self.run_program("cut", "wedge.toml", "--export", name, status=2).stderr
            for suffix in FORMATS:
                self.assertIn(f".{suffix}", message)
        self.run_program("check", "wedge.toml", "--export", "a.vtp", status=2)
        self.run_program("cut", "wedge.toml", "--export", status=2)
        self.assertEqual(self.files(), ["wedge.toml"])

    def test_refuses_one_name_for_two_files(self):
        self.copy_case("wedge")
        self.run_program("cut", "wedge.toml", "--export", "a.vtp", "--export", "./a.vtp", status=2)
        self.run_program("cut", "wedge.toml", "-o", "a.json", "--export", "a.json", status=2)

    def test_that_cannot_be_written_is_told_before_any_work(self):
        self.copy_case("wedge")
        (self.folder / "folder.vtp").mkdir()
        for name in ("no/such/folder.vtp", "folder.vtp"):
            message = self.run_program("cut", "wedge.toml", "--export", name, status=3).stderr
            self.assertIn(name, message)
        self.assertEqual(self.files(), ["folder.vtp", "wedge.toml"])


if __name__ == "__main__":
    unittest.main()
