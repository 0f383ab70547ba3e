"""Contact on models drawn at random: what slides on what, cards that lean on each other, boxes that rebound, what is thrown at something thin."""
import math
import random

import numpy as np

from contact import G, inclined, path, radians
from runner import Findings, Line, Panel

ROCK = """[[material]]
density = 2600
young_modulus = {modulus:g}
poisson_ratio = 0.25
"""


def drawn(program, text, name="random_contact"):
    return program.run(name, edit=lambda _: text)


def joint_material(name, friction, stiffness=None):
    text = f'[[joint_material]]\nname = "{name}"\nfriction_angle = {friction!r}\n'
    return text + (f"normal_stiffness = {stiffness:g}\nshear_stiffness = {stiffness:g}\n" if stiffness else "")


def box(name, low, high, interface=None):
    text = f'[[solid]]\nname = "{name}"\nshape = "box"\nmin = {list(low)}\nmax = {list(high)}\n'
    return text + (f'interface = "{interface}"\n' if interface else "")


def prism(name, base, extrude, interface=None):
    text = f'[[solid]]\nname = "{name}"\nshape = "prism"\nbase = {np.asarray(base).tolist()}\nextrude = {np.asarray(extrude).tolist()}\n'
    return text + (f'interface = "{interface}"\n' if interface else "")


def held(place):
    return f"[[fixed]]\nwhere = {{block_at = {list(place)}}}\n"


def watched(name, place):
    return f'[[monitor]]\nname = "{name}"\npoint = {np.asarray(place).tolist()}\n'


# What slides on what.

def slide(angle, friction, time):
    return 0.5 * G * max(0.0, math.sin(radians(angle)) - math.cos(radians(angle)) * math.tan(radians(friction))) * time**2


def random_surfaces(program, full):
    """Boxes of several joint materials on a plane with one of its own: each slides by what the two give, off its first footprint as on it."""
    found = Findings("random_surfaces", "Boxes of several materials on one plane")
    draw, worst, count, time = random.Random(56), 0.0, 0, 1.2
    expected, seen = [], []
    for _ in range(100 if full else 2):
        angle = draw.uniform(20, 45)
        names = [f"m{i}" for i in range(draw.randint(2, 4))]
        friction = {name: draw.uniform(5, angle - 3) for name in names}
        ground = draw.choice([None, *names])
        between = {frozenset(pair): draw.choice(names) for pair in ((a, b) for a in names for b in names if a < b) if draw.random() < 0.4}
        model = f"gravity = {inclined(angle)}\n" + ROCK.format(modulus=10**draw.uniform(9, 10.7))
        model += "".join(joint_material(name, friction[name]) for name in names)
        boxes = [draw.choice(names) for _ in range(draw.randint(2, 4))]
        model += box("plane", (-1, -1, -1), (8, 3 * len(boxes), 0), ground)
        model += '[cover]\nlattice = "block"\n' + held((-0.5, -0.5, -0.5))
        model += f'[analysis]\ntype = "dynamic"\ntime_step = 0.005\nend_time = {time}\n[output]\nevery = 0\n'
        for pair, material in between.items():
            model += f'[[contact_pair]]\nbetween = {list(pair)}\nmaterial = "{material}"\n'.replace("'", '"')
        for i, own in enumerate(boxes):
            size = [draw.uniform(0.5, 1.2), draw.uniform(0.5, 1.5), draw.uniform(0.2, 0.5)]
            model += box(f"box{i}", (0, 3 * i, 0), (size[0], 3 * i + size[1], size[2]), own)
            model += watched(f"box{i}", (size[0] / 2, 3 * i + size[1] / 2, size[2] / 2))
        document = drawn(program, model)
        for i, own in enumerate(boxes):
            weaker = min((own, ground or own), key=friction.get)
            must = slide(angle, friction[between.get(frozenset((own, ground)), weaker)], time)
            is_now = float(path(document, f"box{i}")[1][-1][0])
            expected.append(must)
            seen.append(is_now)
            worst = max(worst, abs(is_now / must - 1))
            count += 1
    found.row(f"largest error of the way of {count} boxes", "relative", 0, worst, 2e-2, "closed form")
    panel = Panel("Way in 1.2 s", "closed form, m", "ours, m")
    panel.lines += [Line("_", [0, max(expected)], [0, max(expected)], "reference"), Line("ours", expected, seen, "marks")]
    found.panels.append(panel)
    return found


