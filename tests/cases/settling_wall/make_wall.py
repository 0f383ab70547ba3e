#!/usr/bin/env python3
"""Writes wall.obj: a wall of 102 bricks in running bond, one body each."""

LENGTH, DEPTH, HEIGHT, COURSES, WHOLE = 0.26, 0.12, 0.075, 12, 8
QUADS = [(1, 4, 3, 2), (5, 6, 7, 8), (1, 2, 6, 5), (2, 3, 7, 6), (3, 4, 8, 7), (4, 1, 5, 8)]


def main():
    lines, seen = [], 0
    for course in range(COURSES):
        cuts = [k * LENGTH for k in range(WHOLE + 1)]
        if course % 2 == 1:
            cuts = [0.0] + [(k + 0.5) * LENGTH for k in range(WHOLE)] + [WHOLE * LENGTH]
        low, high = course * HEIGHT, (course + 1) * HEIGHT
        for number, (near, far) in enumerate(zip(cuts, cuts[1:]), 1):
            lines.append(f"o {course + 1}.{number}")
            lines += [f"v {x:.3f} {y:.3f} {z:.3f}" for z in (low, high) for x, y in ((near, 0), (far, 0), (far, DEPTH), (near, DEPTH))]
            lines += ["f " + " ".join(str(seen + k) for k in quad) for quad in QUADS]
            seen += 8
    with open("wall.obj", "w", encoding="utf-8") as out:
        out.write("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
