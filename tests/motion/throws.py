"""Random scenes of blocks that hit, slide and rest, and what must hold of every one of them.

    ROCKFOLD_BINARY=… tests/motion/throws.py [FIRST [COUNT]]     tells of each scene that breaks a rule; exit status 1 if any does

A scene is a seed. `Thrown`: convex blocks of all shapes fly at each other, free in space or over a floor. `Jointed`: a box cut by random joints, of which one
block is struck, or which stands, inclined, on its lowest.
"""
import json
import math
import os
import random
import subprocess
import sys
import tempfile
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent))
from stored_motion import StoredMotion, overlap  # noqa: E402



@dataclass
class Scene:
    seed: int
    kind: str
    head: str = ""
    solids: list = field(default_factory=list)
    joints: list = field(default_factory=list)
    tail: str = ""
    gravity: tuple = (0.0, 0.0, 0.0)
    held: bool = False  # whether a block is fixed
    friction: float = 0.0
    cohesion: float = 0.0
    restitution: float = 0.0
    law: tuple = (0.0, 0.0)  # Pa/m, normal and shear stiffness

    def model(self, order=None):
        """`order`: a random.Random that shuffles solids and joints."""
        solids, joints = list(self.solids), list(self.joints)
        if order:
            order.shuffle(solids)
            order.shuffle(joints)
        return self.head + "".join(solids) + "".join(joints) + self.tail


def vector(v):
    return "[" + ", ".join(repr(float(x)) for x in v) + "]"


