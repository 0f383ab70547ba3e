#!/usr/bin/env python3
"""Draws the figures of docs/verification.md and fills its table, from docs/verification.json.

    tests/verification/verify.py --store     runs the cases and writes docs/verification.json
    docs/draw_verification.py                docs/images/verification_NAME.png and the table
    docs/draw_verification.py cook kirsch    only these figures, and the table

It needs matplotlib (Debian, Ubuntu: apt install python3-matplotlib).
"""
import argparse
import json
import math
from pathlib import Path

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

DOCS = Path(__file__).resolve().parent
SIZE = (4.0, 3.2)   # inches a panel
COLOURS = ["#1f5a96", "#c8553d", "#4b8f52", "#7a5195", "#d08c1f", "#4f9da6"]
OF_ORDER = {"constant covers": "#8a8a8a", "linear covers": "#1f5a96", "quadratic covers": "#c8553d"}
MARKS = ["o", "s", "^", "D", "v", "P"]
REFERENCE = ["#222222", "#4b8f52", "#7a5195"]

plt.rcParams.update({"font.size": 9, "axes.titlesize": 10, "axes.grid": True, "grid.color": "#e4e4e4", "grid.linewidth": 0.7,
                     "axes.edgecolor": "#777777", "axes.axisbelow": True, "legend.fontsize": 8, "legend.frameon": False,
                     "font.family": "DejaVu Sans", "lines.linewidth": 1.4, "lines.markersize": 5})


def colour(label, number):
    """An order of covers has the same colour in every figure; other lines take the next of the list."""
    return next((c for order, c in OF_ORDER.items() if order in label), COLOURS[number % len(COLOURS)])


def draw_line(axes, line, number, references):
    label = None if line["label"].startswith("_") else line["label"]
    x, y = line["x"], line["y"]
    if line["style"] == "reference":
        axes.plot(x, y, color=REFERENCE[references % len(REFERENCE)], linestyle="--", linewidth=1.1, label=label, zorder=1)
    elif line["style"] == "marks":
        hollow = not line["label"].startswith(("ours", "displacement"))
        c = colour(line["label"], number)
        axes.plot(x, y, linestyle="none", marker=MARKS[number % len(MARKS)], color=c, label=label,
                  markerfacecolor="white" if hollow else c, zorder=3)
    elif line["style"] == "curve":
        axes.plot(x, y, color=colour(line["label"], number), linewidth=1.1, label=label)
    else:
        axes.plot(x, y, color=colour(line["label"], number), marker=MARKS[number % len(MARKS)], label=label, zorder=3)


def draw_slopes(axes, panel):
    """A dotted line of the theoretical slope through the middle of each line (one slope each, or one for all), with its exponent."""
    lines = [line for line in panel["lines"] if line["style"] == "ours"]
    slopes = panel["slopes"] * (len(lines) if len(panel["slopes"]) == 1 else 1)
    for number, (line, exponent) in enumerate(zip(lines, slopes)):
        points = sorted(zip(line["x"], line["y"]))
        x0, y0 = points[len(points) // 2]
        ends = np.array([points[0][0], points[-1][0]])
        y = y0 * (ends / x0) ** exponent
        c = colour(line["label"], number)
        axes.plot(ends, y, color=c, linewidth=1.0, linestyle=":", zorder=1)
        axes.annotate(f"{exponent:g}", (ends[1], y[1]), xytext=(7, 0), textcoords="offset points", color=c, va="center")


def spaced(values, factor=1.45):
    """Those of ascending values whose labels on a logarithmic axis do not touch."""
    kept = []
    for value in values:
        if not kept or value >= factor * kept[-1]:
            kept.append(value)
    return kept


def draw_panel(axes, panel, alone):
    """`alone`: the only panel of its figure, with the legend beside it."""
    references = 0
    number = 0
    for line in panel["lines"]:
        same = references - (line["label"].startswith("_") and references > 0)  # unnamed lines look like the one before
        draw_line(axes, line, number, same)
        if line["style"] == "reference":
            references += not line["label"].startswith("_") and panel["ticks"] == []
        else:
            number += 1
    axes.set_title(panel["title"])
    axes.set_xlabel(panel["x"])
    axes.set_ylabel(panel["y"])
    if "x" in panel["log"]:
        axes.set_xscale("log")
    if "y" in panel["log"]:
        axes.set_yscale("log")
    if panel["log"] == "xy":
        draw_slopes(axes, panel)
        spacings = spaced(sorted({x for line in panel["lines"] if line["style"] in ("ours", "marks") for x in line["x"]}))
        axes.set_xticks(spacings, [f"{x:g}" for x in spacings])
        axes.minorticks_off()
        axes.margins(x=0.12)
    elif not panel["log"] and panel["x"].startswith("spacing"):
        axes.set_xlim(left=0)
    if panel["ticks"]:
        axes.set_xticks(range(len(panel["ticks"])), panel["ticks"], rotation=30, ha="right")
        axes.set_ylim(1e-16, 1e-7)
    if alone:
        axes.legend(loc="center left", bbox_to_anchor=(1, 0.5))
    else:
        axes.legend(loc="best")


def draw(case):
    panels = case["panels"]
    figure, axes = plt.subplots(1, len(panels), figsize=(SIZE[0] * max(len(panels), 1.6), SIZE[1]), squeeze=False)
    for one, panel in zip(axes[0], panels):
        draw_panel(one, panel, len(panels) == 1)
    figure.tight_layout()
    figure.savefig(DOCS / "images" / f"verification_{case['name']}.png", dpi=120, metadata={"Software": None})
    plt.close(figure)


def number(value):
    if value == 0:
        return "0"
    digits = 4 if abs(value) < 1e5 else 0
    text = f"{value:.{max(digits - 1 - math.floor(math.log10(abs(value))), 0)}f}" if 1e-3 <= abs(value) < 1e5 else f"{value:.3e}"
    return text.replace("-", "−")


def off(ours, reference):
    """The difference from the reference, relative to it."""
    if not reference:
        return "–"
    share = ours / reference - 1
    return f"{abs(share):.0e}".replace("e-0", "e-") if abs(share) < 5e-5 else f"{100 * share:+.2f} %".replace("-", "−")


def table(cases):
    lines = ["| case | quantity | reference | ours | difference | by explicit steps |", "|---|---|---|---|---|---|"]
    for name, case in cases.items():
        for row in case["rows"]:
            reference, ours, unit = row["reference"], row["ours"], row["unit"]
            unit = "" if unit in ("", "relative") else f" {unit}"
            explicit = row.get("explicit")
            by_substeps = "" if explicit is None else f"{number(explicit)}{unit}" + (f", {off(explicit, reference)}" if reference else "")
            lines.append(f"| [{name}](#{name.replace('_', '-')}) | {row['quantity']} | {number(reference)}{unit} | {number(ours)}{unit} "
                         f"| {off(ours, reference)} | {by_substeps} |")
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="NAME")
    options = parser.parse_args()
    cases = json.loads((DOCS / "verification.json").read_text(encoding="utf-8"))
    for name, case in cases.items():
        if (not options.names or name in options.names) and case["panels"]:
            draw(case)
    page = DOCS / "verification.md"
    if page.exists():
        head, rest = page.read_text(encoding="utf-8").split("<!-- table -->\n", 1)
        page.write_text(f"{head}<!-- table -->\n{table(cases)}\n<!-- end of the table -->{rest.split('<!-- end of the table -->', 1)[1]}",
                        encoding="utf-8")


if __name__ == "__main__":
    main()
