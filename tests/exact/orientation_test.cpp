// Degrees as plane normals: mirror-image angles have mirror-image values, bit for bit.
#include "host/exact/orientation.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace rockfold {
namespace {

void expect_same(const SineCosine& found, Real sine, Real cosine, Real angle) {
  EXPECT_EQ(found.sine, sine) << angle << "°";
  EXPECT_EQ(found.cosine, cosine) << angle << "°";
}

TEST(SineCosine, OfMultiplesOfThirtyAndFortyFiveDegreesAreTheirClosedForms) {
  const Real r2 = std::sqrt(0.5), r3 = std::sqrt(0.75);
  const Real table[][3] = {{0, 0, 1},     {30, 0.5, r3},    {45, r2, r2},    {60, r3, 0.5},
                           {90, 1, 0},    {120, r3, -0.5},  {135, r2, -r2},  {150, 0.5, -r3},
                           {180, 0, -1},  {210, -0.5, -r3}, {225, -r2, -r2}, {240, -r3, -0.5},
                           {270, -1, 0},  {300, -r3, 0.5},  {315, -r2, r2},  {330, -0.5, r3},
                           {360, 0, 1},   {-30, -0.5, r3},  {-90, -1, 0},    {-45, -r2, r2},
                           {405, r2, r2}, {720, 0, 1},      {-3600, 0, 1},   {810, 1, 0}};
  for (const auto& [angle, sine, cosine] : table)
    expect_same(sine_cosine_degrees(angle), sine, cosine, angle);
}

// Angles of 1/64° are exact in double, and so are their sums: every mirror image of a is itself an exact angle.
TEST(SineCosine, OfMirrorImageAnglesAreMirrorImages) {
  for (int i = 0; i <= 45 * 64; ++i) {
    const Real a = i / 64.0;
    const auto [s, c] = sine_cosine_degrees(a);
    expect_same(sine_cosine_degrees(90 - a), c, s, 90 - a);
    expect_same(sine_cosine_degrees(90 + a), c, -s, 90 + a);
    expect_same(sine_cosine_degrees(180 - a), s, -c, 180 - a);
    expect_same(sine_cosine_degrees(180 + a), -s, -c, 180 + a);
    expect_same(sine_cosine_degrees(270 - a), -c, -s, 270 - a);
    expect_same(sine_cosine_degrees(270 + a), -c, s, 270 + a);
    expect_same(sine_cosine_degrees(360 - a), -s, c, 360 - a);
    expect_same(sine_cosine_degrees(360 + a), s, c, 360 + a);
    expect_same(sine_cosine_degrees(-a), -s, c, -a);
  }
}

// The reduction to an octant is exact for angles that are not negative; then the angle in radians is rounded twice (ε of at
// most π/4) and the function once. A negative angle is first added to 360°, which rounds at 3e-14° = 5e-16.
TEST(SineCosine, AreAccurate) {
  for (int i = -7200; i <= 7200; ++i) {
    const Real a = i * 0.1 + 0.0123;
    const long double radians = a * (std::numbers::pi_v<long double> / 180);
    const auto [s, c] = sine_cosine_degrees(a);
    EXPECT_NEAR(s, std::sin(radians), a < 0 ? 8e-16 : 3e-16) << a;
    EXPECT_NEAR(c, std::cos(radians), a < 0 ? 8e-16 : 3e-16) << a;
  }
}

TEST(SineCosine, OfAngleJustBelowZeroAreThoseOfZero) {
  const auto [s, c] = sine_cosine_degrees(-1e-300);
  EXPECT_NEAR(s, 0, 1e-17);
  EXPECT_EQ(c, 1);
}

TEST(UpwardNormal, OfDipNinetyDipDirection135IsExactlyXEqualsY) {
  const Vec3 n = upward_normal({90, 135});
  EXPECT_EQ(n[0], -n[1]);
  EXPECT_EQ(n[2], 0);
}

TEST(UpwardNormal, OfAHorizontalPlaneIsVerticalForAnyDipDirection) {
  for (const Real dip_direction : {0.0, 33.3, 90.0, 359.0}) {
    const Vec3 n = upward_normal({0, dip_direction});
    EXPECT_EQ(n[0], 0);
    EXPECT_EQ(n[1], 0);
    EXPECT_EQ(n[2], 1);
  }
}

// Dip 60 towards the east: the normal leans east.
TEST(UpwardNormal, LeansTowardsTheDipDirection) {
  const Vec3 n = upward_normal({60, 90});
  EXPECT_EQ(n[0], std::sqrt(0.75));
  EXPECT_EQ(n[1], 0);
  EXPECT_EQ(n[2], 0.5);
  const Vec3 tilted = upward_normal({37, 200});
  const Real d = std::numbers::pi / 180;
  EXPECT_NEAR(tilted[0], std::sin(37 * d) * std::sin(200 * d), 1e-15);
  EXPECT_NEAR(tilted[1], std::sin(37 * d) * std::cos(200 * d), 1e-15);
  EXPECT_NEAR(tilted[2], std::cos(37 * d), 1e-15);
}

TEST(NormalOf, AGivenNormalIsTakenAsItIs) {
  const Vec3 given{1e-30, -4, 7e30};
  EXPECT_EQ(normal_of(Orientation{given}), given);
}

}  // namespace
}  // namespace rockfold
