"""The command line: help, options, errors, exit statuses, where results go."""
import json
import os
import stat
import subprocess
import unittest

from program import BINARY, CASES, SANITIZED, ProgramTest, files_of_case

COMMANDS = ["demo", "check", "cut", "support", "stability", "verify", "theory", "sets", "run", "info", "examples", "serve"]


class Help(ProgramTest):
    def test_of_the_program_names_every_command(self):
        text = self.run_program("--help").stdout
        for command in COMMANDS:
            self.assertRegex(text, rf"(?m)^  {command}\b")
        self.assertIn("Example:", text)

    def test_of_each_command_has_an_example_and_the_common_options(self):
        for command in COMMANDS:
            for arguments in ([command, "--help"], ["--help", command]):
                text = self.run_program(*arguments).stdout
                self.assertIn(f"Usage: rockfold {command}", text)
                self.assertIn(f"  rockfold {command}" if command != "examples" else "rockfold examples", text)
                for option in ("--json", "--quiet", "--threads", "--seed", "--set"):
                    self.assertIn(option, text)

    def test_lines_fit_on_100_columns(self):
        for arguments in [["--help"]] + [[command, "--help"] for command in COMMANDS]:
            for line in self.run_program(*arguments).stdout.splitlines():
                self.assertLessEqual(len(line), 100)

    def test_version(self):
        self.assertRegex(self.run_program("--version").stdout, r"^rockfold \d+\.\d+\.\d+ \(.+\)\n$")


class Log(ProgramTest):
    def test_holds_phases_warnings_and_errors(self):
        self.copy_case("wedge")
        for quiet in ((), ("--quiet",), ("--json",)):
            self.run_program("support", "wedge.toml", "--log", "wedge.log", *quiet)
            log = (self.folder / "wedge.log").read_text(encoding="utf-8")
            self.assertRegex(log, r"^log of rockfold \d+\.\d+\.\d+ \(.+\): support wedge.toml --log wedge.log")
            self.assertRegex(log, r"(?m)^Finding key blocks\b")
            self.assertTrue(log.endswith("exit status 0\n"))
        self.run_program("support", "wedge.toml", "--set", "gravity=[0, 0, 9.81]", "--log", "wedge.log")
        self.assertIn("\nwarning: ", (self.folder / "wedge.log").read_text(encoding="utf-8"))
        for json_or_not in ((), ("--json",)):
            self.run_program("check", "none.toml", "--log", "none.log", *json_or_not, status=3)
            self.assertRegex((self.folder / "none.log").read_text(encoding="utf-8"), "none.toml: cannot be read: .*\nexit status 3\n$")

    def test_replaces_nothing_else(self):
        text = self.copy_case("wedge").read_text(encoding="utf-8")
        said = self.run_program("support", "wedge.toml", "--log", "wedge.toml", status=2).stderr
        self.assertIn("wedge.toml: is there, and no log that could be replaced", said)
        self.assertEqual((self.folder / "wedge.toml").read_text(encoding="utf-8"), text)
        self.run_program("support", "wedge.toml", "--log", "wedge.vtkhdf", status=2)
        self.run_program("support", "wedge.toml", "--log", "none/wedge.log", status=3)


class StandardInput(ProgramTest):
    def test_is_a_model_as_from_a_file(self):
        path = self.copy_case("wedge")
        text = path.read_text(encoding="utf-8")
        for command in ("check", "cut", "support", "stability"):
            none = () if command == "check" else ("--no-result",)
            from_input = json.loads(self.run_program(command, "-", "--json", *none, input=text).stdout)
            from_file = json.loads(self.run_program(command, "wedge.toml", "--json", *none).stdout)
            for document in (from_input, from_file):
                document.pop("seconds", None)
            self.assertEqual(from_input, from_file)

    def test_names_no_result(self):
        text = self.copy_case("wedge").read_text(encoding="utf-8")
        self.assertIn("say with -o where its result goes", self.run_program("cut", "-", input=text, status=2).stderr)
        self.run_program("cut", "-", "-o", "other.vtkhdf", input=text)
        self.assertTrue((self.folder / "other.vtkhdf").exists())

    def test_errors_name_it(self):
        self.assertIn("<stdin>:1:1: gravty: unknown key", self.run_program("check", "-", input="gravty = 3\n", status=2).stderr)


