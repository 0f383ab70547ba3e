#!/usr/bin/env python3
"""Writes the base of model.toml and the supports of its outer face: the ellipses as polygons.

    ./make_model.py      replaces the two lists at the top of model.toml
"""
import math
import re
from pathlib import Path

INNER, OUTER = 48, 24   # sides of a quarter of each ellipse
HALF_HEIGHT = 0.3       # m


def ellipse(a, b, sides):
    points = [(a * math.cos(t), b * math.sin(t)) for t in (math.pi / 2 * i / sides for i in range(1, sides))]
    return [(a, 0.0), *points, (0.0, b)]


def main():
    inner, outer = ellipse(2, 1, INNER), ellipse(3.25, 2.75, OUTER)
    base = outer + inner[::-1]
    points = "\n".join(f"    [{x:.15g}, {y:.15g}, 0]," for x, y in base)
    faces = "\n".join(f'    {{where = {{face = "plate.{side}"}}, components = ["x", "y"], method = "penalty"}},' for side in range(OUTER))
    middle = [point for a, b in zip(outer, outer[1:]) for point in (a, tuple((p + q) / 2 for p, q in zip(a, b)))] + outer[-1:]
    line = "\n".join(f'    {{where = {{point = [{x:.15g}, {y:.15g}, {HALF_HEIGHT}]}}, components = ["z"], method = "penalty"}},' for x, y in middle)
    symmetry = "\n".join(f'    {{where = {{face = "plate.{side}"}}, components = ["{axis}"], method = "penalty"}},'
                         for side, axis in ((OUTER, "x"), (len(base) - 1, "y")))
    path = Path(__file__).resolve().parent / "model.toml"
    text = path.read_text(encoding="utf-8")
    for key, lines in (("fixed", symmetry + "\n" + faces + "\n" + line), ("base", points)):
        text = re.sub(rf"^{key} = \[\n.*?^\]$", f"{key} = [\n{lines}\n]", text, flags=re.M | re.S)
    path.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
