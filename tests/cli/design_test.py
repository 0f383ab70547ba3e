"""Support design from the command line: the JSON, the drawings and the tables of the bolted tunnel."""
import csv
import math
import re
import unittest
import xml.etree.ElementTree as xml

from program import ProgramTest

try:
    import h5py
except ImportError:
    h5py = None

SVG = "{http://www.w3.org/2000/svg}"
FILES = ["stereonet.svg", "pyramids.svg", "layout.svg", "keyblocks.csv", "crossings.csv"]


class BoltedTunnel(ProgramTest):
    def setUp(self):
        super().setUp()
        self.copy_case("bolted_tunnel")

    def path(self, name):
        return self.folder / f"bolted_tunnel_{name}"

    def test_tells_what_holds_each_key_block(self):
        document = self.json_of("support", "bolted_tunnel.toml")
        bolts = {bolt["name"]: bolt for bolt in document["bolts"]}
        self.assertEqual(len(bolts), document["bolting"]["bolts"])
        self.assertTrue(all(bolt["rock"] for bolt in bolts.values()))
        # Two blocks lean on less than 2 % of the area of their joints.
        self.assertEqual([w.split(" leans with")[0] for w in document["warnings"]], ["block 203", "block 270"])
        self.assertEqual(document["bolting"]["adequate"], sum(key["adequate"] for key in document["keyblocks"]))
        crossed = 0
        for key in document["keyblocks"]:
            loads = sum(crossing["load"] for crossing in key["bolts"])
            capacity = sum(crossing["capacity"] for crossing in key["bolts"])
            if capacity > 0:
                self.assertAlmostEqual(key["mobilisation"]["force"], loads / capacity)
                self.assertAlmostEqual(key["utilisation"], 100 * key["mobilisation"]["force"])
            self.assertEqual(key["missing_force"] > 0, not key["adequate"])
            for crossing in key["bolts"]:
                rock = bolts[crossing["bolt"]]["rock"]
                crossed += 1
                self.assertIn(key["block"], [part["block"] for part in rock])
                within = sum(part["to"] - part["from"] for part in rock if part["block"] == key["block"])
                self.assertAlmostEqual(crossing["length_within"], within)
                self.assertLessEqual(crossing["axial_capacity"], 150e3)
        self.assertGreater(crossed, 10)
        self.assertEqual(document["classification"]["q"]["proposed"], ["rqd", "jn"])
        demand = document["classification"]["block_theory"]  # what Q and RMR are compared with
        self.assertEqual(demand["keyblocks"], len(document["keyblocks"]))
        self.assertAlmostEqual(demand["largest_pressure"], max(key["support_pressure"] for key in document["keyblocks"]))
        self.assertAlmostEqual(demand["support_force"], sum(key["support_force"] for key in document["keyblocks"]), delta=1e-3)
        best = document["pattern_search"]["best"]
        self.assertEqual(best["held"], document["pattern_search"]["key_blocks"])
        self.assertEqual(document["pattern_search"]["tried"][-1], best)

    def test_names_the_blocks_that_no_pattern_of_the_catalogue_holds(self):
        few = ("--set", "pattern_search.spacing=[2.0,3.0]", "--set", "pattern_search.length=[1.0,1.5]")
        search = self.json_of("support", "bolted_tunnel.toml", *few)["pattern_search"]
        self.assertIsNone(search["best"])
        nearest = search["nearest"]
        self.assertEqual(nearest["held"], max(tried["held"] for tried in search["tried"]))
        self.assertEqual(search["key_blocks"] - nearest["held"], len(search["not_held"]))
        self.assertEqual(search["disturbed"], [])
        # The same pattern as the model's own leaves the same blocks.
        own = [f"--set=bolt_pattern.systematic.{key}={value}" for key, value in
               (("spacing", [nearest["spacing"]] * 2), ("offset", [0, 0]), ("length", nearest["length"]), ("type", f'"{nearest["type"]}"'))]
        keys = self.json_of("support", "bolted_tunnel.toml", *few, *own)["keyblocks"]
        self.assertEqual(search["not_held"], [key["block"] for key in keys if key["batch"] == 1 and not key["adequate"]])
        blocks = ", ".join(str(block) for block in search["not_held"])
        done = self.run_program("support", "bolted_tunnel.toml", *few)
        self.assertRegex(done.stdout, f"not held +{blocks}\n")
        self.assertRegex(done.stderr, f"nearest one leaves blocks? {blocks} below the target factor of safety")
        self.run_program("report", "bolted_tunnel.vtkhdf", "-o", "report.html")
        report = (self.folder / "report.html").read_text(encoding="utf-8")
        self.assertIn(f"With the nearest pattern key blocks stay below the target factor of safety: {blocks}.", report)

    def test_draws_and_tabulates_beside_the_result(self):
        self.run_program("support", "bolted_tunnel.toml")
        for name in FILES[:3]:
            root = xml.parse(self.path(name)).getroot()
            self.assertEqual(root.tag, SVG + "svg")
            self.assertGreater(len(list(root)), 20)
        # Of 2³ joint pyramids 3² − 3 are removable from a tunnel (Goodman & Shi); all are named, on the net or beside it.
        texts = list(xml.parse(self.path("pyramids.svg")).getroot().iter(SVG + "text"))
        codes = [text for text in texts if set(text.text) <= {"0", "1"} and len(text.text) == 3]
        beside = "".join(text.text for text in texts if text.text.startswith("off this paper:"))
        found = [code.text for code in codes] + re.findall("[01]{3}", beside)
        self.assertEqual(sorted(found), sorted(f"{n:03b}" for n in range(8)))
        removable = sum(code.get("font-weight") == "bold" for code in codes) + beside.count("removable")
        self.assertEqual(removable, 6)
        self.assertIn("J1  62/065", [text.text for text in texts])

        document = self.json_of("support", "bolted_tunnel.toml")
        with open(self.path("keyblocks.csv"), encoding="utf-8", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([int(row["block"]) for row in rows],
                         [key["block"] for key in document["keyblocks"] + document["stable"]])
        with open(self.path("crossings.csv"), encoding="utf-8", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(len(rows), sum(len(key["bolts"]) for key in document["keyblocks"] + document["stable"]))

    @unittest.skipIf(h5py is None, "h5py is not installed")
    def test_stores_the_fields_that_colour_the_blocks(self):
        document = self.json_of("support", "bolted_tunnel.toml")
        classes = ["infinite", "tapered", "stable", "key", "excavated"]
        modes = ["none", "lifting", "single_plane", "two_planes", "rotation"]
        moving = {}
        for key in document["keyblocks"] + document["stable"]:
            moving.update({block: key for block in key["blocks"]})
        self.assertTrue(any(key["factor_of_safety"] for key in document["keyblocks"]))
        with h5py.File(self.folder / "bolted_tunnel.vtkhdf", "r") as file:
            fields = file["rockfold/block_theory"]
            cells = file["VTKHDF/Blocks/CellData"]
            of_cell = cells["block"][:] - 1
            for block in document["blocks"]:
                at = block["id"] - 1
                key = moving.get(block["id"])
                self.assertEqual(classes[fields["class"][at]], block["class"])
                self.assertEqual(fields["batch"][at], block["batch"])
                self.assertEqual(modes[fields["mode"][at]], key["mode"] if key else "none")
                for name in ("factor_of_safety", "supported_factor_of_safety"):
                    expected = key[name] if key and key[name] is not None else None
                    found = fields[name][at]
                    if expected is None:
                        self.assertFalse(math.isfinite(found), (name, block))
                    else:
                        self.assertAlmostEqual(found, expected, delta=1e-12)
            # What ParaView colours, face by face, is the same.
            for name in ("class", "batch", "mode"):
                self.assertEqual(list(cells[name][:]), list(fields[name][:][of_cell]), name)
            drawn, stored = cells["factor_of_safety"][:], fields["factor_of_safety"][:][of_cell]
            for a, b in zip(drawn, stored):
                self.assertTrue(math.isnan(a) and math.isnan(b) or abs(a - b) <= 1e-6 * abs(b), (a, b))

    def test_is_the_same_on_any_number_of_threads(self):
        found = []
        for threads in ("1", "3"):
            document = self.json_of("support", "bolted_tunnel.toml", "--threads", threads)
            document.pop("seconds")
            found.append((document, [self.path(name).read_bytes() for name in FILES]))
        self.assertEqual(found[0], found[1])


# Rock beside a gap; a block of 60 kN rests on a floor of 20 degrees, and an anchor of 20 kN pulls it across.


class BoltedRoof(ProgramTest):
    """Two cubes above each other in a roof, on joints without friction, and a bolt up through the lower one."""

    def warnings(self, length, capacity=200):
        joints = "".join(
            f"[[joint]]\nname = '{name}'\ndip = {dip}\ndip_direction = {direction}\npoint = {point}\nmaterial = 'smooth'\n"
            for name, dip, direction, point in (
                ("x1", 90, 90, [1, 0, 0]), ("x2", 90, 90, [2, 0, 0]), ("y1", 90, 0, [0, 1, 0]), ("y2", 90, 0, [0, 2, 0]),
                ("z1", 0, 0, [0, 0, 1]), ("z2", 0, 0, [0, 0, 2])))
        self.write("roof.toml", f"""
[[material]]
density = 2500
[[joint_material]]
name = 'smooth'
friction_angle = 0
[[solid]]
name = 'rock'
shape = 'box'
min = [0, 0, -1]
max = [3, 3, 5]
continues = ['xmin', 'xmax', 'ymin', 'ymax', 'zmin', 'zmax']
[[excavation]]
name = 'room'
shape = 'box'
min = [0, 0, -1]
max = [3, 3, 0]
{joints}
[support]
[[bolt]]
name = 'B'
collar = [1.5, 1.5, 0]
direction = [0, 0, 1]
length = {length}
force_capacity = '{capacity} kN'
plate_capacity = '{capacity} kN'
bond_strength = '400 kN/m'
displacement_capacity = '20 mm'
""")
        document = self.json_of("support", "roof.toml")
        self.assertGreater(document["keyblocks"][0]["supported_factor_of_safety"], 1)
        return [w for w in document["warnings"] if "come down together" in w]


class BoltsIntoRockThatMoves(BoltedRoof):
    """Rock that only the lower cube keeps in place cannot hold it up."""

    def test_are_told_where_no_batch_looks_at_it(self):
        (warning,) = self.warnings(1.9)
        self.assertIn("support.batches = 0", warning)

    def test_are_told_below_the_target_and_where_too_little_lies_beyond(self):
        self.assertEqual(len(self.warnings(1.9, capacity=30)), 1)
        self.assertEqual(len(self.warnings(2.05)), 1)  # 20 kN beyond both cubes

    def test_are_as_they_should_be_where_they_reach_beyond(self):
        self.assertEqual(self.warnings(4), [])


class CollarInsideTheRock(BoltedRoof):
    def test_is_told_with_its_place_on_the_face(self):
        self.warnings(4)
        done = self.run_program("support", "roof.toml", "--no-result", "-q", "--set", "bolt.B.collar=[1.5, 1.5, 0.4]")
        self.assertRegex(done.stderr, r"B: its collar lies 0\.4 m inside block \d+, .*on the block's face it is at \(1\.5, 1\.5, 0\)")
        done = self.run_program("support", "roof.toml", "--no-result", "-q", "--set", "bolt.B.collar=[1.5, 1.5, 0.05]")
        self.assertNotIn("collar", done.stderr)


PULLED_BLOCK = """
gravity = [0, 0, -10]
[[material]]
density = 2000
[[joint_material]]
name = "floor"
friction_angle = 20
[[solid]]
name = "base"
shape = "box"
min = [-6, -6, -6]
max = [6, 6, 0]
continues = ["xmin", "xmax", "ymin", "ymax", "zmin"]
[[solid]]
name = "wall"
shape = "box"
min = [-6, -6, 0]
max = [-2, 6, 4]
continues = ["xmin", "ymin", "ymax"]
[[solid]]
name = "block"
shape = "box"
min = [0, 0, 0]
max = [1, 1, 3]
interface = "floor"
[support]
[[bolt]]
name = "anchor"
collar = [1, 0.5, 0.4]
direction = [-1, 0, 0]
length = 6
coupling = "DMFC"
force_capacity = 20e3
displacement_capacity = 0.02
[[table]]
output = "keyblocks.csv"
kind = "keyblocks"
"""


class AnchorThatDrives(ProgramTest):
    def test_names_the_block_that_rests_without_it(self):
        self.write("pulled.toml", PULLED_BLOCK)
        document = self.json_of("support", "pulled.toml")
        self.assertEqual(document["keyblocks"], [])
        (block,) = document["stable"]
        self.assertEqual(block["mode"], "at_rest")
        self.assertIsNone(block["factor_of_safety"])
        self.assertEqual(block["sliding_force"], 0)
        self.assertEqual(block["supported_mode"], "single_plane")
        expected = 60 * math.tan(math.radians(20)) / 20
        self.assertAlmostEqual(block["supported_factor_of_safety"], expected)
        self.assertEqual(block["utilisation"], 100)
        self.assertFalse(block["adequate"])
        self.assertEqual(document["bolting"]["disturbed"], [block["block"]])
        done = self.run_program("support", "pulled.toml")
        self.assertRegex(done.stderr, f"active bolts bring blocks .*: {block['block']}\n")
        self.assertRegex(done.stdout, f"disturbed +{block['block']} ")
        with open(self.folder / "keyblocks.csv", newline="", encoding="utf-8") as file:
            (row,) = csv.DictReader(file)
        self.assertEqual(row["mode"], "at_rest")
        self.assertAlmostEqual(float(row["supported factor of safety"]), expected)


class TableOfTheCommandLine(ProgramTest):
    def rows(self, name):
        with open(self.folder / name, newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def test_lists_the_key_blocks_of_the_document(self):
        self.copy_case("crossing_tunnels")
        document = self.json_of("support", "crossing_tunnels.toml", "--no-result", "--table", "all.csv")
        blocks = [int(row["block"]) for row in self.rows("all.csv") if int(row["batch"]) > 0]
        self.assertEqual(sorted(blocks), sorted(key["block"] for key in document["keyblocks"]))
        self.assertGreater(len(blocks), 20)
        told = self.run_program("support", "crossing_tunnels.toml", "--no-result").stdout
        self.assertRegex(told, r"… \d+ more: --table keyblocks.csv lists all")

    def test_leaves_small_ones_out_where_told_so(self):
        self.copy_case("crossing_tunnels")
        keys = self.json_of("support", "crossing_tunnels.toml", "--no-result", "--table", "all.csv")["keyblocks"]
        middle = sorted(key["volume"] for key in keys)[len(keys) // 2]
        size = ("--set", f"support.smallest_block={middle}")
        document = self.json_of("support", "crossing_tunnels.toml", "--no-result", "--table", "large.csv", *size)
        self.assertEqual(document["keyblocks"], keys)
        large = [row for row in self.rows("all.csv") if float(row["volume m3"]) >= middle]
        self.assertEqual(self.rows("large.csv"), large)
        self.assertGreater(len(large), 10)
        told = self.run_program("support", "crossing_tunnels.toml", "--no-result", *size).stdout
        self.assertRegex(told, rf"… \d+ smaller than {middle:g} m3, [0-9.]+ m3 together")

    def test_has_a_place_and_a_direction_for_a_bolt_of_each_block(self):
        self.copy_case("wedge")
        key = self.json_of("support", "wedge.toml", "--table", "keys.csv")["keyblocks"][0]
        row = self.rows("keys.csv")[0]
        for i, axis in enumerate("xyz"):
            self.assertAlmostEqual(float(row[f"free face {axis} m"]), key["free_face"]["centre"][i])
            self.assertAlmostEqual(float(row[f"into rock {axis}"]), -key["free_face"]["normal"][i])

    def test_stands_in_the_folder_one_works_in(self):
        self.copy_case("wedge")
        (self.folder / "results").mkdir()
        self.run_program("support", "wedge.toml", "-o", "results/wedge.vtkhdf", "--table", "keys.csv")
        self.assertEqual(len(self.rows("keys.csv")), 1)

    def test_is_refused_where_it_would_destroy_or_be_empty(self):
        self.copy_case("free_fall")
        told = self.run_program("run", "free_fall.toml", "--table", "keys.csv", status=2).stderr
        self.assertIn("--table: lists key blocks, which `run` finds where the model has a [support]", told)
        for name in ("free_fall.toml", "keys.xlsx"):
            told = self.run_program("support", "free_fall.toml", "--table", name, status=2).stderr
            self.assertIn(f"--table: the table is CSV; '{name}' must end in .csv", told)
        self.assertEqual(self.files(), ["free_fall.toml"])


if __name__ == "__main__":
    unittest.main()
