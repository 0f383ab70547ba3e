// Measured intensities against numbers that can be worked out by hand.
#include "tests/joints/intensity.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "host/joints/area_in_box.hpp"
#include "src/base/vector.hpp"

namespace rockfold::test {
namespace {

const Extent box{{0, 0, 0}, {4, 5, 2}};
const std::array<Vec3, 2> upwards{{{1, 1, -1}, {1, 1, 3}}};
const SamplingRectangle level{{0, 0, 1}, {4, 0, 0}, {0, 5, 0}};

FlatJoint joint_of(std::vector<Vec3> polygon) {
  const Vec3 normal = normalized(cross(polygon[1] - polygon[0], polygon[2] - polygon[0]));
  return {normal, dot(normal, polygon[0]), std::move(polygon)};
}

TEST(Intensities, OfOneLevelSquareInsideTheBox) {
  const auto measured = measure_intensities(
      {joint_of({{0.5, 0.5, 1.5}, {1.5, 0.5, 1.5}, {1.5, 1.5, 1.5}, {0.5, 1.5, 1.5}})}, box,
      upwards, level);
  EXPECT_EQ(measured.p10, 1.0 / 4);
  EXPECT_EQ(measured.p20, 0);  // parallel to the rectangle
  EXPECT_EQ(measured.p21, 0);
  EXPECT_EQ(measured.p30, 1.0 / 40);
  EXPECT_NEAR(measured.p32, 1.0 / 40, 1e-17);
}

TEST(Intensities, CountWhatLiesInTheRegionAlone) {
  // Upright, x = 3, from y = 4 to 8 and z = −1 to 3: 1 of 4 m of trace, 1 × 2 of 16 m², centre and midpoint outside.
  const FlatJoint upright = joint_of({{3, 4, -1}, {3, 8, -1}, {3, 8, 3}, {3, 4, 3}});
  const auto measured = measure_intensities({upright}, box, {{{0, 4.5, 0}, {4, 4.5, 0}}}, level);
  EXPECT_EQ(measured.p10, 1.0 / 4);
  EXPECT_EQ(measured.p20, 0);
  EXPECT_NEAR(measured.p21, 1.0 / 20, 1e-16);
  EXPECT_EQ(measured.p30, 0);
  EXPECT_NEAR(measured.p32, 2.0 / 40, 1e-16);
}

TEST(Intensities, OfAConcaveJointHaveATraceForEachOfItsArms) {
  // A U in x = 2: arms y 1…2 and 3…4, up to z = 2, joined below z = 0.5.
  const FlatJoint u = joint_of(
      {{2, 1, 0}, {2, 4, 0}, {2, 4, 2}, {2, 3, 2}, {2, 3, 0.5}, {2, 2, 0.5}, {2, 2, 2}, {2, 1, 2}});
  const auto measured = measure_intensities({u}, box, {{{0, 2.5, 1}, {4, 2.5, 1}}}, level);
  EXPECT_EQ(measured.p10, 0) << "the line passes between the arms";
  EXPECT_NEAR(measured.p20, 2.0 / 20, 1e-16);
  EXPECT_NEAR(measured.p21, 2.0 / 20, 1e-15);
  EXPECT_NEAR(measured.p32, (3 * 2 - 1.5) / 40, 1e-16);
  // Clipped by a box that cuts both arms off: they stay two.
  EXPECT_NEAR(area_in_box(u.polygon, {{0, 0, 1}, {4, 5, 1.5}}), 1, 1e-15);
}

TEST(Intensities, OfAThroughGoingJointAreItsSectionsWithTheRegion) {
  // x + y = 4, upright: the section runs from (4, 0) to (0, 4).
  const FlatJoint plane{normalized({1, 1, 0}), 4 / std::numbers::sqrt2, {}};
  const auto measured = measure_intensities({plane}, box, {{{0, 1, 1}, {4, 1, 1}}}, level);
  EXPECT_EQ(measured.p10, 1.0 / 4);
  EXPECT_EQ(measured.p20, 1.0 / 20);
  EXPECT_NEAR(measured.p21, 4 * std::numbers::sqrt2 / 20, 1e-15);
  EXPECT_EQ(measured.p30, 1.0 / 40);
  EXPECT_NEAR(measured.p32, 8 * std::numbers::sqrt2 / 40, 1e-15);
  const FlatJoint beside{plane.normal, 100, {}};
  const auto nothing = measure_intensities({beside}, box, upwards, level);
  EXPECT_EQ(nothing.p10 + nothing.p20 + nothing.p21 + nothing.p30 + nothing.p32, 0);
}

TEST(Crossings, OfTwoLinesEndToEndAreThoseOfTheWhole) {
  std::vector<FlatJoint> joints;
  for (int k = 0; k <= 4; ++k) joints.push_back({{0, 0, 1}, 0.5 * k, {}});
  const Vec3 a{1, 1, -0.5}, b{1, 1, 1}, c{1, 1, 2.5};  // b lies on a joint
  EXPECT_EQ(crossings(joints, a, c), 5);
  EXPECT_EQ(crossings(joints, a, b) + crossings(joints, b, c), 5);
  EXPECT_EQ(crossings(joints, c, b) + crossings(joints, b, a), 5);
}

}  // namespace
}  // namespace rockfold::test
