"""Goodman & Bray's toppling slope by limit equilibrium, block by block from the top (Toppling of rock slopes, Proc. ASCE Specialty Conf. Rock
Engineering for Foundations and Slopes, Boulder, 1976, vol. 2, 201-234; the example of 16 blocks).

Blocks of width dx stand on a stepped base that dips by alpha; number 1 is at the toe. Friction mu acts at all faces. A block that topples turns
about its lowest corner: it is pressed from above at the top of its own back (below the crest) or of the block behind it, and presses on the top of
the block before it. Forces per metre along the strike.
"""
import math

ALPHA, WIDTH, BLOCKS, CREST, UNIT_WEIGHT = math.radians(30), 10.0, 16, 10, 25.0  # rad, m, -, the block at the crest, kN/m3
RISE_BELOW, RISE_ABOVE = 5.0, 5.0  # m, of the block tops from one to the next: up to the crest, down behind it


def height(n):
    return 4.0 * n if n <= CREST else 40.0 - 6.0 * (n - CREST)


def levers(n):
    """Heights above the block's lowest corner of the forces from behind and on the block before."""
    y = height(n)
    if n < CREST:
        return y, y - RISE_BELOW
    return y - RISE_ABOVE, y - RISE_BELOW if n == CREST else y


def forces(mu):
    """{n: force on block n from block n + 1, kN/m}, {n: "topples", "slides" or "stays"}. Force 0 is what block 1 lacks to stand."""
    sine, cosine = math.sin(ALPHA), math.cos(ALPHA)
    force, mode = {BLOCKS: 0.0}, {}
    for n in range(BLOCKS, 0, -1):
        weight, (above, below) = UNIT_WEIGHT * WIDTH * height(n), levers(n)
        turns = -1.0  # the block at the toe has none to lean on
        if below > 0:
            turns = (force[n] * (above - mu * WIDTH) + weight / 2 * (height(n) * sine - WIDTH * cosine)) / below
        slides = force[n] - weight * (mu * cosine - sine) / (1 - mu**2)
        force[n - 1] = max(turns, slides, 0.0)
        mode[n] = "stays" if force[n - 1] == 0 else "topples" if turns > slides else "slides"
    return force, mode


def limiting_friction(low=0.7, high=0.9):
    """The least tan of the friction angle with which block 1 stands."""
    while high - low > 1e-9:
        mu = (low + high) / 2
        low, high = (mu, high) if forces(mu)[0][0] > 0 else (low, mu)
    return high


def bolt_force(mu):
    """Horizontal force on block 1 that holds the slope, kN/m: block 1 is about to slide on its base."""
    sine, cosine, weight = math.sin(ALPHA), math.cos(ALPHA), UNIT_WEIGHT * WIDTH * height(1)
    return (forces(mu)[0][1] * (1 - mu**2) - weight * (mu * cosine - sine)) / (mu * sine + cosine)
