"""[cut] specks = "merge": what `cut`, `support` and `run` tell of it."""
import unittest

from program import ProgramTest

# Rock round a tunnel, cut by three scattered sets into some 1,400 blocks, of which the smallest has 2e-11 m3.
TUNNEL = """
title = "Tunnel"
[[material]]
density = 2600
young_modulus = 20e9
poisson_ratio = 0.25
[[joint_material]]
friction_angle = 35
[[solid]]
name = "rock"
shape = "box"
min = [0, 0, 0]
max = [12, 8, 12]
continues = ["xmin", "xmax", "ymin", "ymax", "zmin", "zmax"]
[[excavation]]
name = "tunnel"
shape = "tunnel"
path = [[6, 0, 5], [6, 8, 5]]
section = "circle"
radius = 2
sides = 16
""" + "".join(f"""
[[joint_set]]
name = "{name}"
dip = {dip}
dip_direction = {direction}
[joint_set.random]
seed = {seed}
fisher_kappa = 80
spacing = {{distribution = "exponential", mean = {mean}}}
""" for name, dip, direction, seed, mean in [("A", 70, 80, 3, 1.1), ("B", 65, 200, 4, 1.3), ("C", 20, 320, 5, 1.6)])

MERGE = 'cut.specks="merge"'


class Specks(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("tunnel.toml", TUNNEL)

    def test_are_told_with_where_they_went(self):
        kept = self.json_of("cut", "tunnel.toml", "--no-result")
        self.assertNotIn("specks", kept)
        merged = self.json_of("cut", "tunnel.toml", "--no-result", "--set", MERGE)
        specks = merged["specks"]
        totals = merged["totals"]
        self.assertAlmostEqual(specks["limit"], 1e-6 * kept["totals"]["volume"] / kept["totals"]["blocks"], delta=1e-18)
        small = [block for block in kept["blocks"] if block["volume"] < specks["limit"]]
        self.assertGreater(len(small), 10)
        self.assertEqual(specks["left"], [])
        self.assertEqual([s["id"] for s in specks["merged"]], [b["id"] for b in small])
        self.assertEqual([s["volume"] for s in specks["merged"]], [b["volume"] for b in small])
        self.assertEqual(specks["count"], len(small))
        self.assertEqual(totals["blocks"], kept["totals"]["blocks"] - len(small))
        self.assertAlmostEqual(totals["volume"], kept["totals"]["volume"], delta=1e-9)
        self.assertGreaterEqual(min(b["volume"] for b in merged["blocks"]), specks["limit"])
        by_id = {b["id"]: b for b in merged["blocks"]}
        for speck in specks["merged"]:
            self.assertGreater(by_id[speck["block"]]["volume"], speck["volume"])
        text = self.run_program("cut", "tunnel.toml", "--no-result", "--set", MERGE).stdout
        self.assertIn(f"{len(small)} of less than", text)
        self.assertIn("a millionth of the mean block", text)

    def test_are_the_same_on_any_number_of_threads(self):
        one, two = [self.run_program("cut", "tunnel.toml", "--no-result", "--json", "--threads", n, "--set", MERGE).stdout.split('"seconds"')[0]
                    for n in (1, 2)]
        self.assertEqual(one, two)

    def test_stand_in_the_document_of_support_too(self):
        specks = self.json_of("support", "tunnel.toml", "--no-result", "--set", MERGE)["specks"]
        self.assertEqual(specks["count"], len(specks["merged"]))


if __name__ == "__main__":
    unittest.main()
