#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

#include "kernels/constraints/anderson.hpp"
#include "kernels/constraints/merge_points.hpp"

namespace rockfold::solve {
namespace {

/// f(x) = c − S x with eigenvalues of S from 0.01 to 1: plain steps shrink the slowest part by 0.99 each.
std::vector<Real> slow_change(const std::vector<Real>& x, Real c) {
  std::vector<Real> f(x.size());
  for (std::size_t i = 0; i < f.size(); ++i)
    f[i] = c * (1 + 0.3 * i) - std::pow(0.01, Real(i) / (x.size() - 1)) * x[i];
  return f;
}

Real size(const std::vector<Real>& f) {
  Real sum = 0;
  for (Real v : f) sum += v * v;
  return std::sqrt(sum);
}

TEST(Anderson, SolvesALinearSystemInAsManyStepsAsItHasUnknowns) {
  Anderson acceleration(10);
  std::vector<Real> x(8, 0.0);
  int steps = 0;
  for (; size(slow_change(x, 1)) >= 1e-10 && steps < 1000; ++steps)
    x = acceleration.next(x, slow_change(x, 1));
  EXPECT_LE(steps, 8 + 2);
}

TEST(Anderson, RemembersTheSlopeForANewRightHandSideAndTellsItToAnother) {
  Anderson learned(10), told(10);
  std::vector<Real> x(8, 0.0);
  for (int steps = 0; steps < 12; ++steps) x = learned.next(x, slow_change(x, 1));
  told.learn(learned.knowledge(), 8);
  learned.begin_again();
  for (Anderson* acceleration : {&learned, &told}) {
    x.assign(8, 0.0);
    for (int steps = 0; steps < 3; ++steps) x = acceleration->next(x, slow_change(x, -3.7));
    EXPECT_LT(size(slow_change(x, -3.7)), 1e-10);
  }
  told.forget();
  x.assign(8, 0.0);
  for (int steps = 0; steps < 3; ++steps) x = told.next(x, slow_change(x, -3.7));
  EXPECT_GT(size(slow_change(x, -3.7)), 1e-10);
  EXPECT_THROW(told.learn({1, 2, 3}, 8), std::invalid_argument);
}

TEST(MergePoints, AddsUpPointsThatSayTheSame) {
  FixedPoints given;
  given.points.element = {4, 7, 9};
  // The middle of the edge between covers 2 and 5, seen from two tetrahedra; and another point.
  given.points.local.resize(3);
  given.points.begin = {0, 4, 8, 12};
  given.points.unknown = {2, 5, 8, 9, 11, 5, 3, 2, 2, 5, 8, 9};
  given.points.weight = {0.5, 0.5, 1e-17, 0, 0, 0.5 - 1e-16, 0, 0.5, 0.25, 0.25, 0.25, 0.25};
  given.component = {{1, 0, 1}, {1, 0, 1}, {1, 0, 1}};
  given.value = {{1, 2, 3}, {1, 2, 3}, {1, 2, 3}};
  given.stiffness = {100, 300, 50};
  given.enforce = {Enforce::augmented, Enforce::augmented, Enforce::augmented};
  MergedPoints merged = merge_points(given);
  ASSERT_EQ(merged.fixed.points.size(), 2u);
  EXPECT_EQ(merged.fixed.stiffness, (std::vector<Real>{400, 50}));
  EXPECT_EQ(merged.fixed.points.element, (std::vector<Index>{4, 9}));
  const auto shares = merged.shares.share_out({{8, 0, 4}, {1, 0, 1}});
  EXPECT_EQ(shares[0], (Vec3{2, 0, 1}));
  EXPECT_EQ(shares[1], (Vec3{6, 0, 3}));
  EXPECT_EQ(shares[2], (Vec3{1, 0, 1}));

  given.component[1] = {1, 1, 1};  // what says more is a point of its own
  EXPECT_EQ(merge_points(given).fixed.points.size(), 3u);
}

}  // namespace
}  // namespace rockfold::solve
