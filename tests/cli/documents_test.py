"""The JSON documents: every key of the contract, and numbers that are known."""
import json
import random
import re
import unittest

from program import CASES, PRESSED, ProgramTest

CUT_TOTALS = {"blocks", "faces", "vertices", "edges", "volume", "solid_volume", "joint_area", "dangling_joint_area", "cells"}
CUT_BLOCK = {"id", "volume", "centroid", "faces", "edges", "vertices", "convex", "shells", "genus", "finite", "material",
             "dead_end_area", "stage", "surface_area", "alpha", "beta", "aspect_ratio"}
STATISTICS = {"volume", "block_size", "histogram", "shape", "volumetric_joint_count", "rqd", "scanlines", "sections"}
INTENSITY = {"name", "joints", "area", "p10", "p20", "p21", "p30", "p32"}
KEYBLOCK = {"block", "batch", "volume", "weight", "mode", "planes", "direction", "sliding_force", "factor_of_safety",
            "free_area", "support_force", "support_pressure", "support_direction", "bolts", "mobilisation"}
RUN_TOTALS = {"blocks", "mathematical_covers", "physical_covers", "elements", "dof", "steps", "time"}


class Cut(ProgramTest):
    def test_has_every_key_of_the_contract(self):
        self.copy_case("wedge")
        document = self.json_of("cut", "wedge.toml", "--seed", "7")
        self.assertEqual([document[key] for key in ("schema", "command", "title")],
                         ["rockfold/1", "cut", "Wedge on two joints"])
        self.assertEqual(document["seed"], 7)
        self.assertLessEqual(CUT_TOTALS, set(document["totals"]))
        self.assertIn("cut", document["seconds"])
        self.assertEqual([block["id"] for block in document["blocks"]], [1, 2, 3, 4])
        for block in document["blocks"]:
            self.assertLessEqual(CUT_BLOCK, set(block))
        self.assertLessEqual(STATISTICS, set(document["statistics"]))
        self.assertEqual([joint["name"] for joint in document["intensities"]], ["east", "west"])
        for joint in document["intensities"]:
            self.assertLessEqual(INTENSITY, set(joint))
        self.assertEqual((document["stages"], document["flagged"]), ([], {"small_volume": 0, "elongated": 0}))

    def test_a_cube_of_a_thousand_blocks(self):
        self.copy_case("cube")
        document = self.json_of("cut", "cube.toml")
        self.assertEqual(document["totals"]["blocks"], 1000)
        self.assertAlmostEqual(document["totals"]["joint_area"], 2700, delta=1e-9)  # 27 planes of 100 m2
        for block in document["blocks"]:
            self.assertAlmostEqual(block["volume"], 1, delta=1e-12)
            self.assertEqual([block[key] for key in ("faces", "edges", "vertices", "shells", "genus")], [6, 12, 8, 1, 0])
            self.assertTrue(block["convex"] and block["finite"])
            self.assertAlmostEqual(block["aspect_ratio"], 1, delta=1e-9)
        statistics = document["statistics"]
        self.assertAlmostEqual(statistics["volume"]["by_volume"]["D50"], 1, delta=1e-12)
        self.assertAlmostEqual(statistics["block_size"]["D90"], 1, delta=1e-12)
        self.assertEqual([(bin["from"], bin["blocks"]) for bin in statistics["histogram"]], [(1, 1000)])
        self.assertEqual(statistics["shape"]["classes"][0]["blocks"], 1000)
        self.assertAlmostEqual(statistics["volumetric_joint_count"], 2.7, delta=1e-9)
        self.assertEqual(statistics["rqd"], 1)
        for joint in document["intensities"]:
            self.assertEqual(joint["joints"], 9)
            self.assertAlmostEqual(joint["p32"], 0.9, delta=1e-9)
            self.assertAlmostEqual(joint["p21"], 0.6, delta=1e-9)

    def test_needs_no_material(self):
        self.write("bare.toml", '[[solid]]\nname = "rock"\nshape = "box"\nmin = [0, 0, 0]\nmax = [1, 1, 1]\n')
        self.assertIsNone(self.json_of("cut", "bare.toml")["blocks"][0]["material"])

    def test_is_the_same_on_any_number_of_threads_and_for_any_order_of_joints(self):
        text = (CASES / "slope" / "model.toml").read_text(encoding="utf-8")
        head, *sets, tail = re.split(r"(?=\[\[joint_set\]\]|\[support\])", text)
        generator = random.Random(2)
        answers = set()
        for threads in (1, 2, 4):
            generator.shuffle(sets)
            self.write("slope.toml", head + "".join(sets) + tail)
            for command in ("cut", "support"):
                document = self.json_of(command, "slope.toml", "--threads", threads)
                del document["seconds"]
                answers.add(json.dumps(document))
        self.assertEqual(len(answers), 2)


