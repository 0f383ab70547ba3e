"""Contact: cases with a closed form, as those of statics.py."""
import math
import re

import elastic_wedge
import newmark_wedge
import numpy as np

from dynamics import crossing, history
from runner import Findings, Line, Panel, monitor

G = 9.81


def radians(degrees):
    return math.radians(degrees)


def inclined(angle):
    """Gravity on a level plane that stands for one inclined by `angle` degrees."""
    return [G * math.sin(radians(angle)), 0.0, -G * math.cos(radians(angle))]


def path(document, name, what="displacement"):
    entry = monitor(document, name)
    return np.array(entry["time"]), np.array(entry[what])


def end(document, name):
    return path(document, name)[1][-1]


def appended(text):
    return lambda model: model + text


def settled(model):
    """Gravity comes by a few quasi-static steps, so that joints bear from the start; motion counts from there."""
    first = '[[step]]\ntype = "quasi_static"\ntime_step = 0.02\nsteps = 5\n\n'
    return re.sub(r'\[analysis\]\ntype = "dynamic"\ntime_step = (\S+).*\nend_time = (\S+).*\n',
                  first + r'[[step]]\ntype = "dynamic"\ntime_step = \1\nend_time = \2\nreset_displacement = true\n', model)


def from_there(document, name):
    """Time and displacement from the last step's beginning on."""
    time, u = path(document, name)
    return time[5:] - time[5], np.concatenate([[np.zeros(3)], u[6:]])


def turned(model, away=(0, 0, 0)):
    """The model turned by an odd rotation, and moved: boxes become prisms."""
    axis, angle = np.array([1.0, 2.0, -0.7]), 1.234
    axis /= np.linalg.norm(axis)
    k = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
    turn = np.eye(3) + math.sin(angle) * k + (1 - math.cos(angle)) * k @ k

    def text(vector):
        return "[" + ", ".join(repr(float(x)) for x in vector) + "]"

    def numbers(match):
        return np.array([float(x) for x in match.split(",")])

    def prism(match):
        low, high = numbers(match[1]), numbers(match[2])
        base = [low, (high[0], low[1], low[2]), (high[0], high[1], low[2]), (low[0], high[1], low[2])]
        corners = ", ".join(text(turn @ np.array(corner) + away) for corner in base)
        return f'shape = "prism"\nbase = [{corners}]\nextrude = {text(turn @ np.array([0, 0, high[2] - low[2]]))}\n'

    model = re.sub(r'shape = "box"\nmin = \[(.*?)\].*\nmax = \[(.*?)\].*\n', prism, model)
    model = re.sub(r"(gravity|velocity) = \[(.*?)\]", lambda m: f"{m[1]} = {text(turn @ numbers(m[2]))}", model)
    return re.sub(r"(point|block_at) = \[(.*?)\]", lambda m: f"{m[1]} = {text(turn @ numbers(m[2]) + away)}", model)


def moved(model, away):
    """The model at another place."""
    def text(match):
        return f"{match[1]} = {[float(x) + a for x, a in zip(match[2].split(','), away)]}"
    return re.sub(r"^((?:where = \{)?(?:min|max|point|block_at)) = \[(.*?)\]", text, model, flags=re.M)


def sliding_block(program, full):
    """It slides as friction lets it, stays, tips."""
    found = Findings("sliding_block", "Block on an inclined plane")
    panel = Panel("From rest", "time, s", "way, m")
    pairs = ((30, 0), (30, 10), (30, 20), (45, 30), (22.6, 0)) if full else ((30, 20),)
    for angle, friction in pairs:
        a = G * (math.sin(radians(angle)) - math.cos(radians(angle)) * math.tan(radians(friction)))
        document = program.run("sliding_block", {"gravity": inclined(angle), "joint_material.1.friction_angle": friction})
        time, u = path(document, "centre")
        # let go on an elastic joint that does not press yet it sticks at times for some milliseconds, in short steps by either scheme
        found.row(f"way on {angle}°, friction {friction}°", "m", 0.5 * a * time[-1]**2, float(u[-1][0]), 1e-3, "closed form", by_substeps=1e-2)
        panel.lines.append(Line(f"ours, {angle}°, {friction}°", time.tolist(), u[:, 0].tolist(), "curve"))
        panel.lines.append(Line("_", time.tolist(), (0.5 * a * time**2).tolist(), "reference"))
    found.panels.append(panel)
    threshold(program, found, full)
    thrown(program, found, full)
    modes(program, found, full)
    if full:
        same_anywhere(program, found)
    return found


