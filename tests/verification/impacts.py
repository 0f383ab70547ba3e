"""Blocks that meet on edges and vertices: beams across each other, cubes that fall on what is lowest."""
import math

import numpy as np

from contact import G, end, path
from rest import mechanical
from runner import Findings, Line, Panel, monitor

SIDE = 0.4  # of the beams' sections


def bending(model):
    """The beams on a lattice; the lower one lies on smooth edges, which leave it as long as it wants to be."""
    smooth = '[[joint_material]]\nname = "smooth"\nfriction_angle = 0.0\nnormal_stiffness = 1e10\n\n[contact]\nmaterial = "smooth"\n\n'
    ends = "".join(f'\n[[monitor]]\nname = "{name}"\npoint = [{x}, 0.2, 0.0]\n' for name, x in (("left end", 0.2), ("right end", 3.8)))
    model = model.replace('lattice = "block"', 'lattice = "hex8"\nspacing = 0.2\norder = 1\norigin = [0, 0, 0]')
    return model.replace("[[solid]]", f"{smooth}[[solid]]", 1) + ends


def sag():
    """Of the lower beam between its supports, at x = 2: Timoshenko's beam under its own weight, ends that stick out, and a load over 0.2 m."""
    modulus, area, second, span, width, out = 1e10, SIDE**2, SIDE**4 / 12, 3.6, 0.2, 0.2
    own, load = 2500 * G * area, 2500 * G * 0.32
    bends = load / (384 * modulus * second) * (8 * span**3 - 4 * span * width**2 + width**3)
    bends += 5 * own * span**4 / (384 * modulus * second) - own * out**2 / 2 * span**2 / (8 * modulus * second)
    return bends + (load * (span / 4 - width / 8) + own * span**2 / 8) / (5 / 6 * modulus / 2 * area)


def crossing_beams(program, full):
    """A beam laid across another one: who bears what, how far it sags; and one that falls across, edge on edge, off its middle."""
    found = Findings("crossing_beams", "Crossing beams")
    lower, upper, sill = (2500 * G * volume for volume in (0.64, 0.32, 0.016))
    places = (1.0, 2.0, 3.0) if full else (1.0,)
    panel = Panel("What the left support bears", "place of the upper beam, m", "force, kN")
    borne = []
    for x in places:
        document = program.run("crossing_beams", {"solid.4.min": [x - 0.1, -1.8, 0.2], "solid.4.max": [x + 0.1, 2.2, 0.6],
                                                  "monitor.1.point": [x, 0.2, 0.0], "monitor.2.point": [x, 0.2, 0.2]})
        found.row(f"force between the beams, {x:g} m from the end", "N", upper, -0.08 * monitor(document, "joint")["normal_stress"][-1], 1e-6,
                  "weight above")
        left = document["reactions"][0]["force"][2]
        found.row(f"force on the left support, {x:g} m from the end", "N", sill + lower / 2 + upper * (3.8 - x) / 3.6, left, 1e-3, "lever")
        _, u = path(document, "middle")
        found.row(f"motion in the last step, {x:g} m from the end", "m", 0, float(np.linalg.norm(u[-1] - u[-2])), 1e-12, "rest")
        borne.append(left / 1e3)
    panel.lines.append(Line("ours", list(places), borne, "marks"))
    panel.lines.append(Line("lever", [0.2, 3.8], [(sill + lower / 2 + upper) / 1e3, (sill + lower / 2) / 1e3], "reference"))
    if full:
        document = program.run("crossing_beams", {"solid.4.min": [1.9, -1.8, 0.2], "solid.4.max": [2.1, 2.2, 0.6], "material.1.young_modulus": 1e10,
                                                  "monitor.1.point": [2.0, 0.2, 0.0], "monitor.2.point": [2.0, 0.2, 0.2],
                                                  "analysis.time_step": 0.2, "analysis.steps": 12}, bending)
        middle, left, right = (end(document, name)[2] for name in ("middle", "left end", "right end"))
        found.row("sag of the lower beam, hex8, linear covers", "mm", 1e3 * sag(), -1e3 * float(middle - (left + right) / 2), 1e-2, "beam theory")
        found.panels.append(panel)
    fall_across(program, found, full)
    return found


