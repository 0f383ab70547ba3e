"""Which of the uncertain numbers decides whether a block slides: a Latin hypercube, rank correlations, a probability.

A block lies on bedding that comes out in an upright face. Friction, cohesion and dip of the bedding scatter. Prints how
far the factors of safety are off the closed form, the rank correlation of each number with the factor, and how likely
it is that the block slides. Draws sensitivity.png.
"""

import tempfile

import matplotlib.pyplot as plt
import numpy as np
import rockfold

model = {
    "material": [{"density": 2600}],
    "joint_material": [{"name": "bedding", "friction_angle": 33, "cohesion": 30e3}],
    "solid": [{"name": "rock", "shape": "box", "min": [0, 0, 0], "max": [12, 1, 10], "continues": ["xmax", "zmin"]}],
    "joint_set": [{"name": "bed", "dip": 40, "dip_direction": 270, "origin": [0, 0, 2], "spacing": 5, "count": 1}],
    "joint": [{"name": "back", "dip": 90, "dip_direction": 90, "point": [4, 0, 0]}],
    "support": {},
}
scatter = {"joint_material.bedding.friction_angle": {"distribution": "normal", "mean": 33, "standard_deviation": 3},
           "joint_material.bedding.cohesion": {"distribution": "log_normal", "mean": 30e3, "standard_deviation": 10e3},
           "joint_set.bed.dip": {"distribution": "normal", "mean": 40, "standard_deviation": 2}}
plan = {
    "command": "support", "sampling": "latin_hypercube", "runs": 40, "seed": 1,
    "parameter": [{"key": key, **distribution} for key, distribution in scatter.items()],
    "result": [{"name": "factor", "path": "totals.least_factor_of_safety"}],
    "event": [{"name": "slides", "when": "factor < 1"}],
}
with tempfile.TemporaryDirectory() as folder:
    sweep = rockfold.sweep(plan, folder, model=model)
    columns = sweep.columns()
friction, cohesion, dip = numbers = [columns[key] for key in scatter]
factor = columns["factor"]

weight = 2600 * 9.81 * (4 * 8 - 8 * np.tan(np.radians(dip)))        # N, of a slice of 1 m
resists = cohesion * 4 / np.cos(np.radians(dip)) + weight * np.cos(np.radians(dip)) * np.tan(np.radians(friction))
by_hand = resists / (weight * np.sin(np.radians(dip)))
print(f"largest difference from the closed form: {np.max(np.abs(factor / by_hand - 1)):.1e}")

ranks = [np.argsort(np.argsort(values)) for values in [*numbers, factor]]
correlation = dict(zip(("friction angle", "cohesion", "dip"), np.corrcoef(ranks)[-1]))
print("rank correlations:", ", ".join(f"{name} {value:+.2f}" for name, value in correlation.items()))
slides = sweep.document["events"][0]
print(f"slides in {slides['met']} of {slides['count']} runs: {100 * slides['probability']:.0f} %, "
      f"with 95 % confidence {100 * slides['low']:.0f} to {100 * slides['high']:.0f} %")

plt.rcParams.update({"font.size": 12, "axes.spines.top": False, "axes.spines.right": False})
figure, (tornado, points) = plt.subplots(1, 2, figsize=(10, 7), width_ratios=[2, 3], layout="constrained")
for name, value in sorted(correlation.items(), key=lambda one: abs(one[1])):
    tornado.barh(name, value, color="C0" if value > 0 else "C3", height=0.5)
tornado.axvline(0, color="0.3", linewidth=1)
tornado.set(xlim=(-1, 1), xlabel="rank correlation with the factor of safety")
dots = points.scatter(cohesion / 1000, factor, c=friction, s=60, cmap="viridis", edgecolor="0.3", linewidth=0.6)
points.axhspan(0.8, 1, color="C3", alpha=0.08, linewidth=0)
points.text(cohesion.max() / 1000, 0.82, f"slides: {slides['met']} of {slides['count']}", color="C3", ha="right")
points.set(xlabel="cohesion (kPa)", ylabel="factor of safety", ylim=(0.8, None))
figure.colorbar(dots, ax=points, label="friction angle (deg)", location="top", shrink=0.7)
figure.savefig("sensitivity.png", dpi=100)
