"""How likely is a key block of more than 1 m3 in this slope?

Nobody knows where each joint is, but how they scatter: by Fisher's distribution about the mean of their set, with exponential spacings. Sixty
networks are drawn, cut, and searched for key blocks. Prints the probability with its 95 % interval (Wilson's), and how large the largest key
block is. Draws its histogram, and how the probability settles as networks are added, as chance_of_key_blocks.png.
"""

import matplotlib.pyplot as plt
import numpy as np
import rockfold

networks, large = 60, 1.0  # m3


def joint_set(name, dip, dip_direction, spacing):
    return {"name": name, "dip": dip, "dip_direction": dip_direction,
            "random": {"fisher_kappa": 80, "spacing": {"distribution": "exponential", "mean": spacing}}}


def interval(happened, trials, z=1.96):
    """Low and high bounds of a probability of which so many trials happened."""
    middle = (happened + z**2 / 2) / (trials + z**2)
    half = z / (trials + z**2) * np.sqrt(happened * (trials - happened) / trials + z**2 / 4)
    return middle - half, middle + half


section = [(-8, -1), (4, -1), (4, 0), (0, 0), (-3, 8), (-8, 8)]  # x and z of a face of 8 m, m
slope = {
    "material": [{"density": 2600}],
    "joint_material": [{"friction_angle": 35}],
    "solid": [{"name": "rock", "shape": "prism", "base": [[x, 0, z] for x, z in section], "extrude": [0, 12, 0],
               "continues": ["0", "1", "5", "cap0", "cap1"]}],
    "joint_set": [joint_set("bedding", 34, 80, 2.5), joint_set("north", 65, 45, 3), joint_set("south", 70, 150, 3)],
}
largest = np.zeros(networks)  # m3, 0 without key blocks
for network in range(networks):
    # The first set takes the seed, the next ones the numbers behind it: with 1, 2, 3, … networks would share sets.
    answer = rockfold.support(slope, seed=1000 * network, output=False)
    largest[network] = max((block["volume"] for block in answer["keyblocks"]), default=0)
low, high = interval((largest > large).sum(), networks)
print(f"{(largest > 0).sum()} of {networks} networks have key blocks, {(largest > large).sum()} have one of more than {large:g} m3")
print(f"Probability {np.mean(largest > large):.0%}, between {low:.0%} and {high:.0%} with a confidence of 95 %")
print(f"The largest key block, where there is one: median {np.median(largest[largest > 0]):.1f} m3, at most {largest.max():.1f} m3")

plt.rcParams.update({"font.size": 12, "axes.spines.top": False, "axes.spines.right": False,
                     "figure.constrained_layout.w_pad": 0.12, "figure.constrained_layout.h_pad": 0.12})
figure, (above, below) = plt.subplots(2, figsize=(10, 7), dpi=100, layout="constrained")
bins = np.logspace(-4, 3, 29)
above.hist(largest[(largest > 0) & (largest <= large)], bins, color="0.75", edgecolor="white")
above.hist(largest[largest > large], bins, color="C3", edgecolor="white")
above.set(xscale="log", xlim=(1e-4, 1e3), xlabel="volume of the largest key block (m³)", ylabel="networks")
above.xaxis.set_major_formatter("{x:g}")
above.text(0.01, 0.9, f"{(largest == 0).sum()} of {networks} networks have no key block", transform=above.transAxes)
trials = np.arange(1, networks + 1)
happened = np.cumsum(largest > large)
below.fill_between(trials, *(100 * bound for bound in interval(happened, trials)), color="C3", alpha=0.15, linewidth=0, label="95 % interval")
below.plot(trials, 100 * happened / trials, color="C3", linewidth=2, label="so far")
below.set(xlabel="networks", ylabel=f"probability of more than {large:g} m³ (%)", xlim=(1, networks), ylim=(0, 100))
below.legend(frameon=False, ncols=2)
figure.savefig("chance_of_key_blocks.png")
