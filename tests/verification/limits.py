"""Structures of blocks at the limit of their friction or their shape, against limit equilibrium and linear programmes."""
import math
import random

import numpy as np

import arches
import goodman_bray as slope
from contact import path
from runner import Findings, Line, Panel, monitor

THICKNESS = 10.0          # m along the strike, of the toppling slope
BEYOND = 65               # steps, after which its tilt is gone
TIME_STEP = 0.1           # s
TURNED = 1e-3             # rad, by which its blocks turn until a motion is measured: levers change by as much, and what friction must be


def accelerations(document, names):
    """Of points in quasi-static steps, which begin at rest and go β a Δt² far: the median of the last ten, along x."""
    ways = np.array([np.diff(path(document, name)[1][-11:, 0]) for name in names])
    return np.median(ways, axis=1) / (0.25 * TIME_STEP**2)


def modes(document):
    """{block: "topples", "slides" or "stays"}, by what moves after the tilt is gone."""
    found, moved = {}, {}
    for n in range(1, slope.BLOCKS + 1):
        foot, top = (path(document, f"{place} {n}")[1][:, 0] for place in ("foot", "top"))
        foot, top = foot[-1] - foot[BEYOND + 1], top[-1] - top[BEYOND + 1]
        moved[n] = (abs(foot), abs(top - foot))
    much = 0.01 * max(max(pair) for pair in moved.values())
    for n, (way, tip) in moved.items():
        found[n] = "topples" if tip > much else "slides" if way > much else "stays"
    return found


def pressed(document, n):
    """Force between blocks n and n + 1, kN/m: mean stress over the height that they have in common."""
    low, high = n + 1, min(n + 1 + slope.height(n + 1), n + slope.height(n))
    return -monitor(document, f"joint {n + 1}")["normal_stress"][-1] * (high - low) / 1e3


def bolted(force, z=3.0):
    """An edit: a horizontal force of so many kN/m on block 1."""
    x, down = (1e3 * THICKNESS * force * part for part in (math.cos(slope.ALPHA), -math.sin(slope.ALPHA)))
    return lambda model: model + f"\n[[point_load]]\npoint = [5, 5, {z}]\nforce = [{x!r}, 0, {down!r}]\n"


def toppling_slope(program, full):
    """Goodman & Bray's example. What topples, slides and stays; the friction and the bolt that just hold it."""
    found = Findings("toppling_slope", "Toppling slope")
    limit = slope.limiting_friction()
    found.row("limiting tan φ, our limit equilibrium beside the published one", "", 0.7855, limit, 1e-4, "Goodman & Bray 1976")

    def run(mu, edit=None, **changes):
        return program.run("toppling_slope", {"joint_material.1.friction_angle": math.degrees(math.atan(mu)), **changes}, edit)

    below = [limit - 0.006, limit - 0.003]
    documents = [run(mu) for mu in below]
    wanted, seen = slope.forces(below[1])[1], modes(documents[1])
    kinds = ", ".join(f"{sum(mode == kind for mode in wanted.values())} {name}" for kind, name in (
        ("topples", "topple"), ("slides", "slide"), ("stays", "stay")))
    found.row(f"of 16 blocks ({kinds}) do otherwise, tan φ 0.003 below the limit", "", 0, float(sum(seen[n] != wanted[n] for n in wanted)), 0,
              "Goodman & Bray 1976")
    crest = f"top {slope.CREST}"
    rates = [-float(accelerations(document, [crest])[0]) for document in documents]
    found.row("tan φ at which the acceleration of the crest is zero", "", limit, below[0] + (below[1] - below[0]) * rates[0] / (rates[0] - rates[1]),
              TURNED, "limit equilibrium")
    resting = run(limit + 0.003, **{"step.2.steps": 600})  # friction between blocks 3 and 4 may take hundreds of steps to come to work
    _, u = path(resting, crest)
    found.row("motion of the crest in the last step, tan φ 0.003 above the limit", "m", 0, float(np.linalg.norm(u[-1] - u[-2])), 1e-9, "limit equilibrium")
    near = run(limit + 2e-4, **{"step.2.steps": 400})
    expected, mode = slope.forces(limit)
    off = max(abs(pressed(near, n) - expected[n]) for n in range(1, slope.BLOCKS) if mode[n + 1] == "topples") / max(expected.values())
    found.row("forces of the blocks that topple on those before, off the largest, at the limit", "relative", 0, off, 3 * TURNED, "Goodman & Bray 1976")
    if full:
        bolts(run, found)
        found.panels += [forces_panel(near, expected), friction_panel(run, limit)]
    return found


