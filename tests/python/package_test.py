"""The Python package: models, answers, results, errors, progress and sweeps of the program."""
import copy
import os
import pickle
import re
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(os.environ["ROCKFOLD_SOURCE_DIR"])
sys.path.insert(0, str(SOURCE / "python"))

import numpy as np  # noqa: E402

import rockfold  # noqa: E402

rockfold.use_program(os.environ["ROCKFOLD_BINARY"])

CUBE = {
    "title": "A cube cut in two",
    "material": [{"name": "rock", "density": 2700.0}],
    "joint_material": [{"name": "joint", "friction_angle": 30}],
    "solid": [{"name": "cube", "shape": "box", "min": [0, 0, 0], "max": [2, 2, 2], "continues": ["zmin"]}],
    "joint": [{"name": "level", "dip": 45, "dip_direction": 90, "point": np.array([1, 1, 1])}],
}


class PackageTest(unittest.TestCase):
    """Each test runs in a new, empty folder."""

    def setUp(self):
        self._folder = tempfile.TemporaryDirectory()
        self.folder = Path(self._folder.name)
        self.addCleanup(self._folder.cleanup)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(self.folder)


class ModelTest(PackageTest):
    def test_examples_are_the_same_from_their_file_and_as_dictionaries(self):
        for name in ("slope", "bench_on_terrain", "wedge", "random_arches"):
            with self.subTest(name):
                model = rockfold.example(name, self.folder / name)
                from_file = rockfold.cut(self.folder / name / f"{name}.toml", output=False)
                from_dictionary = rockfold.cut(model, output=False)
                for key in ("totals", "blocks", "title"):
                    self.assertEqual(from_file[key], from_dictionary[key])

    def test_changes_are_those_of_set(self):
        answer = rockfold.cut(CUBE, {"solid.cube.max": [2, 2, 4], "joint.level.dip": 0, "material.1.name": None}, output=False)
        self.assertEqual([block["volume"] for block in answer["blocks"]], [4, 12])

    def test_text_and_back(self):
        model = rockfold.Model(CUBE)
        self.assertEqual(rockfold.Model.parse(model.toml())["joint"][0]["point"], [1, 1, 1])
        other = model.copy()
        other["joint"][0]["dip"] = 10
        self.assertEqual(model["joint"][0]["dip"], 45)
        model.write("cube.toml")
        self.assertEqual(rockfold.check("cube.toml")["ok"], True)

    def test_files_lie_in_the_folder_of_the_model(self):
        (self.folder / "far").mkdir()
        (self.folder / "far" / "joints.csv").write_text("dip,dip_direction,x,y,z\n45,90,1,1,1\n", encoding="utf-8")
        model = {key: value for key, value in CUBE.items() if key != "joint"}
        model["joint_table"] = [{"file": "joints.csv"}]
        self.assertEqual(rockfold.cut(rockfold.Model(model, "far"), output=False)["totals"]["blocks"], 2)
        with self.assertRaises(rockfold.FileError):
            rockfold.cut(model)


class VersionTest(unittest.TestCase):
    def test_is_that_of_the_program(self):
        text = (SOURCE / "python" / "pyproject.toml").read_text(encoding="utf-8")
        self.assertRegex(rockfold.version(), "^rockfold " + re.search(r'^version = "(.+)"$', text, re.M).group(1) + " ")


class ErrorTest(PackageTest):
    def test_tells_all_that_is_wrong(self):
        with self.assertRaises(rockfold.ModelError) as caught:
            rockfold.support({**CUBE, "gravty": 3, "material": [{"density": -1}]})
        error = caught.exception
        self.assertEqual(sorted(fault.key for fault in error.faults), ["gravty", "material[1].density"])
        self.assertEqual((error.status, error.file, error.line > 0), (2, "<stdin>", True))
        self.assertIn("did you mean", str(error))

    def test_kinds(self):
        with self.assertRaises(rockfold.FileError):
            rockfold.check("none.toml")
        with self.assertRaises(rockfold.UsageError):
            rockfold.cut(CUBE, threads=0)
        with self.assertRaises(rockfold.FileError):
            rockfold.open_result(__file__)
        with self.assertRaises(rockfold.FileError):
            rockfold.verify("none.json")

    def test_a_program_that_is_not_there(self):
        rockfold.use_program("no-such-program")
        self.addCleanup(rockfold.use_program, os.environ["ROCKFOLD_BINARY"])
        with self.assertRaisesRegex(rockfold.FileError, "no-such-program"):
            rockfold.check(CUBE)


