#include "src/run/base_motion.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "src/base/vector.hpp"
#include "tests/run/run_model.hpp"

namespace rockfold {
namespace {

/// 2 m/s² falling to −4 over 3 s from t = 1 on, as it is before and after: v and d by hand.
TEST(BaseRecord, IsIntegratedExactlyHoweverFewItsRows) {
  const TimeTable table{{1, 4}, {{2, 0, 0}, {-4, 0, 0}}};
  BaseRecord base(table);
  EXPECT_EQ(base.at(0).acceleration[0], 2);
  EXPECT_NEAR(base.at(0.5).velocity[0], 1, 1e-14);
  EXPECT_NEAR(base.at(0.5).displacement[0], 0.25, 1e-14);
  // t = 3: v = 2 + ∫(2 − 2s)ds = 2 + 4 − 4, d = 1 + 2·2 + 2²− 2³/3, s from 0 to 2.
  EXPECT_NEAR(base.at(3).velocity[0], 2, 1e-14);
  EXPECT_NEAR(base.at(3).displacement[0], 9 - 8.0 / 3, 1e-14);
  // Beyond the last row, over it in one go: at t = 4 v = −1, d = 1 + 6 + 9 − 9; then −4 on.
  EXPECT_NEAR(base.at(5).velocity[0], -5, 1e-14);
  EXPECT_NEAR(base.at(5).displacement[0], 7 - 1 - 2, 1e-13);
  EXPECT_EQ(base.at(5).acceleration[0], -4);
  EXPECT_EQ(base.at(5).acceleration[1], 0);
}

/// Average acceleration has means over steps: those of the base beside them leave nothing where the rock stays where it is, and what
/// points held have is what takes them from one velocity to the next.
TEST(BaseRecord, AddsMeansOverStepsToMeansOverSteps) {
  for (const char* held : {"", "[[fixed]]\nwhere = {face = \"b.zmin\"}"}) {
    const RunResult run = run_model(fmt::format(R"(
gravity = [0, 0, 0]
[[material]]
density = 2000
young_modulus = 1e9
poisson_ratio = 0.25
[[solid]]
name = "b"
shape = "box"
min = [0, 0, 0]
max = [1, 1, 1]
[cover]
lattice = "tet6"
spacing = 0.7
{}
[[monitor]]
point = [0.5, 0.5, 0]
[base_acceleration]
table = [[0, 1, 0, 0], [0.013, 7, 0, 0], [0.05, -4, 2, 0]]
[analysis]
type = "dynamic"
time_step = 0.01
steps = 5
)",
                                                held))
                              .result;
    const MonitorHistory& foot = run.monitors[0];
    for (std::size_t i = 1; i < run.base.size(); ++i) {
      const Vec3 absolute = foot.acceleration[i] + run.base[i].acceleration,
                 gained = foot.velocity[i] + run.base[i].velocity - foot.velocity[i - 1] -
                          run.base[i - 1].velocity;
      for (int d = 0; d < 3; ++d) {
        EXPECT_NEAR(absolute[d], gained[d] / 0.01, 1e-9) << i << held;
        if (held[0] == 0 && i != 2) {
          EXPECT_NEAR(absolute[d], 0, 1e-9) << i;  // 2: over a kink
        }
      }
    }
    if (held[0] == 0) {
      EXPECT_NEAR(foot.acceleration[0][0], -1, 1e-12);
    }
  }
}

/// What nothing holds or touches stays where it is, while the ground goes away under it from the step on that the record names.
TEST(BaseAcceleration, IsNoneBeforeItsStep) {
  const RunResult run = run_model(R"(
gravity = [0, 0, 0]
[[material]]
density = 2000
young_modulus = 1e9
poisson_ratio = 0.25
[[solid]]
name = "b"
shape = "box"
min = [0, 0, 0]
max = [1, 1, 1]
[cover]
lattice = "tet6"
spacing = 0.7
[[monitor]]
point = [0.5, 0.5, 0]
[base_acceleration]
table = [[-1, 9, 0, 0], [0.1, 5, 0, 0], [0.2, -4, 2, 0]]
step = "shaking"
[[step]]
type = "quasi_static"
time_step = 0.1
end_time = 0.25
[[step]]
name = "rest"
time_step = 0.01
steps = 7
[[step]]
name = "shaking"
time_step = 0.01
steps = 20
)")
                            .result;
  const MonitorHistory& foot = run.monitors[0];
  const BaseMotion& end = run.base.back();
  ASSERT_EQ(foot.time.size(), 31u);
  for (std::size_t i = 0; i < foot.time.size(); ++i) {
    const Vec3 absolute = foot.displacement[i] + run.base[i].displacement;
    for (int d = 0; d < 3; ++d) EXPECT_NEAR(absolute[d], 0, i <= 10 ? 1e-15 : 2e-4) << i;
    if (i <= 10) {
      EXPECT_NEAR(norm(run.base[i].velocity), 0, 1e-15) << i;
    }
  }
  // Up to the 5.32727 m/s² of its first step's end, then as recorded:
  // v = 0.01 · 5.32727/2 + 0.09 (5.32727 + 5)/2 + 0.1 (5 − 4)/2.
  EXPECT_NEAR(end.velocity[0], 0.5413636, 1e-6);
  EXPECT_NEAR(end.velocity[1], 0.1, 1e-8);
  EXPECT_NEAR(foot.velocity.back()[1], -0.1, 1e-8);
}

}  // namespace
}  // namespace rockfold
