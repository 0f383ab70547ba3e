"""Static cases. Each function runs a model of tests/cases and compares with its reference (numbers: tests/cases/NAME/README.md).

`full` runs all lattices, orders and spacings of the figure, else the few that take a second.
"""
import math

import numpy as np

import fields
from fields import errors, in_eighth, in_quarter, kirsch_stress, probes
from runner import Findings, Line, Panel, last, monitor, without

LATTICES = ("tet5", "tet5 mixed", "tet6", "tet6_kuhn", "tet24", "hex8", "block")
ORDER = ("constant covers", "linear covers", "quadratic covers")


def lattice_changes(lattice):
    if lattice == "tet5 mixed":
        return {"cover.lattice": "tet5", "cover.mixed": True}
    return {"cover.lattice": lattice}


def block_edit(text):
    """Lattice "block" has no planes, and covers of its own for each block: joints that end in it remain."""
    through = text.find("[[joint]]               # through-going")
    if through >= 0:
        text = text[:through] + text[text.index("[[joint]]", through + 9):]
    return without("directions", "origin", "joints", "spacing")(text)


def patch_errors(program, case, exact, stress, lattice, order):
    """Largest relative errors of displacement and stress at the monitors."""
    document = program.run(case, {**lattice_changes(lattice), "cover.order": order}, block_edit if lattice == "block" else None)
    points = {entry["name"]: entry for entry in document["monitors"]}
    found = {name: np.array(entry["displacement"][-1]) for name, entry in points.items()}
    true = {name: exact(np.array(PATCH_POINTS[case][name], float)) for name in found}
    scale = max(np.abs(u).max() for u in true.values())
    displacement = max(np.abs(found[name] - true[name]).max() for name in found) / scale
    scale = max(np.abs(stress).max(), 1.0)
    worst = max(np.abs(np.array(entry["stress"][-1]) - stress).max() for entry in points.values()) / scale
    return displacement, worst


PATCH_POINTS = {"patch": {"top": (1, 0.5, 1), "middle": (0.45, 0.52, 0.48), "side": (0.05, 0.9, 0.1)},
                "bending_patch": {"end": (1, 0, 0), "corner": (1, 0.3, 0.4), "edge": (-1, -0.3, 0.4)}}


def uniform_field(x):
    """Displacement of the patch test: strain times the way from its first support, with the rotation that the three leave none of."""
    x = x - np.array([0.3, 0.2, 0.25])
    xx, yy, zz, xy, yz, zx = 2e-3, -1e-3, 3e-3, 0.75e-3, 1e-3, -0.75e-3
    return np.array([xx * x[0] + 2 * xy * x[1] + 2 * zx * x[2], yy * x[1] + 2 * yz * x[2], zz * x[2]])


def bending_field(x, nu=0.25, curvature=0.01):
    return curvature * np.array([-x[0] * x[2], nu * x[1] * x[2], (x[0]**2 + nu * (x[2]**2 - x[1]**2)) / 2])


def patch_case(program, full, name, title, exact, stress, orders, needs, stress_tolerance=1e-10):
    found = Findings(name, title)
    panel = Panel(title, "lattice", "largest relative error", log="y", ticks=list(LATTICES))
    for order in orders:
        errors = {}
        for lattice in LATTICES if full else ("tet6", "tet5 mixed"):
            if needs(lattice, order):
                errors[lattice] = patch_errors(program, name, exact, stress, lattice, order)
        displacement, worst = (max(e[i] for e in errors.values()) for i in (0, 1))
        where = "every lattice" if full else "tet6 and tet5 mixed"
        found.row(f"displacement, {ORDER[order]}, {where}", "relative", 0, displacement, 1e-10, "exact")
        found.row(f"stress, {ORDER[order]}, {where}", "relative", 0, worst, stress_tolerance, "exact")
        at = [LATTICES.index(lattice) for lattice in errors]
        panel.lines.append(Line(f"displacement, {ORDER[order]}", at, [max(e[0], 1e-17) for e in errors.values()], "marks"))
        panel.lines.append(Line(f"stress, {ORDER[order]}", at, [max(e[1], 1e-17) for e in errors.values()], "marks"))
    panel.lines.append(Line("tolerance", [-0.5, len(LATTICES) - 0.5], [stress_tolerance] * 2, "reference"))
    found.panels.append(panel)
    return found