# Cards.

def fall_of_card(length, thickness, theta, friction, time):
    """How far the foot of a card goes out that leans on its mirror image, edge on edge, in `time`: one freedom, the angle to the floor."""
    share = math.tan(radians(friction))
    inertia = (length**2 + thickness**2) / 12
    rate, foot, steps = 0.0, -length * math.cos(theta), 2000
    for _ in range(steps):
        c, s = math.cos(theta), math.sin(theta)
        x1, z1 = length / 2 * s - thickness / 2 * c, length / 2 * c - thickness / 2 * s
        x2, z2 = length / 2 * c + thickness / 2 * s, -length / 2 * s - thickness / 2 * c
        # m (x'' x1 + z'' z1) + I θ'' = −m g z1 + μ m (g + z'') L sin θ, z'' = z1 θ'' + z2 θ'²
        held_back = share * length * s
        load = -G * (z1 - held_back) - rate**2 * (x2 * x1 + z2 * z1 - z2 * held_back)
        acceleration = load / (x1**2 + z1**2 + inertia - z1 * held_back)
        rate += min(acceleration, -rate / (time / steps)) * time / steps  # friction does not push it up
        theta += rate * time / steps
    return foot + length * math.cos(theta)


def random_cards(program, full):
    """Two cards that lean edge on edge stand if tan φ bears the thrust, else come apart as mirror images."""
    found = Findings("random_cards", "Cards that lean on each other")
    draw, wrong, unlike, worst, time = random.Random(17), 0, 0.0, 0.0, 0.3
    expected, seen, stand = [], [], 0
    count = 100 if full else 3
    while len(expected) + stand < count:
        theta, length, thickness = radians(draw.uniform(35, 70)), draw.uniform(1, 4), draw.uniform(0.02, 0.3)
        thickness *= min(1.0, length / 3)
        friction, depth, turn = draw.uniform(8, 40), draw.uniform(0.3, 2), draw.uniform(0, 2 * math.pi)
        along, up = np.array([math.cos(theta), math.sin(theta)]), np.array([-math.sin(theta), math.cos(theta)])
        foot = np.array([-length * math.cos(theta), 0])
        card = [foot, foot + length * along, foot + length * along + thickness * up, foot + thickness * up]
        centre = foot + (length * along + thickness * up) / 2
        thrust = (centre - foot)[0] / (length * math.sin(theta))  # over the weight
        holds = math.tan(radians(friction))
        if thrust < 0.1 or abs(holds / thrust - 1) < 0.05 or centre[0] > -0.05 * length:
            continue
        turned = np.array([[math.cos(turn), -math.sin(turn)], [math.sin(turn), math.cos(turn)]])

        def place(x, side, y=0.0, turned=turned):
            return [*(turned @ np.array([side * x[0], y])), x[1]]
        far = 1.5 * length + 1
        model = f"gravity = [0, 0, {-G}]\n" + ROCK.format(modulus=3e10) + joint_material("rough", friction)
        model += prism("floor", [place((-far, -1), 1, -far), place((far, -1), 1, -far), place((far, -1), 1, far), place((-far, -1), 1, far)],
                       (0, 0, 1))
        for name, side in (("left", 1), ("right", -1)):
            model += prism(name, [place(x, side, -depth / 2) for x in card], [*(turned @ np.array([0, depth])), 0])
            model += watched(name, place(centre, side))
        model += '[cover]\nlattice = "block"\n' + held(place((-0.9 * far, -0.5), 1))
        model += '[[step]]\ntype = "quasi_static"\ntime_step = 0.01\nsteps = 10\n' if holds > thrust else ""
        model += f'[[step]]\ntype = "dynamic"\ntime_step = 0.002\nend_time = {1.0 if holds > thrust else time}\n[output]\nevery = 0\n'
        document = drawn(program, model)
        left, right = (turned.T @ path(document, name)[1][-1][:2] for name in ("left", "right"))
        if holds > thrust:
            stand += 1
            wrong += max(np.linalg.norm(left), np.linalg.norm(right)) > 1e-3
            continue
        must = fall_of_card(length, thickness, theta, friction, time)
        # the foot goes as far as the angle says; the middle of the card tells the angle
        is_now = -float(left[0])
        must_middle = middle_way(length, thickness, theta, must)
        expected.append(must_middle)
        seen.append(is_now)
        unlike = max(unlike, abs(left[0] + right[0]) / must_middle, abs(left[1]) / must_middle)
        worst = max(worst, abs(is_now / must_middle - 1))
    found.row(f"of {stand} pairs that stand by statics come apart", "", 0, float(wrong), 0, "statics")
    found.row(f"largest error of the way of {len(expected)} that do not stand", "relative", 0, worst, 3e-2, "one freedom, integrated")
    found.row("largest difference from the mirror image, over the way", "relative", 0, unlike, 1e-3, "symmetry")
    panel = Panel("Way of a card's middle in 0.3 s", "one freedom, m", "ours, m")
    panel.lines += [Line("_", [0, max(expected)], [0, max(expected)], "reference"), Line("ours", expected, seen, "marks")]
    found.panels.append(panel)
    return found


