"""Mistakes that people make, and what the program says to them."""
import struct
import unittest

from program import ProgramTest

ROCK = """[[material]]
density = 2700
young_modulus = 30e9
poisson_ratio = 0.25
[[joint_material]]
friction_angle = 30
[[solid]]
name = "rock"
shape = "box"
min = [0, 0, 0]
max = [10, 20, 30]
continues = ["zmin"]
"""
TETRAHEDRON = "v 0 0 0\nv 4 0 0\nv 0 4 0\nv 0 0 4\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n"
POINT = "point = [5, 10, 15]\n"
JOINT = "[[joint]]\ndip = 30\ndip_direction = 90\n" + POINT
STATIC = "[cover]\nspacing = 5\n[analysis]\ntype = 'static'\n[[fixed]]\nwhere = {face = 'rock.zmin'}\n"


class Check(ProgramTest):
    def errors(self, text, status=2):
        self.write("m.toml", text)
        error = self.json_of("check", "m.toml", status=status)["error"]
        return error.get("errors", [error])

    def test_tells_where_solids_meshes_and_terrains_lie(self):
        self.write("rock.obj", TETRAHEDRON.replace("v 4 0 0", "v 447000.25 0 0"))
        self.write("ground.xyz", "-1 -2 5\n9 -2 5\n9 8 5\n-1 8 7\n")
        self.write("m.toml", ROCK + "[[solid]]\nname = 'body'\nshape = 'mesh'\nfile = 'rock.obj'\n"
                   "[[solid]]\nname = 'air'\noperation = 'subtract'\nshape = 'halfspaces'\nplanes = [{dip = 0, dip_direction = 0, point = [0, 0, 29], keep = 'above'}]\n"
                   "[[solid]]\nname = 'ground'\nshape = 'terrain'\nfile = 'ground.xyz'\nbase = -3\n"
                   "[[joint_mesh]]\nname = 'fault'\nfile = 'rock.obj'\n"
                   "[[excavation]]\nname = 'pit'\nshape = 'box'\nmin = [1, 1, 20]\nmax = [2, 2, 40]\n")
        text = self.run_program("check", "m.toml").stdout
        for name, extent in (("rock", "x 0 to 10, y 0 to 20, z 0 to 30 m"), ("body", "x 0 to 447000.25, y 0 to 4, z 0 to 4 m"),
                             ("air", "without bounds"), ("ground", "x -1 to 9, y -2 to 8, z -3 to 7 m"),
                             ("fault", "x 0 to 447000.25, y 0 to 4, z 0 to 4 m"), ("pit", "x 1 to 2, y 1 to 2, z 20 to 40 m")):
            self.assertRegex(text, rf"(?m)^ +{name} +{extent}$")
        extents = self.json_of("check", "m.toml")["extents"]
        self.assertEqual([extent["name"] for extent in extents], ["rock", "body", "air", "ground", "pit", "fault"])
        self.assertEqual(extents[0], {"kind": "solid", "name": "rock", "min": [0, 0, 0], "max": [10, 20, 30]})
        self.assertEqual((extents[2]["min"], extents[5]["kind"]), (None, "joint_mesh"))

    def test_finds_points_outside_the_rock(self):
        text = ROCK + STATIC
        errors = self.errors(text + "[[monitor]]\npoint = [5, 10, 31]\n[[monitor]]\npoint = [5, 10, 30]\n"
                             "[[point_load]]\npoint = [-1, 0, 0]\nforce = [1, 0, 0]\n"
                             "[[fixed]]\nwhere = {point = [50, 0, 0]}\n")
        self.assertEqual([error["key"] for error in errors], ["point_load[1].point", "monitor[1].point", "fixed[2].where.point"])
        self.assertIn("(5, 10, 31) of monitor monitor1 is not in the rock", errors[1]["message"])
        self.assertTrue(all(error["line"] > 0 for error in errors))

    def test_knows_that_excavated_rock_is_gone(self):
        pit = "[[excavation]]\nname = 'pit'\nshape = 'box'\nmin = [4, 9, 14]\nmax = [6, 11, 31]\n"
        load = "[[point_load]]\n" + POINT + "force = [1, 0, 0]\n"
        (error,) = self.errors(ROCK + STATIC + pit + "[[monitor]]\n" + POINT)
        self.assertIn("an [[excavation]] removes it", error["message"])
        (error,) = self.errors(ROCK + STATIC + pit + load)
        self.assertEqual(error["key"], "point_load[1].point")
        self.write("m.toml", ROCK + pit + load)  # block theory begins before any stage
        self.run_program("check", "m.toml")

    def test_tells_of_an_open_mesh_beside_a_wrong_face(self):
        self.write("rock.obj", TETRAHEDRON.replace("f 3 1 4\n", ""))
        self.write("discs.csv", "dip;dip_direction;x;y;z;radius\n95;0;0;0;0;1\n")
        text = "[[solid]]\nname = 'rock'\nshape = 'mesh'\nfile = 'rock.obj'\n[[joint_table]]\nfile = 'discs.csv'\n" + \
            "[[joint_mesh]]\nfile = 'none.obj'\n[[fixed]]\nwhere = {face = 'rock.zmin'}\n"
        errors = self.errors(text)
        self.assertEqual([error["key"] for error in errors],
                         ["joint_mesh[1].file", "fixed[1].where.face", "solid[1].file", "joint_table[1].file"])
        self.assertIn("closed", errors[2]["message"])
        self.assertEqual(errors[3]["line"], 2)

    def test_ends_with_status_3_where_nothing_but_files_are_missing(self):
        self.errors("[[joint_mesh]]\nfile = 'none.obj'\n" + ROCK, status=3)