def patch(program, full):
    stress = np.array([3.2, 0.8, 4.0, 0.6, 0.8, -0.6])
    return patch_case(program, full, "patch", "Patch test: uniform stress", uniform_field, stress, (0, 1, 2),
                      lambda lattice, order: lattice != "block" or order > 0)


def bending_patch(program, full):
    # 1e-8: a monitor stands in the very corner of the box, where the solver's residual of 1e-12 shows in tiny elements (tet24: 7e-9 Pa)
    return patch_case(program, full, "bending_patch", "Patch test: pure bending", bending_field, np.zeros(6), (1, 2),
                      lambda lattice, order: lattice != "block" or order > 1, 1e-8)


def column(program, full):
    found = Findings("column", "Column under its own weight")
    height = np.linspace(0.1, 9.9, 26)
    panel = Panel("Vertical stress", "stress zz, kPa", "height, m")
    for order in (0, 1, 2) if full else (0, 1):
        spacing = 0.5 if order == 0 or full and order == 1 else 1.0
        document = program.run("column", {"cover.order": order, "cover.spacing": spacing, "solver.tolerance": 1e-10}, probes([(0.5, 0.5, z) for z in height]))
        top, base = last(document, "top", "displacement", "z"), last(document, "base", "stress", "zz")
        found.row(f"settlement of the top, {ORDER[order]}", "m", 0.0098, -top, 2e-3 if order == 0 else 1e-6, "closed form")
        if order:  # 1e-5: the multipliers of the base stop at a gap of 1e-7 of the settlement
            found.row(f"stress 10 mm above the base, {ORDER[order]}", "Pa", -195804, base, 1e-5, "closed form")
        stress = [last(document, f"probe {i}", "stress", "zz") / 1e3 for i in range(len(height))]
        panel.lines.append(Line(f"{ORDER[order]}, spacing {spacing} m", stress, list(height), "marks"))
    panel.lines.insert(0, Line("closed form", [-196, 0], [0, 10], "reference"))
    found.panels.append(panel)
    return found


def convergence(program, case, orders, measure, change=lambda h: {"cover.spacing": h}):
    """{order: [(spacing, measured)]} for {order: spacings}."""
    return {order: [(h, measure(program.run(case, {"cover.order": order, **change(h)}))) for h in spacings]
            for order, spacings in orders.items()}


def error_panel(series, reference, title, y, slopes=()):
    panel = Panel(title, "spacing, m", y, log="xy", slopes=list(slopes))
    for order, points in series.items():
        panel.lines.append(Line(ORDER[order], [h for h, _ in points], [abs(v / reference - 1) for _, v in points]))
    return panel


def value_panel(series, reference, title, y, name="reference"):
    panel = Panel(title, "spacing, m", y)
    for order, points in series.items():
        panel.lines.append(Line(ORDER[order], [h for h, _ in points], [v for _, v in points]))
    widest = max(h for points in series.values() for h, _ in points)
    panel.lines.append(Line(name, [0, widest], [reference, reference], "reference"))
    return panel


