"""Rock with elastic joints: waves through them, bars across them."""
import math

import numpy as np

from dynamics import history
from runner import Findings, Line, Panel, monitor

FREQUENCY = 50.0
OMEGA = 2 * math.pi * FREQUENCY
SPEED = math.sqrt(1e9 / 2500)
IMPEDANCE = math.sqrt(1e9 * 2500)
SPACING, TIME_STEP = 0.25, 1e-4


def wave_number(speed):
    """1/m, of the frequency on this lattice in these steps: linear elements with their own mass, average acceleration (Hughes 1987, 9.1)."""
    omega = 2 / TIME_STEP * math.tan(OMEGA * TIME_STEP / 2)
    a = (omega * SPACING / speed)**2
    return math.acos((6 - 2 * a) / (6 + a)) / SPACING


def wave(time, stress, begin, periods=1):
    """Amplitude and phase of what is in a history at the frequency, from `begin` on; complex."""
    there = (time >= begin) & (time < begin + periods / FREQUENCY - 1e-9)
    basis = np.stack([np.sin(OMEGA * time[there]), np.cos(OMEGA * time[there])], 1)
    s, c = np.linalg.lstsq(basis, stress[there], rcond=None)[0]
    return complex(s, c)


def through(document, far_speed):
    """What comes, what goes on, and what comes back, each as it is at the joint at x = 20 m."""
    time, before = history(document, "before", "stress", "xx")
    _, behind = history(document, "behind", "stress", "xx")
    way = 20 - 9.875
    shift = np.exp(-1j * wave_number(SPEED) * way)  # sin(ωt − kx)
    comes = wave(time, before, way / SPEED + 0.006) * shift
    first = comes / shift
    back = before - (first * np.exp(1j * OMEGA * time)).imag
    returns = wave(time, back, (20 + way) / SPEED + 0.004) / shift
    goes_on = wave(time, behind, 20 / SPEED + 9.875 / far_speed + 0.004, 2) * np.exp(1j * wave_number(far_speed) * 9.875)
    return comes, goes_on, returns


def jointed_bar(program, full):
    """Waves through a joint (Pyrak-Nolte, Myer & Cook 1990); the stretch of a bar across a joint."""
    found = Findings("jointed_bar", "Waves through a joint, bars across it")
    document = program.run("jointed_bar")
    comes, goes_on, returns = through(document, SPEED)
    ratio = OMEGA * IMPEDANCE / 2e9
    found.row("share of the wave that goes through a joint of 1 GPa/m", "", 1 / math.sqrt(1 + ratio**2), abs(goes_on / comes), 5e-3, "closed form")
    found.row("its delay", "rad", math.atan(ratio), -float(np.angle(goes_on / comes)), 2e-2, "closed form")
    found.row("share that comes back", "", ratio / math.sqrt(1 + ratio**2), abs(returns / comes), 2e-2, "closed form")
    panel = Panel("Stress behind the joint", "time, s", "stress xx, kPa")
    time, behind = history(document, "behind", "stress", "xx")
    panel.lines.append(Line("ours", time.tolist(), (behind / 1e3).tolist(), "curve"))
    late = time > 29.875 / SPEED
    wanted = -1e5 / math.sqrt(1 + ratio**2) * np.sin(OMEGA * (time - 29.875 / SPEED) - math.atan(ratio))
    panel.lines.append(Line("closed form, steady", time[late].tolist(), (wanted[late] / 1e3).tolist(), "reference"))
    found.panels.append(panel)
    for restitution in (0.5, 1.0) if full else ():
        other = program.run("jointed_bar", {"contact.restitution": restitution})
        off = np.abs(np.array(monitor(other, "behind")["stress"]) - np.array(monitor(document, "behind")["stress"])).max()
        found.row(f"stress with restitution {restitution:g}, off that with 0", "relative", 0, float(off / 1e5), 1e-9, "the joint never opens")
    if full:
        stiff = program.run("jointed_bar", {"solid.2.material": "stiff", "joint_material.1.normal_stiffness": 1e12, "joint_material.1.shear_stiffness": 1e12})
        comes, goes_on, returns = through(stiff, 2 * SPEED)
        found.row("stress that goes on into rock four times as stiff", "", 4 / 3, abs(goes_on / comes), 1e-2, "closed form")
        found.row("stress that comes back from it", "", 1 / 3, abs(returns / comes), 2e-2, "closed form")
    stretched(program, found, full)
    return found


