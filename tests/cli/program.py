"""What the end-to-end tests share: running the program in a folder of its own."""
import json
import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

BINARY = os.environ["ROCKFOLD_BINARY"]
SOURCE = Path(os.environ["ROCKFOLD_SOURCE_DIR"])
CASES = SOURCE / "tests" / "cases"
SANITIZED = os.environ.get("ROCKFOLD_SANITIZE") == "1"  # ten times as slow: fewer models do

# A box of 2 m3 on rollers on three sides, pressed from above.
PRESSED = """
gravity = [0, 0, 0]
[[material]]
name = "sandstone"
density = 2400
young_modulus = 20e9
poisson_ratio = 0.25
cohesion = 3e6
friction_angle = 30
[[solid]]
name = "rock"
shape = "box"
min = [0, 0, 0]
max = [1, 1, 2]
[cover]
spacing = 0.7
[[fixed]]
where = {face = "rock.xmin"}
components = ["x"]
[[fixed]]
where = {face = "rock.ymin"}
components = ["y"]
[[fixed]]
where = {face = "rock.zmin"}
components = ["z"]
[[traction]]
where = {face = "rock.zmax"}
pressure = 10e6
[analysis]
type = "static"
[[monitor]]
point = [0.4, 0.3, 1.2]
"""


def files_of_case(name):
    """The files that an example model names, in the order of the model."""
    return re.findall(r'^ *file *= *"(.+?)"', (CASES / name / "model.toml").read_text(encoding="utf-8"), re.M)


class ProgramTest(unittest.TestCase):
    """Each test runs in a new, empty folder."""

    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="rockfold-"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)

    def run_program(self, *arguments, status=0, **settings):
        """Runs it, expects an exit status, returns the completed process with text outputs."""
        environment = dict(os.environ, OMP_PROC_BIND="false", **settings.pop("env", {}))
        done = subprocess.run([BINARY, *map(str, arguments)], cwd=self.folder, env=environment, text=True,
                              capture_output=True, timeout=settings.pop("timeout", 280), check=False, **settings)
        self.assertEqual(done.returncode, status, f"{arguments}\n{done.stdout}\n{done.stderr}")
        return done

    def json_of(self, *arguments, status=0, **settings):
        """The one document that stands on stdout with --json."""
        return json.loads(self.run_program(*arguments, "--json", status=status, **settings).stdout)

    def copy_case(self, name):
        """A copy of an example model and of the files that it names."""
        for file in files_of_case(name):
            shutil.copy(CASES / name / file, self.folder)
        text = (CASES / name / "model.toml").read_text(encoding="utf-8")
        return self.write(f"{name}.toml", text)

    def write(self, name, text):
        path = self.folder / name
        path.write_text(text, encoding="utf-8")
        return path

    def files(self):
        return sorted(path.name for path in self.folder.iterdir())
