"""report: what stands in it, that names are data, and what it says of files that it cannot tell of."""
import hashlib
import unittest
from html.parser import HTMLParser

import h5py

from program import PRESSED, ProgramTest

VOID = {"meta", "br", "img"}
HOSTILE = "</td><script>window.hacked = 1</script><img src=x onerror=alert(1)>&\""
MONITOR = """
[[monitor]]
name = "bed"
point = [0.5, 0.5, 0]
joint = "block.interface"
"""


class Report(HTMLParser):
    """The document as a browser's parser sees it, without scripts: tags, headings, texts, tables of rows of cells."""

    def __init__(self, text):
        super().__init__()
        self.open, self.tags, self.tables, self.text, self.headings = [], [], [], "", []
        self.feed(text)
        assert not self.open, self.open

    def handle_starttag(self, tag, attrs):
        self.tags.append((tag, dict(attrs)))
        if tag not in VOID:
            self.open.append(tag)
        if tag == "table":
            self.tables.append([])
        if tag == "tr":
            self.tables[-1].append([])
        if tag in ("td", "th"):
            self.tables[-1][-1].append("")
        if tag in ("h1", "h2", "h3"):
            self.headings.append("")

    def handle_startendtag(self, tag, attrs):
        self.tags.append((tag, dict(attrs)))

    def handle_endtag(self, tag):
        assert self.open.pop() == tag, tag

    def handle_data(self, data):
        if {"script", "style"} & set(self.open):
            return
        self.text += data
        if "td" in self.open or "th" in self.open:
            self.tables[-1][-1][-1] += data
        if self.open and self.open[-1] in ("h1", "h2", "h3"):
            self.headings[-1] += data

    def table(self, head):
        """The rows below the head of the one table that has this column."""
        (found,) = [t for t in self.tables if t and head in t[0]]
        return [dict(zip(found[0], row)) for row in found[1:]]

    def facts(self):
        return {row[0]: row[1] for t in self.tables for row in t if len(row) == 2}


