"""Tables of joints, surveys of the ground and records as other programs write them, end to end."""
import random
import unittest

from program import ProgramTest

BOX = """[[material]]
density = 2600
[[joint_material]]
friction_angle = 30
[[solid]]
name = "rock"
shape = "box"
min = [0, 0, 0]
max = [10, 10, 10]
[[joint_table]]
name = "map"
file = "map.csv"
"""
# Both joints go through: by their planes, dip 60 towards 135 through (5, 5, 5) and dip 30 towards 240 through (4, 5, 6).
VOLUMES = [125.987, 224.114, 275.886, 374.013]
# Normals of six digits are off by 1e-6, which moves planes of 115 m2 by 1e-5 m at their ends: m3.
ROUNDED = 2e-3
TABLES = {
    "angles": "dip,dip_direction,x,y,z\n60,135,5,5,5\n30,240,4,5,6\n",
    "quadrants": "x,y,z,strike,dip\n5,5,5,N45E,60SE\n4,5,6,S30E,30SW\n",
    "both angles in one": "ID,X,Y,Z,Dip/DipDir\n1,5,5,5,60/135\n2,4,5,6,30/240\n",
    "normals": "cx,cy,cz,nx,ny,nz\n5,5,5,0.612372,-0.612372,0.500000\n4,5,6,-0.433013,-0.250000,0.866025\n",
    "equations": "0.612372 -0.612372 0.500000 -2.500000\n-0.433013 -0.250000 0.866025 -2.214102\n",
    "units": "Dip,DipDir,X,Y,Z\n(deg),(deg),(m),(m),(m)\n60,135,5,5,5\n30,240,4,5,6\n",
}
SLOPE = """[[material]]
density = 2600.0
[[joint_material]]
friction_angle = 30
[[solid]]
name = "hill"
shape = "terrain"
file = "slope.csv"
base = -10
continues = ["xmin", "xmax", "ymin", "ymax", "zmin"]
[[joint]]
name = "bed"
dip = 35
dip_direction = 90
point = [21.547, 0, 0]
[[joint]]
normal = [0, 1, 0]
point = [0, 5, 0]
[[joint]]
normal = [0, 1, 0]
point = [0, 15, 0]
[[joint]]
normal = [1, 0, 0]
point = [6, 0, 0]
[support]
"""
PROFILE = ((0, 20), (10, 20), (21.547, 0), (40, 0))
POSTS = [(x, y, z) for y in (0, 8, 20) for x, z in PROFILE]


class Tables(ProgramTest):
    def volumes(self, table, model=BOX):
        self.write("map.csv", table)
        self.write("m.toml", model)
        document = self.json_of("cut", "m.toml", "--no-result")
        return sorted(block["volume"] for block in document["blocks"])

    def test_of_joints_read_as_other_programs_write_them(self):
        for name, table in TABLES.items():
            found = self.volumes(table)
            self.assertEqual(len(found), 4, name)
            for volume, wanted in zip(found, VOLUMES):
                self.assertAlmostEqual(volume, wanted, delta=ROUNDED, msg=name)

    def test_of_joints_with_extents_are_discs_unless_the_model_says_otherwise(self):
        table = "Dip,DipDir,X,Y,Z,Persistence (m),Trace length\n60,135,5,5,5,4,3\n30,240,4,5,6,3,3\n"
        self.assertEqual(len(self.volumes(table)), 1)
        told = self.run_program("check", "m.toml").stderr
        self.assertIn("Persistence (m) is taken for the diameter of discs (m)", told)
        self.assertIn("passed over: Trace length", told)
        for volume, wanted in zip(self.volumes(table, BOX + 'extents = "through_going"\n'), VOLUMES):
            self.assertAlmostEqual(volume, wanted, delta=ROUNDED)

    def test_of_joints_name_them_in_results(self):
        table = TABLES["angles"].replace("dip,", "Set,dip,").replace("60,", "J1,60,").replace("30,2", "bedding,30,2")
        self.write("map.csv", table)
        self.write("m.toml", BOX)
        names = {joint["name"] for joint in self.json_of("cut", "m.toml", "--no-result")["intensities"]}
        self.assertEqual(names, {"map.J1", "map.bedding"})

    def test_of_a_whole_site_is_asked_about(self):
        draw = random.Random(1)
        rows = "".join(f"{draw.uniform(0, 90):.1f},{draw.uniform(0, 360):.1f},{draw.uniform(2, 8):.2f},{draw.uniform(2, 8):.2f},{draw.uniform(2, 8):.2f}\n" for _ in range(200))
        self.write("map.csv", "dip,dip_direction,x,y,z\n" + rows)
        self.write("m.toml", BOX)
        for command in ("check", "cut"):
            error = self.json_of(command, "m.toml", status=2)["error"]
            self.assertEqual((error["key"], error["line"]), ("joint_table[1]", 10))
            self.assertRegex(error["message"], r"into about \d+0,000 blocks; 200 of the 200 joints are rows of table \"map\"")
            for way_out in ("--yes", "cut.max_cells", "within = ", "trace lengths"):
                self.assertIn(way_out, error["message"])
        self.json_of("check", "m.toml", "--yes")
        self.json_of("check", "m.toml", "--set", "cut.max_cells=3000000")


