"""Blocks at rest under their weight: joints bear it, and nothing creeps."""
import math

import numpy as np

from contact import G, path
from runner import Findings, Line, Panel, monitor

FLOOR = 1e-40  # what a logarithmic axis shows for nothing


def mechanical(document):
    """Mechanical energy over time."""
    history = document["energy_history"]
    return sum(np.array(history[part]) for part in ("kinetic", "strain", "potential", "contact"))


def sideways(document):
    """The horizontal part of what supports bear, over the vertical one."""
    x, y, z = document["reaction"]
    return math.hypot(x, y) / z


def coming_to_rest(*documents):
    """Kinetic energy of the steps, label by label."""
    panel = Panel("Coming to rest", "step", "kinetic energy, J", log="y")
    for label, document in documents:
        kinetic = np.maximum(document["energy_history"]["kinetic"][1:], FLOOR)
        panel.lines.append(Line(label, list(range(1, len(kinetic) + 1)), kinetic.tolist(), "curve"))
    return panel


def stays(document, found, first, size):
    """Rows of a last dynamic step that begins behind step `first`: what moves by what share of a block, what energy comes from nowhere."""
    creep = max(np.linalg.norm(block["displacement"]) for block in document["blocks"])
    steps = document["totals"]["steps"] - first
    found.row(f"motion of any block in {steps} steps at rest, over its size", "relative", 0, float(creep / size), 1e-6, "rest")
    energy = mechanical(document)
    rise = (energy[first + 1:] - energy[first]).max() / (energy[0] - energy[first])
    found.row(f"energy above that at the start of {steps} steps, over what settling took", "relative", 0, float(max(rise, 0.0)), 1e-9,
              "no load does work")


def brick_wall(program, full):
    """A wall of 120 merged bricks bears its weight. Cells of half a brick are what a brick has in common with one of the next course."""
    found = Findings("brick_wall", "Brick wall under its weight")
    cells = [(0.125 * (i + 0.5), 0.0625) for i in range(12)] + [(0.0625, 0.125 * (i + 1.5)) for i in range(7)]
    steps = 60  # it is at rest after some 30
    text = ""
    for i, (x, y) in enumerate(cells):
        text += f'[[monitor]]\nname = "{i}"\njoint = "bed"\npoint = [{x}, {y}, 0.075]\n'
    document = program.run("brick_wall", {"step.2.steps": 500 if full else 10}, lambda model: model + text)
    stress = np.array([monitor(document, str(i))["normal_stress"][-1] for i in range(len(cells))])
    weight = 1800 * G
    found.row("mean normal stress in the lowest bed joint", "Pa", -weight * 0.825, float(stress.mean()), 1e-2, "weight above over area")
    course = [block for block in document["blocks"] if block["id"] <= 10]
    volume = np.array([block["volume"] for block in course])
    inside = volume @ [block["stress"][2] for block in course] / volume.sum()
    found.row("mean vertical stress in the lowest course", "Pa", -weight * (0.9 - 0.0375), float(inside), 1e-2, "weight over area")
    found.row("force on the ground", "N", weight * 0.2671875, document["reaction"][2], 1e-6, "weight")
    found.row("thrust on the ground, over the weight", "relative", 0, sideways(document), 1e-6, "balance")
    found.row("slip of any joint, over a brick", "relative", 0, document["contacts"]["max_slip"] / 0.25, 1e-4, "it stands")
    stays(document, found, steps, 0.25)
    panel = Panel("Lowest bed joint of the wall to the east", "x, m", "normal stress, kPa")
    panel.lines.append(Line("ours, by half bricks", [x for x, _ in cells[:12]], (stress[:12] / 1e3).tolist(), "marks"))
    panel.lines.append(Line("weight above over area", [0, 1.5], [-weight * 0.825 / 1e3] * 2, "reference"))
    found.panels += [panel, coming_to_rest(("quasi-static, then dynamic", document))]
    return found


def jointed_slope(program, full):
    """10,000 steps of a slope of 198 blocks at rest, after quasi-static gravity; a quarter of its blocks in the fast variant."""
    found = Findings("jointed_slope", "Jointed slope at rest")
    wide = {"joint_set.1.spacing": 5.2, "joint_set.2.spacing": 6.0, "joint_set.3.spacing": 3.0, "step.2.steps": 20}
    document = program.run("jointed_slope", {"step.2.steps": 10000} if full else wide)
    settling = 60
    weight = 2600 * G * 8 * (4 * 20 + 12 * (12 - 6 / math.tan(math.radians(65))))
    found.row("vertical force on the rock around", "N", weight, document["reaction"][2], 1e-6, "weight")
    found.row("horizontal force on the rock around, over the weight", "relative", 0, sideways(document), 1e-6, "balance")
    stays(document, found, settling, 2.0)
    _, crest = path(document, "crest")
    found.row("motion of the crest in the last step", "m", 0, float(np.linalg.norm(crest[-1] - crest[-2])), 1e-12, "rest")
    panel = coming_to_rest(("gravity, quasi-static", document))
    for line in panel.lines:
        line.x, line.y = line.x[:settling], line.y[:settling]
    found.panels.append(panel)
    return found