PILE = {"mass": 2500.0 * 4 * 2, "joint": 1e9 * 4, "rock": 2e9 * 4 / 2}  # of a block, of the joint below it, of its own shortening
PILE_PERIOD, PILE_TOP, PILE_PIECES = 0.1, 1e-4, 20


def pile_wave():
    """Wave number (rad a block) and height of the steady wave in a long pile, by Bloch's theorem: the foot moves the first joint's lower side.

    A block moves by u and its ends by u ± s. With w = mass ω² / 4k and v = (4 rock − mass ω²/3) / 4k: sin²(q/2) = w (v + 1) / (v + w),
    s = ± i u w / (v tan(q/2)). Without the give of the blocks (v → ∞) that is ω = 2 √(k/m) sin(q/2).
    """
    inertia = PILE["mass"] * (2 * math.pi / PILE_PERIOD)**2
    w, v = inertia / (4 * PILE["joint"]), (4 * PILE["rock"] - inertia / 3) / (4 * PILE["joint"])
    q = 2 * math.asin(math.sqrt(w * (v + 1) / (v + w)))
    pieces = (math.sin(math.pi / PILE_PIECES) / (math.pi / PILE_PIECES))**2  # what a sine keeps that is drawn in straight pieces
    return q, PILE_TOP * pieces / math.hypot(1, w / (v * math.tan(q / 2)))


def pile_motion(blocks, end, watched, lag=0.0):
    """Times and displacement of a block's centre by central differences of the chain, in steps far below what it needs.

    `lag`: joints bear what their closure is so much later, as of contact forces of a step's end, half a step.
    """
    m, k, r = PILE["mass"], PILE["joint"], PILE["rock"]
    step, u, s = 5e-5, np.zeros(blocks), np.zeros(blocks)
    u_before, s_before = u.copy(), s.copy()
    corner_times = np.arange(int(end / PILE_PERIOD * PILE_PIECES) + 2) * PILE_PERIOD / PILE_PIECES
    corners = PILE_TOP * np.sin(2 * math.pi / PILE_PERIOD * corner_times)
    motion, gap = [0.0], np.zeros(blocks - 1)
    for i in range(round(end / step)):
        u[0], s[0] = np.interp(i * step, corner_times, corners), 0
        before, gap = gap, u[1:] - s[1:] - u[:-1] - s[:-1]
        force = k * (gap + lag * (gap - before) / step)
        pull_u, pull_s = np.zeros(blocks), -4 * r * s
        pull_u[1:] -= force
        pull_u[:-1] += force
        pull_s[1:] += force
        pull_s[:-1] += force
        u, u_before = 2 * u - u_before + step**2 / m * pull_u, u
        s, s_before = 2 * s - s_before + step**2 / (m / 3) * pull_s, s
        motion.append(u[watched - 1])
    return np.arange(len(motion)) * step, np.array(motion)


