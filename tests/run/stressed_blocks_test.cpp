// Blocks under initial stress, in balance before anything moves: held all round, they lie still.
#include <string>

#include <gtest/gtest.h>

#include "tests/run/run_model.hpp"

namespace rockfold {
namespace {

const Real pressure = 10e6, stiffness = 10e9;

// A cube of 4 m under 10 MPa all round, held on its faces and cut by a joint; `joints` are more of them.
std::string cube(const std::string& joints, const std::string& cover,
                 const std::string& gravity = "[0, 0, 0]") {
  std::string model = "gravity = " + gravity + R"(
[[material]]
density = 2500
young_modulus = 1e9
poisson_ratio = 0.25
[[joint_material]]
name = 'j'
friction_angle = 45
normal_stiffness = 1e10
shear_stiffness = 1e10
[[solid]]
name = 'rock'
shape = 'box'
min = [0, 0, 0]
max = [4, 4, 4]
[initial_stress]
value = [[-1e7, 0, 0], [0, -1e7, 0], [0, 0, -1e7]]
[analysis]
type = 'quasi_static'
time_step = 0.1
steps = 2
)" + joints + "[cover]\n" +
                      cover + "\n";
  for (const char* face : {"xmin", "xmax", "ymin", "ymax", "zmin", "zmax"})
    model += std::string("[[fixed]]\nwhere = {face = 'rock.") + face + "'}\n";
  return model;
}

std::string joint(const std::string& where) {
  return "[[joint]]\n" + where + "\n";
}

const char* const lattices[] = {"lattice = 'tet6'\nspacing = 1",
                                "lattice = 'tet6_kuhn'\nspacing = 1",
                                "lattice = 'tet6'\norder = 1\nspacing = 2"};

const std::string through = joint("dip = 11\ndip_direction = 40\npoint = [2.1, 1.9, 1.1]");

void expect_still(const std::string& model) {
  const RunResult run = run_model(model).result;
  EXPECT_LT(run.largest_displacement.length, 1e-6 * pressure / stiffness) << model;
  EXPECT_EQ(run.contacts.slide, 0) << model;
  EXPECT_EQ(run.divided_steps, 0) << model;
}

// A joint that ends in rock has no contact between its sides: under the stress in the rock they would pass through each other.
TEST(StressedBlocks, LieStillBesideJointsThatEndInRock) {
  for (const char* cover : lattices) {
    expect_still(cube(through + joint("radius = 1.7\ndip = 75\ndip_direction = 171\n"
                                      "point = [2.1, 1.9, 2.2]"),
                      cover));
    expect_still(cube(through + joint("radius = 1.9\ndip = 39\ndip_direction = 11\n"
                                      "point = [3.1, 2.2, 3]"),
                      cover));
  }
}

// Elements of half a percent of a cell beside the joint: what presses on them must be in balance with the stress in them.
TEST(StressedBlocks, LieStillWhereAJointLeavesSliversOfElements) {
  for (const char* cover : lattices)
    expect_still(cube(joint("dip = 0\ndip_direction = 0\npoint = [2, 2, 2.005]"), cover));
}

// Two planes cut a wedge of 8 kg off a corner: its joints press with two thousand times what it weighs.
TEST(StressedBlocks, AreInBalanceWhereASmallOneWeighsLittleBesideWhatPressesIt) {
  const std::string corner = joint("dip = 54.7\ndip_direction = 45\npoint = [3.9, 3.9, 3.9]");
  const RunResult run =
      run_model(cube(through + corner, "lattice = 'tet6'\nspacing = 2", "[0, 0, -9.81]")).result;
  EXPECT_EQ(run.divided_steps, 0);
  EXPECT_LT(run.largest_displacement.length, 1e-3);
  EXPECT_EQ(run.contacts.slide, 0);
}

}  // namespace
}  // namespace rockfold