class AnswerTest(PackageTest):
    def test_lists_are_columns(self):
        answer = rockfold.support(CUBE, output=False)
        columns = answer.columns("keyblocks")
        self.assertEqual(columns["direction"].shape, (len(answer["keyblocks"]), 3))
        self.assertAlmostEqual(columns["factor_of_safety"][0], np.tan(np.radians(30)))
        self.assertEqual(columns["mode"].tolist(), ["single_plane"])
        with self.assertRaises(KeyError):
            answer.columns("totals")

    def test_tables_are_of_pandas(self):
        try:
            import pandas  # noqa: F401
        except ImportError:
            self.skipTest("no pandas")
        table = rockfold.support(CUBE, output=False).table("keyblocks")
        self.assertAlmostEqual(table["factor_of_safety"][0], np.tan(np.radians(30)))
        self.assertIn("mobilisation.force", table)

    def test_an_answer_alone_has_no_result(self):
        with self.assertRaises(AttributeError):
            _ = rockfold.cut(CUBE, output=False).result
        self.assertEqual(list(self.folder.iterdir()), [])


class LifetimeTest(PackageTest):
    def test_errors_and_answers_go_to_other_processes(self):
        with self.assertRaises(rockfold.ModelError) as caught:
            rockfold.check({**CUBE, "gravty": 3})
        again = pickle.loads(pickle.dumps(caught.exception))
        self.assertEqual((str(again), again.status), (str(caught.exception), 2))
        answer = rockfold.cut(CUBE, output="cube.vtkhdf")
        _ = answer.result
        self.assertEqual(len(pickle.loads(pickle.dumps(answer)).result.blocks), 2)

    def test_a_copy_keeps_the_result(self):
        answer = rockfold.cut(CUBE)
        other = copy.deepcopy(answer)
        del answer
        self.assertEqual(len(other.result.blocks), 2)
        copy.copy(other.result.blocks)

    def test_a_closed_result_is_opened_again(self):
        answer = rockfold.cut(CUBE)
        for _ in range(2):
            with answer.result as result:
                self.assertEqual(len(result.blocks), 2)

    def test_a_folder_that_is_gone(self):
        with self.assertRaises(rockfold.FileError):
            rockfold.check(rockfold.Model(CUBE, self.folder / "gone"))
        with self.assertRaises(rockfold.FileError):
            rockfold.cut(rockfold.Model(CUBE, self.folder / "gone"), progress=print)

    def test_models_keep_their_folder(self):
        model = rockfold.Model(CUBE, self.folder / "far")
        for other in (rockfold.Model(model), model | {"title": "other"}, model.copy()):
            self.assertEqual(other.folder, self.folder / "far")
        other = rockfold.Model(model)
        other["material"][0]["density"] = 1
        self.assertEqual(model["material"][0]["density"], 2700)

    def test_warnings_are_told(self):
        with self.assertWarns(rockfold.RockfoldWarning):
            rockfold.support({**CUBE, "gravity": [0, 0, 9.81]}, output=False)

    def test_without_key_blocks_columns_are_empty(self):
        answer = rockfold.support(CUBE, {"joint_material.joint.friction_angle": 60}, output=False)
        self.assertEqual(len(answer.columns("keyblocks")["factor_of_safety"]), 0)


class KeptLoadedTest(PackageTest):
    def test_answers_are_the_same(self):
        alone = rockfold.support(CUBE, output=False)
        with rockfold.kept_loaded():
            kept = [rockfold.support(CUBE, output=False) for _ in range(3)]
            with self.assertRaises(rockfold.ModelError):
                rockfold.check({**CUBE, "gravty": 3})
            self.assertEqual(len(rockfold.cut(CUBE).result.blocks), 2)
        for answer in kept:
            self.assertEqual({**answer, "seconds": 0}, {**alone, "seconds": 0})

    def test_files_lie_in_the_current_folder_of_each_question(self):
        rockfold.Model(CUBE).write("cube.toml")
        with rockfold.kept_loaded():
            self.assertTrue(rockfold.check("cube.toml")["ok"])
            (self.folder / "other").mkdir()
            os.chdir("other")
            with self.assertRaises(rockfold.FileError):
                rockfold.check("cube.toml")