class ProgressOnADescriptor(ProgramTest):
    def test_tells_begin_and_end_of_each_phase(self):
        self.copy_case("wedge")
        reads, writes = os.pipe()
        self.run_program("support", "wedge.toml", "--quiet", "--progress-fd", writes, pass_fds=[writes])
        os.close(writes)
        with open(reads, encoding="utf-8") as lines:
            told = [json.loads(line) for line in lines]
        self.assertEqual([line["phase"] for line in told if line["ended"]][:3], ["Cutting", "Joining blocks", "Finding key blocks"])
        self.assertEqual((told[0]["done"], told[0]["total"], told[0]["ended"]), (0, None, False))

    def test_needs_one_that_is_open(self):
        self.copy_case("wedge")
        self.assertIn("file descriptor 77 is not open", self.run_program("check", "wedge.toml", "--progress-fd", "77", status=2).stderr)


class Serve(ProgramTest):
    def replies(self, *requests):
        """Exit status and output of each."""
        lines = "".join((request if isinstance(request, str) else json.dumps(request)) + "\n" for request in requests)
        said = self.run_program("serve", input=lines).stdout.encode()
        replies = []
        while said:
            header, _, said = said.partition(b"\n")
            bytes_of = json.loads(header)["bytes"]
            replies.append((json.loads(header)["status"], said[:bytes_of].decode()))
            said = said[bytes_of:]
        return replies

    def test_answers_one_after_another_as_the_command_line_does(self):
        text = self.copy_case("wedge").read_text(encoding="utf-8")
        (self.folder / "other").mkdir()
        replies = self.replies({"arguments": ["cut", "wedge.toml", "--no-result", "--json"]},
                               {"arguments": ["support", "-", "--no-result", "--json"], "input": text, "folder": "other"},
                               {"arguments": ["check", "none.toml", "--json"]},
                               {"arguments": ["--version"]})
        self.assertEqual([status for status, _ in replies], [0, 0, 3, 0])
        for (_, output), command in zip(replies, ("cut", "support")):
            mine = json.loads(output)
            alone = self.json_of(command, "wedge.toml", "--no-result")
            mine.pop("seconds"), alone.pop("seconds")
            self.assertEqual(mine, alone)
        self.assertEqual(json.loads(replies[2][1])["error"]["file"], "none.toml")
        self.assertEqual(replies[3][1], self.run_program("--version").stdout)

    def test_what_is_no_request_hurts_no_other(self):
        replies = self.replies("nonsense", {"arguments": "check"}, {"arguments": ["--version"], "folder": "nowhere"}, {"arguments": ["--version"]})
        self.assertEqual([status for status, _ in replies], [2, 2, 3, 0])


class UsageErrors(ProgramTest):
    CASES = [
        ([], "no command given"),
        (["ctu", "m.toml"], 'did you mean "cut"?'),
        (["picture", "m.vtkhdf"], "the commands are: demo, check, cut, support, stability, verify, theory, sets, run, resume, sweep, view, report, info, examples, serve"),
        (["cut"], "no file given: rockfold cut MODEL.toml"),
        (["cut", "m.toml", "--jsno"], 'unknown option \'--jsno\', did you mean "--json"?'),
        (["cut", "m.toml", "n.toml"], "unexpected argument 'n.toml'"),
        (["cut", "m.toml", "check"], "two commands given"),
        (["cut", "m.toml", "-o", "a.vtkhdf", "-o", "b.vtkhdf"], "--output is given twice"),
        (["cut", "m.toml", "--threads", "2", "--threads", "3"], "--threads is given twice"),
        (["--threads", "2", "cut", "m.toml", "--threads", "3"], "--threads is given twice"),
        (["--seed", "2", "cut", "m.toml", "--seed", "3"], "--seed is given twice"),
        (["help", "cutt"], "did you mean \"cut\"?"),
        (["cut", "m.toml", "-o"], "needs a value"),
        (["check", "m.toml", "-o", "x"], "unknown option '-o'"),
        (["cut", "m.toml", "--threads", "0"], "'0' is no whole number from 1 to 4096"),
        (["cut", "m.toml", "--threads", "two"], "'two' is no whole number"),
        (["cut", "m.toml", "--seed", "-1"], "'-1' is no whole number"),
        (["examples", "cub"], 'did you mean "cube"?'),
    ]

    def test_have_status_2_and_say_what_is_right(self):
        for arguments, message in self.CASES:
            with self.subTest(arguments=arguments):
                done = self.run_program(*arguments, status=2)
                self.assertEqual(done.stdout, "")
                self.assertIn(message, done.stderr)

    def test_are_documents_with_json(self):
        for arguments, message in self.CASES[1:]:
            with self.subTest(arguments=arguments):
                done = self.run_program("--json", *arguments, status=2)
                document = json.loads(done.stdout)
                self.assertEqual(document["schema"], "rockfold/1")
                self.assertEqual(document["error"]["kind"], "usage")
                self.assertIn(message, document["error"]["message"])
                self.assertEqual(sorted(document["error"]), ["column", "file", "key", "kind", "line", "message"])


