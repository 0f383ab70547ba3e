#include "tests/model/model_errors.hpp"

namespace rockfold {

const char* const complete_model = R"(title = "Everything"
gravity = [0.5, 0, -10]

[[material]]
name = "granite"
density = 2700
young_modulus = 30e9
poisson_ratio = 0.25
cohesion = 2e6
friction_angle = 40
tensile_strength = 1e6

[[material]]
name = "concrete"
density = 2400.0
young_modulus = 25e9
poisson_ratio = -0.1
hoek_brown = {sigma_ci = 80e6, m_i = 12, GSI = 60, D = 0.5}

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
dilation_angle = 4.5
dilation_limit = 0.05
residual_friction_angle = 15
residual_cohesion = 2.5e3

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

[[solid]]
name = "roof"
shape = "pyramid"
base = [[4, 4, 31], [8, 4, 31], [5, 5, 31], [4, 8, 31]]
apex = [5, 5, 33]
interface = "filled"
continues = ["cap0", "2"]

[[solid]]
name = "footing"
shape = "frustum"
base = [[0, 0, -2], [4, 0, -2], [4, 4, -2], [0, 4, -2]]
top = [[1, 1, 0], [3, 1, 0], [3, 3, 0], [1, 3, 0]]
continues = ["cap1"]

[[solid]]
name = "shaft"
operation = "-"
shape = "cylinder"
axis = [[5, 5, 0], [5, 5, 20]]
radius = 1.5
sides = 12
continues = ["cap0"]

[[solid]]
name = "cavern"
operation = "-"
shape = "sphere"
center = [5, 15, 10]
radius = 2
subdivisions = 3
continues = ["side"]

[[solid]]
name = "gallery"
operation = "-"
shape = "tunnel"
path = [[0, 10, 5], [5, 10, 5], [10, 12, 6]]
section = "d_shape"
width = 3
height = 2.5
sides = 8

[[solid]]
name = "drift"
operation = "-"
shape = "tunnel"
path = [[0, 5, 5], [10, 5, 5]]
section = [[0, 0], [0, 2], [2, 2], [2, 0]]

[[solid]]
name = "ore"
shape = "mesh"
file = ")" ROCKFOLD_SOURCE_DIR R"(/LICENSE"
continues = ["0"]

[[solid]]
name = "ground"
shape = "terrain"
file = ")" ROCKFOLD_SOURCE_DIR R"(/tests/../LICENSE"
base = -50
columns = ["code", "northing", "easting", "elevation"]
continues = ["top"]

[[joint_set]]
name = "J1"
dip = 60
dip_direction = 360
spacing = 2.5
origin = [1, 2, 3]
count = 5
material = "filled"
radius = 3.5
sides = 20
within = "beam"

[[joint_set]]
name = "Baecher"
dip = 70
dip_direction = 15
radius = 1
[joint_set.random]
seed = 9223372036854775807
fisher_kappa = 40
radius = {distribution = "power_law", exponent = 2.5, min = 0.5, max = 8}
p32 = 0.75
location = "uniform"

[[joint_set]]
name = "bedding"
normal = [0, 0.1, 1]
[joint_set.random]
spacing = {distribution = "log_normal", mean = 2, standard_deviation = 0.5, min = 0.25, max = 9}

[[joint_set]]
name = "along"
dip = 80
dip_direction = 270
[joint_set.random]
radius = 2.5
p10 = 0.2
scanline = [[0, 10, 10], [10, 10, 10]]

[[joint_set]]
name = "few"
dip = 10
dip_direction = 270
[joint_set.random]
radius = {distribution = "exponential", mean = 2.5, max = 20}
count = 12

[[joint]]
name = "F1"
dip = 30
dip_direction = 120
point = [5, 5, 5]
material = "filled"

[[joint]]
normal = [1, -2, 0.5]
point = [6, 5, 5]

[[joint]]
name = "disc"
dip = 50
dip_direction = 10
point = [6, 5, 5]
radius = 2.5
sides = 24
within = "rock"

[[joint]]
name = "patch"
dip = 0
dip_direction = 0
point = [0, 0, 7]
polygon = [[1, 1, 7], [5, 1, 8], [2, 2, 7], [1, 5, 6]]

[[joint]]
name = "wall"
polygon = [[1, 1, 1], [1, 5, 1], [1, 5, 4]]

[[joint_mesh]]
name = "faults"
file = ")" ROCKFOLD_SOURCE_DIR R"(/LICENSE"
material = "filled"
within = "rock"
flatness = 7.5

[[joint_table]]
name = "mapped"
file = ")" ROCKFOLD_SOURCE_DIR R"(/LICENSE"
material = "filled"
extents = "through_going"
sides = 6
within = "beam"

[[merge]]
box = [[0, 0, 0], [5, 5, 5]]

[[merge]]
solid = "beam"

[[merge]]
points = [[1, 1, 1], [9, 9, 9]]

[[excavation]]
name = "pit"
stage = 2
shape = "halfspaces"
planes = [{dip = 0, dip_direction = 0, point = [0, 0, 29], keep = "above"}]

[[excavation]]
shape = "tunnel"
path = [[0, 3, 3], [10, 3, 3]]
section = "circle"
radius = 1.25
sides = 16

[cut]
max_cells = 1000000
min_volume = 1e-3
specks = "merge"
max_aspect_ratio = 12.5

[[scanline]]
name = "bore"
from = [5, 5, 0]
to = [5, 6, 30]

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
value_table = [[0, 0, 0, 0], [0.5, 0, 0, 0.01]]
method = "lagrange"

[[fixed]]
where = {face = "pit.0"}
stiffness = 1e12

[[traction]]
where = {face = "rock.xmax"}
value = [0, 0, -1e5]

[[traction]]
where = {plane = {point = [0, 0, 29], normal = [0, 0, 1]}}
pressure_table = [[0, 0], [0.5, 2e5]]
follows = false

[[quiet_boundary]]
where = {face = "rock.zmin"}

[[initial_velocity]]
where = {all = true}
velocity = [1, 0, 0]
angular_velocity = [0, 0, 2]

[initial_stress]
value = [[-1e6, 0, 1e4], [0, -2e6, 0], [1e4, 0, -3e6]]
gradient = [[-1e4, 0, 0], [0, -1e4, 0], [0, 0, -2.6e4]]
reference_z = 20

[base_acceleration]
file = ")" ROCKFOLD_SOURCE_DIR R"(/LICENSE"
scale = 0.5
unit = "cm/s2"
direction = [0, 0, -2]

[[point_load]]
point = [5, 5, 10]
force = [0, 0, -5e3]

[[point_load]]
point = [5, 5, 9]
force_table = [[0, 0, 0, 0], [1, 0, 0, -5e3]]

[analysis]
type = "dynamic"
kinematics = "small"
time_step = 0.02
end_time = 0.5
dynamic_ratio = 0.9
max_displacement_ratio = 0.01
newmark = {beta = 0.3025, gamma = 0.6}
rayleigh = {alpha = 0.5, beta = 0.001}

[contact]
material = "filled"
max_iterations = 25
restitution = 0.3
max_penetration = 1e-4

[solver]
tolerance = 1e-9
max_iterations = 100
preconditioner = "block_jacobi"

[output]
every = 0
compression = 1

[[monitor]]
name = "crest"
point = [5, 5, 30]

[support]
joint_faces_only = false
water_pressure = 1e4
seismic_coefficient = [0.1, 0, 0]
target_factor_of_safety = 1.3
support_direction = [0, 3, -4]
rotation = false
largest_group = 3

[[bolt_type]]
name = "rebar"
coupling = "CMC"
force_capacity = 200e3
displacement_capacity = 0.03
plate_capacity = 100e3
bond_strength = 150e3
shear_capacity = 90e3
stiffness = 12e6
action = "active"
efficiency = "cosine"
mass_per_metre = 3.9
young_modulus = 205e9
diameter = 0.025
yield = 300e6
rupture = 0.05
bond_stiffness = 1e8
pretension = 50e3

[[bolt_type]]
name = "anchor"
coupling = "DMFC"
force_capacity = 500e3
displacement_capacity = 0.05
bond_strength = 300e3
anchor_length = 4
mass_per_metre = 8

[[bolt]]
name = "spot"
collar = [5, 5, 30]
direction = [0, 0, -2]
length = 6
type = "anchor"
install = "stage 1"

[[bolt]]
collar = [5, 5, 30]
toe = [5, 7, 27]
force_capacity = 100e3
displacement_capacity = 0.02

[[bolt_pattern]]
name = "systematic"
on = "excavation2"
layout = "staggered"
spacing = [1.5, 2]
offset = [0.25, 0]
inclination = [-20, 90]
direction = [0, 0, 1]
length = 3
type = "rebar"

[shotcrete]
on = ["excavation2", "rock.zmax"]
thickness = 0.1
shear_strength = 2e6
adhesion_strength = 0.5e6
bond_width = 0.04

[pattern_search]
on = "excavation2.side"
layout = "rectangular"
spacing = [2, 1, 1]
length = [3, 2]
types = ["rebar"]
hold = "first_batch"
smallest_block = 0.5

[classification]
span = 11
height = 9

[classification.q]
rqd = 75
jn = 9
jr = 1.5
ja = 2
jw = 0.66
srf = 2.5
location = "portal"
excavation_support_ratio = 1.6

[classification.rmr]
point_load_index = 5e6
rqd = 75
spacing = 0.5
joint_condition = 22
groundwater = "damp"
orientation = "unfavourable"
use = "slope"

[[drawing]]
output = "net.svg"
kind = "stereonet"
hemisphere = "upper"
projection = "equal_angle"
joint_pyramids = true
poles = false
on = "rock.zmax"

[[drawing]]
output = "bolts.svg"
kind = "bolt_layout"
on = "excavation2"

[[table]]
output = "keys.csv"
kind = "keyblocks"

[[water]]
joints = ["J1", "bedding"]
density = 1025
table = {point = [0, 0, 7], dip = 5, dip_direction = 90}
[[water]]
head = 4
drains = true
law = "mid_height"
[block_theory]
material = "granite"
[[block_theory.tunnel]]
name = "adit"
trend = 20
plunge = 3
section = "horseshoe"
width = 5
height = 5
[[block_theory.slope]]
name = "portal"
dip = 75
dip_direction = 200
height = 12
upper_dip = 15
upper_dip_direction = 190
[block_theory.scan]
step = 20
plunges = [0, 10]
[block_theory.monte_carlo]
realisations = 50
seed = 3
length = 8
reach = 20
friction_angle_deviation = 2
cohesion_variation = 0.2
confidence = 0.9
)";

}  // namespace rockfold
