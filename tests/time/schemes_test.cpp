// Newmark's method with parameters other than those of average acceleration, and damping.
#include <cmath>

#include <gtest/gtest.h>

#include "src/base/vector.hpp"
#include "tests/time/modes.hpp"
#include "tests/time/oscillator.hpp"

namespace rockfold {
namespace {

constexpr Real pi = 3.14159265358979323846;

/// What a free oscillation obeys from the second step on: d'' = p d' − q d. Newmark's method (Hughes 1987, §9.1):
/// p = 2 − Ω² (γ + 1/2) / (1 + βΩ²), q = 1 − Ω² (γ − 1/2) / (1 + βΩ²); √q is the spectral radius where the roots are complex.
struct Recursion {
  Real p, q;
};

Recursion find_recursion(const std::vector<Real>& d) {
  const std::size_t n = d.size() - 4;
  const Real det = d[n + 1] * d[n + 1] - d[n + 2] * d[n];
  return {(d[n + 2] * d[n + 1] - d[n + 3] * d[n]) / det,
          (d[n + 2] * d[n + 2] - d[n + 3] * d[n + 1]) / det};
}

std::vector<Real> free_oscillation(const Oscillator& oscillator, const MotionSetup& setup, Real dt,
                                   int steps) {
  const TrackedPoints point = oscillator.rock.track({{0.3, 0.6, 0.2}});
  Motion motion = oscillator.start(dt, setup);
  std::vector<Real> way{0};
  for (int step = 0; step < steps; ++step) {
    EXPECT_TRUE(motion.step(dt).converged);
    way.push_back(motion.at(point).displacement[0][0]);
  }
  return way;
}

TEST(Newmark, ObeysItsRecursionWithAnyParameters) {
  const Oscillator oscillator;
  const Real schemes[][2] = {{0.25, 0.5},   {0.5, 1}, {1.0 / 6, 0.5}, {1.0 / 12, 0.5},
                             {0.3025, 0.6}, {2, 1.5}, {0.1, 0.4},     {0.25, 0}};
  for (const auto& [beta, gamma] : schemes)
    for (Real turn : {0.1, 0.5, 1.0, 1.7}) {
      MotionSetup setup = oscillator.rock.setup();
      setup.beta = beta;
      setup.gamma = gamma;
      const Recursion found =
          find_recursion(free_oscillation(oscillator, setup, turn / oscillator.omega, 6));
      const Real square = turn * turn / (1 + beta * turn * turn);
      EXPECT_NEAR(found.p, 2 - square * (gamma + 0.5), 1e-8) << beta << ' ' << gamma << ' ' << turn;
      EXPECT_NEAR(found.q, 1 - square * (gamma - 0.5), 1e-8) << beta << ' ' << gamma << ' ' << turn;
    }
}

/// Free rock with slivers, and rock on supports by multipliers: just below the critical step nothing grows, just above it everything does.
TEST(Newmark, IsStableUpToTheCriticalStepOfTheLargestFrequency) {
  for (const bool supported : {false, true}) {
    Rock rock = turned_box({0.1, 0.05, 0}, {0.9, 0.75, 0.7}, 0.35);
    if (supported) rock.hold([](const Vec3& x) { return x[2] < 1e-9; }, 1e9, true);
    MotionSetup setup = rock.setup();
    setup.beta = 1.0 / 12;
    setup.solver.tolerance = 1e-10;
    const Real critical = 1 / (Motion(setup).largest_frequency() * std::sqrt(0.5 / 2 - setup.beta));
    const auto growth = [&](Real dt) {
      Motion motion(setup);
      StateArrays state;
      state.displacement.resize(rock.covers().unknown_count());
      for (std::size_t p = 0; p < state.displacement.size(); ++p)
        state.velocity.push_back({std::sin(1.7 * p), std::cos(2.3 * p), std::sin(0.9 * p + 1)});
      motion.set_motion(state);
      EXPECT_TRUE(motion.start(dt).converged);
      const Real before = motion.energy().kinetic;
      for (int step = 0; step < 300; ++step) motion.step(dt);
      const Energy after = motion.energy();
      return (after.kinetic + after.strain) / before;
    };
    EXPECT_LT(growth(0.97 * critical), 20)
        << supported;  // the scheme's own norm, not the energy, is kept
    EXPECT_GT(growth(1.03 * critical), 1e6) << supported;
  }
}

/// β = 1/2, γ = 1, the scheme of DDA.
TEST(Newmark, OfDdaDampsAsItsSpectralRadiusSays) {
  const Oscillator oscillator;
  MotionSetup setup = oscillator.rock.setup();
  setup.beta = 0.5;
  setup.gamma = 1;
  const Real published[][2] = {{0.1, 0.99750934}, {0.5, 0.94280904}, {1, 0.81649658}};
  for (const auto& [turn, radius] : published) {
    const Recursion found =
        find_recursion(free_oscillation(oscillator, setup, turn / oscillator.omega, 6));
    EXPECT_NEAR(std::sqrt(found.q), radius, 1e-7);
    EXPECT_NEAR(std::sqrt(found.q), std::sqrt(2 / (2 + turn * turn)), 1e-9);
    EXPECT_LT(found.p * found.p, 4 * found.q);  // it swings
  }
  // Over Ω = 4 it creeps, ever slower as the step grows.
  const Recursion found =
      find_recursion(free_oscillation(oscillator, setup, 8 / oscillator.omega, 6));
  EXPECT_GT(found.p * found.p, 4 * found.q);
}

/// With κ = 0 the error of DDA's scheme shrinks by 2 / (2 + Ω²) a step.
TEST(QuasiStatic, OfDdaApproachesTheAnswerFromOneSide) {
  const Oscillator oscillator;
  const TrackedPoints point = oscillator.rock.track({{0.3, 0.6, 0.2}});
  for (Real turn : {0.5, 1.0, 3.0}) {
    MotionSetup setup = oscillator.rock.setup();
    setup.gravity = {7, 0, 0};
    setup.beta = 0.5;
    setup.gamma = 1;
    setup.dynamic_ratio = 0;
    Motion motion(setup);
    const Real answer = 7 / (oscillator.omega * oscillator.omega);
    const Real factor = 2 / (2 + turn * turn);
    for (int step = 1; step <= 8; ++step) {
      ASSERT_TRUE(motion.step(turn / oscillator.omega).converged);
      const Real error = 1 - motion.at(point).displacement[0][0] / answer;
      EXPECT_NEAR(error, std::pow(factor, step), 1e-9);
    }
  }
}

/// A ratio κ is a damping α = −ln κ / Δt.
TEST(Dynamic, TheRatioDampsAsMassDampingDoes) {
  const Oscillator oscillator;
  const Real dt = 0.01, ratio = 0.999;
  MotionSetup setup = oscillator.rock.setup();
  setup.dynamic_ratio = ratio;
  const auto by_ratio = free_oscillation(oscillator, setup, dt, 100);
  setup.dynamic_ratio = 1;
  setup.damping.mass = -std::log(ratio) / dt;
  EXPECT_NEAR(setup.damping.mass, 0.10005, 1e-7);
  const auto by_mass = free_oscillation(oscillator, setup, dt, 100);
  for (std::size_t n = 0; n < by_mass.size(); ++n)
    EXPECT_NEAR(by_ratio[n], by_mass[n], 1e-3 / oscillator.omega) << n;
}

/// A free box and its first elastic mode, tuned to 1 Hz.
struct TunedBox {
  Rock rock = turned_box({0.05, 0.02, 0.03}, {1.4, 0.6, 0.7}, 0.5);
  reference::Mode mode;