def threshold(program, found, full):
    slowly = {"analysis.type": "quasi_static", "analysis.time_step": 0.1, "analysis.end_time": 3.0}
    for friction in (30.05, 29.95):
        document = program.run("sliding_block", {**slowly, "joint_material.1.friction_angle": friction})
        _, u = path(document, "centre")
        step = float(np.linalg.norm(u[-1] - u[-2]))
        a = G * (0.5 - math.sqrt(0.75) * math.tan(radians(friction)))
        if a < 0:
            found.row(f"motion in the last quasi-static step on 30°, friction {friction}°", "m", 0, step, 1e-12, "statics")
        else:  # without velocities each step begins at rest
            found.row(f"motion in the last quasi-static step on 30°, friction {friction}°", "m", 0.25 * a * 0.01, step, 1e-3, "beta a dt²")
    if full:
        document = program.run("sliding_block", {"joint_material.1.friction_angle": 30.05, "analysis.end_time": 2.0})
        _, u = path(document, "centre")
        step = float(np.linalg.norm(u[-1] - u[-2]))
        found.row("motion in the last dynamic step on 30°, friction 30.05°, gravity put on at once", "m", 0, step, 1e-12, "rest")


def thrown(program, found, full):
    """Up the slope, or along a level plane."""
    panel = Panel("Thrown uphill", "time, s", "way, m")
    flat = {"solid.2.max": [1, 1, 0.2], "monitor.1.point": [0.5, 0.5, 0.1], "monitor.2.point": [0.5, 0.5, 0.199]}
    start = '[[initial_velocity]]\nwhere = {{block_at = [0.5, 0.5, 0.1]}}\nvelocity = [{}, 0, 0]\n'
    cases = ((30, 10, -5, 0.780881, 1.952203, True), (30, 40, -5, 0.415498, 1.038746, False)) if full else ()
    for angle, friction, speed, stop, way, goes_on in cases:
        document = program.run("sliding_block", {"gravity": inclined(angle), "joint_material.1.friction_angle": friction, "analysis.end_time": 1.2,
                                                 **flat}, appended(start.format(speed)))
        time, u = path(document, "centre")
        found.row(f"way up {angle}°, friction {friction}°", "m", way, float(-u[:, 0].min()), 1e-3, "closed form")
        a = 3.406977 if goes_on else 0.0
        found.row(f"place after 1.2 s, up {angle}°, friction {friction}°", "m", -way + 0.5 * a * (1.2 - stop)**2, float(u[-1][0]), 2e-3, "closed form")
        panel.lines.append(Line(f"ours, friction {friction}°", time.tolist(), u[:, 0].tolist(), "curve"))
    if full:
        found.panels.append(panel)
    friction = math.degrees(math.atan(0.5))
    document = program.run("sliding_block", {"gravity": [0, 0, -G], "joint_material.1.friction_angle": friction, "analysis.end_time": 1.2},
                           appended(start.format(5)))
    found.row("way on a level plane from 5 m/s, friction 0.5", "m", 2.548420, float(end(document, "centre")[0]), 1e-3, "closed form")


def modes(program, found, full):
    """Stays, slides, tips, or both (Ashby 1971): foot and rotation after half a second."""
    # Within half a percent of its limit it flutters on joints stiffer than its rock, as by implicit steps that are as short.
    stays = 41 if program.by_substeps else 40.1
    cases = ((40, 1, 1, stays, 0, 0), (40, 1, 0.5, 20, 1, 0), (40, 1, 2.5, 40, 0, 1), (30, 0.5, 1, 26, 1, 0), (30, 0.5, 1, 27, 1, 1),
             (30, 0.5, 1, 28, 0, 1)) if full else ((40, 1, 2.5, 40, 0, 1),)
    for angle, b, h, friction, slides, tips in cases:
        changes = {"gravity": inclined(angle), "joint_material.1.friction_angle": friction, "solid.2.max": [b, 1, h],
                   "joint_material.1.normal_stiffness": 1e12, "joint_material.1.shear_stiffness": 1e12,
                   "monitor.1.point": [b - 1e-3, 0.5, 1e-3], "monitor.2.point": [b - 1e-3, 0.5, h - 1e-3]}
        document = program.run("sliding_block", changes, settled)
        foot, top = end(document, "centre"), end(document, "top")
        slip, turn = abs(foot[0]), abs(top[0] - foot[0]) / h
        what = f"{b} × {h} m on {angle}°, friction {friction}°"
        found.row(f"{what}: slides", "", slides, float(slip > 1e-3), 0, "closed form")
        found.row(f"{what}: tips", "", tips, float(turn > 1e-3), 0, "closed form")