class WithoutResult(ProgramTest):
    def test_the_answer_is_the_same_and_nothing_is_left(self):
        # "seconds" are of the clock
        answer = lambda document: {key: value for key, value in document.items() if key not in ("timing", "seconds", "timings")}
        for command, case in (("cut", "cube"), ("support", "wedge"), ("run", "sliding_block")):
            with self.subTest(command=command):
                self.copy_case(case)
                before = self.files()
                alone = self.json_of(command, f"{case}.toml", "--no-result")
                self.assertEqual(self.files(), before)
                self.assertEqual(answer(alone), answer(self.json_of(command, f"{case}.toml")))
                told = self.run_program(command, f"{case}.toml", "--no-result", "-o", "other.vtkhdf").stdout
                self.assertNotIn(".vtkhdf", told)
                self.assertFalse((self.folder / "other.vtkhdf").exists())

    def test_tables_and_exports_are_written(self):
        self.copy_case("wedge")
        self.run_program("support", "wedge.toml", "--no-result", "--export", "wedge.obj")
        self.assertEqual(self.files(), ["wedge.obj", "wedge.toml"])

    def test_a_limit_of_time_says_that_nothing_is_left(self):
        self.copy_case("free_fall")
        stopped = self.run_program("run", "free_fall.toml", "--no-result", "--set", "analysis.end_time=5e5", "--max-time", "2",
                                   status=1)
        self.assertIn("nothing is stored (--no-result)", stopped.stderr)
        self.assertEqual(self.files(), ["free_fall.toml"])

    def test_has_no_report(self):
        self.copy_case("wedge")
        told = self.run_program("support", "wedge.toml", "--no-result", "--report", status=2).stderr
        self.assertIn("--no-result leaves nothing that --report could be made of", told)


class Support(ProgramTest):
    def test_of_the_wedge_has_its_closed_form(self):
        self.copy_case("wedge")
        document = self.json_of("support", "wedge.toml")
        self.assertEqual(document["totals"]["batches"], [1])
        key = document["keyblocks"][0]
        self.assertLessEqual(KEYBLOCK, set(key))
        self.assertEqual(key["mode"], "two_planes")
        self.assertEqual(sorted(key["planes"]), ["east", "west"])
        self.assertAlmostEqual(key["factor_of_safety"], 0.942809, delta=1e-6)
        self.assertAlmostEqual(key["weight"], 2700 * 9.81 * key["volume"], delta=1e-6 * key["weight"])
        self.assertEqual([block["class"] for block in document["blocks"]].count("key"), 1)

    def test_tells_the_least_factor_of_what_moves_first_and_of_each_batch(self):
        self.copy_case("rock_slope")
        document = self.json_of("support", "rock_slope.toml", "--no-result")
        totals, factors = document["totals"], {}
        for key in document["keyblocks"]:
            factors.setdefault(key["batch"], []).append(key["factor_of_safety"] or 0)
        self.assertEqual(totals["least_factors_of_batches"], [min(factors[b + 1]) for b in range(len(totals["batches"]))])
        # One of the second batch falls once the first is gone: that is no factor of the slope as it stands.
        self.assertEqual(totals["least_factors_of_batches"][1], 0)
        self.assertEqual(totals["least_factor_of_safety"], min(factors[1]))
        self.assertGreater(totals["least_factor_of_safety"], 0)

    def test_of_a_falling_block_has_no_factor_of_safety(self):
        self.copy_case("wedge")
        roof = """
[[solid]]
name = "rock"
shape = "box"
min = [-9, -9, 0]
max = [9, 9, 9]
continues = ["xmin", "xmax", "ymin", "ymax", "zmax"]
[[material]]
name = "rock"
density = 2700
[[joint_material]]
name = "clean"
friction_angle = 20
"""
        for n, direction in enumerate((30, 150, 270)):
            roof += f'[[joint]]\nname = "J{n}"\ndip = 60\ndip_direction = {direction}\npoint = [0, 0, 1]\n'
        self.write("roof.toml", roof)
        document = self.json_of("support", "roof.toml")
        self.assertEqual([key["mode"] for key in document["keyblocks"]], ["lifting"])
        self.assertIsNone(document["keyblocks"][0]["factor_of_safety"])