class Slips(ProgramTest):
    def said(self, text, *words):
        path = self.folder / "m.toml"
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        said = self.run_program("check", "m.toml", status=2).stderr
        for word in words:
            self.assertIn(word, said)
        return said

    def test_decimal_commas(self):
        joints = ROCK + "[[joint_set]]\ndip = 60\ndip_direction = 90\nspacing = {}\n"
        for value in ("2,5", "'2,5'"):
            said = self.said(joints.format(value), "m.toml:16:", "decimals stand behind a point: 2.5, not 2,5 (a decimal comma)")
            self.assertEqual(said.count("m.toml"), 1)
        self.said(ROCK.replace("[0, 0, 0]", "[0, 0 0]"), "TOML syntax")
        self.write("m.toml", joints.format(2))
        said = self.run_program("check", "m.toml", "--set", "joint_set.1.spacing=2,5", status=2).stderr
        self.assertIn("2.5, not 2,5", said)

    def test_words_and_units_without_quotes(self):
        self.said(ROCK.replace('name = "rock"', "name = rock"), "m.toml:8:", 'text stands in quotes')
        self.said(ROCK.replace("density = 2700", "density = 2700 kg/m3"), "m.toml:2:", 'a number with its unit stands in quotes: "25 MPa"')
        self.said("density: 2700\n", "a line of a model is key = value, without a colon")

    def test_single_brackets(self):
        joint = "\ndip = 30\ndip_direction = 0\npoint = [5, 5, 5]\n"
        self.said(ROCK + "[joint]" + joint + "[[joint]]" + joint, "Entries of a list stand in double brackets")
        self.said(ROCK + "[joint]" + joint + "[joint]" + joint, "double brackets, all of them: [[joint]]")

    def test_a_part_of_a_key(self):
        self.said(ROCK + "[[joint_set]]\ndip = 60\ndip_direction = 90\n[joint_set.random]\nspacing = 2\nkappa = 20\n",
                  'unknown key "kappa", did you mean "fisher_kappa"?')

    def test_files_that_are_no_text(self):
        for kind, words in ((ROCK.encode("utf-16"), "text in UTF-16"), (ROCK.encode("utf-16-le"), "text in UTF-16"),
                            (ROCK.encode("utf-16-be"), "text in UTF-16"), (b"\x89HDF\r\n\x1a\n\0\0", "rockfold info"),
                            (b"PK\x03\x04\x14\0", "ZIP archive"), (b"solid \0\0\1\2\3", "is binary")):
            self.said(kind, words, "must be a model, TOML text in UTF-8")

    def test_names_of_files(self):
        (self.folder / "Data").mkdir()
        self.write("Data/Ground.xyz", "0 0 5\n9 0 5\n9 8 5\n0 8 7\n")
        ground = "[[solid]]\nname = 'ground'\nshape = 'terrain'\nfile = {}\nbase = -3\n"
        self.said(ground.format('"Data\\Ground.xyz"'), "m.toml:4:", "unknown escape sequence", "write / between folders")
        for name in ("'Data\\Ground.xyz'", "'data/ground.xyz'", "'Data/Grund.xyz'"):
            self.write("m.toml", ground.format(name))
            self.assertIn('did you mean "Data/Ground.xyz"?', self.run_program("check", "m.toml", status=3).stderr)
        self.write("m.toml", ground.format('"Data\\template.xyz"'))
        self.assertIn("write / between folders", self.run_program("check", "m.toml", status=3).stderr)
        self.assertIn('did you mean "m.toml"?', self.run_program("check", "M.TOML", status=3).stderr)
        self.write("portal.html", "")
        self.assertNotIn("did you mean", self.run_program("check", "portal.tml", status=3).stderr)
        self.write("portal.toml", ROCK)
        self.assertIn('did you mean "portal.toml"?', self.run_program("check", "portal.tml", status=3).stderr)
        self.write("m.toml", ground.format("'Data/Ground.xyz'"))
        self.run_program("check", "m.toml")

    def test_tables_of_joints_by_other_programs(self):
        self.write("facets.csv", "Index; CenterX; CenterY; CenterZ; NormalX; Dip dir.; Dip\n0; 5; 10; 15; 0.5; 90; 30\n")
        table = "[[joint_table]]\nfile = '{}'\n"
        self.write("m.toml", ROCK + table.format("facets.csv"))
        document = self.json_of("cut", "m.toml")
        (warning,) = document["warnings"]
        self.assertIn("facets.csv:1:1: joint_table[1].file: 2 columns are passed over: Index, NormalX; without a column radius", warning)
        volumes = [block["volume"] for block in document["blocks"]]
        self.write("strike.csv", "strike;dip;x;y;z;radius\n{};30;5;10;15;\n".format(0))
        for rule, same in (("right_hand", True), ("left_hand", False)):
            self.write("m.toml", ROCK + table.format("strike.csv") + f"rule = '{rule}'\n")
            document = self.json_of("cut", "m.toml", "--force")
            centroids = [block["centroid"] for block in document["blocks"]]
            for block, volume in zip(document["blocks"], volumes):  # through the middle
                self.assertAlmostEqual(block["volume"], volume, delta=1e-9)
            self.assertEqual(centroids[0][0] < 5, same)
            self.assertIn(f"planes dip to the {rule.partition('_')[0]} of their strike", document["warnings"][0])

    def test_other_formats_as_ground(self):
        for name, data, words in (("dem.tif", b"II*\0\x08\0\0\0\n1\n2 3\n", "is a TIFF picture (GeoTIFF): convert it to an ESRI ASCII grid"),
                                  ("fault.dxf", b"0\nSECTION\n2\nENTITIES\n0\n3DFACE\n", "is a DXF drawing")):
            (self.folder / name).write_bytes(data)
            said = self.said(f"[[solid]]\nshape = 'terrain'\nfile = '{name}'\nbase = 0\n", f"{name}: solid[1].file: {words}")
            self.assertEqual(said.count("\n"), 1)

    def test_more_columns_than_posts_have(self):
        self.write("ground.xyz", "0 0 5 255\n9 0 5 255\n9 8 5 7\n0 8 7 8\n")
        self.write("m.toml", "[[solid]]\nname = 'ground'\nshape = 'terrain'\nfile = 'ground.xyz'\nbase = -3\n")
        document = self.json_of("check", "m.toml")
        self.assertEqual(len(document["warnings"]), 1)
        self.assertIn("ground.xyz:1:7: solid[1].file: 1 column behind x, y and z is passed over", document["warnings"][0])


