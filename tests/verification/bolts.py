"""Bolts of rock in motion, against closed forms and the sums of limit equilibrium. Cases as those of statics.py."""
import math

import numpy as np
from contact import G, radians
from runner import Findings, Line, Panel
from water import middle

STEEL = 200e9 * math.pi / 4 * 0.025**2  # E A, N


def pull_out(program, full):
    """The force along a bolt in its bond, for bonds of any stiffness; and once the bond slides."""
    found = Findings("pull_out", "Pull-out of a grouted bolt")
    panel = Panel("Force along a bolt that is drawn out of 1.8 m of rock", "m from the joint", "of the force at the joint")
    below, above, way = 1.8, 1.0, 0.5e-3
    for bond in (1e7, 2e8, 2e9) if full else (2e8,):
        lam, stiffness = math.sqrt(bond / STEEL), math.sqrt(bond * STEEL)
        bolt, = program.run("pull_out", {"bolt.1.bond_stiffness": bond, "bolt.1.force_capacity": 1e6})["bolts"]
        both = 1 / (stiffness * math.tanh(lam * below)) + math.tanh(lam * above) / stiffness
        found.row(f"force at 0.5 mm, bond of {bond / 1e6:g} MN/m per m", "N", way / both, bolt["force"], 1e-2, "bar in an elastic bond")
        places, forces, exact = [], [], []
        for at, force in zip(bolt["along"]["at"], bolt["along"]["force"], strict=True):
            x = at - above
            if x > 1e-9:
                places.append(x)
                forces.append(force / bolt["force"])
                exact.append(math.sinh(lam * (below - x)) / math.sinh(lam * below))
        worst = max(range(len(places)), key=lambda i: abs(forces[i] - exact[i]))
        found.row(f"where it is worst along it, of that at the joint, {bond / 1e6:g} MN/m per m", "", exact[worst], forces[worst], 1e-2, "sinh λ(L − x)/sinh λL")
        line = [0.01 * k for k in range(181)]
        panel.lines += [Line(f"closed form, {bond / 1e6:g} MN/m²", line, [math.sinh(lam * (below - x)) / math.sinh(lam * below) for x in line], "reference"),
                        Line(f"ours, {bond / 1e6:g} MN/m²", places, forces, "marks")]
    if full:
        found.panels.append(panel)
    bolt, = program.run("pull_out", {"bolt.1.bond_strength": 50e3, "bolt.1.bond_stiffness": 1e9, "fixed.2.value_table": [[0, 0, 0, 0], [1, 0, 0, 0.02]]})["bolts"]
    found.row("force once the bond slides, 50 kN/m over what is left of 1.8 m", "N", 50e3 * (below - 0.02), bolt["force"], 1e-2, "b L")
    return found


PLANE = """gravity = [{gx}, 0, {gz}]
[[material]]
density = 2500
young_modulus = 1e10
poisson_ratio = 0.25
[[joint_material]]
name = "bed"
friction_angle = 20
[[solid]]
name = "plane"
shape = "box"
min = [-6, -1, -6]
max = [7, 3, 0]
[[solid]]
name = "box"
shape = "box"
min = [0, 0, 0]
max = [2, 2, 1]
interface = "bed"
[[bolt]]
name = "bolt"
collar = {collar}
direction = {direction}
length = {length}
force_capacity = 100e3
displacement_capacity = 1
stiffness = 5e9
plate_capacity = 1e6
[cover]
lattice = "block"
[[fixed]]
where = {{face = "plane.zmin"}}
[[point_load]]
point = [1, 1, 0.5]
force_table = [[0, 0, 0, 0], [0.5, {push}, 0, 0]]
[[step]]
type = "quasi_static"
time_step = 0.05
steps = 30
[output]
every = 0
[[monitor]]
name = "box"
point = [1, 1, 0.5]
"""


def held_block(program, degrees, push):
    """Whether a box of 10 t on a plane of 30° stays under a push down the plane; its bolt lies at so many degrees to the way up it."""
    a = radians(degrees)
    back = (1 - 1e-9) * min(1 / max(math.sin(a), 1e-9), 1 / max(math.cos(a), 1e-9))
    text = PLANE.format(gx=G * math.sin(radians(30)), gz=-G * math.cos(radians(30)), collar=[1 + back * math.cos(a), 1, back * math.sin(a)],
                        direction=[-math.cos(a), 0, -math.sin(a)], length=back + 3, push=push)
    monitor, = program.run("bolted_wedge", edit=lambda _: text)["monitors"]
    before, last = (way[0] for way in monitor["displacement"][-2:])
    return abs(last - before) < 1e-6


