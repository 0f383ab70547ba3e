#!/usr/bin/env python3
"""Writes the tractions of model.toml: Kirsch's stresses on the 16 sides of the outer boundary, averaged over each.

    ./make_model.py      replaces the list of tractions in model.toml
"""
import math
import re
from pathlib import Path

SIDES = 64         # of the whole circle
RADIUS = 5.0       # m, of the corners of the outer boundary
POINTS = ((-0.8611363115940526, 0.3478548451374538), (-0.3399810435848563, 0.6521451548625461),
          (0.3399810435848563, 0.6521451548625461), (0.8611363115940526, 0.3478548451374538))  # Gauss, 4 points


def stress(x, y):
    """xx, yy, xy round a hole of radius 1 m under a far stress of 1 Pa along x (Kirsch 1898)."""
    r2, two = x * x + y * y, 2 * math.atan2(y, x)
    a2, a4 = 1 / r2, 1 / r2**2
    rr = (1 - a2) / 2 + (1 - 4 * a2 + 3 * a4) / 2 * math.cos(two)
    tt = (1 + a2) / 2 - (1 + 3 * a4) / 2 * math.cos(two)
    rt = -(1 + 2 * a2 - 3 * a4) / 2 * math.sin(two)
    mean, half = (rr + tt) / 2, (rr - tt) / 2
    return (mean + half * math.cos(two) - rt * math.sin(two), mean - half * math.cos(two) + rt * math.sin(two),
            half * math.sin(two) + rt * math.cos(two))


def traction(side):
    """Mean traction on a side, counted against the clock from the x axis (the program goes with it)."""
    ends = [(RADIUS * math.cos(a), RADIUS * math.sin(a)) for a in (2 * math.pi * side / SIDES, 2 * math.pi * (side + 1) / SIDES)]
    middle = 2 * math.pi * (side + 0.5) / SIDES
    n = (math.cos(middle), math.sin(middle))
    total = [0.0, 0.0]
    for at, weight in POINTS:
        xx, yy, xy = stress(*((1 - at) / 2 * p + (1 + at) / 2 * q for p, q in zip(*ends)))
        total[0] += weight / 2 * (xx * n[0] + xy * n[1])
        total[1] += weight / 2 * (xy * n[0] + yy * n[1])
    return total


def main():
    lines = [f'    {{where = {{face = "plate.{SIDES - 1 - side}"}}, value = [{x:.12g}, {y:.12g}, 0]}},'
             for side, (x, y) in ((side, traction(side)) for side in range(SIDES // 4))]
    path = Path(__file__).resolve().parent / "model.toml"
    text = path.read_text(encoding="utf-8")
    path.write_text(re.sub(r"^traction = \[\n.*?^\]$", "traction = [\n" + "\n".join(lines) + "\n]", text, flags=re.M | re.S),
                    encoding="utf-8")


if __name__ == "__main__":
    main()
