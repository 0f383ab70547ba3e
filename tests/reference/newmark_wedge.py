"""A rigid wedge on two planes under a record of the ground (Newmark, Géotechnique 15, 1965, 139), by the forces of Hoek & Bray (1981); in plain
Python, from the papers."""
import bisect
import math

G = 9.81


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def upward(dip, dip_direction):
    """Unit normal of a plane, up."""
    d, a = math.radians(dip), math.radians(dip_direction)
    return (math.sin(d) * math.sin(a), math.sin(d) * math.cos(a), math.cos(d))


def line_of(one, two):
    """Unit, down the line of two planes given by their normals."""
    line = cross(one, two)
    length = math.copysign(math.sqrt(dot(line, line)), -line[2])
    return tuple(x / length for x in line)


class Ground:
    """Acceleration of the ground, rows [t, ax, ay, az], linear between them; as at its ends before and after."""

    def __init__(self, rows):
        self.rows, self.time = rows, [row[0] for row in rows]

    def at(self, t):
        i = bisect.bisect_right(self.time, t)
        if i in (0, len(self.rows)):
            return self.rows[min(i, len(self.rows) - 1)][1:]
        one, two = self.rows[i - 1], self.rows[i]
        share = (t - one[0]) / (two[0] - one[0])
        return [x + share * (y - x) for x, y in zip(one[1:], two[1:])]


class Sliding:
    """m that the wedge has come by `time` (s), a list, and the smaller of both forces on its planes over its mass, m/s², at its least."""

    def __init__(self, planes, friction, rows, end, step=5e-4, start=0.0):
        one, two = (upward(*plane) for plane in planes)
        line, mu = line_of(one, two), math.tan(math.radians(friction))
        c = dot(one, two)
        self.time, self.way, self.least_normal = [start], [0.0], math.inf
        ground, speed, way = Ground(rows), 0.0, 0.0
        for k in range(round((end - start) / step)):
            t = start + (k + 0.5) * step
            a = ground.at(t - start)
            r = (-a[0], -a[1], -G - a[2])
            across = [x - dot(r, line) * y for x, y in zip(r, line)]
            b1, b2 = -dot(across, one), -dot(across, two)
            normal = ((b1 - c * b2) / (1 - c * c), (b2 - c * b1) / (1 - c * c))
            self.least_normal = min(self.least_normal, *normal)
            held = mu * sum(max(0.0, n) for n in normal) * step
            pushed = speed + dot(r, line) * step
            after = math.copysign(max(0.0, abs(pushed) - held), pushed)
            way += 0.5 * step * (speed + after)
            speed = after
            self.time.append(start + (k + 1) * step)
            self.way.append(way)
