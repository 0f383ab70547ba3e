// Polygons that are right, wherever they are and however they are turned. Wrong ones: wrong_models_test.cpp.
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

TEST(PlanarPolygon, MayBeAnyConvexPolygonAnywhere) {
  for (const int corners : {3, 4, 5, 16, 100})
    for (const Real radius : {1e-3, 1.0, 1e4})
      for (const Vec3& centre : {Vec3{}, Vec3{1, 2, 3}, Vec3{500, 5000, -300}}) {
        auto points = polygon(corners, radius, centre);
        EXPECT_EQ(polygon_problem(points), "") << corners << " corners, radius " << radius;
        std::reverse(points.begin(), points.end());
        EXPECT_EQ(polygon_problem(points), "")
            << corners << " corners, radius " << radius << ", reversed";
        EXPECT_TRUE(leaves_plane(points, {0, 0, 1}));
      }
}

TEST(PlanarPolygon, IsNotLeftAlongIt) {
  const auto points = polygon(7, 3, {});
  EXPECT_FALSE(leaves_plane(points, points[2] - points[5]));
  EXPECT_TRUE(leaves_plane(points, {1, 0, 0}));
}

TEST(PlanarPolygon, MayLieAtMapCoordinates) {
  EXPECT_EQ(polygon_problem(polygon(6, 1, {5e6, 4e6, 300})), "");
}

TEST(PlanarPolygon, MayBeConcave) {
  auto points = polygon(8, 2, {1, 2, 3});
  EXPECT_TRUE(is_convex(points));
  points[3] = 0.5 * (points[3] + Vec3{1, 2, 3});
  EXPECT_EQ(polygon_problem(points), "");
  EXPECT_FALSE(is_convex(points));
  std::reverse(points.begin(), points.end());
  EXPECT_EQ(polygon_problem(points), "");
  EXPECT_FALSE(is_convex(points));
}

/// Teeth side by side, whose edges overlap in each direction but meet nowhere.
std::vector<Vec3> comb(int teeth) {
  std::vector<Vec3> points{{2.0 * teeth - 1, -1, 5}, {0, -1, 5}};
  for (int i = 0; i < teeth; ++i) {
    points.push_back({2.0 * i, 100, 5});
    points.push_back({2.0 * i + 1, 100, 5});
    if (i + 1 < teeth) points.push_back({2.0 * i + 1, 0, 5}), points.push_back({2.0 * i + 2, 0, 5});
  }
  return points;
}

TEST(PlanarPolygon, MayHaveAThousandTeeth) {
  EXPECT_EQ(polygon_problem(comb(1000)), "");
  EXPECT_EQ(doubled_area(comb(3))[0], 0);
  EXPECT_EQ(doubled_area(comb(3))[2], -2 * (3 * 100 + 5.0));
}

TEST(PlanarPolygon, NamesTheEdgesOfALongOneThatTouch) {
  auto points = comb(1000);
  points[4 * 400 + 2][1] = -1;  // the tip of a gap reaches the base edge
  EXPECT_NE(polygon_problem(points).find("the one from point 1 to 2 and the one from point"),
            std::string::npos)
      << polygon_problem(points);
}

TEST(PlanarPolygon, HasAFewThousandPointsAtMost) {
  EXPECT_EQ(polygon_problem(polygon(10000, 1, {})), "");
  EXPECT_EQ(polygon_problem(polygon(10001, 1, {})), "has 10001 points, must have 3 to 10000");
}

TEST(PlanarPolygon, TouchesNoEdgeThatItPassesAtAMillionthOfItsSize) {
  for (const Real gap : {1e-6, 1e-12}) {
    const std::vector<Vec3> points{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {2, gap, 0}, {0, 4, 0}};
    EXPECT_EQ(polygon_problem(points).empty(), gap == 1e-6) << polygon_problem(points);
  }
}

TEST(ProjectedPolygon, MayLieOffItsPlane) {
  const Vec3 normal = normalized(Vec3{1, 2, 3});
  auto points = polygon(7, 10, {500, 20, 3});
  for (std::size_t i = 0; i < points.size(); ++i)
    points[i] += (0.3 * static_cast<Real>(i * i)) * normal;
  EXPECT_NE(polygon_problem(points), "");
  EXPECT_EQ(projected_polygon_problem(points, normal), "");
}

TEST(ProjectedPolygon, IsRefusedWhereItsProjectionIsNone) {
  const std::vector<Vec3> upright{{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}};
  EXPECT_EQ(polygon_problem(upright), "");
  EXPECT_EQ(projected_polygon_problem(upright, {0, 1, 0}), "");
  EXPECT_NE(projected_polygon_problem(upright, {0, 0, 1}).find("no area on the joint's plane"),
            std::string::npos);
  const std::vector<Vec3> line{{0, 0, 0}, {0, 0, 1}, {0, 0, 3}};
  EXPECT_NE(projected_polygon_problem(line, {0, 0, 1}).find("line along the joint's normal"),
            std::string::npos);
  // Seen from above its edges cross, on its own spatial surface they do not.
  const std::vector<Vec3> twisted{{0, 0, 0}, {3, 3, 1}, {3, 0, 2}, {0, 2, 3}};
  EXPECT_NE(projected_polygon_problem(twisted, {0, 0, 1}).find("cross"), std::string::npos);
}

}  // namespace
}  // namespace rockfold