def fall_across(program, found, full):
    """At 1 m/s, edge on edge, 0.3 m off its middle: the point that hits goes back at the restitution, the rest follows from an impulse there."""
    half = SIDE / math.sqrt(2)
    arm, inertia = 0.3, (2.6**2 + SIDE**2) / 12  # of a beam of 2.6 m, of its unit of mass
    panel = Panel("A beam falls across another one", "time, ms", "speed of the point that hits, m/s")
    for restitution in (0.0, 0.5, 1.0) if full else (0.5,):
        document = program.run("crossing_beams", edit=lambda _, e=restitution: falling(half, e))
        time, centre = path(document, "centre", "velocity")
        _, tip = path(document, "end", "velocity")
        up = centre[:, 2]
        turning = -(tip[:, 2] - up) / 1.299
        point = up + arm * turning
        name = f"restitution {restitution:g}"
        if restitution:
            found.row(f"speed of the point that hits, after over before, {name}", "", restitution, float(point[-1]), 0.03 / restitution,
                      "as asked for")
        else:
            found.row(f"rebound of the point that hits, of the height of its fall, {name}", "", 0, float(point[-1]**2), 2e-2, "as asked for",
                      by_substeps=5e-2)
        impulse = (1 + point[-1]) / (1 + arm**2 / inertia)
        found.row(f"speed of the centre, {name}", "m/s", -1 + impulse, float(up[-1]), 5e-3, "impulse at the point")
        found.row(f"rate of turning, {name}", "rad/s", arm * impulse / inertia, float(turning[-1]), 5e-3, "impulse at the point")
        panel.lines.append(Line(name, (1e3 * time).tolist(), point.tolist(), "curve"))
    if full:
        found.panels.append(panel)


def falling(half, restitution):
    def square(z):
        return [[0, z], [half, z + half], [0, z + 2 * half], [-half, z + half]]
    return f"""gravity = [0, 0, 0]
[[material]]
density = 2500
young_modulus = 1e12
poisson_ratio = 0
[[joint_material]]
name = "smooth"
friction_angle = 0
normal_stiffness = 1e9
[[solid]]
name = "lower"
shape = "prism"
base = {[[-1, y, z] for y, z in square(-2 * half)]}
extrude = [2, 0, 0]
[[solid]]
name = "upper"
shape = "prism"
base = {[[x, -1, z] for x, z in square(0.01)]}
extrude = [0, 2.6, 0]
[contact]
restitution = {restitution}
[cover]
lattice = "block"
[[fixed]]
where = {{block_at = [0, 0, {-half}]}}
[[initial_velocity]]
where = {{block_at = [0, 0.3, {0.01 + half}]}}
velocity = [0, 0, -1]
[analysis]
type = "dynamic"
time_step = 0.0005
end_time = 0.03
[output]
every = 0
[[monitor]]
name = "centre"
point = [0, 0.3, {0.01 + half}]
[[monitor]]
name = "end"
point = [0, 1.599, {0.01 + half}]
"""


def axes_on(vertex_down):
    """The edges of a cube with one of its vertices lowest, or highest."""
    a, b = np.array([1, 1, 1]) / math.sqrt(3), np.array([1, -1, 0]) / math.sqrt(2)
    turn = np.array([b, np.cross(a, b), a])
    return turn if vertex_down else np.diag([1, -1, -1]) @ turn


def cube(turn, centre):
    base = [(turn @ np.array([x, y, -0.5]) + centre).tolist() for x, y in ((-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5))]
    return f'shape = "prism"\nbase = {base}\nextrude = {(turn @ np.array([0, 0, 1.0])).tolist()}\n'


def dropped_cube(program, full):
    """A cube that falls on an edge stays on it, if nothing turns it; else, and from a vertex, it comes to rest on a face. Two that meet keep
    their momentum."""
    found = Findings("dropped_cube", "Cube dropped on an edge, on a vertex, on another one's")
    panel = Panel("Height of the centre", "time, s", "height, m")
    still = {"initial_velocity.1.angular_velocity": [0, 0, 0]}
    onto_vertex = {"initial_velocity.1.where.block_at": [0, 0, 1.3], "monitor.1.point": [0, 0, 0.5 + math.sqrt(0.75)]}
    drops = (("edge, in balance", still, None, math.sqrt(0.5)), ("edge", {}, None, math.sqrt(0.5)),
             ("vertex", onto_vertex, on_vertex, math.sqrt(0.75)))
    for name, changes, edit, high in drops if full else drops[1:2]:
        changes = changes if full else {**changes, "analysis.end_time": 2.5}
        document = program.run("dropped_cube", changes, edit)
        time, u = path(document, "centre")
        height = 0.5 + high + u[:, 2]
        panel.lines.append(Line(name, time.tolist(), height.tolist(), "curve"))
        balance = "balance" in name
        found.row(f"height at the end, {name}", "m", high if balance else 0.5, float(height[-1]), 2e-4, "stays" if balance else "rests on a face")
        if balance:
            found.row(f"sideways, {name}", "m", 0, float(np.linalg.norm(u[-1][:2])), 1e-6, "symmetry")
        else:
            found.row(f"penetration at the end, {name}", "m", 2500 * G / 1e9, document["contacts"]["max_penetration"], 2e-3, "weight over stiffness",
                      by_substeps=1e-2)
        accounts(found, document, name, u)
    found.panels.append(panel)
    meet(program, found)
    return found


