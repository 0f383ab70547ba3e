"""Mistakes that people make, and what the program says to them."""
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

    def test_a_part_of_a_key(self):
        self.said(ROCK + "[[joint_set]]\ndip = 60\ndip_direction = 90\n[joint_set.random]\nspacing = 2\nkappa = 20\n",
                  'unknown key "kappa", did you mean "fisher_kappa"?')

    def test_files_that_are_no_text(self):
        for kind, words in ((ROCK.encode("utf-16"), "text in UTF-16"), (ROCK.encode("utf-16-le"), "text in UTF-16"),
                            (ROCK.encode("utf-16-be"), "text in UTF-16"), (b"\x89HDF\r\n\x1a\n\0\0", "rockfold info"),
                            (b"PK\x03\x04\x14\0", "ZIP archive"), (b"solid \0\0\1\2\3", "is binary")):
            self.said(kind, words, "must be a model, TOML text in UTF-8")

    def test_more_columns_than_posts_have(self):
        self.write("ground.xyz", "0 0 5 255\n9 0 5 255\n9 8 5 7\n0 8 7 8\n")
        self.write("m.toml", "[[solid]]\nname = 'ground'\nshape = 'terrain'\nfile = 'ground.xyz'\nbase = -3\n")
        document = self.json_of("check", "m.toml")
        self.assertEqual(len(document["warnings"]), 1)
        self.assertIn("ground.xyz:1:7: solid[1].file: 1 column behind x, y and z is passed over", document["warnings"][0])


class Help(ProgramTest):
    def test_is_a_command_too(self):
        self.assertEqual(self.run_program("help").stdout, self.run_program("--help").stdout)
        self.assertEqual(self.run_program("help", "cut").stdout, self.run_program("cut", "--help").stdout)


if __name__ == "__main__":
    unittest.main()
