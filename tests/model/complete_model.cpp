#include "tests/model/model_errors.hpp"

namespace rockfold {

const char* const complete_model = R"(title = "Everything"
gravity = [0.5, 0, -10]

[[material]]
name = "granite"
density = 2700
young_modulus = 30e9
poisson_ratio = 0.25

[[material]]
name = "concrete"
density = 2400.0
young_modulus = 25e9
poisson_ratio = -0.1

[[joint_material]]
name = "clean"
friction_angle = 35

[[joint_material]]
name = "filled"
friction_angle = 20.5
cohesion = 1e4
tensile_strength = 2e3
normal_stiffness = 10e9
shear_stiffness = 5e9

[[solid]]
name = "rock"
operation = "add"
shape = "box"
min = [0, 0, 0]
max = [10, 20, 30.5]
material = "granite"
continues = ["xmin", "zmin"]

[[solid]]
name = "cut.away"
operation = "subtract"
shape = "halfspaces"
planes = [
  {dip = 45, dip_direction = 90, point = [10, 0, 20], keep = "above"},
  {normal = [0, 0, 2], point = [0, 0, 25], keep = "below"},
]
continues = ["1"]

[[solid]]
name = "beam"
shape = "prism"
base = [[0, 0, 31], [4, 0, 31], [0, 3, 31]]
extrude = [1, 0, 5]
material = "concrete"
continues = ["side", "cap1"]

[[joint_set]]
name = "J1"
dip = 60
dip_direction = 360
spacing = 2.5
origin = [1, 2, 3]
count = 5
material = "filled"

[[joint]]
name = "F1"
dip = 30
dip_direction = 120
point = [5, 5, 5]
material = "filled"

[[joint]]
normal = [1, -2, 0.5]
point = [6, 5, 5]

[cover]
lattice = "tet6"
spacing = 1.5
order = 0
directions = [[0, 0], [90, 45], [90, 135]]
origin = [0.5, 0.5, 0.5]
joints = "welded"

[[fixed]]
where = {face = "rock.zmin"}
components = ["z", "x"]
value = [0.1, 0, -0.2]
method = "penalty"

[[fixed]]
where = {face = "beam.side"}

[[fixed]]
where = {box = [[0, 0, 0], [1, 1, 0]]}

[[fixed]]
where = {point = [1, 1, 1]}

[[fixed]]
where = {plane = {point = [0, 0, 1], normal = [0, 3, 4], tolerance = 0.01}}

[[fixed]]
where = {block_at = [9, 9, 9]}

[[point_load]]
point = [5, 5, 10]
force = [0, 0, -5e3]

[analysis]
type = "dynamic"
kinematics = "small"
time_step = 0.02
end_time = 0.5
dynamic_ratio = 0.9
max_displacement_ratio = 0.01
newmark = {beta = 0.25, gamma = 0.5}

[solver]
tolerance = 1e-9
max_iterations = 100
preconditioner = "block_jacobi"

[output]
every = 0

[[monitor]]
name = "crest"
point = [5, 5, 30]

[support]
joint_faces_only = false
water_pressure = 1e4
seismic_coefficient = [0.1, 0, 0]
target_factor_of_safety = 1.3
)";

}  // namespace rockfold
