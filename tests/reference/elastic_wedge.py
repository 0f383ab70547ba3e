"""A rigid wedge, free to turn, on two planes whose joints are elastic with Coulomb's friction, under a record of the ground: explicit steps over many
points of its faces. The wedge is what lies above both planes, which meet in the origin, in a box."""
import math

import numpy as np
from newmark_wedge import G, Ground, line_of, upward

DENSITY = 2500.0     # kg/m3
SETTLING = 0.5       # s, in which it comes to rest under its weight
DRAG = 100.0         # 1/s, of the mass, meanwhile


def skew(r):
    """[n, 3, 3] of r x."""
    zero = np.zeros(len(r))
    return np.stack([zero, -r[:, 2], r[:, 1], r[:, 2], zero, -r[:, 0], -r[:, 1], r[:, 0], zero], 1).reshape(-1, 3, 3)


class Wedge:
    def __init__(self, planes, low, high, cells=60, points=24):
        self.normals = np.array([upward(*plane) for plane in planes])
        self.line = np.array(line_of(*map(tuple, self.normals)))
        low, high = np.array(low, float), np.array(high, float)
        axes = [low[d] + (np.arange(cells) + 0.5) * (high[d] - low[d]) / cells for d in range(3)]
        x = np.stack(np.meshgrid(*axes, indexing="ij"), -1).reshape(-1, 3)
        x = x[(x @ self.normals.T > 0).all(1)]
        mass = DENSITY * np.prod((high - low) / cells)
        self.mass, self.centroid = mass * len(x), x.mean(0)
        r = skew(x - self.centroid)
        self.inverse_inertia = np.linalg.inv(mass * np.einsum("nij,nkj->ik", r, r))
        reach = 2 * np.linalg.norm(high - low)
        self.faces = [self.points_of(f, low, high, reach / points / 2) for f in (0, 1)]

    def points_of(self, face, low, high, size):
        """Middles of small squares on a face."""
        n = self.normals[face]
        across = np.cross(n, self.line)
        count = int(np.ceil(np.linalg.norm(high - low) / size))
        steps = (np.arange(-count, count) + 0.5) * size
        x = (steps[:, None, None] * self.line + steps[None, :, None] * across).reshape(-1, 3)
        inside = (x @ self.normals[1 - face] > 0) & (x > low).all(1) & (x < high).all(1)
        return x[inside] - self.centroid, size**2

    def slide(self, friction, rows, end, normal, ratio, step=4e-5):
        """m down the line. `normal`: Pa/m; shear stiffness is `ratio` times that. Its normal motion is damped, or friction shakes it."""
        mu, ground = math.tan(math.radians(friction)), Ground(rows)
        r = np.concatenate([points for points, _ in self.faces])
        n = np.repeat(self.normals, [len(points) for points, _ in self.faces], 0)
        area = np.concatenate([np.full(len(points), a) for points, a in self.faces])[:, None]
        drag = 1.4 * math.sqrt(normal * self.mass / area.sum())
        x, v, turn, spin = (np.zeros(3) for _ in range(4))
        stretch, begun = np.zeros_like(r), 0.0
        for k in range(round((SETTLING + end) / step)):
            t = k * step - SETTLING
            if t < 0:
                begun = x @ self.line
            a = np.array(ground.at(t) if t >= 0 else (0.0, 0.0, 0.0))
            gap = ((x + np.cross(turn, r)) * n).sum(1, keepdims=True)
            speed = v + np.cross(spin, r)
            opening = (speed * n).sum(1, keepdims=True)
            pressure = np.where(gap < 0, np.maximum(0, -normal * gap - drag * opening), 0)
            stretch += step * (speed - opening * n)
            length = np.sqrt((stretch**2).sum(1, keepdims=True))
            stretch *= np.minimum(1, mu * pressure / (ratio * normal * np.maximum(length, 1e-300)))
            force = area * (pressure * n - ratio * normal * stretch)
            damping = DRAG if t < 0 else 0
            v = v + step * (force.sum(0) / self.mass - a - [0, 0, G] - damping * v)
            spin = spin + step * (self.inverse_inertia @ np.cross(r, force).sum(0) - damping * spin)
            x, turn = x + step * v, turn + step * spin
        return float(x @ self.line - begun)
