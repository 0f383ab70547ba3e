"""The stress round a circular opening in elastic rock, from the arrays of the result, beside Kirsch's closed form.

The example kirsch is a quarter of a plate with a hole of radius 1 m, under a far stress of 1 Pa along x, tension
positive. Prints the hoop stress at the wall and a radius away from it, in parts of the far stress. Draws
tunnel_stress.png: a section whose colours are computed and whose dashed lines are Kirsch's, and the hoop stress along
both axes.
"""

import tempfile

import matplotlib.pyplot as plt
import numpy as np
import rockfold


def kirsch(x, y):
    """Hoop stress in parts of the far stress, at a place in m."""
    squared, angle = x**2 + y**2, np.arctan2(y, x)
    return (1 + 1 / squared) / 2 - (1 + 3 / squared**2) / 2 * np.cos(2 * angle)


with tempfile.TemporaryDirectory() as folder:
    model = rockfold.example("kirsch", folder)
    answer = rockfold.run(model, {"cover.spacing": [0.5, 0.125, 0.125]})

elements = answer.result.file["VTKHDF/Elements"]                    # tetrahedra: docs/result_file.md
points = elements["Points"][:]                                      # [V][3] m
stress = elements["PointData/nodal_stress"][-len(points):]          # [V][6] Pa, of the last state: xx yy zz xy yz zx
x, y, z = points.T
angle = np.arctan2(y, x)
hoop = stress[:, 0] * np.sin(angle)**2 + stress[:, 1] * np.cos(angle)**2 - stress[:, 3] * np.sin(2 * angle)

places = {"top of the wall": (0, 1), "1 m above it": (0, 2), "side of the wall": (1, 0), "1 m beside it": (2, 0)}
for name, there in places.items():
    nearest = np.argmin(np.hypot(x - there[0], y - there[1]))
    print(f"{name:16} {hoop[nearest]:6.3f}, Kirsch {kirsch(*there):6.3f}")

# The sides of tetrahedra that lie in the plane z = 0 are a section.
tetrahedra = elements["Connectivity"][:].reshape(-1, 4)
sides = np.concatenate([np.delete(tetrahedra, corner, axis=1) for corner in range(4)])
section = sides[np.all(z[sides] < 1e-9, axis=1)]

plt.rcParams.update({"font.size": 12, "axes.spines.top": False, "axes.spines.right": False})
figure, (plate, axes) = plt.subplots(1, 2, figsize=(10, 7), width_ratios=[3, 2], layout="constrained")
levels = np.arange(-1, 3.1, 0.25)
colours = plate.tricontourf(x, y, section, hoop, levels, cmap="RdYlBu_r", extend="both")
r, turn = np.meshgrid(np.linspace(1, 4.3, 120), np.linspace(0, np.pi / 2, 90))
across, up = r * np.cos(turn), r * np.sin(turn)
plate.contour(across, up, kirsch(across, up), levels, colors="0.2", linewidths=0.9, linestyles="dashed")
plate.set(aspect="equal", xlim=(0, 3), ylim=(0, 3), xlabel="x (m)", ylabel="y (m)", title="computed, and Kirsch's (dashed)")
figure.colorbar(colours, ax=plate, location="bottom", label="hoop stress / far stress", shrink=0.8)

away = np.linspace(1, 4, 200)
for name, on_axis, place, exact, colour in (("on y", x < 1e-9, y, kirsch(0, away), "C3"),
                                            ("on x", y < 1e-9, x, kirsch(away, 0), "C0")):
    axes.plot(away, exact, color=colour, label=f"{name}, Kirsch")
    axes.plot(place[on_axis], hoop[on_axis], "o", color=colour, markersize=4, label=f"{name}, computed")
axes.set(xlabel="distance from the centre (m)", ylabel="hoop stress / far stress", xlim=(1, 4))
axes.legend(frameon=False)
figure.savefig("tunnel_stress.png", dpi=100)
