"""Random prisms on planes and random wedges on two joints: each stays, slides or tips as statics says."""
import math
import random

import numpy as np

from contact import G, inclined, normal_of, path, radians, wedge_acceleration
from runner import Findings, Line, Panel

NEAR = 0.02  # of 1: factors of safety nearer to it are not drawn

HEAD = """gravity = {gravity}
[[material]]
density = 2500
young_modulus = 1e10
poisson_ratio = 0.25
[[joint_material]]
name = "clean"
friction_angle = {friction}
[cover]
lattice = "block"
[output]
every = 10
[[step]]
type = "quasi_static"
time_step = 0.01
steps = 5
[[step]]
type = "dynamic"
time_step = 0.002
end_time = {end}
reset_displacement = true
"""


def hull(points):
    """The convex hull, counter-clockwise (Andrew 1979)."""
    def chain(sorted_points):
        kept = []
        for p in sorted_points:
            while len(kept) > 1 and np.cross(np.subtract(kept[-1], kept[-2]), np.subtract(p, kept[-2])) <= 0:
                kept.pop()
            kept.append(p)
        return kept[:-1]
    points = sorted(map(tuple, points))
    return np.array(chain(points) + chain(points[::-1]))


def area_and_centroid(polygon):
    after = np.roll(polygon, -1, 0)
    twice = np.cross(polygon, after)
    return twice.sum() / 2, ((polygon + after) * twice[:, None]).sum(0) / (3 * twice.sum())


def depth(polygon, x):
    """How far inside the polygon x lies; negative outside."""
    edge = np.roll(polygon, -1, 0) - polygon
    return (np.cross(edge, x - polygon) / np.linalg.norm(edge, axis=1)).min()


def random_prism(draw):
    """An oblique prism on a plane: one on which friction and the base decide clearly."""
    while True:
        base = hull([(draw.uniform(-0.6, 0.6), draw.uniform(-0.6, 0.6)) for _ in range(draw.randint(3, 9))])
        if len(base) < 3 or np.linalg.norm(np.roll(base, -1, 0) - base, axis=1).min() < 0.1:
            continue
        area, middle = area_and_centroid(base)
        height, lean, azimuth = draw.uniform(0.2, 2.0), draw.uniform(0, 0.3), draw.uniform(0, 2 * math.pi)
        axis = height * np.array([lean * math.cos(azimuth), lean * math.sin(azimuth), 1])
        angle, friction = draw.uniform(5, 45), draw.uniform(5, 45)
        drives, holds = math.tan(radians(angle)), math.tan(radians(friction))
        # A block that slides is pressed along a line that leans by the friction angle.
        centre, lean = middle + axis[:2] / 2, min(drives, holds) * height / 2
        stands = [depth(base, centre + np.array([share * lean, 0])) for share in (1 - NEAR, 1, 1 + NEAR)]
        if area > 0.15 and abs(drives / holds - 1) > NEAR and depth(base, centre) > 0 and abs(stands[1]) > NEAR * math.sqrt(area) and \
                (stands[0] > 0) == (stands[2] > 0):
            return {"base": base, "axis": axis, "angle": angle, "friction": friction, "tips": stands[1] < 0,
                    "acceleration": max(0.0, G * math.cos(radians(angle)) * (drives - holds))}


def prism_model(prism):
    base, axis = prism["base"], prism["axis"]
    low, high = base.min(0) - 1, base.max(0) + (4, 1)
    text = HEAD.format(gravity=inclined(prism["angle"]), friction=prism["friction"], end=0.5)
    text += f'[[solid]]\nname = "floor"\nshape = "box"\nmin = {[*low, -1]}\nmax = {[*high, 0]}\n'
    text += f'[[solid]]\nname = "block"\nshape = "prism"\nbase = {[[*corner, 0] for corner in base.tolist()]}\nextrude = {axis.tolist()}\ninterface = "clean"\n'
    text += f"[[fixed]]\nwhere = {{block_at = {[*(low + 0.5), -0.5]}}}\n"
    middle = np.array([*area_and_centroid(base)[1], 0])
    for name, share in (("foot", 0.01), ("centre", 0.5), ("top", 0.99)):
        text += f'[[monitor]]\nname = "{name}"\npoint = {(middle + share * axis).tolist()}\n'
    return text


def rate(document, name, along):
    """The acceleration in the second half of the last step."""
    time, v = path(document, name, "velocity")
    half = len(v) // 2
    return float((v[-1] - v[half]) @ along / (time[-1] - time[half]))