def same_anywhere(program, found):
    """A model that is turned, moved, or has a softer joint in shear slides the same way."""
    exactly = {"solver.tolerance": 1e-12}
    here = np.linalg.norm(end(program.run("sliding_block", exactly, settled), "centre"))
    for away, tolerance in (((0, 0, 0), 1e-9), ((3500.0, -7200.0, 1250.0), 1e-5)):  # there a gap is rounded to 1e-7 of a closure
        there = np.linalg.norm(end(program.run("sliding_block", exactly, lambda model, away=away: turned(settled(model), away)), "centre"))
        found.row("way of the turned model" + (", moved by 8 km" if any(away) else ""), "m", float(here), float(there), tolerance, "as it was")
    for far in (5e5, 5e6):  # map coordinates: there the turned corners are rounded to 6e-11 and 9e-10 m
        away = (far, far, 1250.0)
        for name, move in (("model", moved), ("turned model", turned)):
            document = program.run("sliding_block", exactly, lambda model, away=away, move=move: move(settled(model), away))
            off = float(abs(np.linalg.norm(end(document, "centre")) - here))
            found.row(f"way of the {name} at map coordinates of {far / 1e3:g} km, off its way here", "m", 0, off, 1e-6, "as it was")
    soft = program.run("sliding_block", {"joint_material.1.normal_stiffness": 1e9, "joint_material.1.shear_stiffness": 1e8}, settled)
    time, u = from_there(soft, "centre")
    a = G * (0.5 - math.sqrt(0.75) * math.tan(radians(20)))
    found.row("way with k_s = k_n / 10", "m", 0.5 * a * time[-1]**2, float(u[-1][0]), 1e-3, "closed form")


def cohesive_block(program, full):
    """A block on a slope stays just below the cohesion's limit and goes just above it."""
    found = Findings("cohesive_block", "Block held by cohesion")
    critical, panel = 9283.43, Panel("Quasi-static steps", "step", "way, m", log="y")
    for share in (1.005, 0.995) if full else (0.995,):
        document = program.run("cohesive_block", {"joint_material.1.cohesion": share * critical})
        _, u = path(document, "centre")
        holds = float(np.linalg.norm(u[-1] - u[-2]) < 1e-9)
        found.row(f"holds with {share} times the cohesion in need", "", float(share > 1), holds, 0, "limit equilibrium")
        panel.lines.append(Line(f"cohesion {share} of that in need", list(range(len(u) - 1)), np.linalg.norm(u[1:], axis=1).tolist(), "curve"))
    found.panels.append(panel)
    fast = {"analysis.type": "dynamic", "analysis.time_step": 0.002, "analysis.steps": 150, "joint_material.1.cohesion": 9000.0}
    for residual, a in ((0.0, 3.570548), (5000.0, 1.647471)) if full else ((0.0, 3.570548),):
        document = program.run("cohesive_block", {**fast, "joint_material.1.residual_cohesion": residual})
        time, u = path(document, "centre")
        _, v = path(document, "centre", "velocity")
        half = len(time) // 2
        rate = float(np.linalg.norm(v[-1] - v[half]) / (time[-1] - time[half]))
        found.row(f"acceleration after the break, residual cohesion {residual:g} Pa", "m/s²", a, rate, 2e-2, "closed form", by_substeps=3e-2)
    return found


def normal_of(dip, direction):
    d, a = radians(dip), radians(direction)
    return np.array([math.sin(d) * math.sin(a), math.sin(d) * math.cos(a), math.cos(d)])


