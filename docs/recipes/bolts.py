"""Which spacing of bolts holds the key blocks of a slope?

Cable bolts stand in a grid on a face of 14 m, and the grid gets denser until each key block of more than 1 m3 reaches the target factor of
safety: those that come loose first, and those behind them. Prints the key blocks without bolts, then a table of spacing, number of bolts and
least factor. Draws the factors over the spacing as bolts.png.
"""

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
import rockfold

target, smallest = 1.3, 1.0  # m3: smaller blocks fit between the bolts, and are left to mesh
section = [(-16, -2), (6, -2), (6, 0), (0, 0), (-5, 14), (-16, 14)]  # x and z of the slope, m
slope = {
    "material": [{"density": 2600}],
    "joint_material": [{"friction_angle": 32, "cohesion": 4000}],
    "solid": [{"name": "rock", "shape": "prism", "base": [[x, 0, z] for x, z in section], "extrude": [0, 26, 0],
               "continues": ["0", "1", "5", "cap0", "cap1"]}],  # 3 is the face
    "joint_set": [{"name": "bedding", "dip": 25, "dip_direction": 100, "spacing": 4, "origin": [0.3, 0.2, 0.1]},
                  {"name": "north", "dip": 60, "dip_direction": 50, "spacing": 5, "origin": [0.3, 0.2, 0.1]},
                  {"name": "south", "dip": 63, "dip_direction": 135, "spacing": 5.5, "origin": [0.3, 0.2, 0.1]}],
    "bolt_type": [{"name": "cable", "force_capacity": "250 kN", "displacement_capacity": "50 mm", "bond_strength": 250e3}],  # N/m
    "support": {"target_factor_of_safety": target},
}
bare = rockfold.support(slope, output=False).table("keyblocks").query("volume > @smallest")
print(bare[["block", "batch", "volume", "motion", "factor_of_safety", "support_force"]].round(2).to_string(index=False))

rows, factors = [], {}
for spacing in (4, 3.5, 3, 2.75, 2.5, 2.25, 2, 1.75, 1.5):
    pattern = {"on": "rock.3", "type": "cable", "spacing": spacing, "length": 8, "direction": [-0.97, 0, -0.25]}
    answer = rockfold.support({**slope, "bolt_pattern": [pattern]}, output=False)
    keys = answer.table("keyblocks").query("volume > @smallest").set_index("block")
    # Without a factor nothing resists the block, or the bolts hold it so that nothing drives it.
    factors[spacing] = keys["supported_factor_of_safety"].fillna(0).where(keys["supported_mode"] != "at_rest", np.inf)
    rows.append({"spacing, m": spacing, "bolts": answer["bolting"]["bolts"], "held": f"{keys['adequate'].sum()} of {len(keys)}",
                 "least factor": factors[spacing].min(), "in block": factors[spacing].idxmin()})
table, factors = pd.DataFrame(rows), pd.DataFrame(factors).T
print("With bolts:", table.round(2).to_string(index=False), sep="\n")
enough = factors.index[factors.min(axis=1) < target].min()
print(f"Every grid closer than {enough:g} m holds all of them; a wider one does if its bolts happen to meet the smaller blocks.")

plt.rcParams.update({"font.size": 12, "axes.spines.top": False, "axes.spines.right": False,
                     "figure.constrained_layout.w_pad": 0.12, "figure.constrained_layout.h_pad": 0.12})
figure, axes = plt.subplots(figsize=(10, 7), dpi=100, layout="constrained")
axes.plot(factors.index, factors.min(axis=1), color="0.85", linewidth=10, label="the least of them")
for block, volume in zip(bare["block"], bare["volume"]):
    axes.plot(factors.index, factors[block], marker="o", label=f"block {block}, {volume:.0f} m³")
axes.axhline(target, color="0.2", linestyle="--", linewidth=1)
axes.text(1.43, target * 1.02, f"target {target}")
axes.set_yscale("log")
axes.minorticks_off()
axes.set_yticks([0.5, 1, 2, 5, 10], ["0.5", "1", "2", "5", "10"])
axes.set_xticks(factors.index, [f"{spacing:g}\n{bolts}" for spacing, bolts in zip(factors.index, table["bolts"])])
axes.set(xlabel="spacing (m), and number of bolts", ylabel="factor of safety with bolts")
axes.legend(frameon=False)
figure.savefig("bolts.png")
