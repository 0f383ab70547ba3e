"""Block theory: in-situ stress on joints round openings, and bolts. Cases as those of statics.py."""
import math

import numpy as np

from contact import inclined
from runner import Findings, Line, Panel

POINTS, WEIGHTS = np.polynomial.legendre.leggauss(16)


def kirsch_plane(point, radius, across, vertical):
    """Stress (2 × 2, x and z) round a circular tunnel under far stresses xx = across, zz = vertical: Kirsch's solution."""
    r, angle = math.hypot(*point), math.atan2(point[1], point[0])
    mean, half, q = (across + vertical) / 2, (across - vertical) / 2, (radius / r) ** 2
    two = 2 * angle
    rr = mean * (1 - q) + half * (1 - 4 * q + 3 * q * q) * math.cos(two)
    tt = mean * (1 + q) - half * (1 + 3 * q * q) * math.cos(two)
    rt = -half * (1 + 2 * q - 3 * q * q) * math.sin(two)
    turn = np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
    return turn @ np.array([[rr, rt], [rt, tt]]) @ turn.T


def mean_traction(ends, normal, stress):
    """Mean of σ n over a straight line between two points."""
    middle, half = (ends[0] + ends[1]) / 2, (ends[1] - ends[0]) / 2
    return sum(w / 2 * stress(middle + g * half) @ normal for g, w in zip(POINTS, WEIGHTS))


def nearest(ends):
    """Distance of a segment from the origin."""
    along = ends[1] - ends[0]
    t = min(1.0, max(0.0, -ends[0] @ along / (along @ along)))
    return float(np.linalg.norm(ends[0] + t * along))


def whole_faces(document, width, depth):
    """Of the joints parallel to the tunnel: their ends, normal and normal stress, where the face is not cut off."""
    (state,) = document["joint_stress"]
    for face in state["faces"]:
        if face["joint"] == "C" or abs(face["area"] - width * depth) > 1e-6:
            continue
        centre, normal = np.array(face["centre"])[[0, 2]], np.array(face["normal"])[[0, 2]]
        along = width / 2 * np.array([-normal[1], normal[0]])
        yield (centre - along, centre + along), normal, face["normal_stress"]


def stressed_tunnel(program, full):
    """Normal stress on joints round a circular tunnel (Kirsch), each joint face by its mean."""
    found = Findings("stressed_tunnel", "Joints round a tunnel under stress")
    radius, far = 2.0, 10e6
    states = (("horizontal stress twice the vertical", -10e6, -5e6), ("stress alike all round", -10e6, -10e6),
              ("horizontal stress alone", -10e6, 0.0)) if full else (("horizontal stress twice the vertical", -10e6, -5e6),)
    panel = Panel("Faces of joints by their distance", "least distance from the axis, radii", "error of normal stress, % of the far stress")
    scatter = Panel("Normal stress on joints", "Kirsch, MPa", "ours, MPa")
    for name, across, vertical in states:
        changes = {"initial_stress.value": [[across, 0, 0], [0, 0.25 * (across + vertical), 0], [0, 0, vertical]]}
        document = program.support("stressed_tunnel", changes)
        exact, ours, distance = [], [], []
        for ends, normal, stress in whole_faces(document, 0.8, 1.0):
            if nearest(ends) < 1.1 * radius:
                continue
            exact.append(normal @ mean_traction(ends, normal, lambda p, a=across, v=vertical: kirsch_plane(p, radius, a, v)))
            ours.append(stress)
            distance.append(nearest(ends) / radius)
        error = (np.array(ours) - np.array(exact)) / far
        worst = int(np.abs(error).argmax())
        found.row(f"{name}: largest error on {len(ours)} faces beyond 1.1 radii, over the far stress", "", 0, float(abs(error[worst])), 0.05, "Kirsch")
        found.row(f"{name}: mean error (root of the mean square)", "", 0, float(np.sqrt((error**2).mean())), 0.015, "Kirsch")
        drawn = slice(None, None, 16)  # of thousands of faces, what a figure can show
        panel.lines.append(Line(f"ours, {name}", distance[drawn], (100 * error[drawn]).tolist(), "marks"))
        scatter.lines.append(Line(f"ours, {name}", (np.array(exact[drawn]) / 1e6).tolist(), (np.array(ours[drawn]) / 1e6).tolist(), "marks"))
    ends = [min(line.x[i] for line in scatter.lines for i in range(len(line.x))), max(line.x[i] for line in scatter.lines for i in range(len(line.x)))]
    scatter.lines.append(Line("equal", ends, ends, "reference"))
    panel.lines.append(Line("5 %", [1.1, 8], [5, 5], "reference"))
    panel.lines.append(Line("_", [1.1, 8], [-5, -5], "reference"))
    found.panels += [scatter, panel]
    return found


