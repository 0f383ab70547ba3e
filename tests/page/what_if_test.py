"""The sliders of the page answer as `rockfold support --set …` does, at 20 random settings of each model."""
import json
import os
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from web_packages import BINARY, SOURCE, WEB, node_output, packages, skip

TOLERANCE = 1e-12  # relative: the same operations in the same order, but for the last digit of a tangent
SETTINGS = 3 if os.environ.get("ROCKFOLD_SANITIZE") == "1" else 20

WET_BENCH = """
title = "Wedge below a water table, with a small load"
[[material]]
name = "granite"
density = 2700.0
[[joint_material]]
name = "clean"
friction_angle = 33.0
cohesion = 4e3
[[joint_material]]
name = "filled"
friction_angle = 18.0
[[solid]]
name = "rock"
shape = "box"
min = [-10, -5, 0]
max = [10, 15, 10]
material = "granite"
continues = ["xmin", "xmax", "ymin", "ymax", "zmin"]
[[solid]]
name = "face"
operation = "subtract"
shape = "halfspaces"
planes = [{dip = 65.0, dip_direction = 180.0, point = [0, 0, 10], keep = "above"}]
[[joint_set]]
name = "east"
dip = 47.0
dip_direction = 128.0
spacing = 4.5
origin = [0, 7.5, 10]
material = "clean"
[[joint_set]]
name = "west"
dip = 52.0
dip_direction = 221.0
spacing = 5.5
origin = [0, 7.5, 10]
material = "filled"
[[joint_set]]
name = "back"
dip = 70.0
dip_direction = 15.0
spacing = 4.0
origin = [1, 5, 10]
material = "clean"
[[water]]
table = {point = [0, 0, 6], dip = 12.0, dip_direction = 180.0}
[[point_load]]
point = [0.3, 2.2, 9.0]
force = [2e4, -3e4, -1e5]
[support]
target_factor_of_safety = 1.4
seismic_coefficient = [0.03, -0.04, 0.01]
"""

STAGED = """
title = "Heading and bench of a chamber"
[[material]]
name = "gneiss"
density = 2700.0
[[joint_material]]
name = "rough"
friction_angle = 38.0
cohesion = 1e3
[[solid]]
name = "rock"
shape = "box"
min = [-12, -9, -9]
max = [12, 9, 12]
material = "gneiss"
continues = ["xmin", "xmax", "ymin", "ymax", "zmin", "zmax"]
[[excavation]]
name = "heading"
stage = 1
shape = "box"
min = [-4, -6, 0]
max = [4, 6, 4]
[[excavation]]
name = "bench"
stage = 2
shape = "box"
min = [-4, -6, -4]
max = [4, 6, 0]
[[joint_set]]
name = "a"
dip = 35
dip_direction = 75
spacing = 2.6
[[joint_set]]
name = "b"
dip = 68
dip_direction = 195
spacing = 3.1
origin = [0.4, 0.2, 0.3]
[[joint_set]]
name = "c"
dip = 81
dip_direction = 305
spacing = 2.8
origin = [0.1, 0.9, 0.2]
[support]
support_direction = [0, 0, 1]
"""


ROUGH_FAULT = """
title = "A block on a fault from a file in centimetres, which bends by 20 degrees, below a water table"
[[material]]
density = 2600.0
[[joint_material]]
name = "clean"
friction_angle = 34.0
cohesion = 2e3
[[solid]]
name = "rock"
shape = "box"
min = [0, 0, -8]
max = [10, 10, 10]
continues = ["zmin"]
[[joint_mesh]]
name = "fault"
file = "rough_fault.obj"
[[water]]
table = {point = [0, 0, 4], dip = 8.0, dip_direction = 270.0}
[support]
target_factor_of_safety = 1.4
"""


def rough_fault():
    """A surface that dips 30 degrees to the west, then 50; its corners, 4 m apart, are rounded to centimetres and off by some."""
    vertices, triangles = [], []
    for i in range(6):
        x = 4 * i - 5
        for j in range(6):
            z = (0.577 if x < 5 else 1.19) * (x - 5) + 2 + 0.01 * ((7 * i + 3 * j * j) % 11 - 5)
            vertices.append(f"v {x} {4 * j - 5} {z:.2f}")
            if i < 5 and j < 5:
                a = 6 * i + j + 1
                triangles.append(f"f {a} {a + 6} {a + 7}\nf {a} {a + 7} {a + 1}")
    return "\n".join(vertices + triangles)


def case(name):
    return (SOURCE / "tests" / "cases" / name / "model.toml").read_text(encoding="utf-8")