def bolts(run, found):
    """The horizontal force on block 1 at which the acceleration is zero, where friction is too low. It falls by a hundredth for TURNED more friction."""
    for mu in (0.65, 0.70):
        force = slope.bolt_force(mu)
        shares = (0.95, 0.98)
        rates = [-float(accelerations(run(mu, bolted(share * force)), [f"top {slope.CREST}"])[0]) for share in shares]
        zero = shares[0] + (shares[1] - shares[0]) * rates[0] / (rates[0] - rates[1])
        found.row(f"force on block 1 that holds the slope, tan φ {mu:.2f}", "kN/m", force, zero * force, 10 * TURNED, "Goodman & Bray 1976")


def forces_panel(document, expected):
    panel = Panel("Forces between blocks at the limit", "block", "force on it from above, MN/m")
    blocks = list(range(1, slope.BLOCKS))
    panel.lines.append(Line("Goodman & Bray", blocks, [expected[n] / 1e3 for n in blocks], "reference"))
    panel.lines.append(Line("ours", blocks, [pressed(document, n) / 1e3 for n in blocks], "marks"))
    return panel


def friction_panel(run, limit):
    """What a tilt before does: without one faces still bear as a whole, and the slope stands with less friction."""
    panel = Panel("Acceleration of the crest", "tan φ", "acceleration, mm/s²")
    frictions = [0.760, 0.764, 0.768, 0.772, 0.775, 0.777, 0.780, 0.783, 0.785, 0.786, 0.788, 0.790]
    for label, changes in (("ours, after a tilt", {}), ("ours, weight alone", {"base_acceleration.scale": 0.0})):
        changes = {"step.2.steps": 300, **changes}  # above the limit it takes so many to come to rest
        rates = [1e3 * max(0.0, -float(accelerations(run(mu, **changes), [f"top {slope.CREST}"])[0])) for mu in frictions]
        panel.lines.append(Line(label, frictions, rates))
    panel.lines.append(Line("limit equilibrium", [limit, limit], [0, max(panel.lines[0].y)], "reference"))
    return panel


RADIUS = 10.0             # m, mean, of arches
ARCH_STEP = 0.02          # s
SHARES = (0.01, 0.02)     # beyond the limit, where accelerations are measured


def rounded(arch):
    """The arch with corners of nine decimals in m, as a model has them."""
    return {end: np.round(RADIUS * arch[end], 9) for end in ("inner", "outer")}


def watched(arch):
    """[n][2][2]: the inner and outer end of each voussoir's middle line, a little inside."""
    ends = np.stack([(arch[end][1:] + arch[end][:-1]) / 2 for end in ("inner", "outer")], axis=1)
    return np.round(0.98 * ends + 0.02 * ends.mean(1, keepdims=True), 9)