class Run(ProgramTest):
    def test_of_free_fall(self):
        self.copy_case("free_fall")
        document = self.json_of("run", "free_fall.toml")
        self.assertLessEqual(RUN_TOTALS, set(document["totals"]))
        self.assertEqual(document["totals"]["steps"], 20)
        self.assertGreater(document["totals"]["elements"], 300)
        self.assertEqual(document["totals"]["dof"], 3 * document["totals"]["physical_covers"])
        monitor = document["monitors"][0]
        for t, u, v in zip(monitor["time"], monitor["displacement"], monitor["velocity"]):
            self.assertAlmostEqual(u[2], -5 * t * t, delta=1e-9 * 5)
            self.assertAlmostEqual(v[2], -10 * t, delta=1e-9 * 10)
        self.assertEqual(len(monitor["time"]), 21)
        self.assertLessEqual({"kinetic", "strain", "potential", "contact", "dissipated"}, set(document["energy"]))
        self.assertEqual(set(document["energy_history"]), {"time", *document["energy"]})
        for name, values in document["energy_history"].items():
            self.assertEqual(len(values), 21)
            self.assertEqual(values[-1], document["energy"].get(name, monitor["time"][-1]))
        self.assertEqual(set(document["contacts"]),
                         {"open", "stick", "slide", "max_penetration", "max_opening", "max_slip"})
        self.assertEqual(set(document["contacts_history"]), {"time", "open", "stick", "slide", "iterations", "substeps"})
        self.assertLessEqual({"cut", "cover", "contact", "assemble", "solve", "output", "total"}, set(document["seconds"]))
        self.assertEqual(set(document["iterations"]), {"pcg", "open_close", "fallbacks", "preconditioner"})
        self.assertAlmostEqual(document["blocks"][0]["displacement"][2], -5, delta=1e-8)
        info = self.json_of("info", "free_fall.vtkhdf")
        self.assertEqual(info["states"]["step"], [0, 5, 10, 15, 20])
        shapes = {entry["path"]: entry["shape"] for entry in info["datasets"]}
        self.assertEqual(shapes["/rockfold/states/block_stress"], [5, 1, 6])
        for name in document["energy_history"]:
            self.assertEqual(shapes[f"/rockfold/energy/{name}"], [21])

    def test_of_a_column_under_its_own_weight(self):
        self.copy_case("column")
        document = self.json_of("run", "column.toml")
        top, base = (monitor["displacement"][-1] for monitor in document["monitors"])
        # rho g H² / 2E = 0.0098 m. Linear interpolation between nodes is exact at them in one dimension; the
        # covers of the slender column are not aligned with its faces: 1 % for 20 cells of its height.
        self.assertAlmostEqual(top[2], -0.0098, delta=1e-4)
        self.assertAlmostEqual(document["reaction"][2], 2000 * 9.8 * 10, delta=1)
        (floor,) = document["reactions"]
        self.assertEqual(floor["fixed"], 1)
        self.assertAlmostEqual(floor["force"][2], 2000 * 9.8 * 10, delta=1)

    def test_tells_how_near_the_rock_is_to_failure(self):
        """A box pressed to 10 MPa, free to its sides: with c = 3 MPa and 30 degrees it bears 2 c sqrt(3) = 10.392 MPa."""
        self.write("press.toml", PRESSED)
        document = self.json_of("run", "press.toml")
        ratio = 6e6 * 3 ** 0.5 / 10e6
        monitor, block = document["monitors"][0], document["blocks"][0]
        for found in ({name: monitor[name][-1] for name in ("stress", "principal_stress", "von_mises", "strength_ratio")}, block):
            self.assertAlmostEqual(found["stress"][2] / -10e6, 1, delta=1e-6)
            self.assertAlmostEqual(found["principal_stress"][2] / -10e6, 1, delta=1e-6)
            self.assertAlmostEqual(found["principal_stress"][0] / 10e6, 0, delta=1e-6)
            self.assertAlmostEqual(found["von_mises"] / 10e6, 1, delta=1e-6)
            self.assertAlmostEqual(found["strength_ratio"], ratio, delta=1e-6)
        self.assertAlmostEqual(document["strength"]["least_ratio"], ratio, delta=1e-6)
        self.assertEqual((document["strength"]["block"], document["strength"]["failed_volume"]), (1, 0))
        self.assertIn("strength               at least 1.04 of the stress", self.run_program("run", "press.toml").stdout)
        document = self.json_of("run", "press.toml", "--set", "traction.1.pressure=11e6")
        self.assertAlmostEqual(document["strength"]["failed_volume"], 2, delta=1e-9)
        shapes = {entry["path"]: entry["shape"] for entry in self.json_of("info", "press.vtkhdf")["datasets"]}
        points = shapes["/VTKHDF/Elements/Points"][0]
        for name, width in (("stress", [6]), ("principal_stress", [3]), ("von_mises", []), ("strength_ratio", [])):
            self.assertEqual(shapes[f"/VTKHDF/Elements/PointData/nodal_{name}"], [2 * points, *width])
            self.assertEqual(shapes[f"/VTKHDF/Blocks/CellData/{name}"], [2 * 6, *width])

    def test_of_rock_without_strength_has_no_strength_ratio(self):
        self.write("press.toml", PRESSED.replace("cohesion = 3e6\nfriction_angle = 30\n", ""))
        document = self.json_of("run", "press.toml")
        self.assertIsNone(document["strength"])
        self.assertNotIn("strength_ratio", document["monitors"][0])
        self.assertNotIn("strength_ratio", document["blocks"][0])

    def test_of_a_moving_base_tells_absolute_motion_too(self):
        """A free block under a steady base: it stays where it is, and so the base runs away from below it."""
        self.copy_case("free_fall")
        text = (self.folder / "free_fall.toml").read_text(encoding="utf-8")
        text = re.sub(r"(?m)^gravity.*$", "", text)
        self.write("base.toml", "gravity = [0, 0, 0]\n" + text + "\n[base_acceleration]\ntable = [[0, 3, 0, 0]]\nscale = 2\n")
        monitor = self.json_of("run", "base.toml")["monitors"][0]
        for t, relative, absolute, speed, a in zip(*(monitor[key] for key in ("time", "displacement", "absolute_displacement",
                                                                             "absolute_velocity", "absolute_acceleration"))):
            self.assertAlmostEqual(relative[0], -3 * t * t, delta=6e-7)
            for value in (*absolute, *speed, *a):
                self.assertAlmostEqual(value, 0, delta=6e-7)  # of 6 m/s2

    def test_of_supports_is_the_weight_with_covers_of_every_order(self):
        self.copy_case("column")
        for order, method in ((1, "augmented_lagrangian"), (1, "penalty"), (2, "augmented_lagrangian")):
            document = self.json_of("run", "column.toml", "--set", f"cover.order={order}", "--set", "cover.spacing=1.3",
                                    "--set", f'fixed.1.method="{method}"')
            self.assertAlmostEqual(document["reaction"][2], 2000 * 9.8 * 10, delta=1)

    def test_of_a_wave_along_a_bar(self):
        self.copy_case("bar_wave")
        document = self.json_of("run", "bar_wave.toml")
        end, middle = (dict(zip(m["time"], [-v[0] for v in m["velocity"]])) for m in document["monitors"])
        arrival = next(t for t, v in end.items() if v > 0.632456)
        self.assertAlmostEqual(arrival, 0.0158114, delta=0.01 * 0.0158)

        def mean(values):
            return sum(values) / len(values)

        self.assertAlmostEqual(mean([v for t, v in middle.items() if 0.0105 < t < 0.0215]), 0.632456, delta=0.0063)
        self.assertAlmostEqual(mean([v for t, v in end.items() if t > 0.018]), 1.264911, delta=0.0126)
        # The pressure is constant: its work is lost potential.
        energy = document["energy"]
        self.assertAlmostEqual((energy["kinetic"] + energy["strain"]) / -energy["potential"], 1, delta=1e-6)

    def test_of_a_wave_that_leaves_through_a_quiet_boundary(self):
        self.copy_case("quiet_boundary")
        document = self.json_of("run", "quiet_boundary.toml")
        energy, pulse = document["energy"], document["energy"]["loads"]
        self.assertLess(energy["kinetic"] + energy["strain"], 2e-3 * pulse)
        self.assertAlmostEqual(energy["quiet"] / pulse, 1, delta=2e-3)
        self.assertAlmostEqual(energy["numerical"] / pulse, 0, delta=1e-6)
        crest = max(-v[0] for v in document["monitors"][0]["velocity"])
        self.assertAlmostEqual(crest, 0.632456, delta=0.02 * 0.632456)

    def test_warns_of_blocks_without_contact(self):
        self.copy_case("cube")
        model = """
[cover]
spacing = 5.0
[analysis]
type = "dynamic"
time_step = 0.01
steps = 2
"""
        with open(self.folder / "cube.toml", "a", encoding="utf-8") as file:
            file.write(model)
        done = self.run_program("run", "cube.toml", "--json", "--set", "joint_set.1.spacing=5",
                                "--set", "joint_set.2.spacing=5", "--set", "joint_set.3.spacing=5", "--set", "cover.order=2")
        self.assertIn("the 8 blocks move through each other: contact needs", done.stderr)
        self.assertEqual(len(json.loads(done.stdout)["warnings"]), 2)  # and that nothing holds them


if __name__ == "__main__":
    unittest.main()