class ResultTest(PackageTest):
    def test_blocks_as_arrays(self):
        answer = rockfold.cut(CUBE)
        blocks = answer.result.blocks
        self.assertEqual(len(blocks), 2)
        np.testing.assert_allclose(blocks.volume[:], [block["volume"] for block in answer["blocks"]])
        for b in range(2):
            corners = np.concatenate([face[0] for face in blocks.faces(b)])
            self.assertEqual({tuple(x) for x in corners}, {tuple(x) for x in blocks.vertices(b)})
        self.assertIn("volume", dir(blocks))
        with self.assertRaisesRegex(AttributeError, "face_area"):
            _ = blocks.nothing
        self.assertEqual(answer.result.interfaces.area[:].tolist(), [4 * np.sqrt(2)])

    def test_triangles_enclose_the_volume_of_each_block(self):
        result = rockfold.cut(rockfold.example("random_arches", self.folder)).result
        mesh = result.mesh()
        triangles, polygon = mesh.triangles()
        a, b, c = np.moveaxis(mesh.points[triangles], 1, 0)
        enclosed = np.bincount(mesh.fields["block"][polygon] - 1, np.einsum("ij,ij->i", a, np.cross(b, c)) / 6)
        np.testing.assert_allclose(enclosed, result.blocks.volume[:], rtol=1e-6)
        block = mesh.of_block(2)
        self.assertEqual(len(block), int(np.sum(mesh.fields["block"] == 2)))
        self.assertEqual(sorted(map(tuple, block.points)), sorted(map(tuple, np.unique(result.blocks.vertices(1), axis=0))))

    def test_motion(self):
        model = rockfold.example("falling_block", self.folder / "model")
        told = []
        answer = rockfold.run(model, output="fall.vtkhdf", progress=told.append)
        with answer.result as result:
            self.assertEqual(result.command, "run")
            self.assertEqual(result.times[0], 0)
            self.assertEqual(result.displacement(0).max(), 0)
            self.assertLess(result.displacement(-1)[:, 2].min(), -0.01)
            np.testing.assert_allclose(result.mesh(state=-1).points, result.mesh().points + result.displacement(-1))
            self.assertEqual(result.document["totals"]["steps"], answer["totals"]["steps"])
            np.testing.assert_allclose(result.energy.kinetic[-1], answer["energy"]["kinetic"])
            with self.assertRaises(IndexError):
                result.displacement(len(result.times))
        self.assertIn("Analysis", {progress.phase for progress in told})
        self.assertTrue(told[-1].ended)
        self.assertEqual(rockfold.view("fall.vtkhdf"), Path("fall.html"))
        self.assertTrue(rockfold.report("fall.vtkhdf").exists())

    def test_a_run_that_is_interrupted_goes_on(self):
        model = rockfold.example("slope", self.folder / "model")

        def stop(progress):
            if progress.phase == "Analysis" and progress.done > 3:
                raise InterruptedError

        with self.assertRaises(InterruptedError):
            rockfold.run(model, {"step.motion.end_time": 0.1}, output="slope.vtkhdf", progress=stop)
        answer = rockfold.resume("slope.vtkhdf")
        self.assertEqual(answer["totals"]["steps"], 30)
        self.assertEqual(len(answer.result.blocks), 100)

    def test_a_limit_leaves_what_there_is(self):
        with self.assertRaises(rockfold.AnalysisError) as caught:
            rockfold.run(rockfold.example("slope", self.folder / "model"), max_time=0.5)
        self.assertIn("totals", caught.exception.document)


class SurveyTest(PackageTest):
    def test_sets(self):
        """Six planes at 60 deg to a line to the east, 4 m apart along it."""
        rows = "".join(f"A,90,30,{4 * k}\n" for k in range(6))
        (self.folder / "survey.csv").write_text("set,dip,dip_direction,distance\n" + rows, encoding="utf-8")
        answer = rockfold.sets("survey.csv", scanline=(90, 0), output="sets.toml", picture="net.svg")
        columns = answer.columns("sets")
        np.testing.assert_allclose([columns["dip"][0], columns["dip_direction"][0]], [90, 30], atol=1e-9)
        self.assertAlmostEqual(answer["sets"][0]["spacing"]["normal"], 2)
        self.assertEqual(rockfold.Model.read("sets.toml")["joint_set"][0]["name"], "A")
        self.assertIn("<svg", (self.folder / "net.svg").read_text(encoding="utf-8"))
        self.assertEqual(rockfold.sets("survey.csv", count=1)["grouping"], "poles")
        with self.assertRaises(rockfold.UsageError):
            rockfold.sets("survey.csv", blind_zone=90)


class SweepTest(PackageTest):
    def test_table(self):
        plan = {"command": "support", "parameter": [{"key": "joint_material.joint.friction_angle", "values": [20, 30]}],
                "result": [{"name": "least", "path": "totals.least_factor_of_safety"}]}
        columns = rockfold.sweep(plan, "sweep", model=CUBE).columns()
        self.assertEqual(columns["run"].tolist(), [1, 2])
        np.testing.assert_allclose(columns["least"], np.tan(np.radians([20, 30])))
        self.assertEqual(columns["status"].tolist(), ["done", "done"])

    def test_proofs(self):
        answer = rockfold.stability(CUBE, certificate="proof.json", output=False)
        self.assertAlmostEqual(answer["stability"]["sliding"]["factor"], np.tan(np.radians(30)), places=3)
        self.assertTrue(rockfold.verify("proof.json")["holds"])


if __name__ == "__main__":
    unittest.main()
