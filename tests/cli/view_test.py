"""view: what it writes, and what it says of files that are none of its own."""
import base64
import json
import re
import struct
import subprocess
import unittest
import zlib

import h5py

from program import BINARY, PRESSED, ProgramTest

NO_PAGE = "without npm"


def parts(html):
    """The document of a page and its arrays, decoded as the page's script does."""
    document = json.loads(re.search(r'id="document">(.*?)</script>', html, re.S).group(1))
    arrays = {}
    for entry in document["arrays"]:
        packed = re.search(rf'id="array-{entry["name"]}">(.*?)</script>', html, re.S).group(1)
        data = zlib.decompress(base64.b64decode(packed))
        kind, size = {"uint8": ("B", 1), "uint16": ("H", 2), "int16": ("h", 2), "uint32": ("I", 4), "float32": ("f", 4), "float64": ("d", 8)}[entry["type"]]
        n = entry["count"]
        raw = b"".join(bytes(data[k * n + i] for k in range(size)) for i in range(n))
        numbers = list(struct.unpack(f"<{n}{kind}", raw))
        if entry["differences"]:
            mask = (1 << 8 * size) - 1
            for i in range(1, n):
                numbers[i] = (numbers[i] + numbers[i - 1]) & mask
            if kind == "h":
                numbers = [v - (1 << 16) if v >= 1 << 15 else v for v in numbers]
        arrays[entry["name"]] = numbers
    return document, arrays