def middle_way(length, thickness, theta, foot_way):
    """Out, of a card's middle, when its foot has gone out by `foot_way`."""
    after = math.acos(math.cos(theta) + foot_way / length)
    return (length / 2 * math.cos(after) + thickness / 2 * math.sin(after)) - (length / 2 * math.cos(theta) + thickness / 2 * math.sin(theta))


# Boxes that rebound.

def pose(kind, half, yaw):
    """A rotation that turns the box's face, edge or vertex down, its middle straight above."""
    lowest = {"face": (0, 0, 1), "edge": (half[0], 0, half[2]), "vertex": half}[kind]
    down = np.array(lowest) / np.linalg.norm(lowest)
    side = np.cross(down, (0, 1, 0))
    side /= np.linalg.norm(side)
    upright = -np.array([side, np.cross(down, side), down])
    upright[0] = np.cross(upright[1], upright[2])
    c, s = math.cos(yaw), math.sin(yaw)
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]) @ upright


def sink(kind, half, weight, stiffness):
    """How deep a box at rest presses its joint in."""
    length = 2 * half[1]
    return {"face": weight / (stiffness * 4 * half[0] * half[1]),
            "edge": math.sqrt(weight / (stiffness * length)),  # of 90 degrees, about
            "vertex": (2 * weight / (math.sqrt(3) * stiffness))**(1 / 3)}[kind]  # of a cube, about