def rockfold(folder, *arguments):
    done = subprocess.run([str(BINARY), *arguments], cwd=folder, capture_output=True, text=True)
    if "without npm" in done.stderr:
        skip("the program has no page")
    if done.returncode != 0:
        sys.exit(f"rockfold {' '.join(arguments)}: {done.stderr}")
    return done.stdout


def differs(mine, its, size):
    """Whether two numbers, lists of them, or texts differ by more than rounding; `size` is what their rounding comes from."""
    if isinstance(its, list):
        return len(mine) != len(its) or any(differs(a, b, size) for a, b in zip(mine, its))
    if isinstance(its, float) and isinstance(mine, (int, float)):
        return abs(mine - its) > TOLERANCE * max(abs(its), size)
    return mine != its


def compare(mine, its, where):
    faults = []
    for name in ("block", "batch", "stage", "mode", "planes", "direction", "sliding_force", "factor_of_safety", "free_area", "volume",
                 "weight", "support_force", "support_pressure", "support_direction"):
        size = mine["weight"] if "force" in name else mine["weight"] / mine["free_area"] if "pressure" in name else 1
        if differs(mine[name], its[name], size):
            faults.append(f"{where}, block {mine['block']}: {name} is {mine[name]}, the program has {its[name]}")
    return faults


def check(folder, name, setting, answer):
    sets = [part for text in setting["sets"] for part in ("--set", text)]
    its = json.loads(rockfold(folder, "support", f"{name}.toml", "--json", "--threads", "1", "-o", f"{name}-{answer}.vtkhdf", "--force", *sets))
    where = f"{name}, {' '.join(setting['sets'])}"
    unknown = set(setting["by_program"])
    singles = [k for k in its["keyblocks"] if len(k["blocks"]) == 1 and not unknown & set(k["blocks"])]
    grouped = {b for k in its["keyblocks"] if len(k["blocks"]) > 1 for b in k["blocks"]}
    if grouped and not setting["groups"]:
        return [f"{where}: groups {grouped} were not foreseen"]
    if setting["groups"]:  # what follows from them is the program's
        singles = [k for k in singles if k["block"] in {m["block"] for m in setting["keyblocks"]}]
    stable = [k for k in its["stable"] if k["block"] not in unknown]
    held = [k for k in setting["stable"] if k["block"] not in grouped]
    faults = []
    for kind, mine, theirs in (("key blocks", setting["keyblocks"], singles), ("stable ones", held, stable)):
        if [k["block"] for k in mine] != [k["block"] for k in theirs]:
            faults.append(f"{where}: {kind} {[k['block'] for k in mine]}, the program has {[k['block'] for k in theirs]}")
        else:
            for a, b in zip(mine, theirs):
                faults += compare(a, b, where)
    return faults


def main():
    packages()
    models = {"wedge": case("wedge"), "bench": WET_BENCH, "staged": STAGED, "rough": ROUGH_FAULT}
    for extra in sys.argv[1:]:
        models[extra] = case(extra)
    faults, looked_at = [], 0
    with tempfile.TemporaryDirectory(prefix="rockfold-what-if-") as where:
        folder = Path(where)
        (folder / "rough_fault.obj").write_text(rough_fault(), encoding="utf-8")
        for name, text in models.items():
            (folder / f"{name}.toml").write_text(text, encoding="utf-8")
            for file in (SOURCE / "tests" / "cases" / name).glob(f"{name}*"):
                (folder / file.name).write_bytes(file.read_bytes())
            rockfold(folder, "support", f"{name}.toml", "-q")
            rockfold(folder, "view", f"{name}.vtkhdf", "-q")
            settings = json.loads(node_output("test/what_if.mjs", folder / f"{name}.html", 7, SETTINGS))
            with ThreadPoolExecutor(2) as pool:
                for found in pool.map(lambda i: check(folder, name, settings[i], i), range(SETTINGS)):
                    faults += found
            keys = sum(len(s["keyblocks"]) for s in settings)
            print(f"{name}: {SETTINGS} settings, {keys} key blocks, {sum(len(s['stable']) for s in settings)} that stay, "
                  f"{sum(len(s['by_program']) for s in settings)} left to the program, {sum(s['milliseconds'] for s in settings) / SETTINGS:.2f} ms a setting")
            looked_at += keys
    print("\n".join(faults[:20]), f"{len(faults)} differ", sep="\n")
    return 1 if faults or looked_at < 5 * SETTINGS else 0


if __name__ == "__main__":
    sys.exit(main())
