"""Limit analysis of arches of voussoirs that neither slide nor crush: a linear programme, solved by looking at every vertex.

Joints bear pressure only, friction keeps them from sliding (whether it does is asked afterwards): an arch stands if there is a line of thrust in it
(Heyman, The stone skeleton, Int. J. Solids Structures 2, 1966, 249). With the force and its moment at the first joint as unknowns, the thrust at any
joint is linear in them and in the load, and lies between the joint's ends where its moments about them have opposite signs.

An arch is {"inner": [n+1][2], "outer": [n+1][2]}, the ends of its joints, counter-clockwise from the right springing; m. Voussoirs are the
quadrilaterals between, unless "voussoirs" has their areas and centroids. Weights are areas: forces in units of density, gravity and a metre of width.
"""
import itertools
import math

import numpy as np


def cross(a, b):
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]


def areas_and_centroids(arch):
    """[n], [n][2] of the voussoirs: of a quadrilateral by two triangles."""
    if "voussoirs" in arch:
        return arch["voussoirs"]
    a, b, c, d = arch["inner"][:-1], arch["outer"][:-1], arch["outer"][1:], arch["inner"][1:]
    parts = [(cross(q - p, r - p) / 2, (p + q + r) / 3) for p, q, r in ((a, b, c), (a, c, d))]
    area = sum(part for part, _ in parts)
    return area, sum(part[:, None] * middle for part, middle in parts) / area[:, None]


def conditions(arch, loads):
    """Rows [2 (n+1)][3 + len(loads) - 1] and constants of: rows v + constants >= 0, v = (force at joint 0, its moment, factors of the further loads).

    loads: [k][2], a force on a unit of area; the first is there as it is, the others by a factor each.
    """
    area, middle = areas_and_centroids(arch)
    rows, constants = [], []
    for end, sign in (("inner", 1.0), ("outer", -1.0)):
        for i, point in enumerate(arch[end]):
            levers = [sum(area[k] * cross(middle[k] - point, load) for k in range(i)) for load in np.asarray(loads, float)]
            rows.append(sign * np.array([point[1], -point[0], 1.0, *levers[1:]]))
            constants.append(sign * levers[0])
    return np.array(rows), np.array(constants)


def highest(rows, constants, aim, near=1e-9):
    """The v of the largest aim v with rows v + constants >= 0, and which rows hold it. None where no v meets all of them."""
    scale = np.abs(rows).max()
    sets = np.array(list(itertools.combinations(range(len(rows)), rows.shape[1])))
    found, best = None, -math.inf
    for some in np.array_split(sets, max(1, len(sets) // 20000)):
        some = some[np.abs(np.linalg.det(rows[some] / scale)) > 1e-13]
        v = np.linalg.solve(rows[some], -constants[some][..., None])[..., 0]
        meets = (v @ rows.T + constants >= -near * scale).all(1)
        value = np.where(meets, v @ aim, -math.inf)
        if len(value) and value.max() > best:
            best, found = value.max(), (v[value.argmax()], some[value.argmax()])
    return found


def tilt(arch):
    """The horizontal load over the weight, to the left, with which the arch fails; {joint: "inner" or "outer"} of its hinges; the steepest
    friction that the thrust asks for. None where it does not stand with any."""
    loads = [[0, -1], [-1, 0]]
    rows, constants = conditions(arch, loads)
    if (best := highest(rows, constants, np.array([0, 0, 0, 1.0]))) is None:
        return None
    v, held = best
    joints = len(arch["inner"])
    hinges = {int(i % joints): "inner" if i < joints else "outer" for i in held}
    area, _ = areas_and_centroids(arch)
    thrust = v[:2] + np.concatenate([[0], area.cumsum()])[:, None] * np.array([-v[3], -1])
    along = arch["outer"] - arch["inner"]
    return float(v[3]), hinges, float(np.abs((thrust * along).sum(1) / cross(along, thrust)).max())


def semicircle(voussoirs, thickness, curved=False):
    """Radial joints at equal angles, of the mean radius 1. `curved`: voussoirs are sectors of a ring, not quadrilaterals."""
    angles = np.linspace(0, math.pi, voussoirs + 1)
    around = np.stack([np.cos(angles), np.sin(angles)], 1)
    arch = {"inner": (1 - thickness / 2) * around, "outer": (1 + thickness / 2) * around}
    if curved:
        half, middle = math.pi / voussoirs / 2, (angles[:-1] + angles[1:]) / 2
        far = (1 + thickness**2 / 12) * math.sin(half) / half
        arch["voussoirs"] = np.full(voussoirs, 2 * half * thickness), far * np.stack([np.cos(middle), np.sin(middle)], 1)
    return arch


def least_thickness(voussoirs, curved=False):
    """Of a semicircular arch under its weight, over its mean radius. By symmetry the force at the springing bears half the weight."""
    low, high = 0.08, 0.13
    while high - low > 1e-8:
        middle = (low + high) / 2
        arch = semicircle(voussoirs, middle, curved)
        rows, constants = conditions(arch, [[0, -1]])
        half = areas_and_centroids(arch)[0].sum() / 2
        constants, rows = constants + half * rows[:, 1], rows[:, [0, 2]]
        spare = -np.ones((len(rows), 1))  # the moment about all ends that is left over
        enough = highest(np.hstack([rows, spare]), constants, np.array([0, 0, 1.0]))[0][2] >= 0
        low, high = (low, middle) if enough else (middle, high)
    return high
