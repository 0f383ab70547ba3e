#!/usr/bin/env python3
"""Writes the fault surface and the mapped joints of this case: ./make_files.py"""
import math
import random
from pathlib import Path

HERE = Path(__file__).parent
ALONG, UP = 8, 10  # cells of the fault's grid


def fault(u, v):
    """Steep, across the tunnel (which runs along y), undulating; beyond the model on all sides."""
    x, z = -26 + 52 * u, -17 + 54 * v
    return x, 6 + 0.3 * x + 0.35 * z + 0.8 * math.sin(0.25 * x + 0.2 * z), z


lines = ["# A fault across the tunnel: a grid of triangles, m"]
lines += ["v {:.3f} {:.3f} {:.3f}".format(*fault(i / ALONG, j / UP)) for j in range(UP + 1) for i in range(ALONG + 1)]
for j in range(UP):
    for i in range(ALONG):
        a = j * (ALONG + 1) + i + 1
        lines += [f"f {a} {a + 1} {a + ALONG + 2}", f"f {a} {a + ALONG + 2} {a + ALONG + 1}"]
(HERE / "arbitrary_tunnel_fault.obj").write_text("\n".join(lines) + "\n", encoding="ascii")

rng = random.Random(3)
lines = ["# Joints mapped on the tunnel's walls", "dip,dip_direction,x,y,z,radius,material"]
for number in range(30):
    side = rng.choice([-1, 1])
    place = [round(side * rng.uniform(3, 7), 2), round(rng.uniform(-22, 22), 2), round(rng.uniform(0, 10), 2)]
    lines.append(",".join(map(str, [rng.randint(30, 85), rng.randint(0, 359), *place, f"{rng.uniform(3, 8):.1f}",
                                    "gouge" if number % 5 == 0 else ""])))
(HERE / "arbitrary_tunnel_joints.csv").write_text("\n".join(lines) + "\n", encoding="ascii")