def cantilever(program, full):
    found = Findings("cantilever", "Cantilever")

    def tip(document):
        return -last(document, "tip", "displacement", "z")

    orders = {0: (1.0, 0.5, 0.25, 0.125), 1: (1.0, 0.5, 0.25), 2: (1.0, 0.5)} if full else {1: (0.5,)}
    series = convergence(program, "cantilever", orders, tip)
    for order, at in ((1, 0.25), (2, 0.5)) if full else ((1, 0.5),):
        found.row(f"tip deflection under 1 N, {ORDER[order]}, spacing {at} m", "m", 0.0040015, dict(series[order])[at], 0.01,
                  "finite elements, extrapolated")
    if full:
        weight = program.run("cantilever", {"gravity": [0, 0, -10], "traction.1.value": [0, 0, 0], "cover.order": 2, "cover.spacing": 0.5})
        found.row("tip deflection under its weight, quadratic covers, spacing 0.5 m", "m", 0.1801, tip(weight), 0.01,
                  "finite elements, extrapolated")
        bending = program.run("cantilever", {"cover.order": 2, "cover.spacing": 0.5})
        found.row("bending stress half way, quadratic covers", "Pa", 30, last(bending, "middle", "stress", "xx"), 0.01, "beam theory")
    found.panels += [value_panel(series, 0.0040015, "Tip deflection under 1 N", "deflection, m", "finite elements, extrapolated"),
                     error_panel(series, 0.0040015, "Its error", "relative error", (2,))]
    return found


def cook(program, full):
    found = Findings("cook", "Cook's membrane")

    def middle(document):
        return last(document, "middle", "displacement", "y")

    orders = {0: (8, 4, 2, 1), 1: (8, 4, 2), 2: (8, 4)} if full else {1: (8,)}
    series = convergence(program, "cook", orders, middle, lambda h: {"cover.spacing": [1, h, h]})
    for order, at in ((1, 2), (2, 4)) if full else ((1, 8),):
        found.row(f"deflection at (48, 52), {ORDER[order]}, spacing {at} m", "m", 23.96, dict(series[order])[at],
                  0.01 if full else 0.03, "finite elements, extrapolated")
    found.panels += [value_panel(series, 23.96, "Deflection at (48, 52)", "deflection, m", "finite elements, extrapolated"),
                     error_panel(series, 23.96, "Its error", "relative error", (1.3,))]
    return found


def le10(program, full):
    found = Findings("le10", "Thick plate (NAFEMS LE10)")

    def stress(document):
        return last(document, "D", "stress", "yy") / 1e6

    orders = {1: (0.5, 0.3, 0.2, 0.15, 0.1), 2: (0.5, 0.3, 0.25)} if full else {1: (0.5,)}
    series = convergence(program, "le10", orders, stress, lambda h: {"cover.spacing": [0.3 if h > 0.1 else 0.2, h, h]})
    if full:
        for order, at in ((1, 0.1), (2, 0.25)):
            found.row(f"stress yy at D, {ORDER[order]}, spacing {at} m", "MPa", -5.38, dict(series[order])[at], 0.03, "NAFEMS")
    else:
        found.row("stress yy at D, linear covers, spacing 0.5 m", "MPa", -5.38, series[1][0][1], 0.1, "NAFEMS")
    found.panels.append(value_panel(series, -5.38, "Stress yy at D", "stress, MPa", "NAFEMS"))
    return found


def study(program, found, orders, at, quantities, change, exact, points, within):
    """Runs {order: spacings} with probes at `points`, of which a panel of errors each for displacement and stress, and how fast they fall.

    A row for each of `quantities`: {name: (unit, reference, measure(document))} at each of `at`: {order: spacing}, to be met within `within`, or
    what stands fourth; rows for the errors over the points.
    """
    falls = {what: {} for what in ("displacement", "stress")}
    for order, spacings in orders.items():
        for spacing in spacings:
            document = program.run(found.name, {"cover.order": order, **change(spacing)}, probes(points))
            for what, error in zip(falls, errors(document, exact, points)):
                falls[what].setdefault(order, []).append((spacing, error))
            if at.get(order) == spacing:
                for name, (unit, reference, measure, *own) in quantities.items():
                    found.row(f"{name}, {ORDER[order]}, spacing {spacing} m", unit, reference, measure(document), *(own or [within]), "closed form")
    for what, series in falls.items():
        panel = Panel(f"{what.capitalize()} at {len(points)} points", "spacing, m", "error, root mean square, relative", log="xy",
                      slopes=[order + (2 if what == "displacement" else 1) for order in series])
        for order, line in series.items():
            panel.lines.append(Line(ORDER[order], [h for h, _ in line], [e for _, e in line]))
            if order in at:
                found.row(f"error of {what} at {len(points)} points, {ORDER[order]}, spacing {at[order]} m", "relative", 0,
                          dict(line)[at[order]], within, "closed form")
        found.panels.append(panel)
    return falls