def wedge_acceleration(one, two, friction):
    """Of a wedge on two planes (upward normals) that slides down their line, and its direction."""
    line = np.cross(one, two)
    line *= -np.sign(line[2]) / np.linalg.norm(line)
    weight = np.array([0, 0, -G])
    across = weight - weight @ line * line
    n1, n2 = np.linalg.solve(np.array([[one @ one, one @ two], [one @ two, two @ two]]), [-across @ one, -across @ two])
    return weight @ line - (n1 + n2) * math.tan(radians(friction)), line


def sliding_wedge(program, full):
    """A wedge on two planes slides down their line of intersection, or stays."""
    found = Findings("sliding_wedge", "Wedge on two joints")
    panel = Panel("From rest", "time, s", "way, m")
    cases = (((40, 130), (60, 220), (0, 20, 33)), ((52, 63), (53, 296), (0,)), ((45, 135), (45, 225), (20,))) if full else \
        (((40, 130), (60, 220), (20,)),)
    for one, two, frictions in cases:
        n = [normal_of(*one), normal_of(*two)]
        corners = [np.array([x, y, z]) for x in (-2.9, 2.9) for y in (-2.9, 2.9) for z in (-2.9, 2.9)]
        held = [max(corners, key=lambda c: min(s * (n[0] @ c), t * (n[1] @ c))).tolist() for s, t in ((-1, -1), (1, -1), (-1, 1))]
        places = {f"fixed.{i + 1}.where.block_at": point for i, point in enumerate(held)}
        for friction in frictions:
            changes = {"joint.1.dip": one[0], "joint.1.dip_direction": one[1], "joint.2.dip": two[0], "joint.2.dip_direction": two[1],
                       "joint_material.1.friction_angle": friction, "step.2.end_time": 0.6 if friction == 33 else 0.3, **places}
            document = program.run("sliding_wedge", changes, settled)
            time, u = from_there(document, "wedge")
            a, line = wedge_acceleration(*n, friction)
            name = f"{one[0]}/{one[1]:03}, {two[0]}/{two[1]:03}, friction {friction}°"
            way = 0.5 * a * time[-1]**2
            if friction == 33:  # 1 % above its limit it swings at first between what sticks and what slides: the last half counts
                _, v = path(document, "wedge", "velocity")
                half = len(v) // 2
                rate = float((v[-1] - v[half]) @ line / (time[-1] - time[half - len(v)]))
                found.row(f"acceleration, {name}", "m/s²", a, rate, 2e-3, "closed form")
            else:
                found.row(f"way, {name}", "m", way, float(u[-1] @ line), 1e-3, "closed form")
            found.row(f"off the line, {name}", "relative", 0, float(np.linalg.norm(u[-1] - u[-1] @ line * line) / way), 1e-3,
                      "closed form")
            panel.lines.append(Line(f"ours, {name}", time.tolist(), (u @ line).tolist(), "curve"))
            panel.lines.append(Line("_", time.tolist(), (0.5 * a * time**2).tolist(), "reference"))
    found.panels.append(panel)
    return found


STEEP = ((64, 40), (70, 140))    # joints of a narrow wedge, its friction and a normal stiffness of the joints
FRICTION, NORMAL = 54.0, 2.6e9   # deg, Pa/m
SHAKEN = 2.5                     # s
LINE = newmark_wedge.line_of(*(newmark_wedge.upward(*plane) for plane in STEEP))


def pulses(largest, period, count):
    """A record along the line of the wedge, rows [t, ax, ay, az]: sines that begin by throwing the slope back."""
    trend = math.atan2(LINE[0], LINE[1])
    rows = []
    for t in np.linspace(0, count * period, round(100 * count * period) + 1):
        a = -largest * math.sin(2 * math.pi * t / period)
        rows.append([float(f"{x:.6f}") for x in (t, a * math.sin(trend), a * math.cos(trend), 0)])
    return rows


def shaken(rows):
    return lambda model: settled(model) + f'\n[base_acceleration]\nstep = "step 2"\ntable = {rows}\n'