def bolted_wedge(program, full):
    """A wedge under water and anchors; a block under one bolt at any angle to its way."""
    found = Findings("bolted_wedge", "Bolts that hold rock in motion")
    for force in (200e3, 400e3, 600e3) if full else (400e3,):
        document = program.run("bolted_wedge", {"bolt_type.1.force_capacity": force})
        key, = document["support"]["keyblocks"]
        found.row(f"factor of the wedge under water, two anchors of {force / 1e3:g} kN", "", key["supported_factor_of_safety"], middle(document), 1e-2,
                  "limit equilibrium")
    weight, friction = 10e3 * G, math.tan(radians(20))
    panel = Panel("A block of 98 kN on a plane of 30°, friction 20°, bolt of 100 kN", "angle of the bolt to the way up the plane, deg", "push at which it slides, kN")
    angles = (5, 15, 30, 45, 60, 75, 85) if full else (30,)
    exact, ours = [], []
    for degrees in angles:
        a = radians(degrees)
        slides = (weight * math.cos(radians(30)) + 100e3 * math.sin(a)) * friction + 100e3 * math.cos(a) - weight * math.sin(radians(30))
        low, high = 0.95 * slides, 1.05 * slides
        for _ in range(6 if full else 4):
            push = (low + high) / 2
            low, high = (push, high) if held_block(program, degrees, push) else (low, push)
        exact.append(slides / 1e3)
        ours.append((low + high) / 2e3)
        found.row(f"push at which a block slides, bolt at {degrees}° to its way", "kN", exact[-1], ours[-1], 1e-2, "limit equilibrium")
    panel.lines += [Line("limit equilibrium", list(angles), exact, "reference"), Line("ours", list(angles), ours, "marks")]
    if full:
        found.panels.append(panel)
    return found


def wall_of_ring(lets_go, count, stiffness):
    """Convergence of a wall as rock that bore `lets_go` (Pa) on it lets go, and the force of each anchor between the wall and 3 m behind it: in
    two rings of rock in plane strain u = A r + B/r; anchors press the wall, and pull at the rock where they end; nothing moves 10 m out."""
    inner, anchor, outer, width, modulus, poisson = 2, 5, 10, 0.1, 1e9, 0.25
    shear = modulus / (2 * (1 + poisson))
    even, hole = 2 * shear / (1 - 2 * poisson), 2 * shear
    pressure = [count / (2 * math.pi * r * width) for r in (inner, anchor)]  # of 1 N in each
    equations = np.array([  # of A and B within the anchors, A and B beyond, and the force
        [even, -hole / inner**2, 0, 0, pressure[0]],
        [anchor, 1 / anchor, -anchor, -1 / anchor, 0],
        [-even, hole / anchor**2, even, -hole / anchor**2, -pressure[1]],
        [0, 0, outer, 1 / outer, 0],
        [stiffness * (anchor - inner), stiffness * (1 / anchor - 1 / inner), 0, 0, -1]])
    a, b, _, _, force = np.linalg.solve(equations, [lets_go, 0, 0, 0, 0])
    return -(a * inner + b / inner), force


def lined_tunnel(program, full):
    """A tunnel let go in three parts, with bolts that come in after the first, and without."""
    found = Findings("lined_tunnel", "Tunnel let go in three parts, bolts in between")
    panel = Panel("Convergence of a tunnel under 5 MPa", "of what the rock bore, let go", "convergence, mm")
    angles = [math.radians(7 + 45 * k) for k in range(8)]
    monitors = "".join(f'[[monitor]]\nname = "{k}"\npoint = [{2.001 * math.cos(a)}, 0.05, {2.001 * math.sin(a)}]\n' for k, a in enumerate(angles))
    parts, spacing = (0.4, 0.7, 1), 0.25 if full else 0.4
    for stiffness in (0, 2e6, 6e6) if full else (2e6,):
        document = program.run("lined_tunnel", {"bolt_pattern.1.stiffness": stiffness or 1, "cover.spacing": [spacing, 0.1, spacing]},
                               edit=lambda text: text + monitors)
        steps = [0] + [-sum(m["displacement"][at][0] * math.cos(a) + m["displacement"][at][2] * math.sin(a)
                             for m, a in zip(document["monitors"], angles, strict=True)) / len(angles) for at in (4, 6, 8)]
        bolts = document["bolts"]
        first, _ = wall_of_ring(0.4 * 5e6, 1, 0)
        rest, force = wall_of_ring(0.6 * 5e6, len(bolts), stiffness)
        name = f"{len(bolts)} bolts of {stiffness / 1e6:g} MN/m" if stiffness else "no bolts"
        found.row(f"convergence by the first part, {name}", "m", first, steps[1], 1e-2, "Lamé")
        found.row(f"by the second, {name}", "m", rest / 2, steps[2] - steps[1], 1e-2, "Lamé, two rings")
        found.row(f"by the third, {name}", "m", rest / 2, steps[3] - steps[2], 1e-2, "Lamé, two rings")
        if stiffness:
            found.row(f"force of a bolt, mean, {name}", "N", force, sum(bolt["force"] for bolt in bolts) / len(bolts), 2e-2, "Lamé, two rings")
        panel.lines += [Line(f"closed form, {name}", [0, *parts], [0, 1e3 * first, 1e3 * (first + rest / 2), 1e3 * (first + rest)], "reference"),
                        Line(f"ours, {name}", list(parts), [1e3 * u for u in steps[1:]], "marks")]
    if full:
        found.panels.append(panel)
    return found