def order_of_convergence(found, falls, expected):
    """Rows for {order of covers: order of the stress's error} between the two finest spacings.

    Cells are not small against the radius of the wall, so that the orders come up to theory from below: they may fall short by 0.3 of it.
    """
    for order, theory in expected.items():
        (wide, more), (fine, less) = falls["stress"][order][-2:]
        found.row(f"order of convergence of stress, {ORDER[order]}, spacing {wide} to {fine} m", "", theory,
                  math.log(more / less) / math.log(wide / fine), 0.3, "theory")


def along(document, name, what, direction):
    """Component of a vector, or of a stress's traction, along a unit direction."""
    value = monitor(document, name)[what][-1]
    if what != "stress":
        return sum(a * b for a, b in zip(value, direction))
    xx, yy, zz, xy, yz, zx = value
    x, y, z = direction
    return xx * x * x + yy * y * y + zz * z * z + 2 * (xy * x * y + yz * y * z + zx * z * x)


def hollow_cylinder(program, full):
    found = Findings("hollow_cylinder", "Thick cylinder under internal pressure (Lame)")
    angle = math.pi / 64
    inner = (math.cos(angle), math.sin(angle), 0)
    bisector, across = (math.sqrt(0.5), math.sqrt(0.5), 0), (-math.sqrt(0.5), math.sqrt(0.5), 0)
    quantities = {
        "radial displacement at 1 m": ("m", 0.00190667, lambda d: along(d, "inner", "displacement", inner)),
        "radial displacement at 1.5 m": ("m", 0.00141556, lambda d: along(d, "bisector", "displacement", bisector)),
        "radial displacement at 2 m": ("m", 0.00121333, lambda d: last(d, "outer", "displacement", "x")),
        "hoop stress at 1.1 m": ("Pa", (1 + 4 / 1.21) / 3, lambda d: last(d, "near", "stress", "yy")),
        "hoop stress at 1.5 m": ("Pa", 25 / 27, lambda d: along(d, "bisector", "stress", across)),
        "radial stress at 1.5 m": ("Pa", -7 / 27, lambda d: along(d, "bisector", "stress", bisector))}
    orders = {0: (0.5, 0.25, 0.125, 0.0625), 1: (0.5, 0.25, 0.125), 2: (0.5, 0.25)} if full else {1: (0.5, 0.25)}
    falls = study(program, found, orders, {1: 0.125, 2: 0.25} if full else {1: 0.25}, quantities, lambda h: {"cover.spacing": [0.25, h, h]},
                  fields.lame_cylinder, in_quarter((1.1, 1.2, 1.35, 1.5, 1.65, 1.8), 40, 0.125), 0.01 if full else 0.03)
    order_of_convergence(found, falls, {0: 1, 1: 2} if full else {1: 2})
    return found