def random_rebounds(program, full):
    """Boxes that fall on a face, an edge or a vertex come up to e² of their height, each time: up to six times, while a flight takes sixty steps and
    is many times as high as the box sinks into its joint at rest, and before it tumbles: what turns it a little, if by rounding, turns it a
    hundred times as much after the next impact."""
    found = Findings("random_rebounds", "Boxes that rebound")
    draw, worst, expected, seen = random.Random(56), 0.0, [], []
    count = 100 if full else 3
    for i in range(count):
        half = np.array([draw.uniform(0.25, 0.7) for _ in range(3)])
        kind, restitution = draw.choice(("face", "edge", "vertex")), draw.choice((0.3, 0.5, 0.8, 0.9))
        modulus, share, height = 10**draw.uniform(8, 11), 10**draw.uniform(-1, 1), draw.uniform(0.5, 2)
        scheme, step = draw.choice(("explicit", "implicit")), draw.choice((1e-3, 2e-3))
        # A joint as stiff as its rock of a block's size: on edges and vertices it bears by less.
        stiffness = share * modulus / (2 * half.min())
        turn = pose(kind, half, draw.uniform(0, 6.28))
        corners = [turn @ (half * np.array(signs)) for signs in ((-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1))]
        top = turn @ np.array([0, 0, 2 * half[2]])
        lowest = min((corner + lift)[2] for corner in corners for lift in (0 * top, top))
        centre = np.array([0, 0, height - lowest])
        fall, tops = math.sqrt(2 * height / G), 6
        low = max(G / 8 * (60 * step)**2, 20 * sink(kind, half, 2600 * 8 * half.prod() * G, stiffness))
        while tops > 1 and height * restitution**(2 * tops) < low:
            tops -= 1
        seconds = fall * (1 + 2 * sum(restitution**n for n in range(1, tops + 1)))
        model = f"gravity = [0, 0, {-G}]\n" + ROCK.format(modulus=modulus) + joint_material("face", 30.0, stiffness)
        model += box("floor", (-2, -2, -1), (2, 2, 0)) + prism("box", [centre + corner for corner in corners], top)
        model += f'[contact]\nrestitution = {restitution}\n[cover]\nlattice = "block"\n' + held((1.5, 1.5, -0.5))
        model += watched("centre", centre) + watched("above", centre + [0, 0, 0.2])
        model += f'[analysis]\ntype = "dynamic"\ntime_step = {step}\nscheme = "{scheme}"\nend_time = {seconds:.6g}\n[output]\nevery = 0\n'
        document = drawn(program, model)
        u = path(document, "centre")[1]
        z, tilt = height + u[:, 2], np.linalg.norm((path(document, "above")[1] - u)[:, :2], axis=1) / 0.2
        peaks = [k for k in range(1, len(z) - 1) if z[k] >= z[k - 1] and z[k] > z[k + 1]]
        for n in range(1, tops + 1):
            must = height * restitution**(2 * n)
            if n <= len(peaks) and tilt[peaks[n - 1]] > 1e-3:
                break
            is_now = float(z[peaks[n - 1]]) if n <= len(peaks) else 0.0
            expected.append(must)
            seen.append(is_now)
            if abs(is_now / must - 1) > worst:
                worst = abs(is_now / must - 1)
            if abs(is_now / must - 1) > 0.05:
                print(f"  drop {i} ({kind}, {scheme}, e {restitution}, E {modulus:.2g}, k {share:.2g}, h {height:.2f}): top {n} is {is_now:.4g}, "
                      f"must be {must:.4g}")
    found.row(f"largest error of {len(expected)} tops of {count} drops", "relative", 0, worst, 5e-2, "e² each time")
    panel = Panel("Tops", "e² each time, m", "ours, m")
    panel.lines += [Line("_", [0, max(expected)], [0, max(expected)], "reference"), Line("ours", expected, seen, "marks")]
    found.panels.append(panel)
    return found


# What is thrown.

HALF = 2.0  # m, of what is thrown at


def target(draw):
    """Something thin that is held, and whether a way of the middle of what was thrown leads through it."""
    kind = draw.choice(("plate", "tiles", "rod", "trough"))
    thin = 10**draw.uniform(-2.3, -0.7)
    text = ""
    if kind == "plate":
        text = box("plate", (-HALF, -HALF, -thin), (HALF, HALF, 0)) + held((0.9 * HALF, 0.9 * HALF, -thin / 2))
    elif kind == "tiles":
        cuts = sorted(draw.uniform(-0.8 * HALF, 0.8 * HALF) for _ in range(3))
        for i, (low, high) in enumerate(zip([-HALF, *cuts], [*cuts, HALF], strict=True)):
            text += box(f"tile{i}", (low, -HALF, -thin), (high, HALF, 0), "face") + held(((low + high) / 2, 0.9 * HALF, -thin / 2))
    elif kind == "rod":
        text = box("rod", (-thin / 2, -HALF, -thin), (thin / 2, HALF, 0)) + held((0, 0.9 * HALF, -thin / 2))
    else:
        slope = draw.uniform(0.1, 0.6)
        section = [[-HALF, -HALF, slope * HALF], [-HALF, -HALF, slope * HALF - thin], [0, -HALF, -thin], [HALF, -HALF, slope * HALF - thin],
                   [HALF, -HALF, slope * HALF], [0, -HALF, 0]]
        text = prism("trough", section, (0, 2 * HALF, 0)) + held((0, 0.9 * HALF, -thin / 2))
        return text, lambda u: through(u, lambda x: slope * abs(x[0]) - thin, HALF)
    wide = thin / 2 if kind == "rod" else HALF
    return text, lambda u: through(u, lambda _: -thin, wide)


