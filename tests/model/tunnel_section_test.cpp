// Sections of tunnels: their outline, exact symmetry, and area.
#include "src/model/tunnel_section.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "src/model/planar_polygon.hpp"

namespace rockfold {
namespace {

Real area(const Section& section) {
  Real sum = 0;
  for (std::size_t i = 0; i < section.size(); ++i) {
    const auto& a = section[i];
    const auto& b = section[(i + 1) % section.size()];
    sum += (a[0] * b[1] - a[1] * b[0]) / 2;
  }
  return sum;
}

/// To the last bit; the points go bottom right, up, over and down to bottom left.
void expect_mirrored(const Section& section) {
  for (std::size_t i = 0; i < section.size(); ++i) {
    const auto& mirror = section[section.size() - 1 - i];
    EXPECT_EQ(section[i][0], -mirror[0]) << i;
    EXPECT_EQ(section[i][1], mirror[1]) << i;
  }
}

void expect_simple(const Section& section) {
  std::vector<Vec3> points;
  for (const auto& [x, y] : section) points.push_back({x, y, 0});
  EXPECT_EQ(polygon_problem(points), "");
  EXPECT_GT(area(section), 0);
}

TEST(CircleSection, IsARegularPolygonOnAFlatEdge) {
  for (const Index n : {3, 4, 5, 6, 7, 8, 12, 24, 25, 1000}) {
    const auto section = circle_section(1.75, n);
    ASSERT_EQ(section.size(), static_cast<std::size_t>(n));
    expect_mirrored(section);
    expect_simple(section);
    for (const auto& [x, y] : section) EXPECT_NEAR(std::hypot(x, y), 1.75, 1e-15);
    EXPECT_EQ(section.front()[1], section.back()[1]);
    const Real exact = n * 1.75 * 1.75 * std::sin(2 * std::numbers::pi / n) / 2;
    EXPECT_NEAR(area(section), exact, 1e-14 * n);  // n rounded terms of size 1 and less
  }
}

TEST(CircleSection, MirrorsInBothDiagonalsToo) {
  const auto section = circle_section(2.1, 24);
  for (const auto& [x, y] : section) {
    const auto has = [&](Real u, Real v) {
      return std::count(section.begin(), section.end(), std::array<Real, 2>{u, v}) == 1;
    };
    EXPECT_TRUE(has(x, -y) && has(-x, y) && has(y, x));
  }
}

TEST(RectangleSection, StandsOnThePath) {
  EXPECT_EQ(rectangle_section(3, 2), (Section{{1.5, 0}, {1.5, 2}, {-1.5, 2}, {-1.5, 0}}));
}

TEST(DShapeSection, HasWallsAndHalfACircle) {
  for (const Index n : {3, 4, 8, 24, 25}) {
    const auto section = d_shape_section(4, 3.5, n);
    ASSERT_EQ(section.size(), static_cast<std::size_t>(n) + 3);
    expect_mirrored(section);
    expect_simple(section);
    EXPECT_EQ(section[0], (std::array<Real, 2>{2, 0}));
    EXPECT_EQ(section[1], (std::array<Real, 2>{2, 1.5}));
    EXPECT_NEAR(area(section), 4 * 1.5 + n * 4 * std::sin(std::numbers::pi / n) / 2, 1e-13);
  }
  const auto low = d_shape_section(4, 2, 24);  // the roof stands on the floor
  EXPECT_EQ(low.size(), 25u);
  expect_simple(low);
  EXPECT_EQ(low[12], (std::array<Real, 2>{0, 2}));
}

TEST(HorseshoeSection, NarrowsTowardsItsFloor) {
  for (const Index n : {3, 8, 24, 240}) {
    const auto section = horseshoe_section(4, 4, n);
    expect_mirrored(section);
    expect_simple(section);
    EXPECT_EQ(section.front()[1], 0);
    // The wall's circle about the opposite springing point (−2, 2) meets the floor here.
    EXPECT_NEAR(section.front()[0], std::sqrt(16 - 4) - 2, 1e-15);
    for (const auto& [x, y] : section) {
      const Real reach = y > 2 ? std::hypot(x, y - 2) - 2 : std::hypot(std::abs(x) + 2, y - 2) - 4;
      EXPECT_NEAR(reach, 0, 1e-14);
    }
  }
}

TEST(HorseshoeSection, KeepsTheAreaOfItsArcs) {
  // Under the springing line: x from 0 to √(w² − d²) − w/2, integrated over the depth d to w/2.
  const Real w = 4, h = w / 2;
  const Real half = (h * std::sqrt(w * w - h * h) + w * w * std::asin(h / w)) / 2 - w / 2 * h;
  const Real exact = 2 * half + std::numbers::pi * w * w / 8;
  EXPECT_NEAR(area(horseshoe_section(w, w, 1000)), exact, 1e-5 * exact);
  EXPECT_LT(area(horseshoe_section(w, w, 24)), exact);
  EXPECT_GT(area(horseshoe_section(w, w, 24)), 0.99 * exact);
}

TEST(HorseshoeSection, WithoutWallsIsHalfACircle) {
  EXPECT_EQ(horseshoe_section(4, 2, 24), d_shape_section(4, 2, 24));
}

}  // namespace
}  // namespace rockfold
