#!/usr/bin/env python3
"""Writes model.toml: a house of cards of three storeys. make_cards.py [ANGLE], in degrees from the floor, 60 by default."""
import math
import sys

LENGTH, THICKNESS, WIDTH, GAP = 3.0, 0.1, 2.0, 0.3  # m; the last between the feet of neighbours

HEAD = """# A house of cards of three storeys: two cards that lean edge on edge press each other along the middle of the cone of planes that part them.
title = "House of cards"
gravity = [0, 0, -9.81]

[[material]]
density = 2600.0
young_modulus = 3e10
poisson_ratio = 0.25

[[joint_material]]
name = "card"
friction_angle = 26.565051177   # tan = 1/2

[cover]
lattice = "block"

[[solid]]
name = "floor"
shape = "box"
min = [{low}, -1, -0.5]
max = [{high}, 3, 0]

[[fixed]]
where = {{block_at = [0, 1, -0.25]}}

[[step]]
name = "weight"
type = "quasi_static"
time_step = 0.01
steps = 20

[[step]]
name = "free"
type = "dynamic"
time_step = 0.005
end_time = 1.0

[[monitor]]
name = "top"
point = [{x:.12g}, 1, {z:.12g}]
"""


def prism(name, corners):
    base = ", ".join(f"[{x:.12g}, 0, {z:.12g}]" for x, z in corners)
    return f'\n[[solid]]\nname = "{name}"\nshape = "prism"\nbase = [{base}]\nextrude = [0, {WIDTH:g}, 0]\n'


def pair(name, middle, z, angle):
    """Two cards that lean on each other at `middle`; their inner lower edges stand on z."""
    c, s = math.cos(angle), math.sin(angle)
    left = [(-LENGTH * c, 0), (0, LENGTH * s), (-THICKNESS * s, LENGTH * s + THICKNESS * c), (-LENGTH * c - THICKNESS * s, THICKNESS * c)]
    return "".join(prism(f"{name} {side}", [(middle + sign * x, z + h) for x, h in left])
                   for side, sign in (("left", 1), ("right", -1)))


def main():
    angle = math.radians(float(sys.argv[1]) if len(sys.argv) > 1 else 60)
    spacing = 2 * (LENGTH * math.cos(angle) + THICKNESS * math.sin(angle)) + GAP
    height = LENGTH * math.sin(angle) + THICKNESS * math.cos(angle)
    text, z = "", 0.0
    for storey, pairs in enumerate((3, 2, 1), 1):
        for i in range(pairs):
            text += pair(f"{storey}.{i + 1}", (i - (pairs - 1) / 2) * spacing, z, angle)
        z += height
        if pairs > 1:
            reach = (pairs - 1) / 2 * spacing + 0.5
            text += prism(f"{storey} across", [(-reach, z), (reach, z), (reach, z + THICKNESS), (-reach, z + THICKNESS)])
            z += THICKNESS
    c, s = math.cos(angle), math.sin(angle)
    place = (-0.5 * (LENGTH * c + THICKNESS * s), z - height + 0.5 * (LENGTH * s + THICKNESS * c))
    head = HEAD.format(low=-2 * spacing, high=2 * spacing, x=place[0], z=place[1])
    with open("model.toml", "w", encoding="utf-8") as out:
        out.write(head + text)


if __name__ == "__main__":
    main()