  TunedBox() {
    rock.materials = {{2000, 1e5, 0.25}};
    mode = reference::first_elastic_mode(rock.covers(), rock.materials);
    const Real hertz = mode.omega / (2 * pi);
    rock.materials[0].young_modulus /=
        hertz * hertz;  // ω² is proportional to E, the shape the same
    mode.omega = 2 * pi;
  }
  /// Amplitude of the mode in a field.
  Real part(const std::vector<Vec3>& field) const {
    Real sum = 0;
    for (std::size_t p = 0; p < field.size(); ++p) sum += dot(field[p], mode.weighted[p]);
    return sum;
  }
};

/// 5 % at 1 and 10 Hz; the logarithmic decrement at 1 Hz is 0.314553.
TEST(Rayleigh, DampsAModeAtItsRatio) {
  const TunedBox box;
  const Real alpha = 0.57119866, beta = 0.00144686;
  EXPECT_NEAR(alpha / (2 * box.mode.omega) + beta * box.mode.omega / 2, 0.05, 1e-7);
  MotionSetup setup = box.rock.setup();
  setup.damping = {alpha, beta};
  Motion motion(setup);
  StateArrays state;
  state.displacement.resize(box.mode.shape.size());
  state.velocity = box.mode.shape;
  motion.set_motion(state);
  const Real dt = 1.0 / 250;
  ASSERT_TRUE(motion.start(dt).converged);
  std::vector<Real> way{0};
  for (int step = 1; step <= 520; ++step) {
    ASSERT_TRUE(motion.step(dt).converged);
    way.push_back(box.part(motion.state().displacement));
  }
  // Peaks a period apart, by the parabola through three values.
  const auto peak_after = [&](std::size_t from) {
    std::size_t n = from;
    while (!(way[n] >= way[n - 1] && way[n] > way[n + 1])) ++n;
    const Real slope = (way[n + 1] - way[n - 1]) / 2, bend = way[n + 1] - 2 * way[n] + way[n - 1];
    return way[n] - slope * slope / (2 * bend);
  };
  // Average acceleration keeps ζ to O(Ω²) = 6e-4 / 12.
  EXPECT_NEAR(std::log(peak_after(1) / peak_after(200)), 0.314553, 1e-4);
  const Energy e = motion.energy();
  const Real given = 0.5;  // the shape has unit mass
  EXPECT_NEAR((e.kinetic + e.strain + e.damping) / given, 1, 1e-9);
  EXPECT_NEAR(e.numerical / given, 0, 1e-9);
  EXPECT_GT(e.damping, 0.6 * given);
}

/// Stiffness damping takes nothing from a rigid motion, mass damping the share that it says: v' = v (2 − αΔt)/(2 + αΔt).
TEST(Rayleigh, OfAFreeBlockDampsByMassAlone) {
  const Rock rock = turned_box({0.05, 0.02, 0.03}, {2.1, 0.6, 0.7}, 0.4);
  for (Real alpha : {0.0, 3.0}) {
    MotionSetup setup = rock.setup();
    setup.damping = {alpha, 0.01};
    Motion motion(setup);
    StateArrays state;
    state.displacement.resize(rock.covers().unknown_count());
    state.velocity.assign(rock.covers().unknown_count(), {1, -2, 0.5});
    motion.set_motion(state);
    ASSERT_TRUE(motion.start(0.05).converged);
    const TrackedPoints point = rock.track({{0.5, 0.3, 0.3}});
    for (int step = 1; step <= 10; ++step) {
      ASSERT_TRUE(motion.step(0.05).converged);
      const Real left = std::pow((2 - alpha * 0.05) / (2 + alpha * 0.05), step);
      EXPECT_NEAR(motion.at(point).velocity[0][1], -2 * left, 1e-10);
    }
    const Energy e = motion.energy();
    EXPECT_NEAR(e.numerical / (e.kinetic + e.damping), 0, 1e-10);
  }
}

}  // namespace
}  // namespace rockfold