class Implausible(ProgramTest):
    def warnings(self, text, command="check"):
        self.write("m.toml", text)
        warnings = self.json_of(command, "m.toml")["warnings"]
        said = self.run_program(command, "m.toml").stderr
        for warning in warnings:
            self.assertIn("warning: " + warning, said)
        return warnings

    def warned(self, text, *words, command="check"):
        (warning,) = self.warnings(text, command)
        for word in words:
            self.assertIn(word, warning)

    def test_numbers_in_other_units(self):
        self.assertEqual(self.warnings(ROCK), [])
        modulus, density = "young_modulus = 30e9", "density = 2700"
        for given, line, words in ((modulus.replace("30e9", "30"), 3, "material[1].young_modulus: is 30 Pa: did you mean 3e10 (30 GPa)?"),
                                   (modulus.replace("30e9", "30e3"), 3, "did you mean 3e10 (30000.0 MPa)?"),
                                   ("density = 2.7", 2, "is 2.7 kg/m3: did you mean 2700 (2.7 t/m3)?"),
                                   ("density = 27", 2, "did you mean 2752 (27 kN/m3, a unit weight)?"),
                                   ("density = 27e3", 2, "did you mean 2752 (27000.0 N/m3, a unit weight)?")):
            old = modulus if "young" in given else density
            self.warned(ROCK.replace(old, given), f"m.toml:{line}:", words)
        bolt = "[[bolt]]\nforce_capacity = 150\ndisplacement_capacity = 0.02\ncollar = [10, 5, 5]\ndirection = [-1, 0, 0]\nlength = 3\n"
        self.warned(ROCK + bolt, "bolt[1].force_capacity: is 150 N: did you mean 150000 (150 kN)?")
        # Without weight a model may well have no units.
        self.assertEqual(self.warnings("gravity = [0, 0, 0]\n" + ROCK.replace("30e9", "1").replace("2700", "1").replace("angle = 30", "angle = 30\ncohesion = 1\nnormal_stiffness = 1")), [])

    def test_joints_and_bolts_in_other_units(self):
        def joint(keys):
            return ROCK.replace("friction_angle = 30", "friction_angle = 30\n" + keys)
        for keys, words in (("normal_stiffness = 5", "normal_stiffness: is 5 Pa/m: did you mean 5e9 (5 GPa/m)?"),
                            ("normal_stiffness = 5e9\nshear_stiffness = 2000", "shear_stiffness: is 2000 Pa/m: did you mean 2e9 (2000 MPa/m)?"),
                            ("cohesion = 20", "cohesion: is 20 Pa: did you mean 20000 (20 kPa)?"),
                            ("cohesion = 0.05", "cohesion: is 0.05 Pa: did you mean 50000 (0.05 MPa)?")):
            self.warned(joint(keys), "joint_material[1]." + words)
        self.warned(ROCK.replace("poisson_ratio = 0.25", "poisson_ratio = 0.25\nfriction_angle = 45\ncohesion = 12"),
                    "material[1].cohesion: is 12 Pa: did you mean 1.2e7 (12 MPa)?")
        self.assertEqual(self.warnings(joint("cohesion = 100\nnormal_stiffness = 1e6\nshear_stiffness = 1e6")), [])
        bolt = "[[bolt]]\nforce_capacity = 150e3\ndisplacement_capacity = {}\nbond_strength = {}\ncollar = [10, 5, 5]\n" \
            "direction = [-1, 0, 0]\nlength = 3\n"
        self.warned(ROCK + bolt.format(25, "200e3"), "bolt[1].displacement_capacity: is 25 m: did you mean 0.025 (25 mm)?")
        self.warned(ROCK + bolt.format(0.025, 200), "bolt[1].bond_strength: is 200 N/m: did you mean 2e5 (200 kN/m)?")
        self.assertEqual(self.warnings(ROCK + bolt.format(1, "1e3")), [])

    def test_tractions_in_kilopascals(self):
        traction = "[[traction]]\nwhere = {{face = 'rock.zmax'}}\n{}\n"
        for value in ("pressure = 250", "value = [0, 0, -250]", "pressure_table = [[0, 0], [1, -250]]"):
            self.warned(ROCK + traction.format(value), "traction[1]: is at most 250 Pa", "kPa?")
            self.assertEqual(self.warnings("gravity = [0, 0, 0]\n" + ROCK + traction.format(value)), [])
        for value in ("pressure = 0", "pressure = 1e3", "pressure_table = [[0, 0], [1, 250e3]]"):
            self.assertEqual(self.warnings(ROCK + traction.format(value)), [])

    def test_heads_far_above_the_rock(self):
        for load in ("[[water]]\nhead = {}\n", "[[traction]]\nwhere = {{face = 'rock.zmax'}}\nhead = {}\n"):
            self.warned(ROCK + JOINT + load.format(1200), "has a head of 1200 m; the solids reach from z = 0 to 30 m")
            self.assertEqual(self.warnings(ROCK + JOINT + load.format(1030)), [])

    def test_angles_in_radians(self):
        joint = "[[joint]]\ndip = {}\ndip_direction = {}\n" + POINT
        radians = ROCK.replace("friction_angle = 30", "friction_angle = 0.52")
        self.warned(radians + joint.format(1.047, 2.1), "joint[1].dip: is 1.047 deg", "radians?")
        for text in (radians, radians + joint.format(60, 2.1), radians + joint.format(1, 120)):
            self.warned(text, "joint_material[1].friction_angle: is 0.52 deg: did you mean 29.79 (0.52 rad)?")
        for text in (ROCK + joint.format(1, 2), ROCK + joint.format(1.047, 0), radians.replace("0.52", "0") + joint.format(0, 0), radians.replace("0.52", "1")):
            self.assertEqual(self.warnings(text), [])

    def test_angles_in_radians_beside_others_in_degrees(self):
        joint = "[[joint_set]]\nspacing = 9\ndip = {}\ndip_direction = {}\n"
        self.warned(ROCK + joint.format(60, 120) + joint.format(0.66, 3.05), "joint_set[2].dip: is 0.66 deg, and dip_direction 3.05 deg: did you mean radians?")
        table = "[[joint_table]]\nfile = 'map.csv'\nextents = 'through_going'\n"
        for rows, told in (("0.66,3.05,5,5,5\n1.2,1.05,5,5,5\n", True), ("0.66,3.05,5,5,5\n60,1.05,5,5,5\n", False), ("1,3,5,5,5\n", False)):
            self.write("map.csv", "Dip,DipDir,X,Y,Z\n" + rows)
            if told:
                self.warned(ROCK + table, "map.csv:1: joint_table[1].file: no dip is over 1.2 deg and no direction over 3.05 deg: did you mean radians?")
            else:
                self.assertEqual(self.warnings(ROCK + table), [])
        self.write("map.csv", "Dip (rad),DipDir (rad),X,Y,Z\n0.66,3.05,5,5,5\n")
        self.warned(ROCK + table, "Dip (rad), DipDir (rad) are converted, times 57.29578 deg")

    def test_gravity_that_points_up_or_acts_alone(self):
        self.warned("gravity = [0, 0, 9.81]\n" + ROCK, "m.toml:1:11: gravity: points up")
        still = "gravity = [0, 0, 0]\n" + ROCK + STATIC
        self.warned(still, "gravity: is zero and nothing else acts")
        self.assertEqual(self.warnings(still + "[[traction]]\nwhere = {face = 'rock.zmax'}\npressure = 1e5\n"), [])

    def test_excavated_rock_meets_nothing(self):
        pit = "[[excavation]]\nshape = 'box'\nmin = [-1, -1, {}]\nmax = [11, 21, 30]\n"
        dynamic = STATIC.replace("'static'", "'dynamic'\nsteps = 1")
        for analysis in (STATIC, dynamic, dynamic.replace("spacing = 5", "lattice = 'block'")):
            self.assertEqual(self.warnings(ROCK + analysis + pit.format(10), "run"), [])
            (self.folder / "m.vtkhdf").unlink()
        joint = "[[joint]]\ndip = 0\ndip_direction = 0\npoint = [5, 10, {}]\n"
        small = ROCK + STATIC.replace("'static'", "'quasi_static'\nsteps = 20\nkinematics = 'small'")
        self.assertEqual(self.warnings(small + pit.format(10) + joint.format(20), "run"), [])
        (self.folder / "m.vtkhdf").unlink()
        # The upper one falls: it is not in balance either.
        found = self.warnings(small + pit.format(20) + joint.format(10), "run")
        self.assertTrue(any("the 2 blocks move through each other" in warning for warning in found), found)

    def test_joints_beside_the_rock(self):
        dips = "dip = 0\ndip_direction = 0\n"
        self.warned(ROCK + "[[joint]]\n" + dips + "point = [0, 0, 31]\n", "m.toml:13:", "joint[1]: lies beside the rock and cuts nothing")
        self.warned(ROCK + "[[joint]]\n" + dips + "point = [15, 0, 15]\nradius = 4\n", "joint[1]: lies beside")
        self.assertEqual(self.warnings(ROCK + "[[joint]]\n" + dips + "point = [15, 0, 15]\nradius = 6\n"), [])
        joints = ROCK + "[[joint_set]]\n" + dips + "spacing = 10\norigin = [0, 0, 15]\n"
        self.assertEqual(self.warnings(joints), [])
        self.warned(joints + "count = 5\n", "joint_set[1]: 2 of 5 planes lie beside the rock", command="cut")
        self.warned(joints.replace("spacing = 10", "spacing = 100").replace("15", "50"), "joint_set[1]: has no plane that meets the rock")
        self.warned(joints.replace("[0, 0, 15]", "[90, 0, 15]") + "radius = 3\n", "all 3 discs lie beside the rock")
        self.write("discs.csv", "dip\tdip_direction\tx\ty\tz\tradius\n0\t0\t5\t5\t5\t1\n0\t0\t5\t5\t50\t1\n0\t0\t5\t5\t50\t\n")
        self.warned(ROCK + "[[joint_table]]\nfile = 'discs.csv'\n", "joint_table[1]: 2 of 3 joints lie beside the rock")
        self.write("fault.obj", TETRAHEDRON.replace("v ", "v 5000"))
        self.warned(ROCK + "[[joint_mesh]]\nfile = 'fault.obj'\n", "joint_mesh[1]: all 4 triangles lie beside the rock")

    def test_excavations_beside_the_rock(self):
        pit = "[[excavation]]\nname = 'pit'\nshape = 'box'\nmin = [{}, 9, 14]\nmax = [60, 11, 31]\n"
        self.warned(ROCK + pit.format(50), "excavation[1]: lies beside the rock and removes nothing")
        self.assertEqual(self.warnings(ROCK + pit.format(9)), [])

    def test_stress_that_pulls_and_earthquakes_in_per_cent(self):
        stress = ROCK + "[initial_stress]\nvalue = [[{0}, 0, 0], [0, {0}, 0], [0, 0, {0}]]\n"
        self.warned(stress.format("5e6"), "initial_stress.value: is tension in every direction: compression is negative")
        self.assertEqual(self.warnings(stress.format("-5e6")), [])
        self.warned(ROCK + "[support]\nseismic_coefficient = [10, 0, 0]\n", "support.seismic_coefficient: is 10 times g")
        self.warned(ROCK + "[support]\ntarget_factor_of_safety = 150\n", "support.target_factor_of_safety: is 150: it is a factor, 1.5 for 150 %")
        self.assertEqual(self.warnings(ROCK + "[support]\ntarget_factor_of_safety = 20\n"), [])

    def test_files_in_millimetres(self):
        faces = TETRAHEDRON.index("f ")
        self.write("body.obj", TETRAHEDRON[:faces].replace("4", "30000") + TETRAHEDRON[faces:])
        mesh = "[[solid]]\nname = 'body'\nshape = 'mesh'\nfile = 'body.obj'\n"
        self.warned(ROCK + mesh, "solid[2].file: is 5.2e+04 m large, the solids given by numbers 37.4 m: did you mean mm?")
        self.write("body.obj", TETRAHEDRON)
        self.assertEqual(self.warnings(ROCK + mesh), [])

    def test_map_coordinates_in_single_precision(self):
        points = [tuple(map(float, line.split()[1:])) for line in TETRAHEDRON.splitlines() if line[0] == "v"]
        faces = [tuple(map(int, line.split()[1:])) for line in TETRAHEDRON.splitlines() if line[0] == "f"]
        mesh = "[[solid]]\nname = 'body'\nshape = 'mesh'\nfile = 'body.stl'\n"
        for north, warned in ((5806917.0, True), (0.0, False)):
            facets = b"".join(struct.pack("<12fH", 0, 0, 0, *(x for v in face for x in (points[v - 1][0], points[v - 1][1] + north, points[v - 1][2])), 0)
                              for face in faces)
            (self.folder / "body.stl").write_bytes(b" " * 80 + struct.pack("<I", len(faces)) + facets)
            if warned:
                self.warned(mesh, "body.stl: solid[1].file: holds numbers of single precision, which are 0.5 m apart at y = 5806921")
            else:
                self.assertEqual(self.warnings(mesh), [])

    def test_ground_in_degrees(self):
        self.write("dem.asc", "ncols 2\nnrows 2\nxllcorner 7.9151\nyllcorner 46.6126\ncellsize 0.00028\n1700 1710\n1730 1777\n")
        ground = "[[solid]]\nshape = 'terrain'\nfile = 'dem.asc'\nbase = 1000\n"
        self.warned(ground, "dem.asc: solid[1].file: x and y look like degrees", "x 7.91524 to 7.91552", "777 m high", "UTM zone 32N")

    def test_loads_and_motions_that_do_nothing(self):
        load = "[[point_load]]\n" + POINT + "force = [0, 0, -{}]\n"
        heavy = ROCK.replace("[10, 20, 30]", "[100, 200, 300]")
        self.warned(heavy + load.format(5), "point_load[1]: is at most 5 N on rock that weighs giganewtons")
        self.assertEqual(self.warnings(heavy + load.format("5e3")), [])
        held = "[[fixed]]\nwhere = {face = 'rock.zmin'}\n"
        motion = ROCK + "[cover]\nspacing = 5\n[analysis]\ntype = 'dynamic'\n"
        self.warned(motion, "all rock falls freely")
        self.assertEqual(self.warnings(motion + held), [])
        # A P-wave crosses 5 m in 1.37 ms.
        self.warned(motion.replace("'dynamic'", "'dynamic'\ntime_step = 2\nend_time = 10") + held, "is 2 s, 1461 times the travel time")

    def test_gravity_put_on_at_once_where_blocks_come_apart(self):
        joint = "[[joint]]\ndip = 50\ndip_direction = 90\n" + POINT
        held = ROCK + joint + "[[fixed]]\nwhere = {face = 'rock.zmin'}\n[cover]\nlattice = 'block'\n"
        dynamic, slow = "[[step]]\ntype = 'dynamic'\nsteps = 2\n", "[[step]]\ntype = 'quasi_static'\nsteps = 2\n"
        line = held.count("\n") + 1
        for command in ("check", "run"):
            self.warned(held + "[analysis]\ntype = 'dynamic'\nsteps = 2\n", f"m.toml:{line}:1: analysis.type: ", "no equilibrium", "[[step]]", "quasi_static",
                        command=command)
            (self.folder / "m.vtkhdf").unlink(missing_ok=True)
        self.warned(held + dynamic, f"m.toml:{line}:1: step[1].type: ")
        stress = "[initial_stress]\nvalue = [[0, 0, 0], [0, 0, 0], [0, 0, -1e5]]\n"
        welded = held.replace("lattice = 'block'", "spacing = 5\njoints = 'welded'")
        for text in (held + slow + dynamic, held + dynamic + "dynamic_ratio = 0\n", held + stress + dynamic, welded + dynamic,
                     held.replace(joint, "") + dynamic):
            self.assertEqual(self.warnings(text), [])

    def test_records_that_do_not_lie_within_their_step(self):
        model = ROCK + "[cover]\nlattice = 'block'\n[[fixed]]\nwhere = {face = 'rock.zmin'}\n" \
            "[base_acceleration]\nfile = 'quake.csv'\nunit = 'g'\ndirection = [1, 0, 0]\nstep = 'shaking'\n" \
            "[[step]]\ntype = 'quasi_static'\nsteps = 10\ntime_step = 0.1\n[[step]]\nname = 'shaking'\ntype = 'dynamic'\ntime_step = 0.01\nend_time = 8\n"
        line = 1 + model[:model.index("[base_acceleration]")].count("\n")
        whole = ((0, 0), (4, 0.3), (8, 0))

        def record(rows):
            self.write("quake.csv", "time,acc\n" + "".join(f"{t},{a}\n" for t, a in rows))
            return model

        def shifted(shift, rows=whole):
            return record([(t + shift, a) for t, a in rows])

        self.assertEqual(self.warnings(record(whole)), [])
        self.assertRegex(self.run_program("check", "m.toml").stdout, r"(?m)^ +record +peak 0.3 g, 8 s, from t = 1 to 9 s$")
        place = f"m.toml:{line}:1: base_acceleration: "
        self.warned(shifted(20), place + 'lies beside step "shaking", which takes t = 1 to 9 s: it begins at t = 21 s',
                    "its first value, 0 g")
        self.warned(shifted(-4, whole[:2]), "it ends at t = 1 s, and all that acts there is its last value, 0.3 g")
        self.warned(record(whole[:2]), place + "ends at t = 5 s with 0.3 g, which goes on acting to the end of the analysis, t = 9 s")
        self.warned(shifted(2), "goes on to t = 11 s, and the analysis ends at t = 9 s: the last 2 s, up to 0.15 g, do not act")
        self.warned(shifted(-2, ((0, 0), (4, 0.3), (10, 0))), "begins 2 s before its step", "up to 0.15 g")
        self.warned(record(((2, 0.3), (8, 0))), "begins at t = 3 s with 0.3 g, which acts from the start of its step, t = 1 s, on")
        self.assertEqual(self.warnings(record(((0, 0), (4, 0.3), (8, 0.002)))), [])
        ramp = model.replace("file = 'quake.csv'", "table = [[0, 0], [1, 0.1]]")
        self.assertEqual(self.warnings(ramp), [], "goes up and stays there")
        self.warned(ramp.replace("[1, 0.1]", "[1, 0.1], [2, 0.05]"), "ends at t = 3 s with 0.05 g")

    def test_statics_that_only_contact_could_hold(self):
        joint = "[[joint]]\ndip = 50\ndip_direction = 90\n" + POINT
        self.warned(ROCK + STATIC + joint, "analysis.type", "welded", "quasi_static")
        self.assertEqual(self.warnings(ROCK + STATIC.replace("spacing = 5", "spacing = 5\njoints = 'welded'") + joint), [])

    def test_rock_that_goes_on_nowhere(self):
        joint = "[[joint]]\ndip = 50\ndip_direction = 90\n" + POINT
        free = ROCK.replace('continues = ["zmin"]\n', "") + joint
        self.warned(free, "solid[1].continues: no solid has any", command="support")
        self.assertEqual(self.warnings(ROCK + joint, "support"), [])
        self.assertEqual(self.warnings(free, "cut"), [])
        parted = ROCK.replace('continues = ["zmin"]\n', "") + "[[solid]]\nshape = 'box'\nmin = [0, 0, 30]\nmax = [5, 5, 35]\ninterface = 'joint_material1'\n"
        self.warned(parted, "solid[1].continues: no solid has any", command="support")


