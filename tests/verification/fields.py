"""Closed forms of the elastic cases, and how far the program's displacement and stress are from them over many points.

One point says little about a stress: within an element it is a polynomial that crosses the exact stress somewhere, and a point near a face of a cut
element shows more than the usual error. The root of the mean square over fixed points scattered through the body falls at the order of theory.
All cases: E = 1000 Pa, nu = 0.3.
"""
import math
import sys

import numpy as np

from runner import CASES, monitor

YOUNG, NU = 1000.0, 0.3


def round_tensor(point, radial, hoop, along_axis=None):
    """Stress tensor with principal values along and across the radius: of a cylinder about z, or of a sphere if `along_axis` is None."""
    n = np.array(point, float)
    if along_axis is not None:
        n[2] = 0
    n /= np.linalg.norm(n)
    tensor = hoop * np.eye(3) + (radial - hoop) * np.outer(n, n)
    if along_axis is not None:
        tensor[2, 2] = along_axis
    return tensor


def lame_cylinder(point):
    """Displacement and stress of a cylinder of 1 m and 2 m under 1 Pa inside, plane strain."""
    r = math.hypot(point[0], point[1])
    radial, hoop = (1 - 4 / r**2) / 3, (1 + 4 / r**2) / 3
    axial = NU * (radial + hoop)
    stretch = (hoop - NU * (radial + axial)) / YOUNG
    return stretch * np.array([point[0], point[1], 0]), round_tensor(point, radial, hoop, axial)


def lame_sphere(point):
    """Displacement and stress of a sphere of 1 m and 2 m under 1 Pa inside."""
    r = np.linalg.norm(point)
    radial, hoop = (1 - 8 / r**3) / 7, (1 + 4 / r**3) / 7
    return (hoop - NU * (radial + hoop)) / YOUNG * np.asarray(point, float), round_tensor(point, radial, hoop)


def kirsch_stress(r, degrees):
    """Radial, hoop and shear stress of Kirsch's solution: a hole of 1 m under 1 Pa along x."""
    two, a2, a4 = 2 * math.radians(degrees), r**-2, r**-4
    rr = (1 - a2) / 2 + (1 - 4 * a2 + 3 * a4) / 2 * math.cos(two)
    tt = (1 + a2) / 2 - (1 + 3 * a4) / 2 * math.cos(two)
    return rr, tt, -(1 + 2 * a2 - 3 * a4) / 2 * math.sin(two)


def kirsch(point):
    """Displacement and stress of Kirsch's solution in plane strain."""
    r, angle = math.hypot(point[0], point[1]), math.atan2(point[1], point[0])
    rr, tt, rt = kirsch_stress(r, math.degrees(angle))
    ur = (r * (1 - 2 * NU) + 1 / r + (r + 4 * (1 - NU) / r - r**-3) * math.cos(2 * angle)) / 2
    ut = -(r + 2 * (1 - 2 * NU) / r + r**-3) / 2 * math.sin(2 * angle)
    turn = np.array([[math.cos(angle), -math.sin(angle), 0], [math.sin(angle), math.cos(angle), 0], [0, 0, 1]])
    polar = np.array([[rr, rt, 0], [rt, tt, 0], [0, 0, NU * (rr + tt)]])
    return turn @ np.array([ur, ut, 0]) * (1 + NU) / YOUNG, turn @ polar @ turn.T


def goodier(point):
    """Displacement and stress round a spherical cavity of 1 m under 1 Pa along z: the form that made the model's tractions."""
    sys.path.insert(0, str(CASES / "spherical_cavity"))
    import make_model
    x = np.array(point, float)[:, None]
    fading = np.einsum("m,mi->i", make_model.coefficients(), make_model.displacement_modes(x)[:, :, 0].real)
    far = np.array([-NU * point[0], -NU * point[1], point[2]]) / YOUNG
    return far + fading * (1 + NU) / YOUNG, make_model.stress(x)[:, :, 0]


def in_quarter(radii, count, z):
    """Points of a quarter of a cylinder, `count` angles a radius, none on the planes of symmetry."""
    golden = (math.sqrt(5) - 1) / 2
    return [(r * math.cos(a), r * math.sin(a), z) for i, r in enumerate(radii)
            for a in (math.pi / 2 * ((k + 0.5 + golden * i) % count) / count for k in range(count))]


def in_eighth(radii, count):
    """Points of an eighth of a sphere, `count` directions a radius, evenly spread (golden spiral)."""
    golden = (math.sqrt(5) - 1) / 2
    found = []
    for i, r in enumerate(radii):
        for k in range(count):
            z, angle = (k + 0.5) / count, math.pi / 2 * ((golden * (k + 1) + 0.3 * i) % 1)
            rho = math.sqrt(1 - z * z)
            found.append((r * rho * math.cos(angle), r * rho * math.sin(angle), r * z))
    return found


def probes(points):
    """An edit that adds a monitor at each point."""
    added = "".join(f'[[monitor]]\nname = "probe {i}"\npoint = [{", ".join(repr(float(x)) for x in point)}]\n'
                    for i, point in enumerate(points))
    return lambda text: text + "\n" + added


def tensor(stress):
    xx, yy, zz, xy, yz, zx = stress
    return np.array([[xx, xy, zx], [xy, yy, yz], [zx, yz, zz]])


def errors(document, exact, points):
    """Root mean squares of the errors of displacement and of stress over the probes, each relative to that of the exact field."""
    u, s = zip(*(exact(point) for point in points))
    entries = [monitor(document, f"probe {i}") for i in range(len(points))]
    du = np.array([entry["displacement"][-1] for entry in entries]) - u
    ds = np.array([tensor(entry["stress"][-1]) for entry in entries]) - s
    return float(np.linalg.norm(du) / np.linalg.norm(u)), float(np.linalg.norm(ds) / np.linalg.norm(s))