def shaken_wedge(program, full):
    """A wedge under a record slides as far as Newmark's rigid block where its joints are softer in shear than in compression; as stiff in shear,
    they keep it jammed between pulses, as a rigid wedge on elastic joints is."""
    found = Findings("shaken_wedge", "Wedge under a record")
    rows = pulses(2.0, 0.5, 4)
    rigid = newmark_wedge.Sliding(STEEP, FRICTION, rows, SHAKEN)
    planes = {f"joint.{i + 1}.{key}": value for i, plane in enumerate(STEEP) for key, value in zip(("dip", "dip_direction"), plane)}
    held = ((-2.9, -2.9, -4.9), (-2.9, -2.9, 0), (-2.9, 2.9, 0))
    places = {f"fixed.{i + 1}.where.block_at": point for i, point in enumerate(held)}

    def run(ratio, normal, young, step):
        changes = {**planes, **places, "solid.1.min": [-3, -3, -5], "material.1.young_modulus": young,
                   "joint_material.1.friction_angle": FRICTION, "joint_material.1.normal_stiffness": normal,
                   "joint_material.1.shear_stiffness": ratio * normal, "step.2.time_step": step, "step.2.end_time": SHAKEN}
        document = program.run("sliding_wedge", changes, shaken(rows))
        time, u = from_there(document, "wedge")
        wedge, = document["shaken"]
        return time, u @ np.array(LINE), wedge["newmark"]

    of_newmark, stiff = "Newmark 1965, Hoek & Bray 1981", 10 * NORMAL
    _, way, own = run(0.1, stiff, 1e11, 0.005)
    found.row("way of Newmark's block", "m", rigid.way[-1], own, 2e-3, of_newmark)
    # substeps keep it shaking on its joints, where steps of 5 ms damp that away, and friction then holds less
    found.row("way, kₛ/kₙ = 0.1, kₙ = 26 GPa/m, steps of 5 ms", "m", rigid.way[-1], float(way[-1]), 0.02, of_newmark, by_substeps=0.15)
    if not full:
        return found
    _, way, _ = run(0.1, stiff, 1e11, 0.002)
    found.row("way, kₛ/kₙ = 0.1, kₙ = 26 GPa/m, steps of 2 ms", "m", rigid.way[-1], float(way[-1]), 0.02, of_newmark, by_substeps=0.15)
    panel, elastic = Panel("Rigid rock, kₙ = 2.6 GPa/m", "time, s", "way, mm"), elastic_wedge.Wedge(STEEP, (-3, -3, -5), (3, 3, 3))
    for ratio in (0.1, 0.3, 1.0):
        time, way, _ = run(ratio, NORMAL, 1e13, 0.002)
        found.row(f"way, kₛ/kₙ = {ratio:g}, kₙ = 2.6 GPa/m, steps of 2 ms", "m", elastic.slide(FRICTION, rows, SHAKEN, NORMAL, ratio), float(way[-1]),
                  0.06, "rigid wedge, elastic joints", by_substeps=0.15)
        panel.lines.append(Line(f"ours, kₛ/kₙ = {ratio:g}", time.tolist(), (1e3 * way).tolist(), "curve"))
    panel.lines.append(Line("Newmark", rigid.time, [1e3 * w for w in rigid.way], "reference"))
    found.panels.append(panel)
    return found


def without_monitors(model):
    return model[:model.index("[[monitor]]\nname = \"joint 1\"")]


