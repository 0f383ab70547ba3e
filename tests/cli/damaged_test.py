"""Result files whose numbers make no sense: they are told, or passed over, and never crash."""
import os
import random
import shutil
import subprocess
import unittest

import h5py
import numpy

from program import BINARY, SANITIZED, ProgramTest

DAMAGES = int(os.environ.get("ROCKFOLD_DAMAGES", "12" if SANITIZED else "40"))
FIRST_SEED = int(os.environ.get("ROCKFOLD_FIRST_SEED", "1"))

# Two blocks on covers of a lattice, with a key block, a bolt, a monitor and contact points.
CUBES = """
[[material]]
density = 2500
young_modulus = 1e9
poisson_ratio = 0.25
cohesion = 1e6
friction_angle = 30
[[joint_material]]
name = "plane"
friction_angle = 20
[[solid]]
name = "base"
shape = "box"
min = [-2, -2, -1]
max = [9, 2, 0]
[[solid]]
name = "cube"
shape = "box"
min = [-0.5, -0.5, 0]
max = [0.5, 0.5, 1]
interface = "plane"
[[bolt]]
collar = [0, 0, 1]
direction = [0, 0, -1]
length = 1.8
force_capacity = 1e5
displacement_capacity = 0.1
[cover]
lattice = "hex8"
spacing = 2
[[fixed]]
where = {block_at = [0, 0, -0.5]}
[[monitor]]
point = [0, 0, 0.5]
[analysis]
type = "dynamic"
time_step = 0.01
steps = 4
[output]
every = 2
"""

NUMBERS = [-1, 0, 1, 7, 255, 1000, 2**31 - 1, -(2**31), 1e308, float("nan"), float("inf")]


def change_numbers(file, name, draw):
    data = file[name]
    if data.dtype.kind not in "iuf" or data.size == 0:
        return None
    values = numpy.atleast_1d(data[()])
    flat = values.reshape(-1)
    at = [draw.randrange(flat.size) for _ in range(draw.choice([1, 1, 5]))]
    for i in at:
        with numpy.errstate(all="ignore"):
            flat[i] = numpy.array(draw.choice([*NUMBERS, flat[draw.randrange(flat.size)]])).astype(flat.dtype)
    data[...] = values.reshape(data.shape)
    return f"{name}{at}"


def change_length(file, name, draw):
    data = file[name]
    if data.shape == () or data.size == 0:
        return None
    rows = max(0, data.shape[0] + draw.choice([-5, -1, 1, 3, -data.shape[0]]))
    values = numpy.resize(data[()], (rows, *data.shape[1:]))
    del file[name]
    file[name] = values
    return f"{name} of {rows} rows"


def leave_out(file, name, _):
    del file[name]
    return f"no {name}"


def change_attribute(file, name, draw):
    owner = file[name.rsplit("/", 1)[0]]
    if len(owner.attrs) == 0:
        return None
    key = draw.choice(sorted(owner.attrs))
    owner.attrs[key] = draw.choice(NUMBERS)
    return f"{owner.name}.{key}"


class DamagedResults(ProgramTest):
    def test_are_told_or_passed_over(self):
        self.write("cubes.toml", CUBES)
        self.run_program("run", "cubes.toml", "-q", "-o", "whole.vtkhdf")
        names = []
        with h5py.File(self.folder / "whole.vtkhdf") as file:
            file.visititems(lambda name, item: names.append(name) if isinstance(item, h5py.Dataset) and not name.startswith("xdmf") else None)
        for seed in range(FIRST_SEED, FIRST_SEED + DAMAGES):
            draw = random.Random(seed)
            shutil.copy(self.folder / "whole.vtkhdf", self.folder / "damaged.vtkhdf")
            with h5py.File(self.folder / "damaged.vtkhdf", "r+") as file:
                change = draw.choice([change_numbers, change_numbers, change_length, leave_out, change_attribute])
                what = change(file, draw.choice(names), draw)
            for command in (["info"], ["view", "-q"], ["report", "-q"]):
                done = subprocess.run([BINARY, *command, "damaged.vtkhdf"], cwd=self.folder, capture_output=True, text=True, errors="replace",
                                      timeout=120, check=False)
                self.assertIn(done.returncode, (0, 3), f"seed {seed}, {command[0]}: {what}\n{done.stderr}")
                if done.returncode == 3:
                    self.assertIn("damaged.vtkhdf: ", done.stderr, what)

    def test_are_told_where_indices_point_nowhere(self):
        self.write("cubes.toml", CUBES)
        self.run_program("run", "cubes.toml", "-q", "-o", "whole.vtkhdf")
        for name in ("VTKHDF/Blocks/Polygons/Offsets", "VTKHDF/Blocks/Polygons/Connectivity", "VTKHDF/Elements/Connectivity",
                     "rockfold/blocks/corner_vertex", "rockfold/blocks/face_origin"):
            for index in (-5, 2**31 - 1):
                with self.subTest(name=name, index=index):
                    shutil.copy(self.folder / "whole.vtkhdf", self.folder / "damaged.vtkhdf")
                    with h5py.File(self.folder / "damaged.vtkhdf", "r+") as file:
                        file[name][3] = index
                    self.assertIn("is damaged", self.run_program("view", "damaged.vtkhdf", status=3).stderr)


if __name__ == "__main__":
    unittest.main()