def random_prisms(program, full):
    """Stays, slides at its acceleration, or tips."""
    found = Findings("random_prisms", "Random prisms on planes")
    draw, wrong, worst = random.Random(17), 0, 0.0
    expected, seen, kinds = [], [], {"stay": 0, "slide": 0, "tip": 0}
    for _ in range(300 if full else 12):
        prism = random_prism(draw)
        document = program.run("random_prisms", edit=lambda _, prism=prism: prism_model(prism))
        foot, top = path(document, "foot")[1][-1], path(document, "top")[1][-1]
        turn = np.linalg.norm(top - foot) / prism["axis"][2]
        slides = prism["acceleration"] > 0
        kinds["tip" if prism["tips"] else "slide" if slides else "stay"] += 1
        if prism["tips"]:
            wrong += turn < 3e-3
            continue
        a = rate(document, "centre", np.array([1, 0, 0])) if slides else 0.0
        wrong += turn > 3e-3 or (not slides and np.linalg.norm(foot) > 1e-3)
        if slides:
            worst = max(worst, abs(a / prism["acceleration"] - 1))
            expected.append(prism["acceleration"])
            seen.append(a)
    count = sum(kinds.values())
    found.row(f"of {count} prisms ({kinds['stay']} stay, {kinds['slide']} slide, {kinds['tip']} tip) do otherwise", "", 0, float(wrong), 0,
              "statics")
    found.row("largest error of an acceleration", "relative", 0, worst, 2e-2, "closed form")
    found.panels.append(against(expected, seen))
    return found


def against(expected, seen):
    panel = Panel("Acceleration of those that slide", "closed form, m/s²", "ours, m/s²")
    panel.lines.append(Line("_", [0, max(expected)], [0, max(expected)], "reference"))
    panel.lines.append(Line("ours", expected, seen, "marks"))
    return panel


def random_wedge(draw):
    """A wedge between two joints in a cube of 6 m, whose mode is clear: down the line of both joints or down one of them."""
    weight = np.array([0, 0, -G])
    corners = [np.array([x, y, z]) for x in (-2.9, 2.9) for y in (-2.9, 2.9) for z in (-2.9, 2.9)]
    while True:
        joints = [(draw.uniform(25, 75), draw.uniform(0, 360)) for _ in (1, 2)]
        n = [normal_of(*joint) for joint in joints]
        line, friction = np.cross(*n), draw.uniform(5, 50)
        if np.linalg.norm(line) < 0.3 or abs(line[2]) / np.linalg.norm(line) < math.sin(radians(8)):
            continue
        acceleration, along = wedge_acceleration(*n, friction)
        hold, single, clear = weight @ along - acceleration, False, True
        for i in (0, 1):
            steepest = weight - weight @ n[i] * n[i]
            steepest /= np.linalg.norm(steepest)
            opens = steepest @ n[1 - i]
            clear = clear and abs(opens) > 1e-3
            if opens > 0:  # from the other joint
                along, hold, single = steepest, -math.tan(radians(friction)) * (weight @ n[i]), True
        drive = weight @ along
        # Friction that presses on the other joint may hold a wedge a little beyond the limit of one joint: statics leaves it open.
        if not clear or abs(drive / hold - 1) < NEAR or (single and 0.95 < hold / drive < 1):
            continue
        sides = ((-1, -1), (1, -1), (-1, 1), (1, 1))
        places = [max(corners, key=lambda c, a=a, b=b: min(a * (n[0] @ c), b * (n[1] @ c))) for a, b in sides]
        if all(min(a * (n[0] @ c), b * (n[1] @ c)) > 0.1 for c, (a, b) in zip(places, sides)):
            return {"joints": joints, "held": places[:3], "top": places[3], "friction": friction, "along": along, "single": single,
                    "acceleration": max(0.0, float(drive - hold))}


def wedge_model(wedge):
    text = HEAD.format(gravity=[0, 0, -G], friction=wedge["friction"], end=0.3)
    text += '[[solid]]\nname = "rock"\nshape = "box"\nmin = [-3, -3, -3]\nmax = [3, 3, 3]\n'
    for i, (dip, direction) in enumerate(wedge["joints"]):
        text += f'[[joint]]\nname = "joint {i + 1}"\ndip = {dip}\ndip_direction = {direction}\npoint = [0, 0, 0]\n'
    for place in wedge["held"]:
        text += f"[[fixed]]\nwhere = {{block_at = {place.tolist()}}}\n"
    return text + f'[[monitor]]\nname = "wedge"\npoint = {(0.9 * wedge["top"]).tolist()}\n'


def random_wedges(program, full):
    """Stays, or slides along the line of both joints or down one of them, at its acceleration."""
    found = Findings("random_wedges", "Random wedges on two joints")
    draw, wrong, worst = random.Random(17), 0, 0.0
    expected, seen, kinds = [], [], {"stay": 0, "slide on one": 0, "slide on two": 0}
    for _ in range(300 if full else 12):
        wedge = random_wedge(draw)
        document = program.run("random_wedges", edit=lambda _, wedge=wedge: wedge_model(wedge))
        if wedge["acceleration"] == 0:
            kinds["stay"] += 1
            wrong += np.linalg.norm(path(document, "wedge")[1][-1]) > 1e-3
            continue
        kinds["slide on one" if wedge["single"] else "slide on two"] += 1
        a = rate(document, "wedge", wedge["along"])
        worst = max(worst, abs(a / wedge["acceleration"] - 1))
        expected.append(wedge["acceleration"])
        seen.append(a)
    count = sum(kinds.values())
    found.row(f"of {count} wedges ({', '.join(f'{n} {kind}' for kind, n in kinds.items())}) move that must stay", "", 0, float(wrong), 0,
              "statics")
    found.row("largest error of an acceleration", "relative", 0, worst, 2e-2, "closed form")
    found.panels.append(against(expected, seen))
    return found
