#!/usr/bin/env python3
"""Writes the ground and the rock head of this case from a formula (README.md); no measured elevations.

    ./make_terrain.py            writes great_wall_ground.asc and great_wall_rock.asc beside this file
    ./make_terrain.py --path     prints the wall's path: points on the crest, 14 m apart
"""
import math
import sys
from pathlib import Path

CELL, COLUMNS, ROWS = 8.0, 31, 21  # m, posts from x = 0 to 240 m and y = 0 to 160 m


def ridge(x):
    """y of the crest."""
    return 80 + 20 * math.sin(2 * math.pi * x / 170)


def crest(x):
    """Its elevation."""
    return 74 + 12 * math.cos(2 * math.pi * (x - 30) / 150) + 0.05 * x


def ground(x, y):
    fall = (y - ridge(x)) / 55
    gullies = 3 * math.sin(2 * math.pi * x / 48) * (1 - math.exp(-4 * fall * fall))
    return 10 + (crest(x) - 10) / (1 + fall * fall) + gullies


def rock_head(x, y):
    """The weathered rock is 4 m thick on the crest, 6 m far from it."""
    fall = (y - ridge(x)) / 55
    return ground(x, y) - 6 + 2 / (1 + fall * fall)


def write(name, elevation):
    rows = [" ".join(f"{elevation(CELL * i, CELL * (ROWS - 1 - j)):.2f}" for i in range(COLUMNS)) for j in range(ROWS)]
    head = f"ncols {COLUMNS}\nnrows {ROWS}\nxllcenter 0\nyllcenter 0\ncellsize {CELL:g}\n"
    (Path(__file__).parent / name).write_text(head + "\n".join(rows) + "\n", encoding="ascii")


if sys.argv[1:] == ["--path"]:
    print("path = [" + ", ".join(f"[{x}, {ridge(x):.2f}, {ground(x, ridge(x)):.2f}]" for x in range(22, 219, 14)) + "]")
else:
    write("great_wall_ground.asc", ground)
    write("great_wall_rock.asc", rock_head)
