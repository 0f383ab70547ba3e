// Bases of prisms that are right, wherever they are and however they are turned. Wrong ones: wrong_models_test.cpp.
#include "src/model/planar_polygon.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "src/base/vector.hpp"

namespace rockfold {
namespace {

/// A regular polygon on a plane along no axis.
std::vector<Vec3> polygon(int corners, Real radius, const Vec3& centre) {
  const Vec3 u = normalized(Vec3{2, -1, 3}), v = normalized(cross(u, Vec3{1, 1, 5}));
  std::vector<Vec3> points;
  for (int i = 0; i < corners; ++i) {
    const Real angle = 2 * std::numbers::pi * i / corners + 0.1;
    points.push_back(centre + (radius * std::cos(angle)) * u + (radius * std::sin(angle)) * v);
  }
  return points;
}

TEST(PrismBase, MayBeAnyConvexPolygonAnywhere) {
  for (const int corners : {3, 4, 5, 16, 100})
    for (const Real radius : {1e-3, 1.0, 1e4})
      for (const Vec3& centre : {Vec3{}, Vec3{1, 2, 3}, Vec3{500, 5000, -300}}) {
        auto points = polygon(corners, radius, centre);
        EXPECT_EQ(base_problem(points), "") << corners << " corners, radius " << radius;
        std::reverse(points.begin(), points.end());
        EXPECT_EQ(base_problem(points), "")
            << corners << " corners, radius " << radius << ", reversed";
        EXPECT_TRUE(leaves_plane(points, {0, 0, 1}));
      }
}

TEST(PrismBase, IsNotLeftAlongIt) {
  const auto points = polygon(7, 3, {});
  EXPECT_FALSE(leaves_plane(points, points[2] - points[5]));
  EXPECT_TRUE(leaves_plane(points, {1, 0, 0}));
}

TEST(PrismBase, MayLieAtMapCoordinates) {
  EXPECT_EQ(base_problem(polygon(6, 1, {5e6, 4e6, 300})), "");
}

TEST(PrismBase, IsNotConvexWithADent) {
  auto points = polygon(8, 2, {1, 2, 3});
  points[3] = 0.5 * (points[3] + Vec3{1, 2, 3});
  EXPECT_NE(base_problem(points).find("concave"), std::string::npos);
}

}  // namespace
}  // namespace rockfold