def crawford_and_bray(push, half, friction, normal_stiffness, shear_stiffness):
    """N/m that pulls a symmetric roof wedge out (Crawford & Bray 1983); `push`: horizontal force on each side, N/m."""
    s, c = math.sin(half), math.cos(half)
    return (2 * push * (shear_stiffness * c * c + normal_stiffness * s * s) * math.sin(friction - half) /
            (shear_stiffness * c * math.cos(friction) + normal_stiffness * s * math.sin(friction)))


def stressed_wedge(program, full):
    """The force that pulls a roof wedge out, clamped by the stress over a tunnel: Kirsch for the stress, Crawford & Bray for the joints."""
    found = Findings("stressed_wedge", "Roof wedge under stress")
    radius, half, apex = 3.0, math.radians(30), np.array([0.0, 5.0])
    down = np.array([math.sin(half), -math.cos(half)])
    length = min(np.roots([1.0, 2 * apex @ down, apex @ apex - radius**2]).real)  # of the joint, from the apex to the wall
    normal = np.array([math.cos(half), math.sin(half)])
    panel = Panel("Stress alike all round", "friction angle, deg", "pull-out force, kN/m")
    states = (("1 MPa all round", -1e6, -1e6), ("1 MPa across, 0.5 MPa upright", -1e6, -0.5e6)) if full else (("1 MPa all round", -1e6, -1e6),)
    for name, across, vertical in states:
        push = -length * mean_traction((apex, apex + length * down), normal, lambda p, a=across, v=vertical: kirsch_plane(p, radius, a, v))[0]
        for ratio in (0.1, 1.0, 10.0) if full else (1.0,):
            frictions = (35, 40, 45, 50, 55, 60) if full else (45,)
            pull = []
            for friction in frictions:
                changes = {"initial_stress.value": [[across, 0, 0], [0, 0, 0], [0, 0, vertical]], "joint_material.1.friction_angle": friction,
                           "joint_material.1.shear_stiffness": ratio * 10e9}
                document = program.support("stressed_wedge", changes)
                (wedge,) = document["keyblocks"] + document["stable"]
                pull.append(wedge["resisting_force"] / 2)  # the wedge is 2 m long
            exact = [crawford_and_bray(push, half, math.radians(friction), 1.0, ratio) for friction in frictions]
            worst = max(range(len(pull)), key=lambda i: abs(pull[i] / exact[i] - 1))
            found.row(f"{name}, ks/kn = {ratio:g}: pull-out force, friction {frictions[worst]}°", "N/m", exact[worst], pull[worst], 0.05,
                      "Kirsch, Crawford & Bray")
            if name == states[0][0]:
                panel.lines.append(Line(f"ours, ks/kn = {ratio:g}", list(frictions), [p / 1e3 for p in pull], "marks"))
                curve = np.linspace(30, 60, 61)
                panel.lines.append(Line("_" if len(panel.lines) > 1 else "Crawford & Bray", curve.tolist(),
                                        [crawford_and_bray(push, half, math.radians(f), 1.0, ratio) / 1e3 for f in curve], "reference"))
    found.panels.append(panel)
    return found


