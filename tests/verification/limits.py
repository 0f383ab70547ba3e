"""Structures of blocks at the limit of their friction or their shape, against limit equilibrium and linear programmes."""
import math

import numpy as np

import goodman_bray as slope
from contact import path
from runner import Findings, Line, Panel, monitor

THICKNESS = 10.0          # m along the strike, of the toppling slope
BEYOND = 13               # steps, after which its tilt is gone
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
    resting = run(limit + 0.003, **{"analysis.steps": 400})  # friction between blocks 3 and 4 may take hundreds of steps to come to work
    _, u = path(resting, crest)
    found.row("motion of the crest in the last step, tan φ 0.003 above the limit", "m", 0, float(np.linalg.norm(u[-1] - u[-2])), 1e-9, "limit equilibrium")
    near = run(limit + 2e-4)
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
        rates = [1e3 * max(0.0, -float(accelerations(run(mu, **changes), [f"top {slope.CREST}"])[0])) for mu in frictions]
        panel.lines.append(Line(label, frictions, rates))
    panel.lines.append(Line("limit equilibrium", [limit, limit], [0, max(panel.lines[0].y)], "reference"))
    return panel
