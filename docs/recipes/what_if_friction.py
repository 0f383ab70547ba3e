"""What if the friction is less, or water stands in the joints?

A wedge on two joints in a bench of 10 m, computed for 125 pairs of friction angle and water. No result files are written, so that each takes a
few hundredths of a second. Prints the factors of safety, one of them by hand, and how much friction the target factor asks for. Draws the
factor of safety and the support force as what_if_friction.png.
"""

import math

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
import rockfold

target = 1.3
bench = {
    "material": [{"name": "granite", "density": 2700}],
    "joint_material": [{"name": "clean", "friction_angle": 30}],
    "solid": [{"name": "rock", "shape": "box", "min": [-10, -5, 0], "max": [10, 15, 10],
               "continues": ["xmin", "xmax", "ymin", "ymax", "zmin"]},
              {"name": "face", "operation": "subtract", "shape": "halfspaces",
               "planes": [{"dip": 65, "dip_direction": 180, "point": [0, 0, 10], "keep": "above"}]}],
    "joint": [{"name": "east", "dip": 45, "dip_direction": 135, "point": [0, 7.5, 10]},
              {"name": "west", "dip": 45, "dip_direction": 225, "point": [0, 7.5, 10]}],
    "water": [{"head": 10}],  # up to the crest, and out at the face
    "support": {"target_factor_of_safety": target},
}
frictions = np.arange(20, 50.1, 1.25)
waters = [0, 0.25, 0.5, 0.75, 1]  # share of that pressure
rows = []
for water in waters:
    for friction in frictions:
        totals = rockfold.support(bench, {"joint_material.clean.friction_angle": friction, "water.1.factor": water}, output=False)["totals"]
        force = totals["support_force"] + totals["below_target"]["support_force"]  # of blocks that slide, and that are not safe enough
        rows.append({"friction": friction, "water": water, "safety": totals["least_factor_of_safety"], "force": force / 1000})
table = pd.DataFrame(rows).pivot(index="friction", columns="water")
print("Factor of safety by friction angle (deg) and share of water:", table["safety"].iloc[::4].round(2).to_string(), sep="\n")

plunge, half_angle = math.atan(math.sqrt(0.5)), math.radians(60)  # of the line where the joints meet, and between them
by_hand = math.tan(math.radians(30)) / (math.tan(plunge) * math.sin(half_angle))
print(f"Dry, 30 deg: {table['safety'].loc[30, 0]:.4f}, by hand {by_hand:.4f}")
for water in waters:
    enough = np.interp(target, table["safety"][water], frictions, right=np.inf)
    print(f"Water {water:4.0%}: {target} needs {enough:.1f} deg" if enough < 50 else f"Water {water:4.0%}: {target} needs more than 50 deg")

plt.rcParams.update({"font.size": 12, "axes.spines.top": False, "axes.spines.right": False,
                     "figure.constrained_layout.w_pad": 0.12, "figure.constrained_layout.h_pad": 0.12})
figure, (above, below) = plt.subplots(2, sharex=True, figsize=(10, 7), dpi=100, layout="constrained")
for water, colour in zip(waters, plt.cm.Blues(np.linspace(0.45, 1, len(waters)))):
    above.plot(frictions, table["safety"][water], color=colour, linewidth=2)
    above.text(50.4, table["safety"][water].iloc[-1], "dry" if water == 0 else f"{water:.0%} of the head", color=colour, va="center")
    below.plot(frictions, table["force"][water], color=colour, linewidth=2)
above.plot([20, 50], [target, target], color="C3", linewidth=1, linestyle="--")
above.text(20.2, target + 0.03, f"target {target}", color="C3")
above.set(ylabel="factor of safety", xlim=(20, 54.5), ylim=(0, None))
below.set(ylabel=f"support force for {target} (kN)", xlabel="friction angle (deg)", ylim=(0, None))
figure.savefig("what_if_friction.png")
