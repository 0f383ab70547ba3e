#include "src/system/merge_points.hpp"

#include <gtest/gtest.h>

namespace rockfold::solve {
namespace {

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
  given.enforce = {Enforce::held, Enforce::held, Enforce::held};
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
