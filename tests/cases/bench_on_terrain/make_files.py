#!/usr/bin/env python3
"""Writes the ground, the fault and the mapped joints of this case from formulas (README.md): ./make_files.py"""
import math
import random
from pathlib import Path

HERE = Path(__file__).parent
CELL, COLUMNS, ROWS = 4.0, 36, 28  # m, posts from x = 0 to 140 m and y = 0 to 108 m


def ground(x, y):
    """A hillside that rises to the north, with a gully and a spur."""
    return 26 + 0.22 * y + 4.0 * math.sin(2 * math.pi * x / 95) + 1.5 * math.cos(2 * math.pi * (x + y) / 40)


rows = [" ".join(f"{ground(CELL * i, CELL * (ROWS - 1 - j)):.2f}" for i in range(COLUMNS)) for j in range(ROWS)]
head = f"ncols {COLUMNS}\nnrows {ROWS}\nxllcenter 0\nyllcenter 0\ncellsize {CELL:g}\nNODATA_value -9999\n"
(HERE / "bench_on_terrain_ground.asc").write_text(head + "\n".join(rows) + "\n", encoding="ascii")


def fault(u, v):
    """An undulating surface that dips by some 58 degrees towards 235 and reaches beyond the rock: u along the strike, v up the dip."""
    dip, azimuth = math.radians(58), math.radians(235)
    strike = (-math.cos(azimuth), math.sin(azimuth), 0.0)
    up = (-math.cos(dip) * math.sin(azimuth), -math.cos(dip) * math.cos(azimuth), math.sin(dip))
    normal = (math.sin(dip) * math.sin(azimuth), math.sin(dip) * math.cos(azimuth), math.cos(dip))
    wave = 0.5 * math.sin(2 * math.pi * (u / 60 + v / 170)) + 0.3 * math.cos(2 * math.pi * (v / 45 - u / 210))
    return [c + u * s + v * w + wave * n for c, s, w, n in zip((78, 56, 16), strike, up, normal)]


CELLS_U, CELLS_V = 16, 10
lines = ["# Fault F1, m: a grid of triangles"]
for j in range(CELLS_V + 1):
    for i in range(CELLS_U + 1):
        lines.append("v {:.3f} {:.3f} {:.3f}".format(*fault(-130 + 260 * i / CELLS_U, -70 + 140 * j / CELLS_V)))
for j in range(CELLS_V):
    for i in range(CELLS_U):
        a = j * (CELLS_U + 1) + i + 1
        lines += [f"f {a} {a + 1} {a + CELLS_U + 2}", f"f {a} {a + CELLS_U + 2} {a + CELLS_U + 1}"]
(HERE / "bench_on_terrain_fault.obj").write_text("\n".join(lines) + "\n", encoding="ascii")

# A window of the lowest bench face, as a mapping tool exports it: disc centres on the face, radius from the trace length.
rng = random.Random(5)
lines = ["# Window W1, face mapping", "ID;Set;Dip [deg];Dip Dir. [deg];X [m];Y [m];Z [m];Trace length [m];Radius [m]"]
for number in range(1, 31):
    name, dip, azimuth = [("A", 66, 142), ("B", 62, 222), ("bedding", 24, 176)][number % 3]
    z = rng.uniform(1.5, 10.5)
    x, y = rng.uniform(48, 92), 36 + z / math.tan(math.radians(72))
    trace = rng.uniform(4, 10)
    lines.append(f"J{number:02d};{name};{dip + rng.gauss(0, 5):.0f};{azimuth + rng.gauss(0, 8):.0f};{x:.2f};{y:.2f};{z:.2f};{trace:.1f};{trace / 2:.2f}")
(HERE / "bench_on_terrain_mapped.csv").write_text("\n".join(lines) + "\n", encoding="ascii")