class ModelErrors(ProgramTest):
    MODEL = 'title = "wrong"\n[[solid]]\nname = "rock"\nshape = "box"\nmin = [0, 0, 0]\nmax = [1, 1, 1]\n' \
            '[[joint_set]]\nname = "J"\ndip = 95\ndip_direction = 0\nspaceing = 1\n'

    def test_are_told_all_at_once_with_their_places(self):
        self.write("wrong.toml", self.MODEL)
        lines = self.run_program("check", "wrong.toml", status=2).stderr.splitlines()
        self.assertRegex(lines[0], r"^wrong\.toml:\d+:\d+: joint_set\[1\]\S*: .")
        self.assertEqual(lines[-1], f"{len(lines) - 1} errors")
        self.assertGreaterEqual(len(lines), 3)

    def test_with_json_the_first_stands_in_the_error_and_all_in_its_list(self):
        self.write("wrong.toml", self.MODEL)
        error = self.json_of("cut", "wrong.toml", status=2)["error"]
        self.assertEqual(error["kind"], "model")
        self.assertEqual(error["file"], "wrong.toml")
        self.assertGreater(error["line"], 0)
        self.assertGreater(error["column"], 0)
        self.assertTrue(error["key"].startswith("joint_set[1]"))
        self.assertEqual({key: error[key] for key in error["errors"][0]}, error["errors"][0])
        self.assertGreaterEqual(len(error["errors"]), 2)

    def test_a_point_outside_the_rock_is_named(self):
        self.copy_case("free_fall")
        done = self.run_program("run", "free_fall.toml", "--set", "monitor.1.point=[5, 5, 5]", status=2)
        self.assertIn("monitor[1].point: (5, 5, 5) of monitor centre is not in the rock", done.stderr)

    def test_of_shapes_and_joints_are_found_by_check_as_by_cut(self):
        rock = "[[solid]]\nname = 'rock'\nshape = 'box'\nmin = [0, 0, 0]\nmax = [10, 10, 10]\n"
        planes = "[[joint_set]]\nnormal = [%s]\nspacing = 0.01\n"
        for text, message in {
                "[[joint]]\ndip = 0\ndip_direction = 0\npoint = [5, 5, 5]\nradius = 1e-12\n": "joint[1].radius: a disc of",
                "[[merge]]\npoints = [[1, 1, 1], [100, 1, 1]]\n": "merge[1].points: (100, 1, 1) is not in the rock",
                rock.replace("'rock'", "'hole'\noperation = 'subtract'"): "leave no rock",
                "".join(planes % normal for normal in ("1, 0, 0", "0, 1, 0", "0, 0, 1")):
                    "cut.max_cells: the model makes about 1e+09 cells",
                "[[joint_set]]\ndip = 9\ndip_direction = 9\nradius = 1\n[joint_set.random]\np32 = 1e9\n": "random.p32: asks for about",
        }.items():
            self.write("wrong.toml", rock + text)
            for command in ("check", "cut"):
                error = self.run_program(command, "wrong.toml", status=2).stderr
                self.assertRegex(error, r"^wrong\.toml:6:1: ")
                self.assertIn(message, error)

    def test_of_more_elements_than_allowed_are_found_by_check(self):
        """1000 m3 in cells of 1 m3, each of six tetrahedra; what stages remove makes none."""
        rock = ("[[solid]]\nname = 'rock'\nshape = 'box'\nmin = [0, 0, 0]\nmax = [10, 10, 10]\n"
                "[cover]\nspacing = 1\nmax_elements = 1000\n")
        self.write("many.toml", rock)
        self.assertRegex(self.run_program("check", "many.toml", status=2).stderr,
                         r"^many.toml:6:1: cover.spacing: makes at least [56]\d\d\d elements, must make cover.max_elements = 1000 or fewer")
        self.write("many.toml", rock + "[[excavation]]\nname = 'most'\nshape = 'box'\nmin = [0, 0, 1]\nmax = [10, 10, 10]\n")
        self.run_program("check", "many.toml")

    def test_a_missing_model_has_status_3(self):
        self.assertIn("missing.toml", self.run_program("check", "missing.toml", status=3).stderr)
        self.assertEqual(self.json_of("run", "missing.toml", status=3)["error"]["kind"], "io")

    def test_a_missing_file_of_a_right_model_has_status_3(self):
        text = (CASES / "cube" / "model.toml").read_text(encoding="utf-8")
        self.write("files.toml", text + "\n[[joint_mesh]]\nfile = \"no.stl\"\n")
        for command in ("check", "cut"):
            self.assertRegex(self.run_program(command, "files.toml", status=3).stderr,
                             r"^files.toml:\d+:8: joint_mesh\[1\].file: there is no file")
        self.write("files.toml", text + "\n[[joint_mesh]]\nfile = \"no.stl\"\nfiel = 1\n")
        self.assertIn("2 errors", self.run_program("check", "files.toml", status=2).stderr)