def slides(resultant, planes):
    """Factor of safety of a block that leans on planes (outward normal, tan φ) under a resultant: Goodman & Shi's vector equilibrium; None: at rest."""
    names = []
    for i, (n, friction) in enumerate(planes):
        normal = resultant @ n
        along = resultant - normal * n
        if normal > 0 and np.linalg.norm(along) > 0 and all(along @ m <= 1e-12 for j, (m, _) in enumerate(planes) if j != i):
            names.append(normal * friction / np.linalg.norm(along))
    for i, (n, f) in enumerate(planes):
        for m, g in planes[i + 1:]:
            line = np.cross(n, m)
            line = line * np.sign(resultant @ line) / np.linalg.norm(line)
            forces = np.linalg.solve(np.column_stack([n, m, line]), resultant)
            if forces[0] > 0 and forces[1] > 0 and forces[2] > 0:
                names.append((forces[0] * f + forces[1] * g) / forces[2])
    if all(resultant @ n <= 0 for n, _ in planes):
        return 0.0
    return min(names) if names else None


def safety(document):
    blocks = document["keyblocks"] + document["stable"]
    return blocks[0]


def anchored_block(program, full):
    """Case G-1: the bolt that a block on a plane of 50° needs at every angle, and what an anchor that presses or drives it makes of it."""
    found = Findings("anchored_block", "Anchored block")
    slope, friction, weight = math.radians(50), math.tan(math.radians(30)), 1e6
    driving, pressing = weight * math.sin(slope), weight * math.cos(slope)

    def bolt(degrees, capacity, action, target=1.0):
        """`degrees`: of the bolt, from straight up the plane over its normal to straight down."""
        angle = math.radians(degrees)
        changes = {"gravity": inclined(50), "bolt.1.direction": [-math.cos(angle), 0.0, -math.sin(angle)], "bolt.1.force_capacity": capacity,
                   "bolt.1.action": action, "support.target_factor_of_safety": target}
        return safety(program.support("anchored_block", changes))

    # Bolts as strong as Hoek's formula asks for bring the block to the target.
    for action, target, angles in (("active", 1.0, (0, 30, 60, 90)), ("active", 1.5, (0, 30, 60, 75)), ("passive", 1.5, (0, 60, 90))):
        for normal_angle in angles if full else angles[:1]:  # from the plane's normal, as Hoek's
            a = math.radians(normal_angle)
            up = target if action == "active" else 1.0
            need = (target * driving - pressing * friction) / (math.cos(a) * friction + up * math.sin(a))
            if normal_angle == 90:  # a bolt along the plane never meets it
                continue
            block = bolt(90 - normal_angle, need, action, target)
            found.row(f"{action}, {need / 1e3:.4f} kN at {normal_angle}° to the normal: factor of safety", "", target,
                      block["supported_factor_of_safety"], 1e-9, "Hoek & Bray")
    panel = Panel("A bolt of 200 kN, plane of 50°, friction 30°", "angle of the bolt to the direction up the plane, deg", "factor of safety")
    angles = range(10, 171, 10) if full else (30, 90, 150)
    for action in ("active", "passive"):
        exact, ours = [], []
        for degrees in angles:
            a = math.radians(degrees)
            up, into = 200e3 * math.cos(a), 200e3 * math.sin(a)
            if action == "active":
                exact.append((pressing + into) * friction / (driving - up))
            else:  # beyond 90° it has only shear, of which none is given
                exact.append((up + (pressing + into) * friction) / driving if degrees <= 90 else None)
            ours.append(bolt(degrees, 200e3, action)["supported_factor_of_safety"])
        known = [i for i, value in enumerate(exact) if value is not None]
        worst = max(known, key=lambda i: abs(ours[i] / exact[i] - 1))
        found.row(f"{action} bolt of 200 kN at {list(angles)[worst]}°, the worst of {len(known)} angles", "", exact[worst], ours[worst], 1e-9, "statics")
        panel.lines.append(Line(f"ours, {action}", list(angles), ours, "marks"))
        panel.lines.append(Line(f"{action}, statics", [list(angles)[i] for i in known], [exact[i] for i in known], "reference"))
    found.panels.append(panel)
    return found