def arch_solids(arch):
    """Voussoirs 1, 2, … from the right and two abutments, which are held; monitors at the ends of the voussoirs' middle lines."""
    inner, outer = arch["inner"], arch["outer"]

    def solid(name, corners):
        base = ", ".join(f"[{x!r}, 0, {z!r}]" for x, z in corners.tolist())
        return f'\n[[solid]]\nname = "{name}"\nshape = "prism"\nbase = [{base}]\nextrude = [0, 1, 0]\ninterface = "rough"\n'

    text = ""
    for name, end, beside in (("right", 0, 1), ("left", -1, -2)):  # as voussoirs beyond the springing would be
        back = np.round(np.array([2 * outer[end] - outer[beside], 2 * inner[end] - inner[beside]]), 9)
        corners = np.array([inner[end], outer[end], *back])
        x, z = np.round(corners.mean(0), 9).tolist()
        text += solid(name, corners) + f"\n[[fixed]]\nwhere = {{block_at = [{x!r}, 0.5, {z!r}]}}\n"
    for k, ends in enumerate(watched(arch).tolist()):
        text += solid(k + 1, np.array([inner[k], outer[k], outer[k + 1], inner[k + 1]]))
        for name, (x, z) in zip(("inner", "outer"), ends):
            text += f'\n[[monitor]]\nname = "{name} {k + 1}"\npoint = [{x!r}, 0.5, {z!r}]\n'
    return text


def with_arch(arch):
    """An edit: the case's material, joints and steps with the solids of another arch."""
    return lambda model: model[:model.index("\n[[solid]]")] + arch_solids(arch)


def motion(document, arch):
    """The largest acceleration in the last step, and the hinges that turn in it, as arches.tilt tells them."""
    places = watched(arch)
    ways = np.array([[np.diff(path(document, f"{name} {k + 1}")[1][-2:], axis=0)[0][[0, 2]] for name in ("inner", "outer")] for k in range(len(places))])
    along = places[:, 1] - places[:, 0]
    turns = np.diff(arches.cross(along, ways[:, 1] - ways[:, 0]) / (along**2).sum(1), prepend=0.0, append=0.0)
    hinges = {i: "inner" if turn > 0 else "outer" for i, turn in enumerate(turns.tolist()) if abs(turn) > 0.05 * np.abs(turns).max()}
    return float(np.linalg.norm(ways, axis=2).max()) / (0.25 * ARCH_STEP**2), hinges


def zero(x, y):
    """Where the line through two points crosses zero."""
    return float(x[0] - y[0] * (x[1] - x[0]) / (y[1] - y[0]))


def voussoir_arch(program, full):
    """Semicircular arches: the least thickness with which they stand under their weight."""
    found = Findings("voussoir_arch", "Semicircular arch of voussoirs")
    found.row("least thickness over radius, 20 sectors, our linear programme", "", 0.107478, arches.least_thickness(20, curved=True), 1e-3,
              "Milankovitch 1907, without end many")
    panel = Panel("Acceleration under its weight", "thickness over radius", "acceleration, m/s²")
    for voussoirs in (20, 7, 11, 15) if full else (20,):
        least = arches.least_thickness(voussoirs)
        thin = [(1 - share) * least for share in SHARES]
        found_at = []
        for thickness in thin:
            arch = rounded(arches.semicircle(voussoirs, thickness))
            acceleration, hinges = motion(program.run("voussoir_arch", edit=with_arch(arch)), arch)
            found_at.append(acceleration)
        found.row(f"least thickness over radius, {voussoirs} voussoirs", "", least, zero(thin, found_at), 1e-3, "linear programme")
        if voussoirs == 20:
            found.row("hinges at springings, haunches and crown", "", 5, float(len(hinges)), 0, "Heyman 1966")
        panel.lines.append(Line(f"ours, {voussoirs} voussoirs", thin, found_at))
        panel.lines.append(Line("linear programme" if voussoirs == 20 else "_", [least, least], [0, max(found_at)], "reference"))
    document = program.run("voussoir_arch")
    arch = rounded(arches.semicircle(20, 1.03 * arches.least_thickness(20)))
    found.row("acceleration of an arch 3 % thicker", "m/s²", 0, motion(document, arch)[0], 1e-9, "stands")
    if full:
        found.panels += [panel, falling(program, found)]
    return found