class Reports(ProgramTest):
    def report(self, name):
        text = (self.folder / name).read_text(encoding="utf-8")
        self.assertNotRegex(text.split("</style>")[0] + text.split("<body>")[1].split("<script", 1)[0], r"https?://(?!www\.w3\.org/2000/svg)")
        return Report(text)

    def test_tells_of_scattered_joints_water_stages_and_shotcrete(self):
        self.copy_case("water_cavern")
        told = self.run_program("support", "water_cavern.toml", "--report").stdout
        self.assertRegex(told, r"not examined +53 blocks that only key blocks keep in place, and groups that fail together")
        self.assertRegex(told, r"batch 3, stage 3 .*\n\n +block")  # what each stage lets go first is listed
        report = self.report("water_cavern.report.html")
        west, cross = [row for row in report.table("Fisher's κ") if row["joint"] in ("west", "cross")]
        self.assertEqual((west["Fisher's κ"], west["spacingm"], west["radiusm"]), ("150", "6.5 ± 2 (log-normal)", "through-going"))
        self.assertEqual((cross["spacingm"], cross["radiusm"]), ("P32 0.08 m²/m³", "10 ± 4 (log-normal)"))
        facts = report.facts()
        self.assertEqual(facts["Water"], "level at 2 m, in all joints that no other names")
        self.assertEqual((facts["Shotcrete on"], facts["Thickness"]), ("heading", "0.1 m"))
        self.assertEqual([row["stage"] for row in report.table("stage")], ["1", "2", "3"])

    def test_tells_of_key_blocks_support_and_classification(self):
        self.copy_case("bolted_tunnel")
        answer = self.json_of("support", "bolted_tunnel.toml", "--report")
        report = self.report("bolted_tunnel.report.html")
        self.assertEqual(report.headings[0], "Bolted tunnel")
        for heading in ("Model", "Joints", "Views", "Key blocks", "Support design", "Classification", "Assumptions and limits", "Appendix: the model"):
            self.assertIn(heading, report.headings)
        rows = report.table("motion")
        self.assertEqual(len(rows), len(answer["keyblocks"]))
        self.assertEqual(sorted(int(row["block"]) for row in rows), sorted(key["block"] for key in answer["keyblocks"]))
        self.assertEqual([int(row["batch"]) for row in rows], sorted(int(row["batch"]) for row in rows))
        told = {int(row["block"]): row for row in rows}
        for key in answer["keyblocks"]:
            row = told[key["block"]]
            self.assertEqual(row["held"], "yes" if key["adequate"] else "no")
            self.assertEqual(int(row["bolts"]), len(key["bolts"]))
            safety = row["factor of safety"]
            if key["factor_of_safety"] is None:
                self.assertEqual(safety, "none")
            else:
                self.assertAlmostEqual(float(safety), key["factor_of_safety"], delta=6e-3 * key["factor_of_safety"])
            self.assertAlmostEqual(float(row["support forcekN"]), key["support_force"] / 1e3, delta=6e-4 * key["support_force"] / 1e3)
        facts = report.facts()
        self.assertEqual(facts["Model"], "SHA-256 " + hashlib.sha256((self.folder / "bolted_tunnel.toml").read_bytes()).hexdigest())
        self.assertAlmostEqual(float(facts["Q"]), answer["classification"]["q"]["value"], 2)
        self.assertEqual(len([t for t, a in report.tags if t == "svg"]), 1)  # the stereonet
        self.assertIn('section = "horseshoe"', report.text)

    def test_tells_of_a_run_with_plots(self):
        model = self.copy_case("sliding_block")
        model.write_text(model.read_text(encoding="utf-8") + MONITOR, encoding="utf-8")
        answer = self.json_of("run", "sliding_block.toml", "--report", "--set", "analysis.end_time=0.2")
        report = self.report("sliding_block.report.html")
        (joint,) = report.table("normal stresskPa")
        told = answer["monitors"][-1]
        self.assertEqual(joint["state"], told["state"][-1])
        self.assertAlmostEqual(float(joint["slipmm"]), 1e3 * told["slip"][-1], delta=0.05)
        self.assertEqual(len(report.table("eastmm")), 2)
        for curve in ("centre", "top", "bed", "kinetic", "slide"):
            self.assertIn(curve, report.text)
        # Stereonet, displacement, velocity, slip, opening, normal and shear stress, energy, contact points.
        self.assertEqual(len([t for t, a in report.tags if t == "svg"]), 9)
        self.assertIn("Blocks that moved", report.facts())

    def test_tells_of_key_blocks_beside_their_motion_and_why_not(self):
        self.copy_case("sliding_wedge")
        for time, row in (("0.3", ("sliding", "yes")), ("0.1", ("stays", "no: time"))):
            self.run_program("run", "sliding_wedge.toml", "-q", "--report", "--set", f"analysis.end_time={time}")
            (wedge,) = self.report("sliding_wedge.report.html").table("as predicted")
            self.assertEqual((wedge["seen"], wedge["as predicted"]), row)

    def test_tells_what_bolts_bear_in_motion(self):
        self.copy_case("pull_out")
        bolt, = self.json_of("run", "pull_out.toml", "--report")["bolts"]
        report = self.report("pull_out.report.html")
        row, = report.table("broken ats")
        self.assertEqual((row["bolt"], row["state"]), (bolt["name"], bolt["state"]))
        self.assertAlmostEqual(float(row["forcekN"]), bolt["force"] / 1e3, delta=6e-4 * bolt["force"] / 1e3)
        self.assertAlmostEqual(float(row["used%"]), 100 * bolt["mobilisation"], delta=6e-3 * 100 * bolt["mobilisation"])
        self.assertIn("Force along the bolts most used", report.text)
        self.assertIn("Bolts are bars", report.text)

    def test_of_a_cut_has_sizes_of_blocks_and_the_same_bytes_again(self):
        self.copy_case("wedge")
        self.run_program("cut", "wedge.toml", "-q")
        done = self.json_of("report", "wedge.vtkhdf", "-o", "first.html")
        first = (self.folder / "first.html").read_bytes()
        self.assertEqual((done["report"], done["bytes"]), ("first.html", len(first)))
        self.assertEqual(b"array-point_xyz" in first, done["views"])
        self.assertIn("Sizes of blocks", self.report("first.html").headings)
        self.assertIn("second.html", self.run_program("report", "wedge.vtkhdf", "-o", "second.html").stdout)
        self.assertEqual((self.folder / "second.html").read_bytes(), first)

    def test_names_are_text_whatever_they_say(self):
        quoted = HOSTILE.replace("\\", "\\\\").replace('"', '\\"')
        text = PRESSED.replace('"sandstone"', f'"{quoted}"').replace("[[monitor]]", f'[[monitor]]\nname = "{quoted}"')
        text += f'[[joint_material]]\nname = "{quoted}"\nfriction_angle = 30\n'
        text += f'[[joint_set]]\nname = "{quoted}"\ndip = 30\ndip_direction = 90\nspacing = 5\norigin = [0, 0, 0.9]\n[support]\n'
        self.write("hostile.toml", f'title = "{quoted}"\n{text}')
        self.run_program("run", "hostile.toml", "-q", "--report", "--set", 'cover.joints="welded"')
        text = (self.folder / "hostile.report.html").read_text(encoding="utf-8")
        self.assertNotIn("<script>window.hacked", text)
        self.assertNotIn("<img", text.split("<body>")[1].split("<script", 1)[0])
        report = Report(text)
        self.assertEqual(report.headings[0], HOSTILE)
        self.assertEqual([a for t, a in report.tags if any(name.startswith("on") for name in a)], [])
        self.assertGreater(report.text.count(HOSTILE), 5)

    def test_says_what_it_found_instead_of_a_result_of_this_program(self):
        self.copy_case("cube")
        self.run_program("cut", "cube.toml", "-q")
        whole = (self.folder / "cube.vtkhdf").read_bytes()
        (self.folder / "short.vtkhdf").write_bytes(whole[:len(whole) // 2])
        with h5py.File(self.folder / "other.vtkhdf", "w") as file:
            file["numbers"] = [1, 2, 3]
        changed = {"later": lambda f: f["rockfold"].attrs.modify("format_version", 7),
                   "early": lambda f: f["rockfold"].__delitem__("answer"),
                   "no_faces": lambda f: f["rockfold/blocks"].__delitem__("face_plane")}
        for name, change in changed.items():
            (self.folder / f"{name}.vtkhdf").write_bytes(whole)
            with h5py.File(self.folder / f"{name}.vtkhdf", "r+") as file:
                change(file)
        with h5py.File(self.folder / "older.vtkhdf", "w") as file:
            with h5py.File(self.folder / "cube.vtkhdf") as source:
                source.copy("rockfold", file)
            text = bytes(file["rockfold/answer"][:]).replace(b'"setup"', b'"sotup"')
            del file["rockfold/answer"]
            file["rockfold/answer"] = list(text)
        before = self.files()
        for name, said in (("none.vtkhdf", "no such file"), ("cube.toml", "no HDF5 file"), ("short.vtkhdf", "cut short"),
                           ("other.vtkhdf", "no result of Rockfold"), ("later.vtkhdf", "result format 7"),
                           ("early.vtkhdf", "`cut` ended early"), ("older.vtkhdf", "did not store what a report tells"),
                           ("no_faces.vtkhdf", "cannot read")):
            failed = self.run_program("report", name, status=3)
            self.assertIn(name, failed.stderr)
            self.assertIn(said, failed.stderr)
        self.assertIn("overwrite", self.run_program("report", "cube.vtkhdf", "-o", "cube.vtkhdf", status=2).stderr)
        self.assertIn("no folder", self.run_program("report", "cube.vtkhdf", "-o", "none/x.html", status=3).stderr)
        self.assertEqual(self.files(), before)
        self.assertIn("no file given", self.run_program("report", status=2).stderr)
        self.assertIn("unknown option '--report'", self.run_program("cut", "cube.toml", "--report", status=2).stderr)

    def test_is_tried_before_any_work_is_done(self):
        self.copy_case("wedge")
        (self.folder / "wedge.report.html").mkdir()
        failed = self.run_program("support", "wedge.toml", "--report", status=3)
        self.assertIn("wedge.report.html", failed.stderr)
        self.assertNotIn("wedge.vtkhdf", self.files())


if __name__ == "__main__":
    unittest.main()
