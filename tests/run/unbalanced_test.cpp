// How far a run that ends with a quasi-static step is from equilibrium.
#include <cmath>

#include <gtest/gtest.h>

#include "tests/run/run_model.hpp"

namespace rockfold {
namespace {

// Cubes of 1, 8 and 27 m³ side by side, not touching; the largest is held at its foot, the others where `held` says so.
std::string cubes(const std::string& held, const std::string& analysis) {
  return R"(
[[material]]
density = 2000
young_modulus = 1e9
poisson_ratio = 0.2
[[joint_material]]
friction_angle = 30
[[solid]]
name = "small"
shape = "box"
min = [0, 0, 0]
max = [1, 1, 1]
[[solid]]
name = "middle"
shape = "box"
min = [10, 0, 0]
max = [12, 2, 2]
[[solid]]
name = "large"
shape = "box"
min = [20, 0, 0]
max = [23, 3, 3]
[cover]
lattice = "block"
[[fixed]]
where = {face = "large.zmin"}
)" + held +
         "[analysis]\n" + analysis;
}

const std::string small_held = "[[fixed]]\nwhere = {face = \"small.zmin\"}\n";
const std::string slowly = "type = \"quasi_static\"\ntime_step = 0.05\nsteps = 20\n";

class UnbalancedByScheme : public testing::TestWithParam<const char*> {
 protected:
  const std::string slowly_ = slowly + "scheme = \"" + GetParam() + "\"\n";
};
INSTANTIATE_TEST_SUITE_P(Schemes, UnbalancedByScheme, testing::Values("implicit", "explicit"),
                         [](const auto& scheme) { return std::string(scheme.param); });

// What falls is not balanced at all: 8 of 36 m³, in each step anew, as a step hands no velocity on. Steps that relax rock move it with mass that
// they add to it, and hold it back: neither is part of the balance.
TEST_P(UnbalancedByScheme, IsTheWeightOfWhatFalls) {
  const RunResult run = run_model(cubes(small_held, slowly_)).result;
  ASSERT_TRUE(run.unbalanced);
  EXPECT_NEAR(run.unbalanced->share, 8.0 / 36, 1e-3);
  EXPECT_EQ(run.unbalanced->block, 1);
  EXPECT_NEAR(run.unbalanced->force, 8 * 2000 * 9.81, 10);
  EXPECT_TRUE(is_far_from_balance(*run.unbalanced));
}

// However few or many steps: what falls beside it has no part in it, and what falls slowly yet is not at rest.
TEST_P(UnbalancedByScheme, IsNoPartOfWhatSupportsBear) {
  for (const char* steps : {"steps = 1\n", "steps = 7\n"}) {
    std::string step = slowly_;
    step.replace(step.find("steps = 20\n"), 11, steps);
    const RunResult run = run_model(cubes(small_held, step)).result;
    for (const auto& [condition, volume] : {std::pair{0, 27}, {1, 1}})
      EXPECT_NEAR(run.conditions[condition].force[2] / (volume * 2000 * 9.81), 1, 0.01);
    ASSERT_TRUE(run.rest);
    EXPECT_FALSE(run.rest->at_rest);
    EXPECT_EQ(run.rest->moving, std::vector<Index>{1});
  }
}

TEST_P(UnbalancedByScheme, IsNothingOfRockThatRests) {
  const RunResult run =
      run_model(cubes(small_held + "[[fixed]]\nwhere = {face = \"middle.zmin\"}\n", slowly_))
          .result;
  ASSERT_TRUE(run.unbalanced);
  EXPECT_LT(run.unbalanced->share, 1e-4);
  EXPECT_FALSE(is_far_from_balance(*run.unbalanced));
}

TEST(Unbalanced, IsNotToldOfDynamics) {
  EXPECT_FALSE(run_model(cubes(small_held, "time_step = 0.05\nsteps = 3\n")).result.unbalanced);
}

}  // namespace
}  // namespace rockfold
