"""Dynamic cases, as those of statics.py."""
import math

import numpy as np

from runner import Findings, Line, Panel, last, monitor

ORDER = ("constant covers", "linear covers", "quadratic covers")


def history(document, name, what, component):
    entry = monitor(document, name)
    index = (["xx", "yy", "zz", "xy", "yz", "zx"] if what == "stress" else ["x", "y", "z"]).index(component)
    return np.array(entry["time"]), np.array([value[index] for value in entry[what]])


def frequencies(signal, step, modes):
    """Frequencies (Hz) of a sum of undamped oscillations by matrix pencil (Hua & Sarkar 1990), strongest first."""
    n = len(signal)
    width = n // 2
    windows = np.lib.stride_tricks.sliding_window_view(signal, width + 1)
    _, singular, vectors = np.linalg.svd(windows, full_matrices=False)
    rank = min(2 * modes, int((singular > 1e-9 * singular[0]).sum()))
    v = vectors[:rank].T
    poles = np.linalg.eigvals(np.linalg.lstsq(v[:-1], v[1:], rcond=None)[0])
    poles = poles[(np.abs(np.abs(poles) - 1) < 0.02) & (poles.imag > 1e-9)]
    basis = np.vander(np.concatenate([poles, poles.conj()]), n, increasing=True).T
    amplitude = np.abs(np.linalg.lstsq(basis, signal, rcond=None)[0][:len(poles)])
    return (np.angle(poles) / (2 * math.pi * step))[np.argsort(-amplitude)], np.sort(amplitude)[::-1]


def continuous(frequency, step):
    """The frequency of the structure whose motion by average acceleration has this one: tan(w dt / 2) instead of w dt / 2."""
    return math.tan(math.pi * frequency * step) / (math.pi * step)


def nearest(found, expected, step):
    return min((continuous(f, step) for f in found), key=lambda f: abs(f - expected))


def spectrum(signal, step):
    """Amplitude over frequency, with a Hann window, zero-padded."""
    n = len(signal)
    padded = np.abs(np.fft.rfft((signal - signal.mean()) * np.hanning(n), 8 * n))
    return np.fft.rfftfreq(8 * n, step), padded / padded.max()


def spectrum_panel(title, channels, step, highest, marks):
    panel = Panel(title, "frequency, Hz", "amplitude of velocity, relative", log="y")
    for label, signal in channels.items():
        f, a = spectrum(signal, step)
        keep = f <= highest
        panel.lines.append(Line(label, f[keep].tolist(), np.maximum(a[keep], 1e-6).tolist(), "curve"))
    for label, f in marks.items():
        panel.lines.append(Line(label, [f, f], [1e-5, 2], "reference"))
    return panel


def vibration(program, full):
    found = Findings("vibration", "Vibration of a cantilever")
    expected = {"bending 1": (1.6113, "z"), "bending 2": (9.664, "z"), "bending 3": (25.45, "z"), "torsion": (14.28, "t"),
                "stretching": (25.08, "x")}
    changes = {} if full else {"cover.order": 1}
    document = program.run("vibration", changes)
    time, z = history(document, "tip", "velocity", "z")
    _, side = history(document, "side", "velocity", "z")
    _, x = history(document, "tip", "velocity", "x")
    step = time[1] - time[0]
    channels = {"z": z, "t": side - z, "x": x}
    measured = {key: frequencies(signal[1:], step, 24)[0] for key, signal in channels.items()}
    for name, (reference, channel) in expected.items():
        if full or name in ("bending 1", "bending 2"):
            # one cell across the section is too few for its warping in torsion: linear covers are 8.6, 2.1 % off with one, two cells
            tolerance = 0.03 if name == "torsion" or not full else 0.01
            found.row(f"frequency, {name}, {ORDER[2 if full else 1]}", "Hz", reference, nearest(measured[channel], reference, step),
                      tolerance, "finite elements")
    found.panels.append(spectrum_panel("Spectrum at the tip", {"along z": z, "side less middle, along z": side - z, "along x": x}, step, 40,
                                       {"finite elements": 1.6113, **{f"_{i}": f for i, f in enumerate((9.664, 14.28, 25.08, 25.45))}}))
    return found


