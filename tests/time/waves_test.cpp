// Waves along bars: a column of lattice cells with ν = 0, or held sideways so that a plane wave runs through.
#include <cmath>

#include <gtest/gtest.h>

#include "src/base/vector.hpp"
#include "src/space/shape_functions.hpp"
#include "tests/time/rock.hpp"

namespace rockfold {
namespace {

/// L = 10, E = 1e9, ρ = 2500; the bar lies along x, its sides held where `confined` or where ν = 0 must keep it
/// plane: split cells are not symmetric.
struct Bar {
  static constexpr Index cells = 80;
  static constexpr Real length = 10, spacing = length / cells, section = 4 * spacing * spacing;
  Rock rock = whole_box({cells, 2, 2}, spacing);
  Real wave_modulus;  ///< Pa

  explicit Bar(Real poisson_ratio) {
    rock.materials = {{2500, 1e9, poisson_ratio}};
    wave_modulus = 1e9 * (1 - poisson_ratio) / ((1 + poisson_ratio) * (1 - 2 * poisson_ratio));
  }
  Real speed() const { return std::sqrt(wave_modulus / 2500); }

  /// Holds y and z everywhere, x as well where `fixed_end` at x = 0.
  void hold_plane(bool fixed_end) {
    rock.hold([](const Vec3&) { return true; }, 1e12, false);
    for (std::size_t n = 0; n < rock.fixed.points.size(); ++n) {
      const Vec3 x = point_position(rock.covers(), rock.fixed.points, n);
      rock.fixed.component[n] = {std::uint8_t(fixed_end && x[0] < 1e-9), 1, 1};
    }
  }
  /// Corners of the lattice on the face at x, with their share of its area; linear functions integrate exactly.
  std::pair<MaterialPoints, std::vector<Real>> face(Real x) const {
    std::vector<Vec3> points;
    std::vector<Real> area;
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j)
        for (int k = 0; k < 3;
             ++k) {  // a triangle's edge midpoints are exact for what is quadratic
          const Real y = spacing * i, z = spacing * j, h = spacing / 2;
          const Real at[3][2] = {{y + h, z}, {y, z + h}, {y + h, z + h}};
          const Real mirrored[3][2] = {{y + h, z + 2 * h}, {y + 2 * h, z + h}, {y + h, z + h}};
          points.push_back({x, at[k][0], at[k][1]});
          area.push_back(spacing * spacing / 6);
          points.push_back({x, mirrored[k][0], mirrored[k][1]});
          area.push_back(spacing * spacing / 6);
        }
    return {reference::locate(rock.covered, points), area};
  }
  /// A pressure p on the end at x = length.
  LoadPoints push(const TimeTable& pressure) const {
    const auto [points, area] = face(length);
    LoadPoints loads;
    loads.points = points;
    loads.force.resize(area.size());
    loads.table.assign(area.size(), 0);
    loads.scale.assign(area.size(), 0);
    loads.pressure.assign(area.size(), 1);
    for (Real a : area) loads.area.push_back({a, 0, 0});
    loads.tables = {pressure};
    return loads;
  }
  QuietPoints quiet(Real x) const {
    const auto [points, area] = face(x);
    QuietPoints quiet;
    quiet.points = points;
    const Real shear = std::sqrt(1e9 / (2 * 2500));
    for (Real a : area) {
      quiet.normal.push_back({x > 0 ? 1.0 : -1.0, 0, 0});
      quiet.normal_damping.push_back(2500 * speed() * a);
      quiet.shear_damping.push_back(2500 * shear * a);
    }
    return quiet;
  }
};

const TimeTable step_load{{0}, {{1e6, 0, 0}}};

/// c = 632.4555 m/s; behind the front v = p/ρc = 0.632456 m/s; the free end doubles it; period of a bar that is
/// held at one end 4L/c.
TEST(Wave, ASteppedPressureRunsAlongABarAndDoublesAtItsFreeEnd) {
  Bar bar(0);
  EXPECT_NEAR(bar.speed(), 632.4555, 1e-4);
  bar.hold_plane(false);
  MotionSetup setup = bar.rock.setup();
  setup.solver.tolerance = 1e-9;
  setup.loads = bar.push(step_load);
  Motion motion(setup);
  const Real dt = 0.5 * Bar::spacing / bar.speed();
  ASSERT_TRUE(motion.start(dt).converged);
  const TrackedPoints points = bar.rock.track({{0, 0.1, 0.1}, {5, 0.1, 0.1}});
  Real arrival = 0, middle = 0, end = 0;
  int in_middle = 0, at_end = 0;
  while (motion.time() < 0.028) {
    ASSERT_TRUE(motion.step(dt).converged);
    const PointMotion at = motion.at(points);
    // The front of a step is smeared over a few cells; its middle is where half the velocity is reached.
    if (arrival == 0 && -at.velocity[0][0] > 0.632456) arrival = motion.time();
    if (motion.time() > 0.0105 && motion.time() < 0.0215) middle -= at.velocity[1][0], ++in_middle;
    if (motion.time() > 0.018) end -= at.velocity[0][0], ++at_end;
  }
  EXPECT_NEAR(arrival / 0.0158114, 1, 0.01);
  EXPECT_NEAR(middle / in_middle / 0.632456, 1, 0.01);
  EXPECT_NEAR(end / at_end / 1.264911, 1, 0.01);
  const Energy e = motion.energy();
  EXPECT_NEAR((e.kinetic + e.strain) / e.loads, 1, 1e-6);
}

TEST(Wave, AFixedEndDoublesTheStressAndTheBarSwingsWithItsPeriod) {
  Bar bar(0);
  bar.hold_plane(true);
  MotionSetup setup = bar.rock.setup();
  setup.solver.tolerance = 1e-9;
  setup.loads = bar.push(step_load);
  Motion motion(setup);
  const Real dt = 0.5 * Bar::spacing / bar.speed();
  ASSERT_TRUE(motion.start(dt).converged);
  const TrackedPoints points = bar.rock.track({{0.03, 0.1, 0.1}, {10, 0.1, 0.1}});
  Real stress = 0, largest = 0, at_largest = 0, smallest = 1, at_smallest = 0;
  int counted = 0;
  while (motion.time() < 0.07) {
    ASSERT_TRUE(motion.step(dt).converged);
    const PointMotion at = motion.at(points);
    const Real t = motion.time(), way = -at.displacement[1][0];
    if (t > 0.0185 && t < 0.0455) stress -= at.stress[0][0], ++counted;
    if (way > largest) largest = way, at_largest = t;
    if (t > 0.05 && way < smallest) smallest = way, at_smallest = t;
  }
  EXPECT_NEAR(stress / counted / 2e6, 1, 0.01);
  EXPECT_NEAR(largest / 0.02, 1, 0.01);
  EXPECT_NEAR(at_largest / 0.0316228, 1, 0.01);
  EXPECT_NEAR(smallest / 0.02, 0, 0.01);
  EXPECT_NEAR(at_smallest / 0.0632456, 1, 0.01);  // the period
}

/// A pulse that leaves through a quiet boundary: what comes back is a few per mille of its energy at most (normal incidence).
TEST(QuietBoundary, LetsAWaveOut) {
  Bar bar(0.25);
  EXPECT_NEAR(bar.speed(), 692.8203, 1e-4);
  bar.hold_plane(false);
  MotionSetup setup = bar.rock.setup();
  setup.solver.tolerance = 1e-9;
  // A pulse of sin² over 6 ms: 4 m long, 33 cells.
  TimeTable pulse;
  for (int i = 0; i <= 60; ++i) {
    pulse.time.push_back(1e-4 * i);
    pulse.value.push_back({1e6 * std::pow(std::sin(M_PI * i / 60), 2), 0, 0});
  }
  setup.loads = bar.push(pulse);
  setup.quiet = bar.quiet(0);
  Motion motion(setup);
  const Real dt = 0.5 * Bar::spacing / bar.speed();
  ASSERT_TRUE(motion.start(dt).converged);
  while (motion.time() < 0.009) ASSERT_TRUE(motion.step(dt).converged);  // in the midst of the bar
  const Energy before = motion.energy();
  const Real pulse_energy = before.kinetic + before.strain;
  EXPECT_NEAR(before.kinetic / before.strain, 1, 0.01);
  // ∫ p²/ρc dt · area = 3/8 · 1e12 · 6e-3 / (ρc).
  EXPECT_NEAR(pulse_energy / (0.375e12 * 6e-3 / (2500 * bar.speed()) * Bar::section), 1, 0.01);
  EXPECT_NEAR(before.quiet / pulse_energy, 0, 1e-3);
  while (motion.time() < 0.0245)
    ASSERT_TRUE(motion.step(dt).converged);  // it would be back in the midst
  const Energy after = motion.energy();
  EXPECT_LT((after.kinetic + after.strain) / pulse_energy, 2e-3);
  EXPECT_NEAR(after.quiet / pulse_energy, 1, 2e-3);
  EXPECT_NEAR(after.numerical / pulse_energy, 0, 1e-7);
}

}  // namespace
}  // namespace rockfold