def falling(program, found):
    """Arches 3 % thinner and thicker than they must be, in motion from rest."""
    panel = Panel("Arches of 20 voussoirs let go", "time, s", "way of the crown down, m")
    for label, share in (("3 % thinner", 0.97), ("3 % thicker", 1.03)):
        arch = rounded(arches.semicircle(20, share * arches.least_thickness(20)))
        document = program.run("voussoir_arch", {"analysis.type": "dynamic", "analysis.time_step": 0.005, "analysis.steps": 260}, with_arch(arch))
        time, u = path(document, "outer 10")
        panel.lines.append(Line(label, time.tolist(), (-u[:, 2]).tolist(), "curve"))
    found.row("way of the crown in 1.3 s of one 3 % thicker, weight put on at once", "m", 0, float(np.abs(u[:, 2]).max()), 1e-3, "stands")
    return panel


def random_arch(draw, voussoirs=20):
    """An arch of voussoirs of all lengths between joints that lean, its tilt at failure, the hinges and the friction that it needs then."""
    while True:
        shares = np.cumsum([0.0] + [draw.uniform(0.5, 1.5) for _ in range(voussoirs)])
        angles = math.pi * shares / shares[-1]
        middle, thickness, lean = (np.array([draw.uniform(*span) for _ in angles]) for span in ((0.95, 1.05), (0.15, 0.3), (-0.12, 0.12)))
        centre = middle[:, None] * np.stack([np.cos(angles), np.sin(angles)], 1)
        half = thickness[:, None] / 2 * np.stack([np.cos(angles + lean), np.sin(angles + lean)], 1)
        arch = rounded({"inner": centre - half, "outer": centre + half})
        corners = np.stack([arch["inner"][:-1], arch["outer"][:-1], arch["outer"][1:], arch["inner"][1:]])
        sides = np.roll(corners, -1, 0) - corners
        if arches.cross(sides, np.roll(sides, -1, 0)).min() > 0 and (failure := arches.tilt(arch)) and failure[0] > 0.02:
            return arch, *failure


def random_arches(program, full):
    """Random voussoirs under their weight and a horizontal load, which grows until they fail."""
    found = Findings("random_arches", "Random arches")
    draw, wrong, worst, moved, steepest = random.Random(17), 0, 0.0, 0.0, 0.0
    expected, seen = [], []
    count = 30 if full else 2
    for _ in range(count):
        arch, most, hinges, friction = random_arch(draw)
        tilts, found_at = [(1 + share) * most for share in SHARES], []
        for tilt in tilts:
            acceleration, opened = motion(program.run("random_arches", {"gravity": [-10 * tilt, 0, -10]}, with_arch(arch)), arch)
            found_at.append(acceleration)
        wrong += opened != hinges
        expected.append(most)
        seen.append(zero(tilts, found_at))
        worst, steepest = max(worst, abs(seen[-1] - most)), max(steepest, friction)
        below = {"gravity": [-9.8 * most, 0, -10], "analysis.steps": 100}  # as near to failure some take more than 30 to settle
        moved = max(moved, motion(program.run("random_arches", below, with_arch(arch)), arch)[0])
    # the give of joints of 1e12 Pa/m; ten times as stiff ones are ten times as near
    found.row(f"largest error of the horizontal load at which one of {count} arches fails, over the weight", "", 0, worst, 1e-4, "linear programme")
    found.row(f"of {count} arches open at other joints", "", 0, float(wrong), 0, "linear programme")
    found.row("acceleration 2 % below", "m/s²", 0, moved, 1e-9, "stands")
    found.row("steepest friction that a thrust asks for, over that of the joints, is less than 1", "", 0, float(steepest >= math.tan(math.radians(60))), 0,
              "no joint slides")
    panel = Panel("Horizontal load over weight at failure", "linear programme", "ours")
    panel.lines.append(Line("_", [0, max(expected)], [0, max(expected)], "reference"))
    panel.lines.append(Line("ours", expected, seen, "marks"))
    found.panels.append(panel)
    return found
