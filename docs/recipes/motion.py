"""A block slides down an inclined plane: a run, its progress, and a monitor beside the closed form.

The block starts at rest and gets faster by a = g (sin b - cos b tan phi). Prints how far the run is, then the way and
the speed of the block's centre after one second, computed and by the closed form. Draws motion.png.
"""

import matplotlib.pyplot as plt
import numpy as np
import rockfold

gravity, dip, friction = 9.81, np.radians(35), np.radians(25)
down_the_dip = np.array([np.cos(dip), 0, -np.sin(dip)])
off_the_plane = np.array([np.sin(dip), 0, np.cos(dip)])


def slab(along, above):
    """The shape of a slab 0.2 m wide: from where to where (m) along the plane and above it."""
    corners = [(along[0], above[0]), (along[1], above[0]), (along[1], above[1]), (along[0], above[1])]
    return {"shape": "prism", "base": [a * down_the_dip + n * off_the_plane for a, n in corners], "extrude": [0, 0.2, 0]}


def tell(progress):
    if progress.phase == "Analysis":
        print(f"step {progress.done} of {progress.total}", end="\n" if progress.ended else "\r")


model = {
    "gravity": [0, 0, -gravity],
    "material": [{"density": 2600, "young_modulus": 20e9, "poisson_ratio": 0.25}],
    "joint_material": [{"name": "clean", "friction_angle": np.degrees(friction)}],
    "solid": [{"name": "bed", **slab((-0.1, 1.3), (-0.1, 0))},
              {"name": "block", **slab((0, 0.2), (0, 0.15)), "interface": "clean"}],
    "cover": {"lattice": "block"},                      # each block moves, turns and strains as one
    "fixed": [{"where": {"face": "bed.0"}}],            # the first side of the prism: its underside
    "monitor": [{"name": "centre", "point": 0.1 * down_the_dip + 0.075 * off_the_plane + [0, 0.1, 0]}],
    "analysis": {"type": "dynamic", "time_step": 0.005, "end_time": 1.0},
}
result = rockfold.run(model, progress=tell).result
centre = result.monitors["centre"]
time, way, speed = centre.time[:], centre.displacement[:] @ down_the_dip, centre.velocity[:] @ down_the_dip

acceleration = gravity * (np.sin(dip) - np.cos(dip) * np.tan(friction))
print(f"after 1 s: {way[-1]:.4f} m and {speed[-1]:.4f} m/s, closed form {acceleration / 2:.4f} m and {acceleration:.4f} m/s")

plt.rcParams.update({"font.size": 12, "axes.spines.top": False, "axes.spines.right": False})
figure, axes = plt.subplot_mosaic("AAABB;AAACC", figsize=(10, 7), layout="constrained")
for instant in (0, 0.5, 0.75, 1):                       # s; block 1 is the bed, whose centre lies lower
    mesh = result.mesh(state=np.argmin(np.abs(result.times - instant)))
    for side, block in zip(mesh.polygons(), mesh.fields["block"]):
        axes["A"].fill(side[:, 0], side[:, 2], facecolor="0.8" if block == 1 else "C3", edgecolor="0.3", linewidth=0.7)
    x, _, z = mesh.of_block(2).points.mean(axis=0)
    axes["A"].text(x, z, f"{instant:g} s", rotation=-35, ha="center", va="center", color="white")
axes["A"].set(aspect="equal", xlabel="x (m)", ylabel="z (m)", title="Dip 35°, friction 25°")
for name, computed, exact, label in (("B", way, acceleration * time**2 / 2, "way down the plane (m)"),
                                     ("C", speed, acceleration * time, "speed (m/s)")):
    axes[name].plot(time, exact, color="0.75", linewidth=7, label="closed form")
    axes[name].plot(time, computed, color="C3", linewidth=1.5, label="run")
    axes[name].set(xlabel="time (s)", ylabel=label, xlim=(0, 1), ylim=(0, None))
axes["B"].legend(frameon=False)
figure.savefig("motion.png", dpi=100)
