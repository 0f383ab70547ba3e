#!/usr/bin/env python3
"""Writes vault.obj: a barrel vault of voussoirs in running bond, turned about its axis' upright and rounded to 1e-5 m, as drawing programs write it."""
import math

RADIUS, THICKNESS, WIDTH, COURSES, ALONG, TURN = 3.0, 0.25, 0.6, 23, 8, 0.3
QUADS = [(1, 2, 3, 4), (8, 7, 6, 5), (1, 5, 6, 2), (2, 6, 7, 3), (3, 7, 8, 4), (4, 8, 5, 1)]


def corners(course, near, far):
    first, last = (math.pi * (course + k) / COURSES for k in (0, 1))
    ring = [(first, RADIUS), (first, RADIUS + THICKNESS), (last, RADIUS + THICKNESS), (last, RADIUS)]
    for y in (near, far):
        for angle, radius in ring:
            x, z = radius * math.cos(angle), radius * math.sin(angle)
            yield x * math.cos(TURN) - y * math.sin(TURN), x * math.sin(TURN) + y * math.cos(TURN), z


def main():
    lines, seen = [], 0
    for course in range(COURSES):
        shift = 0.5 * WIDTH * (course % 2)
        cuts = sorted({0.0, ALONG * WIDTH} | {k * WIDTH + shift for k in range(ALONG + 1) if 0 < k * WIDTH + shift < ALONG * WIDTH})
        for number, (near, far) in enumerate(zip(cuts, cuts[1:]), 1):
            lines.append(f"o {course + 1}.{number}")
            lines += [f"v {x:.5f} {y:.5f} {z:.5f}" for x, y, z in corners(course, near, far)]
            lines += ["f " + " ".join(str(seen + k) for k in quad) for quad in QUADS]
            seen += 8
    with open("vault.obj", "w", encoding="utf-8") as out:
        out.write("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