class View(ProgramTest):
    def page(self, *arguments):
        self.run_program("view", *arguments)
        name = arguments[arguments.index("-o") + 1] if "-o" in arguments else arguments[0].replace(".vtkhdf", ".html")
        return (self.folder / name).read_text(encoding="utf-8")

    def setUp(self):
        super().setUp()
        probe = subprocess.run([BINARY, "view", "none.vtkhdf"], cwd=self.folder, capture_output=True, text=True)
        if NO_PAGE in probe.stderr:
            self.skipTest("the program was built without npm")

    def test_holds_blocks_keyblocks_and_names(self):
        self.copy_case("wedge")
        answer = self.json_of("support", "wedge.toml")
        document, arrays = parts(self.page("wedge.vtkhdf"))
        self.assertEqual(document["title"], "Wedge on two joints")
        self.assertEqual(arrays["block_id"], [1, 2, 3, 4])
        self.assertAlmostEqual(sum(arrays["volume"]), 3466.31, 2)
        self.assertEqual(document["answer"]["keyblocks"], answer["keyblocks"])
        self.assertNotIn("blocks", document["answer"])
        self.assertEqual(arrays["class"][3], 3)
        # A closed surface has three edges for two triangles; each edge is told by both of its faces.
        self.assertEqual(sum(arrays["corner_count"]), len(arrays["corner_point"]))
        self.assertEqual(sum(arrays["point_count"]) * 3, len(arrays["point_xyz"]))

    def test_of_a_run_holds_motion_between_the_corners_of_blocks(self):
        (self.folder / "press.toml").write_text(PRESSED)
        answer = self.json_of("run", "press.toml")
        document, arrays = parts(self.page("press.vtkhdf"))
        self.assertGreater(sum(arrays["point_count"]), 8)  # not the box's corners alone
        self.assertEqual(len(arrays["state_time"]), 2)
        marks = document["answer"]["marks"]
        self.assertEqual([m["kind"] for m in marks], ["fixed", "fixed", "fixed", "load", "monitor"])
        self.assertEqual(marks[3]["directions"], [[0, 0, -1]])
        self.assertEqual(document["answer"]["monitors"], answer["monitors"])
        # A box on rollers under 10 MPa with E = 20 GPa: its top, 2 m above, sinks by 1 mm.
        if "block_motion" in arrays:
            self.assertAlmostEqual(arrays["block_motion"][12 + 3 + 8], -5e-4, 7)
        else:
            unit, p = arrays["displacement_unit"][1], sum(arrays["point_count"])
            self.assertAlmostEqual(min(arrays["point_displacement"][3 * p + 2 * p:]) * unit, -1e-3, 6)

    def test_has_an_arrow_for_each_part_of_a_face_that_a_traction_acts_on(self):
        boxes = {"half of the top": "[[0, 0, 2], [0.5, 1, 2]]", "a corner": "[[0.6, -1, 1.5], [2, 0.2, 3]]", "all": "[[-1, -1, -1], [2, 2, 3]]"}
        text = PRESSED
        for box in boxes.values():
            text += f"[[traction]]\nwhere = {{box = {box}}}\npressure = 1e6\n"
        text += f"[[traction]]\nwhere = {{box = {boxes['half of the top']}}}\nvalue = [1e5, 0, 0]\n"
        (self.folder / "press.toml").write_text(text)
        self.run_program("run", "press.toml")
        loads = [mark for mark in parts(self.page("press.vtkhdf"))[0]["answer"]["marks"] if mark["kind"] == "load"]
        _, half, corner, everything, pushed = ([(tuple(round(x, 6) for x in point), tuple(way)) for point, way in zip(mark["points"], mark["directions"])]
                                               for mark in loads)
        self.assertEqual(half, [((0.25, 0.5, 2), (0, 0, -1))])
        self.assertEqual(sorted(corner), sorted([((0.8, 0.1, 2), (0, 0, -1)), ((1, 0.1, 1.75), (-1, 0, 0)), ((0.8, 0, 1.75), (0, 1, 0))]))
        self.assertEqual(len(everything), 6)
        self.assertEqual(pushed, [((0.25, 0.5, 2), (1, 0, 0))])

    def test_of_blocks_in_contact_holds_their_contact_points(self):
        self.copy_case("sliding_block")
        self.run_program("run", "sliding_block.toml", "-q")
        document, arrays = parts(self.page("sliding_block.vtkhdf"))
        with h5py.File(self.folder / "sliding_block.vtkhdf") as file:
            counts = file["rockfold/states/contact_count"][:]
            stored = {name: file[f"rockfold/contacts/{name}"][:] for name in ("place", "first_block", "state", "slip", "joint")}
        self.assertEqual(arrays["contact_count"], list(counts))
        self.assertEqual(arrays["contact_block"], list(stored["first_block"]))
        self.assertEqual(arrays["contact_state"], list(stored["state"]))
        self.assertEqual(arrays["contact_joint"], list(stored["joint"] + 1))
        for i, x in enumerate(stored["place"].ravel()):
            self.assertAlmostEqual(arrays["contact_place"][i] + document["origin"][i % 3], x, 5)
        low, high = arrays["contact_slip_range"]
        for level, slip in zip(arrays["contact_slip"], stored["slip"]):
            self.assertAlmostEqual(low + level / 1000 * (high - low), slip, delta=(high - low) / 1000)
        # Each second of stored states has its own points, and no others.
        thinned = parts(self.page("sliding_block.vtkhdf", "--every", "2"))[1]
        self.assertEqual(thinned["contact_count"], [counts[s] for s in sorted({*range(0, len(counts), 2), len(counts) - 1})])
        self.assertEqual(len(thinned["contact_slip"]), sum(thinned["contact_count"]))

    def test_every_and_surface_only_make_it_smaller(self):
        self.copy_case("free_fall")
        self.run_program("run", "free_fall.toml", "-q")
        every = parts(self.page("free_fall.vtkhdf", "--every", "3"))[1]
        self.assertEqual(every["state_step"], [0, 15, 20])
        model = ('[[solid]]\nshape = "box"\nmin = [0, 0, 0]\nmax = [3, 3, 3]\n' + "".join(
            f"[[joint_set]]\nspacing = 1\ndip = {dip}\ndip_direction = {way}\norigin = [1, 1, 1]\n" for dip, way in ((0, 0), (90, 0), (90, 90))))
        (self.folder / "dice.toml").write_text(model + '[[joint_material]]\nfriction_angle = 30\n')
        self.run_program("cut", "dice.toml", "-q")
        self.assertEqual(len(parts(self.page("dice.vtkhdf"))[1]["block_id"]), 27)
        ids = parts(self.page("dice.vtkhdf", "--surface-only"))[1]["block_id"]
        self.assertEqual(sorted(set(range(1, 28)) - set(ids)), [14])  # the one in the middle

    def test_names_cannot_end_the_script(self):
        self.copy_case("cube")
        self.run_program("cut", "cube.toml", "-q", "--set", "title='</script><b>&'")
        html = self.page("cube.vtkhdf", "-o", "page.html")
        self.assertIn("\\u003c/script>\\u003cb>&", html)
        self.assertEqual(parts(html)[0]["title"], "</script><b>&")

    def test_says_what_a_file_is_that_is_no_result(self):
        self.copy_case("cube")
        self.run_program("cut", "cube.toml", "-q")
        whole = (self.folder / "cube.vtkhdf").read_bytes()
        (self.folder / "short.vtkhdf").write_bytes(whole[:len(whole) // 2])
        for name, said in (("none.vtkhdf", "no such file"), ("cube.toml", "no HDF5 file"), ("short.vtkhdf", "cut short")):
            failed = self.run_program("view", name, status=3)
            self.assertIn(said, failed.stderr)
            self.assertEqual([f for f in self.files() if f.endswith(".html")], [])
        self.assertIn("overwrite", self.run_program("view", "cube.vtkhdf", "-o", "cube.vtkhdf", status=2).stderr)
        self.assertIn("no whole number", self.run_program("view", "cube.vtkhdf", "--every", "0", status=2).stderr)
        self.assertEqual((self.folder / "cube.vtkhdf").read_bytes(), whole)


if __name__ == "__main__":
    unittest.main()
