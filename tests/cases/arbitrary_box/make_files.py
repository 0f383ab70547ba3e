#!/usr/bin/env python3
"""Writes the fault surface and the mapped joints of this case: ./make_files.py"""
import math
import random
from pathlib import Path

HERE = Path(__file__).parent
CELLS = 8  # of the fault's grid, along each axis


def fault(u, v):
    """An undulating surface that dips 40 degrees or so to the east and reaches beyond the box."""
    x, y = -0.5 + 21 * u, -0.5 + 21 * v
    return x, y, 18 - 0.8 * x + 0.6 * math.sin(0.55 * x) + 0.5 * math.cos(0.4 * y + 0.3 * x)


lines = ["# A fault: a grid of triangles, m"]
lines += ["v {:.3f} {:.3f} {:.3f}".format(*fault(i / CELLS, j / CELLS)) for j in range(CELLS + 1) for i in range(CELLS + 1)]
for j in range(CELLS):
    for i in range(CELLS):
        a = j * (CELLS + 1) + i + 1
        lines += [f"f {a} {a + 1} {a + CELLS + 2}", f"f {a} {a + CELLS + 2} {a + CELLS + 1}"]
(HERE / "arbitrary_box_fault.obj").write_text("\n".join(lines) + "\n", encoding="ascii")

rng = random.Random(7)
lines = ["# Joints as they might be mapped in the field: no two alike", "dip,dip_direction,x,y,z,radius,material"]
for number in range(24):
    place = [round(rng.uniform(1, 19), 2) for _ in range(3)]
    radius = "" if number in (5, 17) else f"{rng.uniform(3, 9):.1f}"
    lines.append(",".join(map(str, [rng.randint(15, 89), rng.randint(0, 359), *place, radius, "clay" if number % 6 == 0 else ""])))
(HERE / "arbitrary_box_joints.csv").write_text("\n".join(lines) + "\n", encoding="ascii")
