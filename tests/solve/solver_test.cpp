#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "src/base/vector.hpp"
#include "tests/solve/systems/systems.hpp"

namespace rockfold {
namespace {

using reference::Dense;

/// Springs that hold all of both bodies.
SmallSystem held_system(bool augmented) {
  SmallSystem s = cut_system();
  const auto value = [](const Vec3& x) { return Vec3{0.01 * x[1], 0.02, -0.01 * x[2]}; };
  s.fixed =
      reference::fix(s.covered,
                     reference::corner_points(
                         s.covered, [](const Vec3& x) { return x[0] < 0.05 + 1e-9 && x[2] > 0.1; }),
                     value, 3e3, augmented, 0);
  const FixedPoints below = reference::fix(
      s.covered,
      reference::corner_points(s.covered, [](const Vec3& x) { return x[2] < -0.4 + 1e-9; }), value,
      3e3, augmented, 1);
  auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  append(s.fixed.points.element, below.points.element);
  append(s.fixed.points.local, below.points.local);
  append(s.fixed.points.unknown, below.points.unknown);
  for (std::size_t n = 0; n < below.points.size(); ++n)
    s.fixed.points.begin.push_back(s.fixed.points.begin.back() + 4);
  append(s.fixed.points.weight, below.points.weight);
  append(s.fixed.component, below.component);
  append(s.fixed.value, below.value);
  append(s.fixed.stiffness, below.stiffness);
  append(s.fixed.enforce, below.enforce);
  return s;
}

Dense dense(const SmallSystem& s, const SystemCoefficients& c) {
  return reference::combine(
      1,
      reference::combine(c.stiffness, reference::assemble_stiffness(s.covers(), s.materials),
                         c.mass, reference::assemble_mass(s.covers(), s.materials)),
      c.springs, reference::assemble_springs(s.covers(), s.fixed));
}

TEST(Solver, EqualsADirectSolution) {
  SmallSystem s = held_system(false);
  for (Vec3& v : s.fixed.value) v = {0, 0, 0};
  const SystemCoefficients c{1, 3, 1};
  const auto b = reference::scattered(s.covers().cover_node.size(), 5);
  const auto expected = reference::solve(dense(s, c), b);
  std::vector<Vec3> x(b.size());
  CoverSystem system = s.make();
  const SolveReport report = system.solve(c, b, x, {1e-13, 5000});
  EXPECT_TRUE(report.converged);
  EXPECT_LE(report.residual, 1e-13);
  // Condition of the scaled matrix below 1e5 (slivers left out at 1e-13 of a cell do not matter in the largest entries).
  EXPECT_LE(reference::largest_difference(x, expected), 1e-8 * reference::largest(expected));
  // Warm: from the answer there is nothing left to do.
  EXPECT_EQ(system.solve(c, b, x, {1e-12, 5000}).iterations, 0);
}

TEST(Solver, PenaltyPullsTowardsPrescribedDisplacements) {
  const SmallSystem s = held_system(false);
  const std::size_t count = s.covers().cover_node.size();
  std::vector<Vec3> load(count), b(count), x(count);
  for (std::size_t n = 0; n < s.fixed.points.size(); ++n)
    for (int a = 0; a < 4; ++a)
      load[s.fixed.points.unknown[4 * n + a]] +=
          s.fixed.points.weight[4 * n + a] * s.fixed.stiffness[n] * s.fixed.value[n];
  const auto expected = reference::solve(dense(s, {1, 1, 1}), load);
  EXPECT_TRUE(s.make().solve({1, 1, 1}, b, x, {1e-13, 5000}).converged);
  EXPECT_LE(reference::largest_difference(x, expected), 1e-8 * reference::largest(expected));
}

TEST(Solver, AugmentedPointsReachTheirPlacesAndTheReactionsBalanceTheLoad) {
  const SmallSystem s = held_system(true);
  const std::size_t count = s.covers().cover_node.size();
  CoverSystem system = s.make();
  std::vector<Vec3> x(count);
  const auto b = system.apply({0, 1, 0}, std::vector<Vec3>(count, Vec3{0.001, -0.002, 0.004}));
  const SolveReport report = system.solve({1, 0, 1}, b, x, {1e-10, 20000});
  EXPECT_TRUE(report.converged);
  EXPECT_LE(report.gap, 1e-10);
  for (std::size_t n = 0; n < s.fixed.points.size(); ++n) {
    Vec3 u{};
    for (int a = 0; a < 4; ++a)
      u += s.fixed.points.weight[4 * n + a] * x[s.fixed.points.unknown[4 * n + a]];
    EXPECT_LE(norm(u - s.fixed.value[n]), 2e-10 * reference::largest(x));
  }
  Vec3 total{};
  for (const Vec3& force : b) total += force;
  const Real load = norm(total);
  for (const Vec3& r : system.reactions(x)) total += r;
  // Elastic forces sum to zero; what is left of the load is the residual, 1e-10 of ‖b‖ with `count` rows.
  EXPECT_LE(norm(total), 1e-10 * std::sqrt(Real(count)) * 10 * load);
}

/// A body whose last layer of elements is thinner and thinner: volumes down to 1e-20 and below.
TEST(Solver, ASliverNeitherBreaksNorPoisonsTheSolution) {
  const Lattice lattice = reference::turned_lattice({0, 0, 0}, 0.5, 0, 0, {1, 0.5, 0.5}, 1.3);
  std::vector<Real> tips;
  for (Real thickness : {0.0, 1e-6, 1e-12, 1e-18}) {
    SmallSystem s;
    // In lattice-aligned coordinates the face at x = 2 is a lattice plane; beyond it the sliver.
    s.covered = reference::cover_regions(lattice, {reference::box({0, 0, 0}, {2 + 1e-3, 1, 1})}, 0);
    CoverArrays& a = s.covered.arrays;
    if (thickness == 0)
      s.covered = reference::cover_regions(lattice, {reference::box({0, 0, 0}, {2, 1, 1})});
    else  // squeeze the layer: exactly representable, where clipping would round it away
      for (Index e = 0; e < a.cut_count(); ++e)
        if (a.lattice.cell_centre(a.element_cell[e])[0] > 2)
          for (Index v = a.vertex_begin[e]; v < a.vertex_begin[e + 1]; ++v) {
            Real& x = a.vertex_xyz[3 * v];
            x = -0.25 + (x + 0.25) * (thickness / 1e-3);
          }
    s.materials = {{2000, 1e6, 0.2}};
    s.fixed = reference::fix(
        s.covered, reference::corner_points(s.covered, [](const Vec3& x) { return x[0] < 1e-9; }),
        [](const Vec3&) { return Vec3{}; }, 1e6, false);
    std::vector<Vec3> x(s.covers().cover_node.size());
    const auto b = s.make().apply({0, 1, 0}, std::vector<Vec3>(x.size(), Vec3{0, 0, -10}));
    const SolveReport report = s.make().solve({1, 0, 1}, b, x, {1e-10, 20000});
    EXPECT_TRUE(report.converged) << "thickness " << thickness << ", residual " << report.residual;
    EXPECT_LT(report.iterations, 500);
    const MaterialPoints tip = reference::locate(s.covered, {{1.9, 0.4, 0.3}});
    Vec3 u{};
    for (int k = 0; k < 4; ++k) u += tip.weight[k] * x[tip.unknown[k]];
    tips.push_back(u[2]);
    EXPECT_LT(reference::largest(x), 10 * std::abs(u[2])) << "covers of the sliver fly off";
  }
  // The layer adds at most `thickness` of stiffness and weight.
  EXPECT_NEAR(tips[1] / tips[0], 1, 1e-4);
  EXPECT_NEAR(tips[2] / tips[0], 1, 1e-7);
  EXPECT_NEAR(tips[3] / tips[0], 1, 1e-7);
}

TEST(Solver, ReportsThatItDidNotConverge) {
  const SmallSystem s = held_system(false);
  const auto b = reference::scattered(s.covers().cover_node.size(), 5);
  std::vector<Vec3> x(b.size());
  const SolveReport report = s.make().solve({1, 0, 1}, b, x, {1e-12, 3});
  EXPECT_FALSE(report.converged);
  EXPECT_EQ(report.iterations, 3);
  EXPECT_GT(report.residual, 1e-12);
}

TEST(Solver, ReportsNotANumber) {
  const SmallSystem s = held_system(false);
  auto b = reference::scattered(s.covers().cover_node.size(), 5);
  b[4][1] = std::numeric_limits<Real>::quiet_NaN();
  std::vector<Vec3> x(b.size());
  EXPECT_FALSE(s.make().solve({1, 0, 1}, b, x).converged);
}

TEST(Solver, RestsWhereNothingPulls) {
  SmallSystem s = cut_system();
  s.fixed = {};
  std::vector<Vec3> b(s.covers().cover_node.size()), x(b.size(), Vec3{1, 2, 3});
  const SolveReport report = s.make().solve({1, 0, 1}, b, x);
  EXPECT_TRUE(report.converged);
  EXPECT_EQ(reference::largest(x), 0);
}

}  // namespace
}  // namespace rockfold