def through(way, bottom, wide):
    """Whether the middle goes from above the target to below it where the target is."""
    for before, after in zip(way[:-1], way[1:], strict=True):
        above, below = before[2] - bottom(before), after[2] - bottom(after)
        if above > 0 >= below:
            at = before + (after - before) * above / (above - below)
            return abs(at[0]) < wide and abs(at[1]) < HALF and way[-1][2] < bottom(way[-1])
    return False


def random_throws(program, full):
    """Boxes thrown at plates, tiles, rods and troughs, at up to 250 m/s: none passes."""
    found = Findings("random_throws", "What is thrown at something thin")
    draw, passed, stopped = random.Random(17), 0, 0
    count = 1000 if full else 6
    for i in range(count):
        text, passes = target(draw)
        size, speed, step = draw.uniform(0.05, 0.4), 10**draw.uniform(1, 2.4), 10**draw.uniform(-4, -2.3)
        height, start = size * draw.uniform(0.3, 1), draw.uniform(0.02, 1)
        start += 0.6 * HALF if "trough" in text else 0
        tilt, turn = (0.0, 0.0) if '"rod"' in text else (draw.uniform(0, 0.8), draw.uniform(0, 6.28))
        off = draw.uniform(-0.3, 0.3) * size if '"rod"' in text else draw.uniform(-0.3, 0.3)
        centre = np.array([off, draw.uniform(-0.3, 0.3), start + height / 2])
        velocity = speed * np.array([math.sin(tilt) * math.cos(turn), math.sin(tilt) * math.sin(turn), -math.cos(tilt)])
        spin = [draw.uniform(-20, 20) for _ in range(3)]
        scheme, restitution = draw.choice(("explicit", "implicit")), draw.choice((0.0, 0.5, 1.0))
        reach = np.array([size / 2, size / 2, height / 2])
        model = f"gravity = [0, 0, {-G}]\n" + ROCK.format(modulus=3e10) + joint_material("face", 30.0) + text
        model += box("thrown", (centre - reach).tolist(), (centre + reach).tolist(), "face")
        model += f'[contact]\nrestitution = {restitution}\n[cover]\nlattice = "block"\n[[initial_velocity]]\n'
        model += f"where = {{block_at = {centre.tolist()}}}\nvelocity = {velocity.tolist()}\nangular_velocity = {spin}\n" + watched("middle", centre)
        model += f'[analysis]\ntype = "dynamic"\ntime_step = {step:.4g}\nend_time = {min(0.2, 6 / speed):.4g}\nscheme = "{scheme}"\n[output]\nevery = 0\n'
        try:
            document = drawn(program, model)
        except RuntimeError as error:
            if "out of nothing" not in str(error):
                raise
            stopped += 1
            continue
        if passes(centre + path(document, "middle")[1]):
            passed += 1
            print(f"  throw {i} passes: {size:.3g} m at {speed:.3g} m/s, {scheme}, step {step:.2g}\n{model}" if passed < 3 else f"  throw {i} passes")
    found.row(f"of {count} throws pass", "", 0, float(passed), 0, "none may")
    found.row("share that ends with an error (energy out of nothing)", "", 0, stopped / count, 2e-2, "told")
    return found