def stacked_blocks(program, full):
    """The stiffness of a jointed column, 1/E + 1/(k_n s), in three directions."""
    found = Findings("stacked_blocks", "Column of cubes")
    document = program.run("stacked_blocks")
    forces = [-monitor(document, f"joint {j}")["normal_stress"][-1] for j in (1, 2, 3, 4)]
    for j, force in enumerate(forces):
        found.row(f"force in joint {j + 1}", "N", (4 - j) * 24525.0, force, 1e-6, "weight above")
    panel = Panel("Force in the joints", "joint, from below", "force, kN")
    panel.lines.append(Line("ours", [1, 2, 3, 4], [force / 1e3 for force in forces], "marks"))
    panel.lines.append(Line("weight above", [1, 4], [98.1, 24.525], "reference"))
    found.panels.append(panel)
    load = '\n[[traction]]\nwhere = {face = "rock.zmax"}\nvalue = [0, 0, -1e6]\n'
    two = {"gravity": [0, 0, 0], "solid.1.max": [1, 1, 2], "monitor.1.point": [0.5, 0.5, 2.0]}
    document = program.run("stacked_blocks", two, lambda model: without_monitors(model) + load)
    found.row("two cubes of 1 GPa under 1 MPa, joint of 1e11 Pa/m", "m", -0.00201, float(end(document, "top")[2]), 2e-3, "closed form")
    for axis, (dip, direction, low, high) in enumerate(((90, 90, "xmin", "xmax"), (90, 0, "ymin", "ymax"), (0, 0, "zmin", "zmax"))):
        size = [1.0, 1.0, 1.0]
        size[axis] = 5.0
        force = [0.0, 0.0, 0.0]
        force[axis] = -1e4
        top = [0.5 * s for s in size]
        top[axis] = size[axis]
        pull = f'\n[[traction]]\nwhere = {{face = "rock.{high}"}}\nvalue = {force}\n'
        changes = {"gravity": [0, 0, 0], "solid.1.max": size, "monitor.1.point": top, "joint_set.1.dip": dip, "joint_set.1.dip_direction": direction,
                   "fixed.1.where.face": f"rock.{low}", "joint_material.1.normal_stiffness": 2e9, "joint_material.1.shear_stiffness": 1e9}
        if not full and axis < 2:
            continue
        document = program.run("stacked_blocks", changes, lambda model, pull=pull: without_monitors(model) + pull)
        expected = -1e4 * (5 / 1e9 + 4 / 2e9)
        found.row(f"shortening of five cubes along {'xyz'[axis]}, joints of 2e9 Pa/m", "m", expected, float(end(document, "top")[axis]), 1e-4,
                  "1/E + 1/(k s)")
    return found


def overhang(program, full):
    """Bricks stay 1 % short of the limit and fall 1 % beyond it."""
    found = Findings("overhang", "Harmonic overhang")
    panel = Panel("Quasi-static steps", "step", "displacement of the tip, m", log="y")
    for count in (1, 2, 4) if full else (2,):
        for share in (0.99, 1.01):
            ends = [0.5 * share * sum(1 / k for k in range(i, count + 1)) for i in range(count, 0, -1)]
            def stack(model, ends=ends, count=count):
                parts = model.split("[[solid]]")
                for i, x in enumerate(ends):
                    parts[2 + i] = re.sub(r"min = .*\nmax = .*\n", f"min = [{x - 1!r}, 0, {0.2 * i!r}]\nmax = [{x!r}, 1, {0.2 * (i + 1)!r}]\n",
                                          parts[2 + i])
                tail = parts[-1][parts[-1].index("[cover]"):]
                if count < 4:
                    parts[1 + count] += tail
                return "[[solid]]".join(parts[:2 + count])
            document = program.run("overhang", {"monitor.1.point": [ends[-1] - 0.01, 0.5, 0.2 * count - 0.1]}, stack)
            _, u = path(document, "tip")
            moves = float(np.linalg.norm(u[-1] - u[-2]) > 1e-6)
            found.row(f"{count} bricks, {share} of the limit: falls", "", float(share > 1), moves, 0, "closed form")
            panel.lines.append(Line(f"{count} bricks, {share} of the limit", list(range(1, len(u))),
                                    np.maximum(np.linalg.norm(u[1:], axis=1), 1e-12).tolist(), "curve"))
    found.panels.append(panel)
    return found


def rate_at(time, values, at, begin, end_of):
    """Slope at a time beside an impact, from the parabola through the values before or behind it."""
    there = (time >= begin) & (time <= end_of)
    return float(np.polyfit(time[there] - at, values[there], 2)[1])


