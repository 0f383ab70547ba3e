"""Energy, momentum and angular momentum, recomputed from stored states alone: what the program says of them is not read."""
import math
import sys
import unittest
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "cli"))
sys.path.insert(0, str(Path(__file__).resolve().parent))
from program import ProgramTest  # noqa: E402
from stored_motion import StoredMotion  # noqa: E402

CUBES = """
gravity = [0, 0, 0]
[[material]]
density = 2500
young_modulus = 1e10
poisson_ratio = 0.25
[[joint_material]]
name = "rough"
friction_angle = 30
normal_stiffness = 1e9
shear_stiffness = 5e8
[[solid]]
name = "left"
shape = "box"
min = [-1.1, 0, 0]
max = [-0.1, 1, 1]
[[solid]]
name = "right"
shape = "box"
min = [0.01, 0.35, 0.2]
max = [1.01, 1.35, 1.2]
[cover]
lattice = "block"
[[initial_velocity]]
where = {block_at = [-0.5, 0.5, 0.5]}
velocity = [3, 0.4, 0.2]
angular_velocity = [0.3, 0.5, 0.2]
[solver]
tolerance = 1e-12
[analysis]
type = "dynamic"
time_step = 0.0005
end_time = 0.1
[output]
every = 10
"""


def total(motion, law):
    return np.array([sum(motion.energy(s, law).values()) for s in range(len(motion.time))])


def kept(motion):
    """By how much momentum and angular momentum change at most, in shares of what moves."""
    linear, angular = zip(*(motion.momentum(s) for s in range(len(motion.time))))
    return [max(np.linalg.norm(v.sum(0) - values[0].sum(0)) for v in values) / np.linalg.norm(values[0], axis=1).sum() for values in (linear, angular)]


class StoredStates(ProgramTest):
    def states_of(self, text, *more):
        self.write("model.toml", text)
        self.run_program("run", "model.toml", "-q", "--force", *more)
        return StoredMotion(self.folder / "model.vtkhdf")

    def test_of_a_spinning_box_keep_energy_and_angular_momentum(self):
        self.copy_case("spinning_box")
        self.run_program("run", "spinning_box.toml", "-q", "--set", "analysis.time_step=0.004", "--set", "gravity=[0,0,0]", "--set", "solver.tolerance=1e-12")
        motion = StoredMotion(self.folder / "spinning_box.vtkhdf")
        energy = total(motion, (1, 1))
        self.assertLess(np.abs(energy / energy[0] - 1).max(), 1e-9)
        for change in kept(motion):
            self.assertLess(change, 1e-9)

    def test_of_cubes_that_collide_keep_momentum_and_gain_no_energy(self):
        for restitution in (0, 0.5, 1):
            motion = self.states_of(CUBES, "--set", f"contact.restitution={restitution}")
            energy = total(motion, (1e9, 5e8))
            kinetic = [motion.energy(s, (1e9, 5e8))["kinetic"] for s in range(len(motion.time))]
            self.assertLess(np.diff(energy).max(), 1e-6 * kinetic[0], restitution)
            self.assertGreater(1 - energy[-1] / energy[0], 1e-3)  # friction, and the plastic impact
            self.assertLess(kept(motion)[0], 1e-9)

    def test_of_cubes_that_collide_keep_angular_momentum_but_for_the_lever_of_their_overlap(self):
        # Shear acts on both sides of a closure of v √(m/k) = 3 mm, and 1 mm.
        soft, stiff = (kept(self.states_of(CUBES, "--set", f"joint_material.1.normal_stiffness={k}", "--set", f"joint_material.1.shear_stiffness={k / 2}"))[1]
                       for k in (1e9, 1e10))
        self.assertLess(soft, 1e-3)
        self.assertLess(stiff, 0.5 * soft)

    def test_of_a_block_that_slides_lose_what_friction_takes(self):
        self.copy_case("sliding_block")
        self.run_program("run", "sliding_block.toml", "-q", "--set", "joint_material.1.friction_angle=20", "--set", "output.every=1",
                         "--set", "joint_material.1.normal_stiffness=2e9", "--set", "joint_material.1.shear_stiffness=2e9")
        motion = StoredMotion(self.folder / "sliding_block.vtkhdf")
        energy = total(motion, (2e9, 2e9))
        block = int(np.argmin(motion.volume))
        at, _ = motion.affine(motion.displacement[-1])
        weight = motion.density[block] * motion.volume[block] * np.array(motion.gravity)
        lost = -weight[2] * math.tan(math.radians(20)) * at[block][0]
        self.assertLess(abs((energy[0] - energy[-1]) / lost - 1), 2e-3)
        self.assertLess(np.diff(energy).max(), 1e-6 * lost)


if __name__ == "__main__":
    unittest.main()
