"""The key blocks of a rock slope that is written in Python.

A face of 14 m in rock with bedding that dips out of it and two sets of joints that make wedges. Prints the key blocks of more than 1 m3 in
the order in which they come loose, and the factor of safety of the first one by hand. Draws the slope as key_blocks.png: blocks are coloured
by their factors of safety, and key blocks have their numbers.
"""

import matplotlib.pyplot as plt
import numpy as np
import rockfold
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

friction, cohesion, dip = 32, 4000, 34  # deg, Pa, deg
section = [(-16, -2), (6, -2), (6, 0), (0, 0), (-5, 14), (-16, 14)]  # x and z of the slope, m
slope = {
    "material": [{"name": "sandstone", "density": 2600}],
    "joint_material": [{"name": "rough", "friction_angle": friction, "cohesion": cohesion}],
    "solid": [{"name": "rock", "shape": "prism", "base": [[x, 0, z] for x, z in section], "extrude": [0, 26, 0],
               "continues": ["0", "1", "5", "cap0", "cap1"]}],  # the others are free: 2 is the floor, 3 the face, 4 the top
    "joint_set": [{"name": "bedding", "dip": dip, "dip_direction": 80, "spacing": 3.5, "origin": [0.3, 0.2, 0.1]},
                  {"name": "north", "dip": 65, "dip_direction": 45, "spacing": 4, "origin": [0.3, 0.2, 0.1]},
                  {"name": "south", "dip": 70, "dip_direction": 150, "spacing": 5, "origin": [0.3, 0.2, 0.1]}],
    "support": {"target_factor_of_safety": 1.3},
}
answer = rockfold.support(slope)
table = answer.table("keyblocks").query("volume > 1")[["block", "batch", "volume", "motion", "planes", "factor_of_safety", "support_force"]]
table["support_force"] /= 1000
print(table.rename(columns={"volume": "m3", "factor_of_safety": "safety", "support_force": "support, kN"}).round(2).to_string(index=False))

blocks, origins = answer.result.blocks, np.array(answer.result.origins)
first = answer["keyblocks"][0]
faces = slice(*blocks.face_begin[first["block"] - 1:first["block"] + 1])
underside = (origins[blocks.face_origin[faces]] == "bedding") & (blocks.face_normal[faces][:, 2] < 0)
bond = cohesion * blocks.face_area[faces][underside].sum() / (first["weight"] * np.sin(np.radians(dip)))
by_hand = np.tan(np.radians(friction)) / np.tan(np.radians(dip)) + bond
print(f"Block {first['block']} slides on the bedding: factor of safety {first['factor_of_safety']:.4f}, by hand {by_hand:.4f}")

mesh = answer.result.mesh()
side, factor = origins[mesh.fields["origin"] - 1], mesh.fields["factor_of_safety"]  # of each polygon
shown = np.isin(side, ["rock.2", "rock.3", "rock.4", "rock.6"])
scale = plt.cm.ScalarMappable(plt.Normalize(0.6, 1.4), "RdYlBu")
colours = np.where(np.isnan(factor)[:, None], (0.87, 0.86, 0.84, 1), scale.to_rgba(factor))
colours[(mesh.fields["class"] == 3) & np.isnan(factor)] = (0.25, 0.22, 0.22, 1)  # key blocks that nothing resists
edges = np.where((side == "rock.6")[:, None], colours, (0.3, 0.3, 0.3, 1))  # polygons of the section are parts of faces
figure = plt.figure(figsize=(10, 7), dpi=100)
axes = figure.add_axes([-0.02, 0.02, 0.9, 0.94], projection="3d", proj_type="ortho")
polygons = [polygon for polygon, drawn in zip(mesh.polygons(), shown) if drawn]
axes.add_collection3d(Poly3DCollection(polygons, facecolors=colours[shown], edgecolors=edges[shown]))
for block, safety in zip(table["block"], table["factor_of_safety"]):
    outside = [polygon for polygon, of_block in zip(polygons, mesh.fields["block"][shown]) if of_block == block]
    place = max(outside, key=lambda polygon: np.ptp(polygon, axis=0).sum()).mean(axis=0)  # the middle of the largest
    axes.text(*place, block, ha="center", va="center", fontsize=11, weight="bold", color="white" if np.isnan(safety) else "black")
axes.set(xlim=(-16, 6), ylim=(0, 26), zlim=(-2, 14), xlabel="east (m)", ylabel="north (m)", zlabel="height (m)",
         xticks=(-15, -10, -5, 0, 5), zticks=(0, 5, 10))
axes.set_box_aspect((22, 26, 16), zoom=1.15)
axes.grid(False)
axes.view_init(20, -28)
figure.colorbar(scale, cax=figure.add_axes([0.9, 0.25, 0.02, 0.5]), extend="both", label="factor of safety")
figure.suptitle("Key blocks by number. Black: nothing resists. Grey: cannot move", x=0.04, y=0.95, ha="left")
figure.savefig("key_blocks.png")