class Outputs(ProgramTest):
    def test_go_beside_the_model_by_default(self):
        (self.folder / "models").mkdir()
        self.copy_case("wedge").rename(self.folder / "models" / "wedge.toml")
        self.run_program("cut", "models/wedge.toml")
        self.assertTrue((self.folder / "models" / "wedge.vtkhdf").is_file())
        self.assertEqual(self.files(), ["models"])

    def test_replace_an_older_result_and_leave_nothing_else(self):
        self.copy_case("wedge")
        self.write("out.vtkhdf", "older")
        self.run_program("cut", "wedge.toml", "-o", "out.vtkhdf")
        self.run_program("info", "out.vtkhdf")
        self.assertFalse([name for name in self.files() if "partial" in name])

    def test_that_cannot_be_written_have_status_3(self):
        self.copy_case("wedge")
        (self.folder / "folder").mkdir()
        self.assertIn("no folder 'nowhere'", self.run_program("cut", "wedge.toml", "-o", "nowhere/x.vtkhdf", status=3).stderr)
        self.assertIn("is a folder", self.run_program("cut", "wedge.toml", "-o", "folder", status=3).stderr)
        self.assertEqual(self.json_of("cut", "wedge.toml", "-o", "nowhere/x.vtkhdf", status=3)["error"]["kind"], "io")

    @unittest.skipIf(os.geteuid() == 0, "root may write everywhere")
    def test_in_a_closed_folder_have_status_3(self):
        self.copy_case("wedge")
        (self.folder / "closed").mkdir(mode=0o500)
        self.run_program("cut", "wedge.toml", "-o", "closed/x.vtkhdf", status=3)

    def test_never_overwrite_the_model(self):
        path = self.copy_case("wedge")
        before = path.read_text(encoding="utf-8")
        self.assertIn("overwrite the model", self.run_program("cut", "wedge.toml", "-o", "./wedge.toml", status=2).stderr)
        self.assertEqual(path.read_text(encoding="utf-8"), before)
        path = path.rename(self.folder / "wedge.xdmf")
        message = self.run_program("cut", "wedge.xdmf", status=2).stderr
        self.assertIn("the .xdmf file that goes with the result would overwrite the model", message)
        self.assertEqual(path.read_text(encoding="utf-8"), before)

    MODEL_WITH_FILES = """
[[solid]]
name = "rock"
shape = "mesh"
file = "rock.obj"
[[solid]]
name = "ground"
operation = "subtract"
shape = "terrain"
file = "ground.xyz"
base = -1
[[joint_mesh]]
name = "fault"
file = "fault.obj"
[[joint_table]]
name = "discs"
file = "discs.csv"
"""
    FILES = {
        "rock.obj": "v 0 0 0\nv 4 0 0\nv 0 4 0\nv 0 0 4\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n",
        "ground.xyz": "9 9 0\n10 9 0\n10 10 0\n9 10 0\n",
        "fault.obj": "v 1 1 0\nv 2 1 0\nv 1 1 1\nf 1 2 3\n",
        "discs.csv": "dip,dip_direction,x,y,z,radius\n30,90,1,1,1,0.5\n",
    }

    def test_never_overwrite_a_file_that_the_model_reads(self):
        (self.folder / "in").mkdir()
        self.write("in/m.toml", self.MODEL_WITH_FILES)
        for name, text in self.FILES.items():
            self.write(f"in/{name}", text)
        (self.folder / "symbolic.obj").symlink_to("in/rock.obj")
        os.link(self.folder / "in" / "fault.obj", self.folder / "hard.obj")
        os.link(self.folder / "in" / "discs.csv", self.folder / "in" / "m.xdmf")
        (self.folder / "beside").symlink_to("in")
        model = "in/m.toml"
        for name, arguments in {
                "in/rock.obj": ["--export", "in/rock.obj", "-o", "a.vtkhdf"], "in/ground.xyz": ["-o", "in/../beside/ground.xyz"],
                "in/fault.obj": ["--export", "hard.obj", "-o", "a.vtkhdf"], "in/discs.csv": ["-o", "in/discs.csv"],
        }.items():
            message = self.run_program("cut", model, *arguments, status=2).stderr
            self.assertIn(f"would overwrite '{name}', which the model reads", message)
        self.assertIn("overwrite 'in/rock.obj'",
                      self.run_program("cut", model, "-o", "a.vtkhdf", "--export", "symbolic.obj", status=2).stderr)
        self.assertIn("the .xdmf file that goes with the result would overwrite 'in/discs.csv'",
                      self.run_program("cut", model, status=2).stderr)
        for name, text in self.FILES.items():
            self.assertEqual((self.folder / "in" / name).read_text(encoding="utf-8"), text)
        (self.folder / "in" / "m.xdmf").unlink()
        self.run_program("cut", model, "--export", "blocks.obj")

    def test_never_overwrite_each_other(self):
        self.copy_case("wedge")
        message = self.run_program("cut", "wedge.toml", "-o", "a.xdmf", status=2).stderr
        self.assertIn("a.xdmf: the .xdmf file that goes with the result would overwrite the result", message)
        self.assertIn("ends in .vtkhdf", message)
        self.assertEqual(self.files(), ["wedge.toml"])

    def test_that_the_model_names_are_plain_names(self):
        """A model from elsewhere writes beside the result and nowhere else."""
        (self.folder / "in").mkdir()
        text = (CASES / "wedge" / "model.toml").read_text(encoding="utf-8")
        for name in ("../evil.svg", str(self.folder / "evil.svg"), "in/evil.svg", "..\\evil.svg"):
            self.write("in/m.toml", text + f"[[drawing]]\noutput = '{name}'\nkind = 'stereonet'\n")
            for command in ("check", "support"):
                error = self.json_of(command, "in/m.toml", status=2)["error"]
                self.assertEqual((error["kind"], error["key"], error["line"]),
                                 ("model", "drawing[1].output", text.count("\n") + 2), error)
                self.assertIn("must be a plain name", error["message"])
        self.assertEqual(self.files(), ["in"])
        self.assertEqual(os.listdir(self.folder / "in"), ["m.toml"])

    def test_that_the_model_names_never_overwrite_what_it_reads_or_another(self):
        text = "[[material]]\ndensity = 2700\n[[joint_material]]\nfriction_angle = 30\n" + self.MODEL_WITH_FILES
        for name, content in self.FILES.items():
            self.write(name, content)
        key_blocks = "[[table]]\noutput = '{}'\nkind = 'keyblocks'\n"
        for tables, key, words in ((("discs.csv",), "table[1].output", "would overwrite 'discs.csv', which the model reads"),
                                   (("a.csv", "a.csv"), "table[2].output", "two files of one name")):
            self.write("m.toml", text + "".join(key_blocks.format(name) for name in tables))
            for command in ("check", "support"):
                error = self.json_of(command, "m.toml", status=2)["error"]
                self.assertEqual((error["kind"], error["file"], error["key"]), ("model", "m.toml", key), error)
                self.assertGreater(error["line"], text.count("\n"))
                self.assertIn(words, error["message"])
                self.assertIn("a name of its own", error["message"])
        self.assertEqual((self.folder / "discs.csv").read_text(encoding="utf-8"), self.FILES["discs.csv"])
        (self.folder / "out").mkdir()  # beside another result the name is free
        self.write("m.toml", text + key_blocks.format("discs.csv"))
        self.run_program("support", "m.toml", "-o", "out/m.vtkhdf")

    def test_quiet_prints_nothing(self):
        self.copy_case("wedge")
        done = self.run_program("support", "wedge.toml", "--quiet")
        self.assertEqual((done.stdout, done.stderr), ("", ""))

    def test_never_replaces_what_is_no_regular_file(self):
        self.copy_case("wedge")
        os.mkfifo(os.path.join(self.folder, "pipe"))
        done = self.run_program("cut", "wedge.toml", "-o", "pipe", status=3)
        self.assertIn("no regular file", done.stderr)
        self.assertTrue(stat.S_ISFIFO(os.stat(os.path.join(self.folder, "pipe")).st_mode))

    def test_an_error_leaves_no_result(self):
        self.copy_case("free_fall")
        self.run_program("run", "free_fall.toml", "--set", "monitor.1.point=[5, 5, 5]", status=2)
        self.assertEqual(self.files(), ["free_fall.toml"])

    @unittest.skipUnless(os.path.exists("/dev/full"), "needs /dev/full")
    def test_on_a_full_stdout_have_status_3(self):
        self.copy_case("wedge")
        with open("/dev/full", "w", encoding="utf-8") as full:
            done = subprocess.run([BINARY, "cut", "wedge.toml", "--json"], cwd=self.folder, stdout=full,
                                  stderr=subprocess.PIPE, text=True, check=False)
        self.assertEqual(done.returncode, 3)
        self.assertIn("standard output: No space left on device", done.stderr)


