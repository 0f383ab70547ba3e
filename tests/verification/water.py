"""Water in joints of rock in motion, against limit equilibrium. Cases as those of statics.py."""
import math
import re

from contact import G, path, radians
from runner import Findings, Line, Panel

GAMMA = 1000 * G


def hoek_and_bray(head, friction=38.0, cohesion=20e3):
    """Of the model's block: plane of 30 degrees, crack at x = 10 from z = 5.77 to 10."""
    dip, foot = radians(30), 10 * math.tan(radians(30))
    area, crack = 10 / math.cos(dip), max(0.0, head - foot)
    face = 10 / math.tan(radians(60))
    weight = 2600 * G * (10 * (10 - face) + face * 10 / 2 - 10 * foot / 2)
    push, uplift = GAMMA * crack**2 / 2, GAMMA * crack * area / 2
    pressed = weight * math.cos(dip) - uplift - push * math.sin(dip)
    return (cohesion * area + pressed * math.tan(radians(friction))) / (weight * math.sin(dip) + push * math.cos(dip))


def middle(document):
    found = document["reduction"]
    return (found["stands"] + found["fails"]) / 2


def wet_slope(program, full):
    """Hoek & Bray's plane below a crack with water; a wedge under water beside block theory; a dam on a joint with uplift."""
    found = Findings("wet_slope", "Water in joints of rock in motion")
    heads = (5.0, 7.0, 8.0, 9.0, 10.0) if full else (9.0,)
    factors = []
    for head in heads:
        document = program.run("wet_slope", {"water.1.head": head})
        factors.append(middle(document))
        found.row(f"factor of the slope, water up to {head:g} m", "", hoek_and_bray(head), factors[-1], 1e-2, "Hoek & Bray")
        key, = [k for k in document["support"]["keyblocks"] + document["support"]["stable"] if k["mode"] == "single_plane"][:1]
        found.row(f"the same by block theory, {head:g} m", "", hoek_and_bray(head), key["factor_of_safety"], 1e-3, "Hoek & Bray")
    line = [5.0 + 0.1 * k for k in range(51)]
    panel = Panel("Slope with a crack", "water over the toe, m", "factor of safety")
    panel.lines += [Line("Hoek & Bray", line, [hoek_and_bray(h) for h in line], "reference"), Line("ours, in motion", list(heads), factors, "marks")]
    if full:
        found.panels.append(panel)
    dam(program, found, full)
    return found


DAM = """gravity = [0, 0, -9.81]
[[material]]
density = 2400
young_modulus = 2e10
poisson_ratio = 0.2
[[joint_material]]
name = "base"
friction_angle = 32
[[solid]]
name = "rock"
shape = "box"
min = [-10, 0, -5]
max = [24, 1, 0]
[[solid]]
name = "dam"
shape = "prism"
base = [[0, 0, 0], [9, 0, 0], [2, 0, 12], [0, 0, 12]]
extrude = [0, 1, 0]
interface = "base"
[[traction]]
where = {face = "dam.3"}
head = HEAD
[[water]]
joints = ["dam.interface"]
head = HEAD
law = "LAW"
[cover]
lattice = "block"
[[fixed]]
where = {block_at = [-5, 0.5, -2]}
[[step]]
type = "quasi_static"
time_step = 0.02
steps = 10
[[step]]
type = "dynamic"
time_step = 0.01
end_time = 1.0
reset_displacement = true
[output]
every = 0
[[monitor]]
name = "dam"
point = [2, 0.5, 3]
"""


def dam(program, found, full):
    """On a joint with the whole head under its heel and none at its toe: the head at which friction is used up."""
    weight, friction = 2400 * G * (2 + 9) / 2 * 12, math.tan(radians(32))
    # gamma h^2/2 = tan phi (W - gamma h b/2)
    head = -4.5 * friction + math.sqrt((4.5 * friction)**2 + 2 * friction * weight / GAMMA)
    for share in (0.99, 1.01):
        text = re.sub("LAW", "drained", re.sub("HEAD", f"{share * head!r}", DAM))
        document = program.run("wet_slope", edit=lambda _, text=text: text)
        way = float(path(document, "dam")[1][-1][0])
        expected = 0.0 if share < 1 else 0.5 * (GAMMA * (share * head)**2 / 2 - friction * (weight - GAMMA * share * head * 4.5)) / (weight / G)
        if share < 1:
            found.row("way of a dam at 99 % of its critical head, in 1 s", "m", 0, way, 1e-4, "stays")
        else:
            found.row("way of a dam at 101 % of its critical head, in 1 s", "m", expected, way, 0.1, "limit equilibrium")