def block_pile(program, full):
    """A sine put in at the foot of a pile of blocks: the speed and height of the wave that runs up."""
    found = Findings("block_pile", "Wave in a pile of blocks")
    near, far, blocks, end = (20, 60, 100, 0.36) if full else (10, 20, 40, 0.19)
    smaller = {"solid.1.max": [2, 2, 2 * blocks], "analysis.time_step": 4e-4, "analysis.end_time": end,
               "monitor.1.point": [1, 1, 2 * near - 1], "monitor.2.point": [1, 1, 2 * far - 1]}
    document = program.run("block_pile", {} if full else smaller)
    time, lower = history(document, "block 20", "displacement", "z")
    _, upper = history(document, "block 60", "displacement", "z")
    q, height = pile_wave()
    omega = 2 * math.pi / PILE_PERIOD
    there = time >= end - PILE_PERIOD - 1e-9
    basis = np.stack([np.sin(omega * time[there]), np.cos(omega * time[there])], 1)
    first, second = (complex(*np.linalg.lstsq(basis, u[there], rcond=None)[0]) for u in (lower, upper))
    behind = float(-np.angle(second / first)) % (2 * math.pi)
    behind += 2 * math.pi * round((q * (far - near) - behind) / (2 * math.pi))
    found.row(f"speed of the wave, from block {near} to block {far}", "m/s", 2 * omega / q, 2 * omega * (far - near) / behind, 2e-2, "closed form")
    found.row(f"its height at block {near}", "mm", 1e3 * height, 1e3 * abs(first), 2e-2, "closed form")
    found.row(f"its height at block {far}", "mm", 1e3 * height, 1e3 * abs(second), 2e-2, "closed form")
    exact_time, exact = pile_motion(blocks, end, far)
    late = pile_motion(blocks, end, far, (time[1] - time[0]) / 2)[1]
    off = np.abs(upper - np.interp(time, exact_time, late)).max() / PILE_TOP
    found.row(f"motion of block {far} at any time, off a chain whose joints lag by half a step, over the height", "relative", 0, float(off), 5e-3,
              "central differences")
    panel = Panel("Motion of the blocks", "time, s", "displacement, mm")
    panel.lines.append(Line(f"block {near}", time.tolist(), (1e3 * lower).tolist(), "curve"))
    panel.lines.append(Line(f"block {far}", time.tolist(), (1e3 * upper).tolist(), "curve"))
    panel.lines.append(Line(f"block {far}, springs and masses", exact_time[::20].tolist(), (1e3 * exact[::20]).tolist(), "reference"))
    found.panels.append(panel)
    return found


OFF_NODES = "spacing = 0.5\norigin = [0.1, 0.2, 0.15]"
LATTICES = (("block covers", 'lattice = "block"'), ("hex8, order 0", f'lattice = "hex8"\n{OFF_NODES}'), 
            ("tet6, order 0", f'lattice = "tet6"\n{OFF_NODES}'), ("tet6, order 1", f'lattice = "tet6"\norder = 1\n{OFF_NODES}'))


def stretched(program, found, full):
    """A bar of 4 × 1 × 1 m, held at one end, pulled or pressed at the other, with a joint across it whose normal is off its axis by an angle."""
    normal, shear, stress = 2e9, 1e9, 1e3
    for angle in (30, 60) if full else (30,):
        for name, cover in LATTICES if full else LATTICES[:2]:
            for sign in (1, -1):
                text = bar(angle, normal, shear, sign * stress, cover)
                document = program.run("jointed_bar", edit=lambda _, text=text: text)
                c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
                u = monitor(document, "end")["displacement"][-1]
                along = sign * stress * (3.999 / 1e9 + c**3 / normal + s * s * c / shear)
                # pulled, the far side slips down the joint's normal to the other
                across = sign * stress * (c * c * s / normal - s * c * c / shear)
                what = f"bar {'pulled' if sign > 0 else 'pressed'} across a joint at {angle}°, {name}"
                found.row(f"{what}: along", "m", along, u[0], 1e-4, "closed form")
                found.row(f"{what}: across", "m", across, u[2], 1e-3, "closed form")


def bar(angle, normal, shear, stress, cover):
    return f"""gravity = [0, 0, 0]
[[material]]
density = 2500
young_modulus = 1e9
poisson_ratio = 0
[[joint_material]]
name = "glued"
friction_angle = 0
cohesion = 1e9
tensile_strength = 1e9
normal_stiffness = {normal}
shear_stiffness = {shear}
[[solid]]
name = "bar"
shape = "box"
min = [0, 0, 0]
max = [4, 1, 1]
[[joint]]
name = "across"
dip = {90 - angle}
dip_direction = 90
point = [2, 0.5, 0.5]
[cover]
{cover}
[[fixed]]
where = {{face = "bar.xmin"}}
[[traction]]
where = {{face = "bar.xmax"}}
value = [{stress}, 0, 0]
[analysis]
type = "quasi_static"
time_step = 1
steps = 8
[[monitor]]
name = "end"
point = [3.999, 0.5, 0.5]
"""