class Examples(ProgramTest):
    def names(self):
        return sorted(path.parent.name for path in CASES.glob("*/model.toml"))

    def test_are_listed_with_what_they_show(self):
        listed = self.json_of("examples")["examples"]
        self.assertEqual([example["name"] for example in listed], self.names())
        text = self.run_program("examples").stdout
        for example in listed:
            self.assertIn(example["summary"], text)

    def test_are_written_as_they_are_and_right(self):
        for name in self.names()[::12 if SANITIZED else 1]:
            self.run_program("examples", name)
            self.assertEqual((self.folder / f"{name}.toml").read_bytes(), (CASES / name / "model.toml").read_bytes())
            for file in files_of_case(name):
                self.assertEqual((self.folder / file).read_bytes(), (CASES / name / file).read_bytes())
            self.run_program("check", f"{name}.toml")

    def test_tell_all_files_that_they_write(self):
        document = self.json_of("examples", "great_wall")
        self.assertEqual(document["written"], "great_wall.toml")
        self.assertEqual(document["files"], ["great_wall.toml", "great_wall_ground.asc", "great_wall_rock.asc"])
        self.assertEqual(self.files(), sorted(document["files"]))
        for file in self.files():
            (self.folder / file).unlink()
        self.assertIn("with it: great_wall_ground.asc, great_wall_rock.asc",
                      self.run_program("examples", "great_wall").stdout)

    def test_are_written_whole_or_not_at_all(self):
        self.write("great_wall_rock.asc", "mine")
        message = self.run_program("examples", "great_wall", status=3).stderr
        self.assertIn("great_wall_rock.asc", message)
        self.assertIn("is there already", message)
        self.assertEqual(self.files(), ["great_wall_rock.asc"])
        self.assertEqual((self.folder / "great_wall_rock.asc").read_text(encoding="utf-8"), "mine")

    def test_leave_a_file_of_that_name_alone(self):
        self.write("cube.toml", "mine")
        self.assertIn("is there already", self.run_program("examples", "cube", status=3).stderr)
        self.assertEqual((self.folder / "cube.toml").read_text(encoding="utf-8"), "mine")


class Info(ProgramTest):
    def test_tells_what_made_the_file_and_what_it_holds(self):
        self.copy_case("wedge")
        self.run_program("support", "wedge.toml")
        self.assertIn("blocks                 4", self.run_program("info", "wedge.vtkhdf").stdout)
        document = self.json_of("info", "wedge.vtkhdf")
        self.assertEqual(document["made_by"]["command"], "support")
        self.assertEqual(document["totals"]["blocks"], 4)
        self.assertTrue(document["block_theory"])
        self.assertEqual(document["model"], (CASES / "wedge" / "model.toml").read_text(encoding="utf-8"))

    def test_of_another_file_has_status_3(self):
        self.write("text.vtkhdf", "no result")
        self.run_program("info", "text.vtkhdf", status=3)
        self.run_program("info", "missing.vtkhdf", status=3)


if __name__ == "__main__":
    unittest.main()