def hollow_sphere(program, full):
    found = Findings("hollow_sphere", "Thick sphere under internal pressure (Lame)")
    golden = (1 + math.sqrt(5)) / 2
    third, outer = (math.sqrt(1 / 3),) * 3, tuple(x / math.hypot(golden, 1) for x in (golden, 0, 1))
    quantities = {
        "radial displacement at 1 m": ("m", 0.0008, lambda d: along(d, "inner", "displacement", third)),
        "radial displacement at 1.5 m": ("m", 131 / 315000, lambda d: along(d, "middle", "displacement", third)),
        "radial displacement at 2 m": ("m", 0.0003, lambda d: along(d, "outer", "displacement", outer))}
    orders = {0: (0.5, 0.25, 0.125, 0.0625), 1: (0.5, 0.25, 0.125, 0.0833), 2: (1.0, 0.5, 0.25)} if full else {1: (0.25, 0.166)}
    falls = study(program, found, orders, {1: 0.0833, 2: 0.25} if full else {1: 0.166}, quantities, lambda h: {"cover.spacing": h},
                  fields.lame_sphere, in_eighth((1.15, 1.25, 1.35, 1.45, 1.55, 1.65, 1.7), 60), 0.01 if full else 0.03)
    order_of_convergence(found, falls, {0: 1, 1: 2} if full else {1: 2})
    return found


def spherical_cavity(program, full):
    found = Findings("spherical_cavity", "Spherical cavity under uniaxial stress")
    points = {"equator 1.1 m": (1.1, 0, 0), "pole 1.1 m": (0, 0, 1.1), "equator 1.5 m": (1.5, 0, 0)}
    quantities = {f"displacement {c} at the {name}": ("m", fields.goodier(points[name])[0]["xyz".index(c)],
                                                       lambda d, name=name, c=c: last(d, name, "displacement", c))
                  for name, c in (("equator 1.1 m", "x"), ("pole 1.1 m", "z"), ("equator 1.5 m", "x"))}
    orders = {0: (0.5, 0.25, 0.125, 0.0625), 1: (0.5, 0.25, 0.125, 0.1), 2: (1.0, 0.5, 0.25)} if full else {1: (0.2,)}
    falls = study(program, found, orders, {1: 0.1, 2: 0.25} if full else {1: 0.2}, quantities, lambda h: {"cover.spacing": h},
                  fields.goodier, in_eighth((1.15, 1.25, 1.4, 1.6, 1.8, 2), 60), 0.01 if full else 0.03)
    order_of_convergence(found, falls, {0: 1, 1: 2} if full else {})
    return found


def kirsch(program, full):
    found = Findings("kirsch", "Hole in a plate (Kirsch)")
    diagonal = (math.sqrt(0.5), math.sqrt(0.5), 0)
    across = (-math.sqrt(0.5), math.sqrt(0.5), 0)
    quantities = {
        "stress xx at 1.1 m, 90 deg": ("Pa", kirsch_stress(1.1, 90)[1], lambda d: last(d, "1.1 m, 90 deg", "stress", "xx")),
        # a fifth of the stress at the wall of 3 Pa: 3 % are 0.6 % of that
        "stress yy at 1.1 m, 0 deg": ("Pa", kirsch_stress(1.1, 0)[1], lambda d: last(d, "1.1 m, 0 deg", "stress", "yy"), 0.03),
        "stress xx at 2 m, 90 deg": ("Pa", 39 / 32, lambda d: last(d, "2 m, 90 deg", "stress", "xx")),
        "stress yy at 2 m, 90 deg": ("Pa", 9 / 32, lambda d: last(d, "2 m, 90 deg", "stress", "yy")),
        "radial stress at 3 m, 45 deg": ("Pa", 4 / 9, lambda d: along(d, "3 m, 45 deg", "stress", diagonal)),
        "hoop stress at 3 m, 45 deg": ("Pa", 5 / 9, lambda d: along(d, "3 m, 45 deg", "stress", across)),
        "displacement x at 2 m, 0 deg": ("m", 0.00297375, lambda d: last(d, "2 m, 0 deg", "displacement", "x")),
        "radial displacement at 3 m, 45 deg": ("m", 9.96667e-4, lambda d: along(d, "3 m, 45 deg", "displacement", diagonal)),
        "hoop displacement at 3 m, 45 deg": ("m", -2.147407e-3, lambda d: along(d, "3 m, 45 deg", "displacement", across))}
    orders = {0: (0.5, 0.25, 0.125, 0.0625), 1: (0.5, 0.25, 0.125), 2: (1.0, 0.5, 0.25)} if full else {1: (0.2,)}
    falls = study(program, found, orders, {1: 0.125, 2: 0.25} if full else {1: 0.2}, quantities, lambda h: {"cover.spacing": [0.5, h, h]},
                  fields.kirsch, in_quarter((1.1, 1.25, 1.5, 2, 2.5, 3, 4), 40, 0.25), 0.01 if full else 0.03)
    order_of_convergence(found, falls, {0: 1, 1: 2} if full else {})
    return found