def rotation(draw):
    q = np.array([draw.gauss(0, 1) for _ in range(4)])
    w, x, y, z = q / np.linalg.norm(q)
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)], [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


def ring(draw, n, radius):
    """Corners of a convex polygon about the origin."""
    while True:
        angles = sorted(draw.uniform(0, 2 * math.pi) for _ in range(n))
        gaps = [(b - a) % (2 * math.pi) for a, b in zip(angles, angles[1:] + angles[:1])]
        if 0.3 < min(gaps) and max(gaps) < 2.6:
            return [np.array([radius * math.cos(a), radius * math.sin(a), 0]) for a in angles]


def shape(draw, turn, centre):
    """The keys of a convex solid within a radius of 1 of its centre."""
    def put(points):
        return "[" + ", ".join(vector(turn @ p + centre) for p in points) + "]"
    kind = draw.choice(("prism", "prism", "cube", "pyramid", "frustum", "plate", "needle"))
    if kind in ("cube", "plate", "needle"):
        half = np.array({"cube": (0.45, 0.45, 0.45), "plate": (0.6, 0.5, 0.08), "needle": (0.12, 0.1, 0.85)}[kind])
        base = [half * (sx, sy, -1) for sx, sy in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
        return f'shape = "prism"\nbase = {put(base)}\nextrude = {vector(turn @ [0, 0, 2 * half[2]])}\n'
    base = [p + [0, 0, -draw.uniform(0.2, 0.5)] for p in ring(draw, draw.randint(3, 6), draw.uniform(0.4, 0.7))]
    base = [np.array([p[0], p[1], base[0][2]]) for p in base]
    if kind == "prism":
        lean = [draw.uniform(-0.2, 0.2), draw.uniform(-0.2, 0.2), -2 * base[0][2]]
        return f'shape = "prism"\nbase = {put(base)}\nextrude = {vector(turn @ lean)}\n'
    if kind == "pyramid":
        return f'shape = "pyramid"\nbase = {put(base)}\napex = {vector(turn @ [draw.uniform(-.2, .2), draw.uniform(-.2, .2), draw.uniform(.3, .7)] + centre)}\n'
    top = [0.5 * p * (1, 1, 0) + [0, 0, draw.uniform(0.2, 0.5)] for p in base]
    top = [np.array([p[0], p[1], top[0][2]]) for p in top]
    return f'shape = "frustum"\nbase = {put(base)}\ntop = {put(top)}\n'


def material(draw, scene):
    scene.friction, scene.cohesion = draw.choice((0.0, 10.0, 30.0, 60.0)), draw.choice((0.0, 0.0, 0.0, 1e4))
    dilates = scene.friction >= 10 and draw.random() < 0.2
    scene.restitution = draw.choice((0.0, 0.0, 0.5, 1.0))
    young = draw.choice((1e9, 1e10, 1e11))
    stiffness = min(young, 2.5e9)  # as by default: E/h, or what closes by 1e-5 of a block of a metre
    scene.law = (stiffness, draw.choice((0.3, 1.0)) * stiffness)
    return (f"[[material]]\ndensity = {draw.choice((1000, 2500, 8000))}\nyoung_modulus = {young}\npoisson_ratio = 0.25\n"
            f'[[joint_material]]\nname = "joint"\nfriction_angle = {scene.friction}\ncohesion = {scene.cohesion}\nresidual_cohesion = {scene.cohesion}\n'
            f"normal_stiffness = {scene.law[0]}\nshear_stiffness = {scene.law[1]}\n" + ("dilation_angle = 5\ndilation_limit = 0.01\n" if dilates else ""))


def contact(scene, order, time_step, steps):
    return (f'[cover]\nlattice = "block"\norder = {order}\n[contact]\nrestitution = {scene.restitution}\n'
            f'[analysis]\ntype = "dynamic"\ntime_step = {time_step}\nsteps = {steps}\n[output]\nevery = 1\n')


def thrown(seed):
    draw = random.Random(seed)
    scene = Scene(seed, "thrown")
    falls = draw.random() < 0.5
    scene.gravity = (0.0, 0.0, -9.81) if falls else (0.0, 0.0, 0.0)
    scene.held = falls
    scene.head = f"gravity = {vector(scene.gravity)}\n" + material(draw, scene)
    speed, steps = draw.choice((0.5, 3.0, 10.0, 30.0)), 40
    time_step = min(0.02, draw.choice((0.01, 0.03, 0.1, 0.3)) / speed)
    order = 0 if draw.random() < 0.1 and not falls else 1  # of order 0 nothing turns
    places = []
    while len(places) < draw.randint(2, 5):
        p = np.array([draw.uniform(-2, 2), draw.uniform(-2, 2), draw.uniform(1.05, 4)])
        if all(np.linalg.norm(p - q) > 2.02 for q in places):
            places.append(p)
    middle = np.mean(places, axis=0) * (1, 1, 0.3 if falls else 1)
    for p in places:
        scene.solids.append(f'[[solid]]\nname = "s{len(scene.solids)}"\ninterface = "joint"\n' + shape(draw, rotation(draw), p))
        way = middle - p + [draw.gauss(0, 0.3) for _ in range(3)]
        spin = np.array([draw.gauss(0, 1) for _ in range(3)]) * draw.choice((0, speed)) * order
        scene.tail += (f"[[initial_velocity]]\nwhere = {{block_at = {vector(p)}}}\nvelocity = {vector(speed * way / np.linalg.norm(way))}\n"
                       f"angular_velocity = {vector(spin)}\n")
    if falls:
        scene.solids.append('[[solid]]\nname = "floor"\nshape = "box"\nmin = [-6, -6, -1]\nmax = [6, 6, 0]\ninterface = "joint"\n')
        scene.tail += "[[fixed]]\nwhere = {block_at = [0.01, 0.02, -0.5]}\n"
    scene.tail += contact(scene, order, time_step, steps)
    return scene


def jointed(seed):
    draw = random.Random(seed)
    scene = Scene(seed, "jointed")
    stands = draw.random() < 0.6
    slope = radians(draw.uniform(0, 50)) if stands else 0
    scene.gravity = (9.81 * math.sin(slope), 0.0, -9.81 * math.cos(slope)) if stands else (0.0, 0.0, 0.0)
    scene.held = stands
    scene.head = f"gravity = {vector(scene.gravity)}\n" + material(draw, scene)
    scene.solids.append('[[solid]]\nname = "rock"\nshape = "box"\nmin = [-1.5, -1.2, -1]\nmax = [1.5, 1.2, 1.4]\n')
    if stands:
        scene.solids.append('[[solid]]\nname = "base"\nshape = "box"\nmin = [-4, -4, -2]\nmax = [5, 4, -1]\ninterface = "joint"\n')
        scene.tail += "[[fixed]]\nwhere = {block_at = [-3.9, 0, -1.5]}\n"
    for i in range(draw.randint(1, 5)):
        axis = np.array([draw.gauss(0, 1) for _ in range(3)])
        if draw.random() < 0.3:
            axis = np.eye(3)[draw.randint(0, 2)]
        point = [draw.uniform(-0.9, 0.9) for _ in range(3)]
        scene.joints.append(f'[[joint]]\nname = "j{i}"\nnormal = {vector(axis)}\npoint = {vector(point)}\n')
    if not stands:
        scene.tail += (f"[[initial_velocity]]\nwhere = {{block_at = [1.45, 1.15, 1.35]}}\nvelocity = {vector([draw.gauss(0, 2) for _ in range(3)])}\n")
    scene.tail += contact(scene, 1, draw.choice((0.0005, 0.002, 0.01, 0.05)), 40)
    return scene


def radians(x):
    return math.radians(x)


def draw_scene(seed):
    return (thrown if seed % 3 else jointed)(seed)


class NotSettled(Exception):
    """The program says that a step does not settle."""


def run(model, threads=1, more=()):
    with tempfile.TemporaryDirectory(prefix="rockfold-") as folder:
        path = Path(folder) / "scene.toml"
        path.write_text(model, encoding="utf-8")
        done = subprocess.run([os.environ["ROCKFOLD_BINARY"], "run", str(path), "--json", "-q", "--threads", str(threads), *more], cwd=folder, capture_output=True,
                              text=True, check=False, env=dict(os.environ, OMP_PROC_BIND="false"))
        if done.returncode == 1 and "does not settle" in done.stdout + done.stderr:
            raise NotSettled(next(line for line in (done.stdout + done.stderr).splitlines() if "does not settle" in line).strip()[:300])
        if done.returncode:
            raise AssertionError(f"exit status {done.returncode}: {done.stderr[-500:]}")
        return StoredMotion(Path(folder) / "scene.vtkhdf"), json.loads(done.stdout)


def broken_rules(scene, motion):
    """What a run does that no run may do."""
    found = []
    energy = [motion.energy(s, scene.law) for s in range(len(motion.time))]
    total = np.array([sum(e.values()) for e in energy])
    scale = max(max(e["kinetic"] for e in energy), max(abs(e["potential"]) for e in energy), max(e["contact"] for e in energy), 1e-12)
    rise = float(np.diff(total).max())
    # In deep impacts, where areas grow under pressure and plastic ones spring back by a little (docs/decisions/0015).
    if not rise <= 0.03 * scale:
        found.append(f"energy rises by {rise / scale:.2e} of {scale:.3g} J in step {int(np.diff(total).argmax()) + 1}")
    if not scene.held:
        found += kept(motion)
    found += unseen_overlaps(motion)
    found += friction_that_fails(scene, motion)
    return found


def kept(motion):
    """Momentum and angular momentum in free space. The second is kept to the share of a block by which two blocks slide on each other in a step."""
    found = []
    linear, angular = zip(*(motion.momentum(s) for s in range(len(motion.time))))
    for what, values, allowed in (("momentum", linear, 1e-8), ("angular momentum", angular, 0.05)):
        scale = max(np.linalg.norm(v, axis=1).sum() for v in values)
        off = max(float(np.linalg.norm(v.sum(0) - values[0].sum(0))) for v in values)
        if not off <= allowed * max(scale, 1e-9):
            found.append(f"{what} changes by {off / scale:.2e}")
    return found


def unseen_overlaps(motion):
    """Blocks that are deeper in each other than their contact points say, or by a third of the smallest."""
    found = []
    size, smallest = float(np.cbrt(motion.volume.mean())), float(np.cbrt(motion.volume.min()))
    for s in range(1, len(motion.time)):
        bodies, told = motion.bodies(s), {}
        c = motion.contacts[s] if motion.contacts else None
        if c is not None:
            for a, b, gap in zip(c["first_block"], c["second_block"], c["gap"]):
                pair = (min(a, b) - 1, max(a, b) - 1)
                told[pair] = max(told.get(pair, 0.0), -float(gap))
        for a in range(len(bodies)):
            for b in range(a + 1, len(bodies)):
                depth = overlap(bodies[a], bodies[b])
                if depth > 1.1 * told.get((a, b), 0.0) + 3e-5 * size:  # points serve on while blocks move by 1e-5
                    found.append(f"blocks {a + 1} and {b + 1} overlap by {depth:.3g} m in state {s}, contact says {told.get((a, b), 0):.3g} m")
                elif depth > 0.3 * smallest:
                    found.append(f"blocks {a + 1} and {b + 1} overlap by {depth:.3g} m in state {s}, {depth / smallest:.2f} of a block")
    return found[:3]


def friction_that_fails(scene, motion):
    """Shear beyond Mohr and Coulomb's strength, where a point is pressed by all of its closure: no impact drags there."""
    found, slope = [], math.tan(math.radians(scene.friction))
    for s, c in enumerate(motion.contacts if scene.restitution == 0 else ()):
        shear, pressure = np.linalg.norm(c["shear_stress"].reshape(-1, 3), axis=1), np.maximum(0, -c["normal_stress"])
        over = shear - (scene.cohesion + pressure * slope)
        counts = (c["state"] > 0) & (np.abs(pressure + scene.law[0] * c["gap"]) < 1e-6 * pressure)
        if counts.any() and over[counts].max() > 1e-6 * max(pressure.max(), 1.0):
            at = np.where(counts, over, -np.inf).argmax()
            found.append(f"shear {shear[at]:.6g} Pa under {pressure[at]:.6g} Pa in state {s}")
    return found[:2]


def differences(scene, motion, document):
    """The same bits on two threads, and the same motion whatever the order of solids and joints."""
    found = []
    other, _ = run(scene.model(), 2)
    if not (other.hash == motion.hash).all():
        found.append("other bits on two threads")
    try:
        other, told = run(scene.model(random.Random(scene.seed + 1)))
    except NotSettled:
        return found + ["with another order of solids and joints it does not settle"]
    # Up to the first step that rounding made Newton's iteration pass or fail in, and to the sixth hard hit (a step that is divided): hits
    # multiply what rounding has left, here by 10 to 100, and 1e-15 m times 100 to the fifth is 1e-5 m.
    substeps = list(zip(document["contacts_history"]["substeps"], told["contacts_history"]["substeps"]))
    hits = [s for s, (a, _) in enumerate(substeps) if a > 1]
    same = min([len(motion.time), *(s for s, (a, b) in enumerate(substeps) if a != b), *hits[5:6]])
    off = max(float(np.abs(motion.places(s) - other.places(s)[other.same_vertices(motion)]).max()) for s in range(same))
    if not off < 1e-5:
        found.append(f"with another order of solids and joints vertices lie {off:.2e} m away")
    return found


def main():
    first, count = int(sys.argv[1]) if len(sys.argv) > 1 else 1, int(sys.argv[2]) if len(sys.argv) > 2 else 10
    bad = unsettled = 0
    for seed in range(first, first + count):
        scene = draw_scene(seed)
        try:
            motion, document = run(scene.model())
            found = broken_rules(scene, motion)
            if seed % 4 == 0:
                found += differences(scene, motion, document)
        except NotSettled as error:
            unsettled += 1
            found = [f"does not settle: {error}"]
        except (AssertionError, subprocess.TimeoutExpired) as error:
            found = [str(error)]
        bad += bool(found)
        for line in found:
            print(f"{seed} ({scene.kind}): {line}", flush=True)
    print(f"{count} scenes from {first}: {bad} break a rule, {unsettled} of them do not settle")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