def accounts(found, document, name, u):
    """What friction and impacts took is what the fall gave but for what is stored; no step takes less than nothing."""
    energy = document["energy"]
    begin = document["energy_history"]["kinetic"][0]
    given = begin - 2500 * G * float(u[-1][2])
    kept = energy["kinetic"] + energy["strain"] + energy["contact"]
    found.row(f"energy lost in friction and impacts, {name}", "J", given - kept, energy["friction"] + energy["impact"] + energy["damping"], 1e-6,
              "weight times fall", by_substeps=4e-3)
    rise = float(np.diff(mechanical(document)).max())
    found.row(f"energy that a step adds, over that of the fall, {name}", "relative", 0, max(rise, 0.0) / given, 1e-6, "none is made",
              by_substeps=2e-2)  # where areas are found anew


def on_vertex(model):
    """The cube of the model turned so that a vertex is lowest."""
    begin = model.index('shape = "prism"')
    return model[:begin] + cube(axes_on(True), np.array([0, 0, 0.5 + math.sqrt(0.75)])) + model[model.index("\n[cover]"):]


def meet(program, found):
    """One cube comes with a vertex down at 2 m/s beside the vertex of another one, both free: momentum and its moment."""
    high = math.sqrt(0.75) + 1e-3
    centres = {"lower": (axes_on(False), np.array([0, 0, -high])), "upper": (axes_on(True), np.array([0.1, 0.03, high]))}

    def pair(model):
        text = "gravity = [0, 0, 0]\n" + model[model.index("[[material]]"):model.index("[[solid]]")]
        text += "[contact]\nrestitution = 0.5\n[cover]\nlattice = \"block\"\n"
        text += '[analysis]\ntype = "dynamic"\ntime_step = 0.0005\nend_time = 0.15\n[output]\nevery = 0\n'
        text += "[[initial_velocity]]\nwhere = {block_at = [0.1, 0.03, 0.87]}\nvelocity = [0, 0, -2]\n"
        for name, (turn, centre) in centres.items():
            text += f'[[solid]]\nname = "{name}"\n{cube(turn, centre)}'
            for i, point in enumerate((centre, *(centre + 0.4 * turn.T))):
                text += f'[[monitor]]\nname = "{name} {i}"\npoint = {point.tolist()}\n'
        return text

    document = program.run("dropped_cube", edit=pair)
    momentum, moment = 0.0, 0.0
    for name, (turn, centre) in centres.items():
        places = [start + path(document, f"{name} {i}")[1] for i, start in enumerate((centre, *(centre + 0.4 * turn.T)))]
        speeds = [path(document, f"{name} {i}", "velocity")[1] for i in range(4)]
        momentum = momentum + 2500 * speeds[0]
        moment = moment + 2500 * np.cross(places[0], speeds[0])
        for i in (1, 2, 3):  # a block deforms as a whole: its axes and their speeds tell all of its motion
            moment = moment + 2500 / 12 * np.cross(places[i] - places[0], speeds[i] - speeds[0]) / 0.16
    found.row("momentum of two cubes that meet near their vertices", "relative", 0, float(np.abs(momentum - momentum[0]).max() / 5000), 1e-9,
              "no force from outside")
    # friction acts on both at points that are apart by how deep they overlap, so soft are vertices at this speed
    found.row("their angular momentum", "relative", 0, float(np.abs(moment - moment[0]).max() / 5000), 1e-3, "but for the overlap's lever")
    energy = document["energy"]
    kept = energy["kinetic"] + energy["strain"] + energy["contact"]
    found.row("energy that they lose in friction and impacts", "J", 5000 - kept, energy["friction"] + energy["impact"] + energy["damping"], 1e-6,
              "balance", by_substeps=1e-3)
