"""A block on a joint under an earthquake: how far it slides for good, beside Newmark's rigid block.

Writes a record of three pulses as CSV, puts gravity on, then shakes the ground across the slope. Prints the way of the
block at the end: computed, by the Newmark block of the document, and integrated here. Draws record.png.
"""

import tempfile

import matplotlib.pyplot as plt
import numpy as np
import rockfold

gravity, dip, friction = 9.81, np.radians(20), np.radians(30)
time = np.linspace(0, 2, 801)                                                       # s
ground = np.where(time < 1.5, 4.0 * np.sin(2 * np.pi * time / 0.5), 0)              # m/s2, towards the hill

model = {
    "gravity": [0, 0, -gravity],
    "material": [{"density": 2600, "young_modulus": 20e9, "poisson_ratio": 0.25}],
    "joint_material": [{"name": "clean", "friction_angle": np.degrees(friction)}],
    "solid": [{"name": "rock", "shape": "box", "min": [0, 0, 0], "max": [8, 2, 6], "continues": ["xmax", "zmin"]}],
    "joint": [{"name": "bed", "dip": np.degrees(dip), "dip_direction": 270, "point": [0, 0, 2]},
              {"name": "back", "dip": 90, "dip_direction": 90, "point": [4, 0, 0]}],
    "support": {},                                                                  # Newmark's block needs block theory
    "cover": {"lattice": "block"},
    "fixed": [{"where": {"block_at": place}} for place in ([2, 1, 1], [7, 1, 1], [7, 1, 5.5])],   # all blocks but one
    "monitor": [{"name": "block", "point": [2, 1, 4.5]}],
    "base_acceleration": {"file": "record.csv", "direction": [1, 0, 0], "step": "earthquake"},
    "step": [{"name": "gravity", "type": "quasi_static", "time_step": 0.1, "steps": 10},
             {"name": "earthquake", "type": "dynamic", "time_step": 0.0025, "end_time": 2.0, "reset_displacement": True}],
}
with tempfile.TemporaryDirectory() as folder:
    np.savetxt(f"{folder}/record.csv", np.column_stack([time, ground]), delimiter=",", header="t, a", comments="")
    answer = rockfold.run(rockfold.Model(model, folder=folder))

block = answer.result.monitors["block"]
shaking = block.time[:] >= 1                                                        # gravity takes the first second
way = block.displacement[shaking] @ [-np.cos(dip), 0, -np.sin(dip)]                 # down the dip

# Newmark's block: what is left of weight and shaking after friction makes it faster; it never slides back.
drive = ground * (np.cos(dip) + np.sin(dip) * np.tan(friction)) + gravity * (np.sin(dip) - np.cos(dip) * np.tan(friction))
speed = np.zeros_like(time)
for i in range(1, len(time)):
    speed[i] = max(0, speed[i - 1] + (drive[i - 1] + drive[i]) / 2 * (time[i] - time[i - 1]))
rigid = np.concatenate([[0], np.cumsum((speed[1:] + speed[:-1]) / 2 * np.diff(time))])
newmark = answer["shaken"][0]["newmark"]                                            # m, of the block that moves furthest
print(f"run {1000 * way[-1]:.1f} mm, Newmark's block {1000 * newmark:.1f} mm, here {1000 * rigid[-1]:.1f} mm")

plt.rcParams.update({"font.size": 12, "axes.spines.top": False, "axes.spines.right": False})
figure, (above, below) = plt.subplots(2, 1, figsize=(10, 7), sharex=True, height_ratios=[2, 3], layout="constrained")
yields = gravity * np.tan(friction - dip)
above.plot(time, ground, color="0.3")
above.fill_between(time, yields, np.maximum(ground, yields), color="C3", alpha=0.4, linewidth=1)
above.text(2, yields + 0.2, f"the block yields at {yields:.2f} m/s²", color="C3", ha="right")
above.set(ylabel="ground acceleration (m/s²)", title="Block on a joint that dips 20°, friction 30°")
below.plot(time, 1000 * rigid, color="0.75", linewidth=7, label="Newmark's rigid block")
below.plot(block.time[shaking] - 1, 1000 * way, color="C3", linewidth=1.5, label="run")
below.set(xlabel="time since the shaking began (s)", ylabel="way down the dip (mm)", xlim=(0, 2), ylim=(0, None))
below.legend(frameon=False, loc="upper left")
figure.savefig("record.png", dpi=100)