SPACINGS = (0.52, 0.32, 0.22, 0.12, 0.08, 0.05)
NMM = dict(zip(SPACINGS, (0.18124, 0.32031, 0.31995, 0.39336, 0.39657, 0.38196)))
CONSTANT = dict(zip(SPACINGS, (0.01348, 0.03257, 0.03648, 0.08212, 0.11796, 0.17367)))
THESIS = dict(zip(SPACINGS, (0.16404, 0.25027, 0.34334, 0.37919, 0.39694, 0.39973)))


def plate(program, full):
    """Table 4-1 of the thesis beside an independent program of the same method on the same covers."""
    found = Findings("plate", "Plate of the thesis under its weight (Table 4-1)")
    spacings = SPACINGS if full else SPACINGS[:3]
    panel = Panel("Deflection of the centre", "spacing, m", "deflection, m")
    for order, reference in ((1, NMM), (0, CONSTANT)):
        ours = [-last(program.run("plate", {"cover.order": order, "cover.spacing": h}), "centre", "displacement", "z") for h in spacings]
        for h, value in zip(spacings, ours):
            found.row(f"deflection, {ORDER[order]}, spacing {h} m", "m", reference[h], value, 0.005, "independent NMM, same covers")
        panel.lines.append(Line(f"ours, {ORDER[order]}", list(spacings), ours))
        panel.lines.append(Line(f"independent NMM, {ORDER[order]}", list(reference), list(reference.values()), "marks"))
    panel.lines.append(Line("thesis", list(THESIS), list(THESIS.values()), "marks"))
    found.panels.append(panel)
    return found


def plate_large(program, full):
    """Table 4-2: the deflection under a load of 5 N, in the deformed state; one layer of cells."""
    found = Findings("plate_large", "Plate of the thesis under a point load (Table 4-2)")
    panel = Panel("Deflection of the centre", "spacing, m", "deflection, m")
    series = convergence(program, "plate_large", {1: (0.5, 0.25, 0.2, 0.1, 0.0625), 2: (0.5, 0.25, 0.2)} if full else {1: (0.2,)},
                         lambda document: -last(document, "centre", "displacement", "z"), lambda h: {"cover.spacing": [0.1, h, h]})
    for order, points in series.items():
        panel.lines.append(Line(f"ours, {ORDER[order]}", [h for h, _ in points], [v for _, v in points]))
    if full:
        for order, points in series.items():
            found.row(f"stable deflection, {ORDER[order]}, spacing {points[-1][0]} m", "m", 0.2487, points[-1][1], 0.03,
                      "finite elements (C3D20, 40x40x2)")
        linear = -last(program.run("plate_large", {"analysis.kinematics": "small", "cover.spacing": 0.32, "cover.origin": [0, 0, 0]}),
                       "centre", "displacement", "z")
        found.row("linear deflection, linear covers, spacing 0.32 m", "m", 0.561, linear, 0.005, "independent NMM, same covers")
    else:
        found.row("stable deflection, linear covers, spacing 0.2 m", "m", 0.2186, series[1][0][1], 0.03, "finite elements (C3D20, 8x8x1)")
    for name, value in (("finite elements, 40x40x2", 0.2487), ("thesis, 0.2523 to 0.2555", 0.2539)):
        panel.lines.append(Line(name, [0, 0.2], [value, value], "reference"))
    found.panels.append(panel)
    return found
