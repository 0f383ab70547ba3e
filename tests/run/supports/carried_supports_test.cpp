// Supports that carry rock by far more than its loads strain it: the springs' load, k times the way, is then many orders larger than
// any force at the solution.
#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/run/run_model.hpp"

namespace rockfold {
namespace {

constexpr Real density = 2500, gravity = 9.81, weight = density * gravity * 1.5;

/// A block of 1 × 1 × 1.5 m on its base. `way`: the line of the base that says how far it is carried.
std::string block_on_base(Real young_modulus, Real weight_share, const std::string& method,
                          const std::string& way, const std::string& analysis) {
  return fmt::format(R"(
gravity = [0, 0, {:.17g}]
[[material]]
density = {}
young_modulus = {:.17g}
poisson_ratio = 0.25
[[solid]]
name = "rock"
shape = "box"
min = [0, 0, 0]
max = [1, 1, 1.5]
[cover]
lattice = "tet6"
spacing = 0.5
order = 1
[[fixed]]
where = {{face = "rock.zmin"}}
method = "{}"
{}
[[monitor]]
point = [0.6, 0.6, 0.75]
[analysis]
kinematics = "small"
{}
)",
                     -weight_share * gravity, density, young_modulus, method, way, analysis);
}

const std::string in_place = "value = [0, 0, 0]", far_away = "value = [0.02, 0.01, 0]",
                  table = "value_table = [[0, 0, 0, 0], [4, 0.02, 0.01, 0]]",
                  at_once = "type = 'static'",
                  in_steps = "type = 'quasi_static'\ntime_step = 1\nsteps = 12";

class CarriedBlock : public testing::TestWithParam<const char*> {};

/// Reactions to what an ulp of the way is in forces; stresses as if it stood in place.
void expect_weight_held(const std::string& method, Real young_modulus, const std::string& way,
                        const std::string& analysis) {
  const RunResult still =
      run_model(block_on_base(young_modulus, 1, method, in_place, at_once)).result;
  const RunResult result = run_model(block_on_base(young_modulus, 1, method, way, analysis)).result;
  const Vec3 reaction = result.conditions.at(0).force;
  const Real tolerance = std::max(1e-6, 2e-18 * young_modulus);
  for (int d = 0; d < 3; ++d) EXPECT_NEAR(reaction[d] / weight, d == 2, tolerance);
  const Stress expected = still.monitors.at(0).stress.back(),
               found = result.monitors.at(0).stress.back();
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(found[i] / expected[2], expected[i] / expected[2], 2e-3);
}

TEST_P(CarriedBlock, RestsOnABaseMovedAtOnceAsOnOneInPlace) {
  for (const Real young_modulus : {1e9, 3e10, 5e13}) {
    SCOPED_TRACE(young_modulus);
    expect_weight_held(GetParam(), young_modulus, far_away, at_once);
  }
}

TEST_P(CarriedBlock, ComesToRestInStepsWhereTheStaticAnswerIs) {
  for (const Real young_modulus : {3e10, 3e11, 5e13}) {
    SCOPED_TRACE(young_modulus);
    expect_weight_held(GetParam(), young_modulus, far_away, in_steps);
    expect_weight_held(GetParam(), young_modulus, table, in_steps);
  }
}

TEST_P(CarriedBlock, IsNotStrainedWithoutAWeight) {
  const Real young_modulus = 3e10;
  const Vec3 way{0.02, 0.01, 0};
  for (const std::string& analysis : {at_once, in_steps}) {
    const RunResult result =
        run_model(block_on_base(young_modulus, 0, GetParam(), far_away, analysis)).result;
    const MonitorHistory& monitor = result.monitors.at(0);
    for (int d = 0; d < 3; ++d) EXPECT_NEAR(monitor.displacement.back()[d], way[d], 1e-11);
    for (const Real stress : monitor.stress.back())
      EXPECT_NEAR(stress, 0, 1e-9 * young_modulus * 0.02);
  }
}

INSTANTIATE_TEST_SUITE_P(Supports, CarriedBlock, testing::Values("penalty", "augmented_lagrangian"),
                         [](const auto& how) { return std::string(how.param); });

}  // namespace
}  // namespace rockfold
