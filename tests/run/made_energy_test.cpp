// Energy that contact makes out of nothing is told with its place, and ends a run that is made of it.
#include "src/run/made_energy.hpp"

#include <gtest/gtest.h>

#include "src/base/error.hpp"
#include "tests/run/run_model.hpp"

namespace rockfold {
namespace {

// A plate of 2 × 1 × 0.2 m, from x on, a part of it over a table's edge, slides onto it, with no friction and no loss in impacts. How soft the joints are,
// `stiffness` in Pa/m, decides how deep it rests in the table, and by that depth what newly touches has closed at once.
std::string plate(Real stiffness, const std::string& analysis, Real speed = 1, Real x = -0.5) {
  return R"(
[[material]]
density = 2500
young_modulus = 1e9
poisson_ratio = 0.2
[[joint_material]]
friction_angle = 0
normal_stiffness = )" +
         std::to_string(stiffness) + R"(
[[solid]]
name = "table"
shape = "box"
min = [0, 0, -1]
max = [6, 1, 0]
[[solid]]
name = "plate"
shape = "box"
min = [)" +
         std::to_string(x) + ", 0, 1e-4]\nmax = [" + std::to_string(x + 2) + R"(, 1, 0.2001]
[contact]
restitution = 1.0
[cover]
lattice = "block"
[[fixed]]
where = {face = "table.zmin"}
[[initial_velocity]]
where = {block_at = [0.5, 0.5, 0.1]}
velocity = [)" +
         std::to_string(speed) + ", 0, 0]\n" + analysis;
}

Energy energy(Real kinetic, Real potential, Real impact) {
  Energy e;
  e.kinetic = kinetic;
  e.potential = potential;
  e.impact = e.dissipated = impact;
  return e;
}

// What falls by 8 J turns 8 J over, whether it then flies or has lost it.
TEST(MadeEnergy, IsWhatImpactGivesBackBesideWhatIsTurnedOver) {
  MadeEnergy made;
  const Energy start = energy(0, 0, 0), falls = energy(8, -8, 0), hits = energy(2, -8, 6),
               gains = energy(3, -8, 5);
  count_made_energy(nullptr, start, made);
  count_made_energy(&start, falls, made);
  EXPECT_EQ(made.turned_over, 8);
  count_made_energy(&falls, hits, made);
  EXPECT_EQ(made.turned_over, 14);
  EXPECT_EQ(made.steps, 0);
  count_made_energy(&hits, gains, made);
  EXPECT_EQ(made.energy, 1);
  EXPECT_EQ(made.steps, 1);
  EXPECT_DOUBLE_EQ(made.share(), 1.0 / 15);
}

const std::string at_rest_then_slides = R"(
[analysis]
type = "dynamic"
time_step = 0.01
steps = 100
)";

TEST(MadeEnergy, IsLittleOnStiffJoints) {
  const RunResult run = run_model(plate(1e9, at_rest_then_slides)).result;
  EXPECT_LT(run.made.share(), 1e-3);
}

TEST(MadeEnergy, EndsARunThatIsMadeOfIt) {
  ModelAnswer answer;
  std::string what;
  try {
    run_model(plate(2.5e4, at_rest_then_slides, 2, -0.9), answer);
    FAIL() << answer.result.made.share();
  } catch (const Error& error) {
    what = error.what();
    EXPECT_NE(what.find("out of nothing"), std::string::npos) << what;
    EXPECT_NE(what.find("between blocks 1 and 2 near"), std::string::npos) << what;
  }
  ASSERT_FALSE(answer.stored.empty());
  EXPECT_EQ(what.find("step " + std::to_string(answer.stored.back()) + ","), 0u) << what;
}

}  // namespace
}  // namespace rockfold
