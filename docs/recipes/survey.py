"""From a survey of joints to key blocks.

Forty joints on a face of 10 m, here made up, stand in a table of pandas. The table goes to the model as a CSV file, and each joint is a disc.
Prints the two sets that the poles fall into, and the key blocks of more than 1 m3 with the joints on which they slide. Draws the poles on a
stereonet (lower hemisphere, equal area), those of joints on which key blocks slide filled, as survey.png.
"""

import tempfile

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
import rockfold


def net(vectors):
    """Where vectors that point down lie on a net of radius 1, north up."""
    return (vectors[:, :2] / np.sqrt(1 - vectors[:, 2:])).T


random = np.random.default_rng(2)
dips, directions = [np.concatenate([random.normal(mean, 6, 20) for mean in means]) for means in ((55, 60), (50, 135))]  # deg
z = random.uniform(0.5, 9.5, 40)  # m
survey = pd.DataFrame({"joint": [f"J{n}" for n in range(1, 41)], "dip": dips, "dip_direction": directions, "x": -0.36 * z,
                       "y": random.uniform(2, 38, 40), "z": z, "radius": random.lognormal(np.log(6), 0.3, 40)}).round(2)

section = [(-12, -1), (4, -1), (4, 0), (0, 0), (-3.6, 10), (-12, 10)]  # x and z, m
rock = {"shape": "prism", "base": [[x, 0, z] for x, z in section], "extrude": [0, 40, 0], "continues": ["0", "1", "5", "cap0", "cap1"]}
with tempfile.TemporaryDirectory() as folder:
    survey.to_csv(f"{folder}/survey.csv", index=False)
    model = rockfold.Model({"material": [{"density": 2600}], "joint_material": [{"friction_angle": 35}], "solid": [rock],
                            "joint_table": [{"name": "survey", "file": "survey.csv"}]}, folder=folder)
    answer = rockfold.support(model, output=False)

dip, direction = np.radians(survey["dip"]), np.radians(survey["dip_direction"])
poles = -np.column_stack([np.sin(dip) * np.sin(direction), np.sin(dip) * np.cos(direction), np.cos(dip)])  # they point down
means = poles[[0, np.argmin(abs(poles @ poles[0]))]]
for _ in range(10):  # each pole belongs to the nearer mean, and each mean is that of its poles
    member = np.argmax(abs(poles @ means.T), axis=1)
    sums = [poles[member == s].sum(axis=0) for s in (0, 1)]
    means = np.array([total / np.linalg.norm(total) for total in sums])
names = [f"{np.degrees(np.arccos(-down)):.0f}/{np.degrees(np.arctan2(-x, -y)) % 360:03.0f}" for x, y, down in means]
print(f"Sets (dip/dip direction): {names[0]} with {(member == 0).sum()} joints, {names[1]} with {(member == 1).sum()}")
keys = answer.table("keyblocks")
print(f"{len(keys)} of {answer['totals']['blocks']} blocks are key blocks; those of more than 1 m3:")
print(keys.query("volume > 1")[["block", "batch", "volume", "motion", "planes", "factor_of_safety"]].round(2).to_string(index=False))
slides = ("survey." + survey["joint"]).isin(keys["planes"].explode()).to_numpy()
figure = plt.figure(figsize=(10, 7), dpi=100)
axes = figure.add_axes([0.02, 0.02, 0.66, 0.96], aspect="equal")
axes.add_patch(plt.Circle((0, 0), 1, facecolor="none", edgecolor="0.3"))
axes.text(0, 1.03, "N", ha="center", fontsize=12)
turn = np.linspace(-np.pi / 2, np.pi / 2, 91)[:, None]
for s, colour in enumerate(("C0", "C1")):
    down_dip = (means[s] * means[s][2] - [0, 0, 1]) / np.hypot(*means[s][:2])
    axes.plot(*net(np.cos(turn) * down_dip + np.sin(turn) * np.cross(means[s], down_dip)), color=colour, label=f"mean plane {names[s]}")
    for chosen, face, label in ((slides, colour, "pole, a key block slides"), (~slides, "none", "pole, none does")):
        axes.scatter(*net(poles[chosen & (member == s)]), s=60, facecolor=face, edgecolor=colour, label=label)
axes.set_axis_off()
axes.legend(frameon=False, fontsize=12, loc="center left", bbox_to_anchor=(1.02, 0.5), title="lower hemisphere, equal area", title_fontsize=12)
figure.savefig("survey.png")