class Ends(ProgramTest):
    def test_joints_that_end_in_rock(self):
        disc = "[[joint]]\ndip = 0\ndip_direction = 0\n" + POINT
        self.write("m.toml", ROCK + disc + "polygon = [[1, 1, 15], [5, 1, 15], [5, 4, 15], [1, 4, 15]]\n")
        whole = "dead ends +12 m2, all of it: every joint ends inside a block"
        for command in ("cut", "support"):
            self.assertRegex(self.run_program(command, "m.toml").stdout, whole)
        self.write("m.toml", ROCK + disc + "polygon = [[-1, -1, 15], [5, -1, 15], [5, 21, 15], [-1, 21, 15]]\n" + disc.replace("15]", "20]"))
        self.assertRegex(self.run_program("cut", "m.toml").stdout, "dead ends +100 m2 of it, 33.3 %: joints that end inside a block")
        self.write("m.toml", ROCK + disc)
        self.assertNotIn("dead ends", self.run_program("cut", "m.toml").stdout)


class Help(ProgramTest):
    def test_is_a_command_too(self):
        self.assertEqual(self.run_program("help").stdout, self.run_program("--help").stdout)
        self.assertEqual(self.run_program("help", "cut").stdout, self.run_program("cut", "--help").stdout)


if __name__ == "__main__":
    unittest.main()
