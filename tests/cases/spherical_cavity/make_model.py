#!/usr/bin/env python3
"""Writes the outer planes of model.toml and their tractions: the stress round a spherical cavity (Goodier 1933), averaged over each face.

    ./make_model.py      replaces the two lists of model.toml; needs numpy

`stress` is the closed form; tests/verification compares with it.
"""
import re
from pathlib import Path

import numpy as np

NU = 0.3
REACH = 3.0   # m, of the outer planes from the centre of the cavity of 1 m


def displacement_modes(x):
    """2G times the displacements of three solutions that fade away, at complex points x [3, n]: [3 modes, 3, n].

    Papkovich and Neuber: 2G u = 4 (1 - nu) psi - grad(x . psi + phi), with phi = 1/r; phi = P2/r^3; psi = (0, 0, z/r^3).
    """
    r = np.sqrt(x[0]**2 + x[1]**2 + x[2]**2)
    z = x[2]
    ez = np.zeros_like(x)
    ez[2] = 1
    point = x / r**3                                                           # -grad 1/r
    double = -(3 * z * ez / r**5 - 7.5 * z**2 * x / r**7 + 1.5 * x / r**5)     # -grad (3 z^2 - r^2) / (2 r^5)
    gradient = 2 * z * ez / r**3 - 3 * z**2 * x / r**5                         # grad z^2 / r^3
    return np.array([point, double, 4 * (1 - NU) * ez * z / r**3 - gradient])


def stress_modes(points):
    """Stresses [3 modes, 3, 3, n] of these, by complex steps (exact to rounding)."""
    step = 1e-30
    gradient = np.empty((3, 3, 3, points.shape[1]))   # [mode, component, direction, point], of 2G u
    for d in range(3):
        moved = points.astype(complex)
        moved[d] += 1j * step
        gradient[:, :, d] = displacement_modes(moved).imag / step
    strain = (gradient + gradient.transpose(0, 2, 1, 3)) / 2
    trace = np.einsum("miin->mn", strain)
    return strain + NU / (1 - 2 * NU) * trace[:, None, None] * np.eye(3)[None, :, :, None]


def coefficients():
    """Of the modes, so that the cavity's wall is free under a far stress of 1 Pa along z."""
    angle = np.linspace(0, np.pi / 2, 7)
    n = np.array([np.sin(angle), 0 * angle, np.cos(angle)])
    modes = np.einsum("mijn,jn->min", stress_modes(n), n)[:, [0, 2]].reshape(3, -1)
    far = np.array([0 * angle, n[2]]).reshape(-1)
    found, *_ = np.linalg.lstsq(modes.T, -far, rcond=None)
    assert np.abs(modes.T @ found + far).max() < 1e-13, "the wall is not free"
    return found


def stress(points):
    """Pa, [3, 3, n] at points [3, n] outside the cavity."""
    total = np.einsum("m,mijn->ijn", coefficients(), stress_modes(np.asarray(points, float)))
    total[2, 2] += 1
    return total


def normals():
    """Of the outer planes: the middles of the 64 triangles into which the eighth of the sphere is divided."""
    corners, n = np.eye(3), 8
    found = []
    for i in range(n):
        for j in range(n - i):
            for up in (True, False) if i + j < n - 1 else (True,):
                a, b = (i + 1 / 3, j + 1 / 3) if up else (i + 2 / 3, j + 2 / 3)
                middle = corners.T @ np.array([a, b, n - a - b]) / n
                found.append(middle / np.linalg.norm(middle))
    return found


def face(plane, planes):
    """The polygon in which a plane (normal, distance) bounds the body: a large square on it, clipped by all others."""
    n, d = plane
    u = np.cross(n, [0.3, -0.5, 0.8])
    u /= np.linalg.norm(u)
    v = np.cross(n, u)
    polygon = [d * n + 9 * (a * u + b * v) for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    for m, e in planes:
        if m is n:
            continue
        clipped = []
        for p, q in zip(polygon, polygon[1:] + polygon[:1]):
            a, b = m @ p - e, m @ q - e
            if a <= 0:
                clipped.append(p)
            if a * b < 0:
                clipped.append(p + a / (a - b) * (q - p))
        polygon = clipped
    return polygon


def mean_traction(polygon, n):
    """Average over a polygon: triangles from its first corner, each divided into 16² with the value in the middle."""
    total, area, parts = np.zeros(3), 0.0, 16
    for b, c in zip(polygon[1:], polygon[2:]):
        a = polygon[0]
        weights = [((i + s) / parts, (j + s) / parts) for i in range(parts) for j in range(parts - i)
                   for s in ((1 / 3, 2 / 3) if i + j < parts - 1 else (1 / 3,))]
        points = np.array([a + p * (b - a) + q * (c - a) for p, q in weights]).T
        share = np.linalg.norm(np.cross(b - a, c - a)) / 2
        total += share * np.einsum("ijn,j->in", stress(points), n).mean(axis=1)
        area += share
    return total / area


def main():
    outer = [(n, REACH) for n in normals()]
    planes = outer + [(-e, 0.0) for e in np.eye(3)]
    halfspaces, tractions = [], []
    for axis in range(3):   # symmetry: rock.0 to rock.2
        normal = [int(axis == d) for d in range(3)]
        halfspaces.append(f'    {{normal = {normal}, point = [0, 0, 0], keep = "above"}},')
    for i, (n, d) in enumerate(outer):
        below = f"point = [{d * n[0]:.12g}, {d * n[1]:.12g}, {d * n[2]:.12g}], keep = \"below\""
        halfspaces.append(f"    {{normal = [{n[0]:.12g}, {n[1]:.12g}, {n[2]:.12g}], {below}}},")
        t = mean_traction(face((n, d), planes), n)
        tractions.append(f'    {{where = {{face = "rock.{i + 3}"}}, value = [{t[0]:.9g}, {t[1]:.9g}, {t[2]:.9g}]}},')
    path = Path(__file__).resolve().parent / "model.toml"
    text = path.read_text(encoding="utf-8")
    for key, lines in (("planes", halfspaces), ("traction", tractions)):
        text = re.sub(rf"^{key} = \[\n.*?^\]$", f"{key} = [\n" + "\n".join(lines) + "\n]", text, flags=re.M | re.S)
    path.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
