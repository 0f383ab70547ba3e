#include <cmath>

#include <gtest/gtest.h>

#include "tests/time/rock.hpp"

namespace rockfold {
namespace {

/// E = 1000, ν = 0.25.
Vec3 patch_field(const Vec3& x) {
  return {1e-3 * (2 * x[0] + x[1] - x[2] / 2), 1e-3 * (x[0] / 2 - x[1] + 1.5 * x[2]),
          1e-3 * (-x[0] + x[1] / 2 + 3 * x[2])};
}
constexpr std::array<Real, 6> patch_stress{3.2, 0.8, 4.0, 0.6, 0.8, -0.6};

TEST(Static, ALinearDisplacementOnTheBoundaryGivesConstantStress) {
  const Vec3 low{0.05, 0.02, 0.03}, high{2.1, 1.3, 1.2};
  Rock rock = turned_box(low, high, 0.55);
  rock.materials = {{2000, 1000, 0.25}};
  const auto on_boundary = [&](const Vec3& x) {
    bool on = false;
    for (int d = 0; d < 3; ++d)
      on = on || std::abs(x[d] - low[d]) < 1e-9 || std::abs(x[d] - high[d]) < 1e-9;
    return on;
  };
  rock.hold(on_boundary, 1e4, true, patch_field);
  MotionSetup setup = rock.setup();
  Motion motion(setup);
  const SolveReport report = motion.solve_static();
  ASSERT_TRUE(report.converged);
  for (const auto& stress : motion.element_stress())
    for (int i = 0; i < 6; ++i) EXPECT_NEAR(stress[i], patch_stress[i], 1e-8 * 4.0);
  Real volume = 1;
  for (int d = 0; d < 3; ++d) volume *= high[d] - low[d];
  EXPECT_NEAR(motion.energy().strain / (0.0105 * volume), 1, 1e-8);
  // The supports do all the work, half of force times way.
  EXPECT_NEAR(motion.energy().dissipated / (0.0105 * volume), 0, 1e-8);
}

/// A column of height 10 under its own weight, ν = 0.
Rock column(Index cells_high) {
  const Real spacing = 10.0 / cells_high;
  Rock rock = whole_box({2, 2, cells_high}, spacing);
  rock.materials = {{2000, 1e8, 0}};
  // Stiff enough for the floor's own give to vanish: ρgH·A / (9 points · k) = 2e-16 m.
  rock.hold([](const Vec3& x) { return x[2] < 1e-9; }, 1e8 * spacing, true);
  return rock;
}

TEST(Static, AColumnSettlesUnderItsWeightAsTheClosedFormSays) {
  Real coarse = 1;
  for (Index cells : {5, 10, 20}) {
    const Rock rock = column(cells);
    const Real spacing = 10.0 / cells;
    MotionSetup setup = rock.setup();
    setup.gravity = {0, 0, -9.8};
    Motion motion(setup);
    ASSERT_TRUE(motion.solve_static().converged);
    const Real top = motion.at(rock.track({{spacing, spacing, 10}})).displacement[0][2];
    const Real base = motion.at(rock.track({{spacing, spacing, 1e-6}})).stress[0][2];
    // Linear elements in one dimension: nodes are exact where the load is consistent; here the split cells see
    // ν = 0 shear from their unequal nodal loads, which refinement takes away.
    const Real error = std::abs(top + 0.0098);
    EXPECT_LT(error, 0.02 * 0.0098) << cells;
    // The stress in the lowest layer is that of its middle: ρg (H − h/2).
    EXPECT_NEAR(base / (-2000 * 9.8 * (10 - spacing / 2)), 1, 0.15);
    EXPECT_LT(error, coarse * 0.6) << cells;
    coarse = error;

    Vec3 total{};
    for (const Vec3& r : motion.reactions())
      for (int d = 0; d < 3; ++d) total[d] += r[d];
    EXPECT_NEAR(total[2] / (2000 * 9.8 * 10 * 4 * spacing * spacing), 1, 1e-9);
    // A linear system: the load's potential goes half into strain.
    const Energy e = motion.energy();
    EXPECT_NEAR(-2 * e.strain / e.potential, 1, 1e-8);
    EXPECT_NEAR(e.dissipated / e.strain, 1, 1e-8);
  }
}

TEST(Static, APointLoadMovesOnlyWhatItMust) {
  Rock rock = turned_box({0.05, 0.02, 0.03}, {2.1, 1.3, 1.2}, 0.55);
  rock.hold([](const Vec3& x) { return x[2] < 0.03 + 1e-9; }, 1e8, false);
  MotionSetup setup = rock.setup();
  const Vec3 at{2.0, 1.2, 1.1}, force{3e3, -1e3, 2e3};
  setup.loads = forces_at(rock, {at}, {force});
  Motion motion(setup);
  ASSERT_TRUE(motion.solve_static().converged);
  const Vec3 u = motion.at(rock.track({at})).displacement[0];
  Real work = 0;
  for (int d = 0; d < 3; ++d) work += force[d] * u[d];
  EXPECT_NEAR(motion.energy().potential / -work, 1, 1e-12);
  Vec3 total{};
  for (const Vec3& r : motion.reactions())
    for (int d = 0; d < 3; ++d) total[d] += r[d];
  for (int d = 0; d < 3; ++d) EXPECT_NEAR(total[d], -force[d], 1e-8 * 3e3);
}

}  // namespace
}  // namespace rockfold