def simply_supported(program, full):
    found = Findings("simply_supported", "Vibration of a beam on two supports")
    changes = {} if full else {"analysis.end_time": 0.4, "cover.order": 1}
    document = program.run("simply_supported", changes)
    time, z = history(document, "under the load", "velocity", "z")
    step = time[1] - time[0]
    measured = frequencies(z[1:], step, 24)[0]
    for name, reference in (("1", 4.4566), ("2", 16.996), ("3", 35.71)) if full else (("1", 4.4566),):
        found.row(f"frequency, bending {name}, {ORDER[2 if full else 1]}", "Hz", reference, nearest(measured, reference, step),
                  0.01 if full else 0.03, "finite elements")
    found.panels.append(spectrum_panel("Spectrum under the load", {"along z": z}, step, 50,
                                       {"finite elements": 4.4566, "_2": 16.996, "_3": 35.71}))
    return found


def crossing(time, values, level):
    """First time at which values reach a level, between steps."""
    i = int(np.argmax(values >= level))
    return time[i - 1] + (level - values[i - 1]) / (values[i] - values[i - 1]) * (time[i] - time[i - 1])


def wave(program, full):
    """A step of 1 MPa: particle velocity p/(rho c) behind the front; twice the stress at the fixed end; 2L/c there and back."""
    found = Findings("wave", "Wave in a bar")
    speed, velocity = math.sqrt(1e9 / 2500), 1e6 / math.sqrt(1e9 * 2500)
    document = program.run("wave", {} if full else {"cover.spacing": [0.5, 0.5, 0.25], "analysis.time_step": 2e-4})
    time, v = history(document, "middle", "velocity", "x")
    _, stress = history(document, "far end", "stress", "xx")
    _, u = history(document, "loaded end", "displacement", "x")
    behind = (time > 5.06 / speed + 0.002) & (time < (20 - 5.06) / speed - 0.002)
    found.row("velocity behind the front", "m/s", velocity, float(v[behind].mean()), 0.01, "closed form")
    found.row("arrival at 5.06 m", "s", 5.06 / speed, crossing(time, v, velocity / 2), 0.01, "closed form")
    behind = (time > 10 / speed + 0.002) & (time < 30 / speed - 0.002)
    found.row("stress at the fixed end", "Pa", -2e6, float(stress[behind].mean()), 0.01, "closed form")
    found.row("arrival at the fixed end", "s", 9.94 / speed, crossing(time, -stress, 1e6), 0.01, "closed form")
    found.row("largest displacement of the loaded end", "m", 0.02, float(u.max()), 0.01, "closed form")
    free = program.run("wave", {"fixed.1.components": ["y"], "analysis.end_time": 0.03})
    time2, v2 = history(free, "far end", "velocity", "x")
    behind = (time2 > 10 / speed + 0.002) & (time2 < 30 / speed - 0.002)
    found.row("velocity of a free end", "m/s", 2 * velocity, float(v2[behind].mean()), 0.01, "closed form")
    middle, end = Panel("Velocity at 5.06 m", "time, ms", "velocity, m/s"), Panel("Stress at the fixed end", "time, ms", "stress xx, MPa")
    displacement = Panel("Displacement of the loaded end", "time, ms", "displacement, mm")
    middle.lines.append(Line("ours", (1e3 * time).tolist(), v.tolist(), "curve"))
    t = np.array([0, 5.06, 14.94, 25.06, 34.94, 40]) / speed * 1e3
    middle.lines.append(Line("closed form", np.repeat(t, 2)[1:-1].tolist(), np.repeat([0, velocity, 0, -velocity, 0], 2).tolist(), "reference"))
    end.lines.append(Line("ours", (1e3 * time).tolist(), (stress / 1e6).tolist(), "curve"))
    t = np.array([0, 9.94, 10.06, 29.94, 30.06, 40]) / speed * 1e3
    end.lines.append(Line("closed form", np.repeat(t, 2)[1:-1].tolist(), np.repeat([0, -1, -2, -1, 0], 2).tolist(), "reference"))
    displacement.lines.append(Line("ours", (1e3 * time).tolist(), (1e3 * u).tolist(), "curve"))
    displacement.lines.append(Line("closed form", [0, 20e3 / speed, 40e3 / speed], [0, 20, 0], "reference"))
    found.panels += [middle, end, displacement]
    return found