def rocking_block(program, full):
    """Housner 1963: quarter period, loss of energy at the impact, peaks."""
    found = Findings("rocking_block", "Rocking block")
    document = program.run("rocking_block", {} if full else {"analysis.end_time": 0.7})
    time, foot = path(document, "right foot")
    _, top = path(document, "top")
    at_start = np.array([0.48, 0, 1.97]) - [0.25, 0, 0.001]
    rod = top - foot + at_start
    angle = 0.5 * math.degrees(math.atan2(0.25, 1.0)) + np.degrees(np.arctan2(rod[:, 0], rod[:, 2]) - math.atan2(at_start[0], at_start[2]))
    hit = crossing(time, -angle, 0.0)
    found.row("four times the first quarter", "s", 1.975213, 4 * hit, 5e-3, "nonlinear pendulum")
    before, after = rate_at(time, angle, hit, hit - 0.03, hit - 0.005), rate_at(time, angle, hit, hit + 0.01, hit + 0.04)
    panel = Panel("Rotation", "time, s", "rotation, degrees")
    panel.lines.append(Line("ours", time.tolist(), angle.tolist(), "curve"))
    if full:
        peaks = [i for i in range(5, len(angle) - 5) if abs(angle[i]) > 0.5 and abs(angle[i]) == np.abs(angle[i - 5:i + 6]).max()]
        for number, (peak, reference) in enumerate(zip(peaks, (5.4235, 4.29458, 3.44731))):
            found.row(f"peak {number + 1}", "degrees", reference, float(abs(angle[peak])), 0.03, "rigid body", by_substeps=0.05)
        panel.lines.append(Line("rigid body's peaks", [float(time[i]) for i in peaks[:3]],
                                [math.copysign(r, angle[i]) for i, r in zip(peaks, (5.4235, 4.29458, 3.44731))], "marks"))
    else:
        found.row("speed after the first impact over that before", "", 0.911765, after / before, 0.03, "angular momentum")
    found.panels.append(panel)
    return found


def falling_block(program, full):
    """A fall of one metre and rebounds by a coefficient of restitution."""
    found = Findings("falling_block", "Fall and rebound")
    panel = Panel("Fall from 1 m", "time, s", "height, m")
    for restitution in (0.0, 0.5, 1.0) if full else (0.5,):
        short = {} if full else {"analysis.end_time": 0.8}
        document = program.run("falling_block", {"contact.restitution": restitution, **short})
        time, u = path(document, "centre")
        _, v = path(document, "centre", "velocity")
        height = 1 + u[:, 2]
        hit = int(np.argmax(height <= 0))
        if restitution == (0.0 if full else 0.5):
            found.row("time of the fall", "s", 0.451524, crossing(time, -height, 0.0), 1e-3, "closed form")
            found.row("speed at the floor", "m/s", 4.429447, float(-v[:, 2].min()), 2e-3, "closed form")
        rebound = float(height[hit + 40:].max())
        found.row(f"height of the rebound, restitution {restitution:g}", "m", restitution**2, max(rebound, 0.0), 0.03 if restitution else 1e-3,
                  "closed form", by_substeps=0.12 if restitution else 1e-2)
        panel.lines.append(Line(f"restitution {restitution:g}", time.tolist(), height.tolist(), "curve"))
    found.panels.append(panel)
    fine = {"contact.restitution": 1.0, "analysis.time_step": 0.0001, "analysis.end_time": 0.48}
    if full:
        document = program.run("falling_block", fine)
        time, u = path(document, "centre")
        touching = time[1 + u[:, 2] < 0]
        found.row("largest penetration, 1e8 N/m", "m", 0.0141056, float(-(1 + u[:, 2]).min()), 2e-3, "closed form")
        found.row("time in touch", "s", 9.978882e-3, float(touching[-1] - touching[0]), 0.03, "closed form")
    return found


