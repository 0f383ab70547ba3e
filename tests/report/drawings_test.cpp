// Stereonets: projections and joint pyramids.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "src/base/vector.hpp"
#include "src/report/drawings/joint_pyramids.hpp"
#include "src/report/drawings/projection.hpp"

namespace rockfold {
namespace {

constexpr Real degree = std::numbers::pi / 180;

Vec3 upward(Real dip, Real dip_direction) {
  return {std::sin(dip * degree) * std::sin(dip_direction * degree),
          std::sin(dip * degree) * std::cos(dip_direction * degree), std::cos(dip * degree)};
}

TEST(Projection, KeepsAnglesOrAreas) {
  for (const bool upper : {false, true})
    for (const Real tilt : {0.0, 25.0, 60.0, 90.0}) {
      const Real z = upper ? std::cos(tilt * degree) : -std::cos(tilt * degree);
      const Vec3 east{std::sin(tilt * degree), 0, z};
      const Point2 angle = Projection{{100, 100}, 80, upper, false}.of(east);
      EXPECT_NEAR(angle[0] - 100, 80 * std::tan(tilt / 2 * degree), 1e-12);
      EXPECT_NEAR(angle[1], 100, 1e-12);
      const Point2 area = Projection{{100, 100}, 80, upper, true}.of(east);
      EXPECT_NEAR(area[0] - 100, 80 * std::sqrt(2) * std::sin(tilt / 2 * degree), 1e-12);
      const Point2 north = Projection{{100, 100}, 80, upper, true}.of({0, east[0], z});
      EXPECT_LE(north[1], 100);  // up on the page
    }
}

TEST(Projection, DrawsGreatCirclesThroughTheDipLineOfTheLowerHemisphere) {
  const Projection net{{0, 0}, 1, false, true};
  const auto arc = net.great_circle(upward(40, 90));
  const Point2 dip = net.of({std::cos(40 * degree), 0, -std::sin(40 * degree)});
  Real nearest = 1;
  for (const Point2& p : arc) nearest = std::min(nearest, std::hypot(p[0] - dip[0], p[1] - dip[1]));
  EXPECT_LT(nearest, 1e-9);
  EXPECT_NEAR(std::hypot(arc.front()[0], arc.front()[1]), 1, 1e-9);
  EXPECT_NEAR(std::hypot(arc.back()[0], arc.back()[1]), 1, 1e-9);
}

std::vector<std::string> removable_codes(const std::vector<PyramidRegion>& regions) {
  std::vector<std::string> codes;
  for (const auto& region : regions)
    if (region.removable) codes.push_back(region.code);
  return codes;
}

// Case E2: 60/030 60/150 60/270.
TEST(JointPyramids, OfThreeJointsAreRemovableWherePublished) {
  const std::vector<Vec3> joints{upward(60, 30), upward(60, 150), upward(60, 270)};
  const auto from = [&](const Vec3& into_opening) {
    return removable_codes(joint_pyramid_regions(joints, {into_opening}, {}));
  };
  EXPECT_EQ(from({0, 0, -1}), std::vector<std::string>{"111"});
  EXPECT_EQ(from({0, 0, 1}), std::vector<std::string>{"000"});
  EXPECT_EQ(from(upward(60, 180)), std::vector<std::string>{"100"});
  const Vec3 axis{std::sin(20 * degree) * std::cos(10 * degree),
                  std::cos(20 * degree) * std::cos(10 * degree), -std::sin(10 * degree)};
  const auto tunnel = removable_codes(joint_pyramid_regions(joints, {}, axis));
  EXPECT_EQ(tunnel.size(), 6u);
  EXPECT_EQ(std::count(tunnel.begin(), tunnel.end(), "011"), 0);
  EXPECT_EQ(std::count(tunnel.begin(), tunnel.end(), "100"), 0);
}

// Case E1: n² − n + 2 are not empty, (n − 1)(n − 2)/2 removable under one plane, n² − n in a tunnel.
TEST(JointPyramids, OfAnyJointsAreAsManyAsCounted) {
  std::mt19937 random(3);
  std::normal_distribution<Real> any;
  for (std::size_t n = 3; n <= 6; ++n)
    for (int trial = 0; trial < 5; ++trial) {
      std::vector<Vec3> joints;
      for (std::size_t i = 0; i < n; ++i) {
        const Vec3 normal = normalized({any(random), any(random), any(random)});
        joints.push_back(normal[2] < 0 ? -normal : normal);
      }
      const Vec3 other = normalized({any(random), any(random), any(random)});
      const auto under_plane = joint_pyramid_regions(joints, {other}, {});
      EXPECT_EQ(under_plane.size(), n * n - n + 2);
      EXPECT_EQ(removable_codes(under_plane).size(), (n - 1) * (n - 2) / 2);
      EXPECT_EQ(removable_codes(joint_pyramid_regions(joints, {}, other)).size(), n * n - n);
      for (const PyramidRegion& region : under_plane)
        for (std::size_t i = 0; i < n; ++i) {
          const Real sign = region.code[i] == '0' ? 1 : -1;
          EXPECT_GT(sign * dot(joints[i], region.middle), 0);
          for (const Vec3& u : region.boundary) EXPECT_GT(sign * dot(joints[i], u), -1e-6);
        }
    }
}

TEST(Svg, EscapesTextsAndRoundsNumbers) {
  Svg svg(10, 10);
  svg.text({0, -0.001}, "a < b & c\n");
  svg.line({1.0 / 3, 1}, {2.5, 100}, {});
  const std::string text = svg.document("T & U");
  EXPECT_NE(text.find("a &lt; b &amp; c "), std::string::npos);
  EXPECT_NE(text.find("<title>T &amp; U</title>"), std::string::npos);
  EXPECT_NE(text.find("M0.33 1L2.5 100"), std::string::npos);
  EXPECT_NE(text.find("y=\"0\""), std::string::npos);
}

}  // namespace
}  // namespace rockfold