def oscillator(program, full):
    """Period and energy of one degree of freedom by average acceleration; decay by beta = 1/2, gamma = 1 (DDA)."""
    found = Findings("oscillator", "Oscillator: error of the period")
    steps = (0.1, 0.2, 0.5, 1.0, 2.0) if full else (0.5,)
    errors = []
    for o in steps:
        document = program.run("oscillator", {"analysis.time_step": o / 10, "analysis.steps": int(120 / o)})
        time, x = history(document, "block", "displacement", "x")
        _, v = history(document, "block", "velocity", "x")
        omega = 2 * math.pi * frequencies(x, o / 10, 1)[0][0]
        errors.append(10 / omega - 1)
        exact = o / (2 * math.atan(o / 2)) - 1
        found.row(f"period, omega dt = {o}: T/T0 - 1", "", exact, errors[-1], 1e-4, "closed form")
        energy = 500 * v**2 + 5e4 * x**2
        found.row(f"energy, omega dt = {o}: drift", "relative", 0, float(np.abs(energy / energy[0] - 1).max()), 1e-9, "closed form")
    panel = Panel("Period by average acceleration", "omega dt", "T / T0 - 1", log="xy", slopes=[2])
    panel.lines.append(Line("ours", list(steps), errors, "marks"))
    o = np.geomspace(0.08, 2.2, 50)
    panel.lines.append(Line("closed form", o.tolist(), (o / (2 * np.arctan(o / 2)) - 1).tolist(), "reference"))
    found.panels.append(panel)
    panel = Panel("Amplitude a step by beta = 1/2, gamma = 1", "omega dt", "spectral radius")
    radii = []
    for o in steps:
        document = program.run("oscillator", {"analysis.time_step": o / 10, "analysis.steps": 60, "analysis.newmark.beta": 0.5,
                                             "analysis.newmark.gamma": 1.0})
        _, x = history(document, "block", "displacement", "x")
        _, v = history(document, "block", "velocity", "x")
        state = np.array([x, v / 10])
        # two states and their successors give the amplification of the pair (x, v): its eigenvalues' modulus
        step = state[:, 2:31] @ np.linalg.pinv(state[:, 1:30])
        radii.append(float(np.abs(np.linalg.eigvals(step)).max()))
        found.row(f"spectral radius, beta = 1/2, gamma = 1, omega dt = {o}", "", math.sqrt(2 / (2 + o * o)), radii[-1], 1e-6, "closed form")
    panel.lines.append(Line("ours", list(steps), radii, "marks"))
    o = np.linspace(0, 2.2, 50)
    panel.lines.append(Line("closed form", o.tolist(), np.sqrt(2 / (2 + o * o)).tolist(), "reference"))
    found.panels.append(panel)
    return found


def quasi_static(program, full):
    """The motion of dynamic ratio 0 comes to rest where statics is."""
    found = Findings("quasi_static", "Quasi-static equals static")
    panel = Panel("Displacement by quasi-static steps", "step", "difference to static, relative", log="y")
    for case, name, order in (("cantilever", "tip", 1), ("column", "top", 0)) if full else (("column", "top", 0),):
        static = last(program.run(case, {"cover.order": order}), name, "displacement", "z")
        document = program.run(case, {"cover.order": order, "analysis.type": "quasi_static", "analysis.time_step": 10.0, "analysis.steps": 30})
        _, z = history(document, name, "displacement", "z")
        found.row(f"{case}, displacement", "m", static, float(z[-1]), 1e-6, "static analysis")
        panel.lines.append(Line(case, list(range(1, len(z))), np.maximum(np.abs(z[1:] / static - 1), 1e-16).tolist()))
    found.panels.append(panel)
    return found


def plate_peak(program, full):
    """The plate of Table 4-2, loaded at once: largest over stable deflection."""
    found = Findings("plate_peak", "Plate of the thesis under a sudden load")
    spacing = [0.1, 0.2, 0.2] if full else [0.1, 0.5, 0.5]
    stable = -last(program.run("plate_large", {"cover.spacing": spacing}), "centre", "displacement", "z")
    document = program.run("plate_large", {"cover.spacing": spacing, "analysis.type": "dynamic", "analysis.time_step": 0.01 if full else 0.02,
                                           "analysis.end_time": 0.6 if full else 0.24, "output.every": 0})
    time, z = history(document, "centre", "displacement", "z")
    found.row("largest over stable deflection", "", 1.59, float((-z).max() / stable), 0.03, "thesis: 1.550, 1.588, 1.612")
    panel = Panel("Deflection of the centre", "time, s", "deflection, m")
    panel.lines.append(Line("ours, undamped", time.tolist(), (-z).tolist(), "curve"))
    panel.lines.append(Line("static equilibrium", [0, float(time[-1])], [stable, stable], "reference"))
    panel.lines.append(Line("1.59 times that", [0, float(time[-1])], [1.59 * stable, 1.59 * stable], "reference"))
    found.panels.append(panel)
    return found