class Ground(ProgramTest):
    def factor(self, text, model=SLOPE):
        self.write("slope.csv", text)
        self.write("m.toml", model)
        return [block["factor_of_safety"] for block in self.json_of("support", "m.toml", "--no-result")["keyblocks"]]

    def test_reads_a_survey_by_its_heading(self):
        east_north = "Easting,Northing,Elevation\n" + "".join(f"{x},{y},{z}\n" for x, y, z in POSTS)
        north_east = "Northing,Easting,Elevation\n" + "".join(f"{y},{x},{z}\n" for x, y, z in POSTS)
        numbered = "".join(f"{n + 1},{y},{x},{z},GND\n" for n, (x, y, z) in enumerate(POSTS))
        columns = SLOPE.replace("base", 'columns = ["point", "northing", "easting", "elevation", "code"]\nbase')
        wanted = self.factor(east_north)
        self.assertEqual(len(wanted), 1)
        self.assertAlmostEqual(wanted[0], 0.8245, delta=5e-5)  # tan 30 / tan 35
        self.assertEqual(self.factor(north_east), wanted)
        self.assertEqual(self.factor(numbered, columns), wanted)
        self.write("m.toml", SLOPE)
        error = self.json_of("check", "m.toml", status=2)["error"]
        self.assertIn("the first column runs 1, 2, 3 …", error["message"])
        self.assertIn('columns = ["point", "northing", "easting", "elevation", "code"]', error["message"])

    def test_refuses_columns_that_say_no_place(self):
        self.write("slope.csv", "0,0,1\n")
        self.write("m.toml", SLOPE.replace("base", 'columns = ["point", "northing", "easting"]\nbase'))
        error = self.json_of("check", "m.toml", status=2)["error"]
        self.assertEqual(error["key"], "solid[1].columns")
        self.assertIn("names no column for z (up)", error["message"])


class Records(ProgramTest):
    MODEL = BOX.partition("[[joint_table]]")[0].replace("2600", "2600\nyoung_modulus = 1e9\npoisson_ratio = 0.2") + """
[cover]
spacing = 10
[[fixed]]
where = {face = "rock.zmin"}
[analysis]
end_time = 0.01
time_step = 0.01
[base_acceleration]
file = "quake.csv"
"""

    def check(self, record, more="", status=0):
        self.write("quake.csv", record)
        self.write("m.toml", self.MODEL + more)
        return self.json_of("check", "m.toml", status=status)

    def test_of_one_component_need_a_direction(self):
        record = "Time (s), Acc (g)\n0, 0\n0.01, 0.3\n"
        error = self.check(record, status=2)["error"]
        self.assertEqual(error["key"], "base_acceleration.file")
        self.assertIn("base_acceleration.direction = [x, y, z]", error["message"])
        self.check(record, "direction = [1, 0, 0]\n")

    def test_in_g_are_seen_by_their_size(self):
        record = "t, ax, ay, az\n0, 0, 0, 0\n0.01, 0.3, 0, 0\n"
        warnings = self.check(record)["warnings"]
        self.assertTrue(any("did you mean 0.3 g?" in warning for warning in warnings), warnings)
        for more in ('unit = "g"\n', 'unit = "m/s2"\n', "scale = 9.81\n"):
            self.assertFalse(any(" g?" in warning for warning in self.check(record, more)["warnings"]), more)


if __name__ == "__main__":
    unittest.main()
