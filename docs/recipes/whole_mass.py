"""The factor of safety of a whole mass: blocks that fail together though none of them moves by itself.

In the example driving_wedge a wedge on a steep joint pushes another one out along a flat joint. Prints, for each
friction angle, the least factor of single key blocks beside the two factors of the whole mass and the factor by
statics of the two wedges, then whether the proof of the last one holds. Draws whole_mass.png.
"""

import tempfile
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import rockfold

friction = np.arange(15, 44, 4)                                     # deg
single, bound, sliding = [], [], []


def imbalance(mobilised):
    """What the driving wedge (75 m2) pushes with, less what holds the other (123 m2), at a mobilised friction (rad)."""
    steep, flat = np.arctan2(15, 10), np.arctan2(2.5, 10)
    push = 75 * np.sin(steep - mobilised) / np.cos(steep - 2 * mobilised)
    return push * np.cos(2 * mobilised - flat) - 123 * np.sin(mobilised - flat)


angles = np.radians(np.linspace(15, 40, 10001))
statics = np.tan(np.radians(friction)) / np.tan(angles[np.argmin(np.abs(imbalance(angles)))])

with tempfile.TemporaryDirectory() as folder:
    model = rockfold.example("driving_wedge", folder)
    certificate = Path(folder) / "certificate.json"
    for angle, by_statics in zip(friction, statics):
        change = {"joint_material.joint.friction_angle": angle}
        totals = rockfold.support(model, change, output=False)["totals"]
        mass = rockfold.stability(model, change, output=False, certificate=certificate)["stability"]
        single.append(totals["least_factor_of_safety"])
        bound.append(mass["bound"]["factor"])
        sliding.append(mass["sliding"]["factor"])
        print(f"friction {angle} deg: single block {single[-1]:.3f}, "
              f"bound {bound[-1]:.3f}, sliding {sliding[-1]:.3f}, statics {by_statics:.3f}")
    proof = rockfold.verify(certificate)
print("the last one", mass["in_words"])
print("its proof holds:", proof["holds"], "for a bound of {below:.5f} to {above:.5f}".format(**proof["bound"]))

plt.rcParams.update({"font.size": 12, "axes.spines.top": False, "axes.spines.right": False})
figure, axis = plt.subplots(figsize=(10, 7), layout="constrained")
axis.axhline(1, color="0.4", linewidth=1)
axis.plot(friction, statics, color="0.8", linewidth=9, label="both wedges, by statics")
axis.plot(friction, single, "o-", color="C0", label="least factor of single blocks")
axis.plot(friction, bound, "s", color="C1", markersize=11, markerfacecolor="none", label="whole mass: bound")
axis.plot(friction, sliding, "x", color="C3", markersize=8, markeredgewidth=2, label="whole mass: sliding")
limit = np.interp(1, sliding, friction)
axis.axvspan(14, limit, color="C3", alpha=0.08, linewidth=0)
axis.text((14 + limit) / 2, 0.15, "each block stands by itself,\nboth together fail", ha="center", color="C3")
axis.set(xlabel="friction angle of the joints (deg)", ylabel="factor of safety", xlim=(14, 44), ylim=(0, None))
axis.legend(frameon=False, loc="upper left", bbox_to_anchor=(0, 0.98))
figure.savefig("whole_mass.png", dpi=100)
