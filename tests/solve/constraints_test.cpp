// Points held, and springs, in the solution: whatever they depend on and however stiff they are.
#include <cmath>

#include <gtest/gtest.h>

#include "src/base/vector.hpp"
#include "tests/solve/systems/systems.hpp"

namespace rockfold {
namespace {

/// The rock of whole cells, the first so many nodes of which are held or on springs, and as many points again `aside` of them: they say the same
/// as long as rock moves there as it does at the nodes.
SmallSystem with_points(bool held, Real stiffness, Real aside = 0) {
  constexpr Index first = 40;
  SmallSystem s = uncut_system();
  Vec3 middle{};
  for (const Index node : s.covers().cover_node)
    middle += 1.0 / s.covers().cover_count() * s.covers().lattice.node_position(node);
  std::vector<Vec3> points;
  for (Index p = 0; p < first; ++p)
    points.push_back(s.covers().lattice.node_position(s.covers().cover_node[p]));
  for (Index p = 0; aside > 0 && p < first; ++p)
    points.push_back(points[p] + aside * (middle - points[p]));
  s.fixed = reference::fix(
      s.covered, points,
      [](const Vec3&) {
        return Vec3{0.01, 0.02, -0.01};
      },
      stiffness, held, 0);
  return s;
}

struct Answer {
  std::vector<Vec3> x;
  SolveReport report;
};

Answer push(const SmallSystem& s) {
  Answer answer{std::vector<Vec3>(s.covers().unknown_count()), {}};
  CoverSystem system = s.make();
  std::vector<Vec3> pull(s.covers().unknown_count());
  std::fill_n(pull.begin(), s.covers().cover_count(), Vec3{0.001, -0.002, 0.004});
  answer.report = system.solve({1, 1, 1}, system.apply({0, 1, 0}, pull), answer.x, {1e-10, 20000});
  return answer;
}

/// How far apart two motions of the rock are, in the mean over its mass, over the second: slivers of covers move as they like.
Real apart(const SmallSystem& s, const std::vector<Vec3>& x, const std::vector<Vec3>& y) {
  std::vector<Vec3> difference = x;
  for (std::size_t i = 0; i < x.size(); ++i) difference[i] -= y[i];
  const CoverSystem system = s.make();
  const auto squared = [&](const std::vector<Vec3>& v) {
    const auto mv = system.apply({0, 1, 0}, v);
    Real sum = 0;
    for (std::size_t i = 0; i < v.size(); ++i) sum += dot(v[i], mv[i]);
    return sum;
  };
  return std::sqrt(squared(difference) / squared(y));
}

TEST(HeldPoints, ThatAllButDependOnEachOtherCostLittleAndHoldAlike) {
  const Answer once = push(with_points(true, 0));
  EXPECT_TRUE(once.report.converged);
  for (const Real aside : {1e-3, 1e-6, 1e-9, 1e-13}) {
    const Answer twice = push(with_points(true, 0, aside));
    EXPECT_TRUE(twice.report.converged) << aside;
    EXPECT_LE(twice.report.gap, 1e-4) << aside;
    EXPECT_LE(twice.report.iterations, 2.5 * once.report.iterations) << aside;
  }
  const SmallSystem same = with_points(true, 0, 1e-13);
  EXPECT_LE(apart(same, push(same).x, once.x), 1e-8);
}

TEST(Springs, CostNoMoreIterationsHoweverStiffAndComeToPointsThatAreHeld) {
  const SmallSystem ideal = with_points(true, 0);
  const Answer held = push(ideal), soft = push(with_points(false, 1e3));
  const Real most = apart(ideal, soft.x, held.x);
  for (Real stiffer = 1e3; stiffer < 1e13; stiffer *= 1e3) {
    const Answer stiff = push(with_points(false, 1e3 * stiffer));
    EXPECT_TRUE(stiff.report.converged) << stiffer;
    EXPECT_LE(stiff.report.iterations, 1.5 * soft.report.iterations) << stiffer;
    EXPECT_LE(apart(ideal, stiff.x, held.x), std::max(5 * most / stiffer, 1e-6)) << stiffer;
  }
}

}  // namespace
}  // namespace rockfold
