#include <cmath>

#include <gtest/gtest.h>

#include "src/base/vector.hpp"
#include "tests/time/oscillator.hpp"

namespace rockfold {
namespace {

/// Nothing but gravity. Average acceleration with a first acceleration of g is exact.
TEST(Dynamic, AFreeBlockFallsExactly) {
  const Rock rock = turned_box({0.05, 0.02, 0.03}, {2.1, 1.3, 1.2}, 0.35);
  EXPECT_GT(rock.covers().element_count(), 500);
  MotionSetup setup = rock.setup();
  setup.solver.tolerance = 1e-8;
  setup.gravity = {0, 0, -10};
  Motion motion(setup);
  ASSERT_TRUE(motion.start(0.05).converged);
  const TrackedPoints points = rock.track({{0.06, 0.03, 0.04}, {1, 0.7, 0.6}, {2.1, 1.3, 1.2}});
  for (int step = 1; step <= 40; ++step) {
    ASSERT_TRUE(motion.step(0.05).converged);
    const Real t = 0.05 * step;
    const PointMotion at = motion.at(points);
    for (int n = 0; n < 3; ++n) {
      EXPECT_NEAR(at.displacement[n][2] / (-5 * t * t), 1, 1e-12);
      EXPECT_NEAR(at.velocity[n][2] / (-10 * t), 1, 1e-12);
      EXPECT_NEAR(at.acceleration[n][2], -10, 1e-11);
      EXPECT_NEAR(at.displacement[n][0], 0, 1e-12);
    }
  }
  const Energy e = motion.energy();
  EXPECT_NEAR(e.kinetic / -e.potential, 1, 1e-11);
  EXPECT_NEAR(e.dissipated / e.kinetic, 0, 1e-11);
}

/// Average acceleration turns by 2 atan(Ω/2) a step instead of Ω = ω Δt, with no damping.
TEST(Dynamic, AnOscillatorHasThePeriodErrorOfAverageAcceleration) {
  Oscillator oscillator;
  const TrackedPoints point = oscillator.rock.track({{0.3, 0.6, 0.2}});
  for (Real turn : {0.1, 0.2, 0.5, 1.0, 2.0}) {
    const Real dt = turn / oscillator.omega;
    Motion motion = oscillator.start(dt);
    const Real angle = 2 * std::atan(turn / 2);
    for (int step = 1; step <= 30; ++step) {
      ASSERT_TRUE(motion.step(dt).converged);
      const PointMotion at = motion.at(point);
      // In place with v = 1: d = sin(n·angle)/ω, v = cos(n·angle). Tolerance of a solve 1e-12, 30 steps.
      EXPECT_NEAR(at.velocity[0][0], std::cos(step * angle), 1e-9);
      EXPECT_NEAR(at.displacement[0][0] * oscillator.omega, std::sin(step * angle), 1e-9);
    }
  }
}

/// κ takes its share of the velocity once a step.
TEST(Dynamic, TheRatioScalesTheVelocityHandedOn) {
  Rock rock = whole_box({2, 2, 2}, 0.5);
  MotionSetup setup = rock.setup();
  setup.dynamic_ratio = 0.9;
  Motion motion(setup);
  StateArrays state;
  state.displacement.resize(27);
  state.velocity.assign(27, Vec3{2, 0, 0});
  motion.set_motion(state);
  ASSERT_TRUE(motion.start(0.01).converged);
  const TrackedPoints point = rock.track({{0.3, 0.6, 0.2}});
  Real way = 0;
  for (int step = 1; step <= 5; ++step) {
    const int parts = step == 3 ? 4 : 1;  // of one step: they share its ratio
    for (int part = 0; part < parts; ++part)
      ASSERT_TRUE(motion.step(0.01 / parts, part == 0).converged);
    const Real v = 2 * std::pow(0.9, step - 1);  // the first step starts from what was given
    way += 0.01 * v;
    EXPECT_NEAR(motion.at(point).velocity[0][0], v, 1e-12);
    EXPECT_NEAR(motion.at(point).displacement[0][0], way, 1e-12);
  }
  // What the ratio took away is dissipated.
  const Energy e = motion.energy();
  EXPECT_NEAR(e.kinetic, 0.5 * 2000 * 4 * std::pow(0.9, 8), 1e-8);
  EXPECT_NEAR(e.dissipated, 0.5 * 2000 * 4 * (1 - std::pow(0.9, 8)), 1e-8);
}

Rock bar(bool augmented) {
  Rock rock = turned_box({0.05, 0.02, 0.03}, {2.1, 0.6, 0.7}, 0.4);
  rock.hold([](const Vec3& x) { return x[0] < 0.05 + 1e-9; }, 1e8, augmented);
  return rock;
}

TEST(QuasiStatic, ConvergesToTheStaticAnswerFromOneSide) {
  const Rock rock = bar(false);
  const TrackedPoints tip = rock.track({{2.0, 0.3, 0.3}});
  MotionSetup setup = rock.setup();
  setup.gravity = {0, 0, -9.81};
  Motion statics(setup);
  ASSERT_TRUE(statics.solve_static().converged);
  const Real answer = statics.at(tip).displacement[0][2];
  for (Real dt : {0.01, 0.02, 1.0}) {
    setup.dynamic_ratio = 0;
    Motion motion(setup);
    ASSERT_TRUE(motion.start(dt).converged);
    Real before = 0;
    for (int step = 1; step <= 100; ++step) {
      ASSERT_TRUE(motion.step(dt).converged);
      const Real now = motion.at(tip).displacement[0][2];
      EXPECT_LE(now, before * (1 - 1e-9)) << "swings back at step " << step;
      EXPECT_GE(now, answer * (1 + 1e-9)) << "overshoots at step " << step;
      before = now;
    }
    // The slowest mode has ω ≈ 50 1/s and loses 4/(4 + ω²Δt²) a step: 0.94^100 and 0.8^100 at the shorter steps.
    EXPECT_NEAR(before / answer, 1, dt < 0.015 ? 0.01 : 1e-6);
  }
}

TEST(Dynamic, AverageAccelerationKeepsTheEnergyOfFreeVibration) {
  const Rock rock = bar(false);
  MotionSetup setup = rock.setup();
  setup.solver.tolerance = 1e-13;
  Motion motion(setup);
  StateArrays state;
  state.displacement.resize(rock.covers().cover_node.size());
  state.velocity = reference::sample_at_nodes(rock.covers(), [](const Vec3& x) {
    return Vec3{0, 0.1 * x[0], (x[0] - 0.05) * (x[0] - 0.05)};
  });
  motion.set_motion(state);
  ASSERT_TRUE(motion.start(1e-3).converged);
  const Real total = motion.energy().kinetic;
  for (int step = 1; step <= 100; ++step) {
    ASSERT_TRUE(motion.step(1e-3).converged);
    // The springs' own energy is the work that the rock has done on its supports: nothing is dissipated.
    const Energy e = motion.energy();
    EXPECT_NEAR((e.kinetic + e.strain - e.supports) / total, 1, 1e-9) << step;
    EXPECT_NEAR(e.dissipated / total, 0, 1e-9) << step;
  }
}

TEST(Dynamic, AugmentedPointsStayInTheirPlaces) {
  const Rock rock = bar(true);
  MotionSetup setup = rock.setup();
  setup.gravity = {0, 0, -9.81};
  Motion motion(setup);
  ASSERT_TRUE(motion.start(2e-3).converged);
  for (int step = 1; step <= 20; ++step) {
    const SolveReport report = motion.step(2e-3);
    ASSERT_TRUE(report.converged);
    EXPECT_LE(report.gap, 1e-8) << step;
  }
  Vec3 total{};
  for (const Vec3& r : motion.reactions()) total += r;
  EXPECT_GT(total[2], 0);
}

TEST(Dynamic, SubstepsAndGoingBackRepeatTheSameMotion) {
  const Rock rock = bar(true);
  MotionSetup setup = rock.setup();
  setup.gravity = {0, 0, -9.81};
  Motion motion(setup), twin(setup);
  ASSERT_TRUE(motion.start(1e-3).converged);
  ASSERT_TRUE(twin.start(1e-3).converged);
  motion.step(1e-3);
  twin.step(1e-3);
  motion.save();
  for (int part = 0; part < 2; ++part) motion.step(2.5e-3, part == 0);
  motion.restore();
  EXPECT_EQ(motion.time(), 1e-3);
  for (int part = 0; part < 4; ++part) motion.step(0.25e-3, part == 0);
  for (int i = 0; i < 4; ++i) twin.step(0.25e-3);
  EXPECT_NEAR(motion.time(), twin.time(), 1e-15);
  const auto a = motion.state().displacement, b = twin.state().displacement;
  EXPECT_LE(reference::largest_difference(a, b), 1e-8 * reference::largest(b));
}

TEST(Dynamic, AStepSaysHowFarAWatchedPointHasMoved) {
  const Rock rock = turned_box({0.05, 0.02, 0.03}, {2.1, 1.3, 1.2}, 0.7);
  MotionSetup setup = rock.setup();
  setup.gravity = {0, 0, -10};
  Motion motion(setup);
  const TrackedPoints corner = rock.track({{0.06, 0.03, 0.04}});
  ASSERT_TRUE(motion.start(0.1).converged);
  ASSERT_TRUE(motion.step(0.1, true, &corner).converged);
  EXPECT_NEAR(motion.largest_increment(), 0.05, 1e-12);  // g Δt²/2
}

TEST(Dynamic, ReportsASolveThatDoesNotConverge) {
  const Rock rock = bar(false);
  MotionSetup setup = rock.setup();
  setup.gravity = {0, 0, -9.81};
  setup.solver.max_iterations = 2;
  Motion motion(setup);
  motion.start(1e-2);
  EXPECT_FALSE(motion.step(1e-2).converged);
}

}  // namespace
}  // namespace rockfold