def colliding_bars(program, full):
    """A bar hits another: stress, time of contact and velocities by the wave equation."""
    found = Findings("colliding_bars", "Impact of two bars")
    document = program.run("colliding_bars", {} if full else {"cover.spacing": [0.04, 0.02, 0.02], "analysis.time_step": 4e-5,
                                                              "monitor.1.point": [0.5, 0.01, 0.01]})
    share = 1 if full else 3
    time, stress = history(document, "left middle", "stress", "xx")
    _, left = history(document, "left end", "velocity", "x")
    _, right = history(document, "right end", "velocity", "x")
    travel = 2 / math.sqrt(1e9 / 2500)
    behind = (time > 1e-4 + 0.35 * travel) & (time < 1e-4 + 0.65 * travel)
    found.row("stress behind the front", "Pa", -790569.4, float(stress[behind].mean()), 0.02 * share, "closed form")
    gone = time > 1e-4 + 1.25 * travel
    # waves of the front that the lattice disperses stay in the bars
    found.row("speed of the bar that came", "m/s", 0, float(left[gone].mean()), 0.03 * share, "closed form")
    found.row("speed of the bar that was at rest", "m/s", 1, float(right[gone].mean()), 0.03 * share, "closed form")
    panel = Panel("Stress in the middle of the left bar", "time, ms", "stress xx, kPa")
    panel.lines.append(Line("ours", (1e3 * time).tolist(), (stress / 1e3).tolist(), "curve"))
    t = 1e3 * np.array([0, 1e-4 + 0.25 * travel, 1e-4 + 0.75 * travel, 5e-3])
    panel.lines.append(Line("closed form", np.repeat(t, 2)[1:-1].tolist(), np.repeat([0, -790.5694, 0], 2).tolist(), "reference"))
    found.panels.append(panel)
    return found


def rolling_prism(program, full):
    """A hexagon begins to roll beyond 30°; of its turning 11/17 is left after each edge that hits."""
    found = Findings("rolling_prism", "Rolling hexagon")
    for angle in (29.5, 30.5) if full else (29.5,):
        still = program.run("rolling_prism", {"gravity": inclined(angle), "analysis.type": "quasi_static", "analysis.time_step": 0.05,
                                              "analysis.end_time": 2.0})
        _, u = path(still, "centre")
        found.row(f"rolls on {angle}°", "", float(angle > 30), float(np.linalg.norm(u[-1] - u[-2]) > 1e-6), 0, "closed form")
    document = program.run("rolling_prism", {} if full else {"analysis.end_time": 1.6})
    time, centre = path(document, "centre")
    _, vertex = path(document, "vertex")
    arm = vertex - centre + [0.999, 0, 0]
    turn = -np.unwrap(np.arctan2(arm[:, 2], arm[:, 0]))
    hit = crossing(time, turn, math.pi / 3)  # by the next one it turns so fast that it has left the plane
    before, after = rate_at(time, turn, hit, hit - 0.05, hit - 0.005), rate_at(time, turn, hit, hit + 0.01, hit + 0.05)
    found.row("turning after the first edge hits, over that before", "", 11 / 17, after / before, 0.03, "angular momentum", by_substeps=0.08)
    panel = Panel("Rate of turning", "time, s", "rad/s")
    panel.lines.append(Line("ours", time.tolist(), np.gradient(turn, time).tolist(), "curve"))
    found.panels.append(panel)
    return found


def spinning_box(program, full):
    """A parabola, and an axis that precesses about the angular momentum."""
    found = Findings("spinning_box", "Spinning box in flight")
    document = program.run("spinning_box", {} if full else {"analysis.time_step": 0.004})
    time, u = path(document, "centre")
    found.row("apex", "m", 5.096840, float(u[:, 2].max()), 1e-4, "closed form")
    found.row("range", "m", 10.193680, float(np.linalg.norm(u[-1])), 1e-6, "closed form")
    about, along = (1 + 9) / 12, (1 + 1) / 12
    momentum = np.array([0.5 * about, 0, 5 * along])
    rate, axis = np.linalg.norm(momentum) / about, momentum / np.linalg.norm(momentum)
    tip = (path(document, "tip")[1] - u + [0, 0, 1.499]) / 1.499
    angle = rate * time[-1]
    e = np.array([0, 0, 1.0])
    expected = e * math.cos(angle) + np.cross(axis, e) * math.sin(angle) + axis * (axis @ e) * (1 - math.cos(angle))
    found.row("axis at the end, off its place", "rad", 0, float(np.linalg.norm(tip[-1] / np.linalg.norm(tip[-1]) - expected)), 1e-4 if full else 1e-3,
              "closed form")
    energy = document["energy"]
    found.row("energy lost", "relative", 0, energy["dissipated"] / energy["kinetic"], 1e-9, "closed form", by_substeps=1e-7)
    panel = Panel("Axis of the box", "x", "y")
    panel.lines.append(Line("ours", tip[:, 0].tolist(), tip[:, 1].tolist(), "curve"))
    found.panels.append(panel)
    return found
