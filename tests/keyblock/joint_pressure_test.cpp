// Water in joints that drain, against closed forms: planes, tension cracks, wedges, dams, roofs; and what any outline must give.
#include "host/keyblock/water/joint_pressure.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "host/keyblock/water/water.hpp"
#include "src/base/vector.hpp"
#include "tests/keyblock/models/half_space_block.hpp"

namespace rockfold {
namespace {

using test::radians;

constexpr Real g = 9.81, gamma_w = 1000 * g;
const Vec3 gravity{0, 0, -g};

Water with_head(Real head, WaterLaw law = WaterLaw::mid_height) {
  Water water;
  water.level = WaterHead{head};
  water.law = law;
  return water;
}

/// Whether the edge from corner i drains, in the order of the corners; corners drain at ends of such edges.
DrainedLoop outline(const std::vector<Vec3>& corners, const std::vector<bool>& edges) {
  DrainedLoop loop;
  const std::size_t n = corners.size();
  for (std::size_t i = 0; i < n; ++i)
    loop.push_back({.at = corners[i],
                    .share = edges[i] || edges[(i + n - 1) % n] ? 1.0 : 0.0,
                    .edge_share = edges[i] ? 1.0 : 0.0});
  return loop;
}

Vec3 normal_of(const DrainedLoop& loop) {
  return normalized(cross(loop[1].at - loop[0].at, loop[2].at - loop[0].at));
}

Real area_of(const DrainedLoop& loop) {
  Vec3 twice{};
  for (std::size_t i = 2; i < loop.size(); ++i)
    twice += cross(loop[i - 1].at - loop[0].at, loop[i].at - loop[0].at);
  return norm(twice) / 2;
}

PressureForce push(const Water& water, const DrainedLoop& loop, const Vec3& normal) {
  std::vector<Vec3> corners;
  for (const DrainedCorner& corner : loop) corners.push_back(corner.at);
  return least_pressure_force({corners}, normal, joint_pressures(water, gravity, {loop, normal}));
}

PressureForce push(const Water& water, const DrainedLoop& loop) {
  return push(water, loop, normal_of(loop));
}

Real force(const Water& water, const DrainedLoop& loop) {
  return push(water, loop).force;
}

/// A plane of 3 m along its strike that dips to +x from z = low + height to low; it daylights below, and above if `daylights_above`.
/// Off the origin, on no axis.
DrainedLoop sliding_plane(Real dip, Real low, Real height, bool daylights_above) {
  const Vec3 toe{17, -6, low}, up{-height / std::tan(radians(dip)), 0, height}, along{0, 3, 0};
  return outline({toe, toe + along, toe + along + up, toe + up},
                 {true, false, daylights_above, false});
}

// Hoek & Bray (1981), Wyllie & Mah (2004): a slope of 30 m whose crack of 12 m holds z_w of water.
TEST(TensionCrack, PushesWithItsWaterAndLiftsByATriangleOnThePlaneBelow) {
  constexpr Real dip = 35, foot = 18;
  for (const Real z : {3.0, 7.0, 12.0}) {
    const Water water = with_head(foot + z, WaterLaw::drained);
    const DrainedLoop plane = sliding_plane(dip, 0, foot, false);
    const DrainedLoop crack = outline({{-4, 0, foot}, {-4, 3, foot}, {-4, 3, 30}, {-4, 0, 30}},
                                      {false, false, true, false});
    EXPECT_NEAR(force(water, crack), 0.5 * gamma_w * z * z * 3, 1e-9 * gamma_w) << z;
    const PressureForce uplift = push(water, plane);
    const Real length = foot / std::sin(radians(dip));
    EXPECT_NEAR(uplift.force, 0.5 * gamma_w * z * length * 3, 1e-9 * uplift.force) << z;
    // It acts a third of the way down from the crack's foot.
    EXPECT_NEAR(uplift.first_moment[2] / uplift.force, foot * 2 / 3, 1e-9) << z;
  }
}

TEST(TensionCrack, WithoutWaterAboveItsFootLeavesThePlaneDry) {
  EXPECT_EQ(force(with_head(10, WaterLaw::drained), sliding_plane(35, 0, 18, false)), 0);
}

// RocPlane's and Hoek & Bray's plane without a crack: a tent with its peak of γ H/2 at mid-height.
TEST(PlaneThatDaylightsAtBothEnds, CarriesAQuarterOfItsHead) {
  for (const Real dip : {20.0, 35.0, 70.0})
    for (const WaterLaw law : {WaterLaw::mid_height, WaterLaw::drained}) {
      const PressureForce u = push(with_head(9, law), sliding_plane(dip, -3, 12, true));
      const Real closed = 0.25 * gamma_w * 12 * 12 / std::sin(radians(dip)) * 3;
      EXPECT_NEAR(u.force, closed, 1e-9 * closed);
      EXPECT_NEAR(u.first_moment[2] / u.force, 3, 1e-9);  // mid-height
    }
}

TEST(PlaneThatDaylightsAtBothEnds, FilledInPartCarriesAQuarterOfItsWetHead) {
  const Real closed = 0.25 * gamma_w * 7 * 7 / std::sin(radians(35)) * 3;
  EXPECT_NEAR(force(with_head(4), sliding_plane(35, -3, 12, true)), closed, 1e-9 * closed);
}

// At mid-height below a crack: the tent's lower half, then hydrostatic up to γ z at the crack's foot.
TEST(MidHeight, BelowATensionCrackIsHydrostaticFromTheMiddleUp) {
  constexpr Real level = 20, foot = 15, z = level - foot, half = level / 2;
  const Real closed =
      gamma_w / std::sin(radians(35)) * 3 * (0.5 * half * half + 0.5 * (half + z) * (half - z));
  EXPECT_NEAR(force(with_head(level), sliding_plane(35, 0, foot, false)), closed, 1e-9 * closed);
}

TEST(MidHeight, OfAPlaneThatEndsInTheRockBelowMidHeightIsATriangle) {
  const Real closed = 0.5 * gamma_w * (20 - 8) * 8 / std::sin(radians(35)) * 3;
  EXPECT_NEAR(force(with_head(20), sliding_plane(35, 0, 8, false)), closed, 1e-9 * closed);
}

// Hoek & Bray's wedge: toe B, crest C, and T where the line of intersection meets the ground: γ H/6 in the mean.
TEST(Wedge, HasAPyramidOfPressureOnEachPlane) {
  const Vec3 b{3, -2, 5}, c{14, 9, 31}, t{-21, 6, 37};
  const DrainedLoop plane = outline({b, c, t}, {true, true, false});
  for (const WaterLaw law : {WaterLaw::mid_height, WaterLaw::drained}) {
    const Real closed = gamma_w * (37 - 5) / 6 * area_of(plane);
    const PressureForce u = push(with_head(37, law), plane);
    EXPECT_NEAR(u.force, closed, 1e-9 * closed);
    // A pyramid's load acts three quarters of the way from the far corner to the apex of each half: (2 M + B + C + 2 C …)/8.
    const Vec3 m = 0.5 * (b + t);
    const Vec3 centre = 0.5 * (0.25 * (b + c) + 0.5 * m) + 0.5 * (0.25 * (t + c) + 0.5 * m);
    EXPECT_NEAR(norm((1 / u.force) * u.first_moment - centre), 0, 1e-9);
  }
}

// Hoek & Bray (1981), wedge with a crack full of water: γ z/3 in the mean on both planes and in the crack.
TEST(Wedge, WithATensionCrackHasItsPeakAtTheCracksFoot) {
  const Vec3 b{3, -2, 5}, c{14, 9, 31}, foot{-9, 2, 21};
  const Vec3 normal = normalized(cross(c - b, foot - b));
  Vec3 top{-6, 8, 0};
  top[2] = b[2] - (normal[0] * (top[0] - b[0]) + normal[1] * (top[1] - b[1])) / normal[2];
  const DrainedLoop plane = outline({b, c, top, foot}, {true, true, false, false});
  const Real level = foot[2] + 10;
  const Real closed = gamma_w * 10 / 3 * area_of(plane);
  ASSERT_LT(top[2], level + 20);
  EXPECT_NEAR(force(with_head(level + 20, WaterLaw::drained), plane), 3 * closed, 1e-6 * closed);
  const DrainedLoop crack =
      outline({foot, {-12, -9, level}, {-6, 11, level}}, {false, true, false});
  const Real in_crack = gamma_w * 10 / 3 * area_of(crack);
  EXPECT_NEAR(force(with_head(level, WaterLaw::drained), crack), in_crack, 1e-9 * in_crack);
}

// Uplift on a dam's base: γ h before it, the tail water's pressure behind it, straight between.
TEST(DamBase, IsLiftedByATrapezium) {
  DrainedLoop base =
      outline({{0, 0, 2}, {0, 15, 2}, {24, 15, 2}, {24, 0, 2}}, {false, false, true, false});
  const Water water = with_head(32);
  EXPECT_NEAR(force(water, base), 0.5 * gamma_w * 30 * 24 * 15, 1e-3);
  base[2].pond = base[3].pond = gamma_w * 6;
  EXPECT_NEAR(force(water, base), 0.5 * gamma_w * (30 + 6) * 24 * 15, 1e-3);
  base[2].pond = base[3].pond = gamma_w * 30;  // ponds at one level: buoyancy
  EXPECT_NEAR(force(water, base), gamma_w * 30 * 24 * 15, 1e-3);
}

// A face of a roof wedge: its apex in the rock, its edge in the roof.
TEST(RoofBlock, IsPressedByElevationOrByAConeFromItsApex) {
  const DrainedLoop face = outline({{0, 0, 10}, {4, 1, 10}, {2, 2, 13}}, {true, false, false});
  const Real area = area_of(face), depth_of_centre = 25 - (10 + 10 + 13) / 3.0;
  EXPECT_NEAR(force(with_head(25, WaterLaw::hydrostatic), face), gamma_w * depth_of_centre * area,
              1e-6);
  EXPECT_NEAR(force(with_head(25), face), gamma_w * (25 - 13) / 3 * area, 1e-6);
}

// A plane that drains all round: a pyramid on its wet part's middle.
TEST(PlaneThatDrainsAllRound, HasItsPeakInTheMiddle) {
  const DrainedLoop plane =
      outline({{0, 0, 0}, {0, 8, 0}, {-6, 8, 6}, {-6, 0, 6}}, {true, true, true, true});
  const Real closed = gamma_w * 3 / 3 * area_of(plane);
  EXPECT_NEAR(force(with_head(6), plane), closed, 1e-9 * closed);
}

TEST(ConstantPressure, ThatDrainsIsThePeakOfATent) {
  Water water;
  water.level = WaterPressure{4e4};
  const DrainedLoop plane = sliding_plane(35, 0, 12, true);
  EXPECT_NEAR(force(water, plane), 4e4 * area_of(plane), 1e-6);  // it drains only when asked
  water.drains = true;
  EXPECT_NEAR(force(water, plane), 2e4 * area_of(plane), 1e-6);
}

TEST(WaterLaw, FollowsFromTheLevelUnlessItIsGiven) {
  Water water;
  water.level = WaterHead{3};
  EXPECT_EQ(law_of(water), WaterLaw::mid_height);
  water.drains = false;
  EXPECT_EQ(law_of(water), WaterLaw::hydrostatic);
  water.level = WaterPressure{3};
  water.drains = {};
  EXPECT_EQ(law_of(water), WaterLaw::hydrostatic);
  water.law = WaterLaw::drained;
  EXPECT_EQ(law_of(water), WaterLaw::drained);
}

/// A polygon of 3 to 8 corners on an ellipse in a plane of any attitude, some of its edges drained.
DrainedLoop random_outline(std::mt19937& random) {
  std::uniform_real_distribution<Real> unit(0, 1);
  const Vec3 normal = test::upward(90 * unit(random), 360 * unit(random));
  const Vec3 e = normalized(cross(normal, Vec3{0.3, 0.5, 0.7})), f = cross(normal, e);
  std::vector<Real> angles(3 + static_cast<std::size_t>(6 * unit(random)));
  for (Real& angle : angles) angle = 2 * std::numbers::pi * unit(random);
  std::sort(angles.begin(), angles.end());
  std::vector<Vec3> corners;
  std::vector<bool> edges;
  for (const Real angle : angles) {
    corners.push_back(Vec3{40, -30, 20} + (9 * std::cos(angle)) * e + (4 * std::sin(angle)) * f);
    edges.push_back(unit(random) < 0.5);
  }
  return outline(corners, edges);
}

/// p at a point, by its definition: the least of the planes.
Real pressure_at(const std::vector<LinearPressure>& pressures, const Vec3& x) {
  Real least = pressures[0].unclipped(x);
  for (const LinearPressure& p : pressures) least = std::min(least, p.unclipped(x));
  return std::max(0.0, least);
}

TEST(AnyOutline, IsZeroWhereItDrainsAndHydrostaticAtCornersInTheRock) {
  std::mt19937 random(5);
  for (int trial = 0; trial < 300; ++trial) {
    const DrainedLoop loop = random_outline(random);
    const Water water =
        with_head(18 + trial % 12, trial % 2 ? WaterLaw::drained : WaterLaw::mid_height);
    const auto pressures = joint_pressures(water, gravity, {loop, normal_of(loop)});
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vec3 &a = loop[i].at, &b = loop[(i + 1) % loop.size()].at;
      const Real full = std::max(0.0, pressures[0].unclipped(a));
      EXPECT_NEAR(pressure_at(pressures, a), loop[i].share > 0 ? 0 : full, 1e-6 * gamma_w) << trial;
      if (loop[i].edge_share > 0) {
        EXPECT_NEAR(pressure_at(pressures, 0.3 * a + 0.7 * b), 0, 1e-6 * gamma_w) << trial;
      }
    }
  }
}

TEST(AnyOutline, HasTheForceOfItsPressureSummedOverSmallTriangles) {
  std::mt19937 random(6);
  constexpr int n = 200;
  for (int trial = 0; trial < 20; ++trial) {
    const DrainedLoop loop = random_outline(random);
    const Water water = with_head(22);
    const auto pressures = joint_pressures(water, gravity, {loop, normal_of(loop)});
    Real sum = 0;
    for (std::size_t k = 2; k < loop.size(); ++k) {
      const Vec3 &a = loop[0].at, &b = loop[k - 1].at, &c = loop[k].at;
      const Real part = norm(cross(b - a, c - a)) / (2 * n * n);
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < 2 * i + 1; ++j) {
          const int column = j / 2;
          const Real s = (i + (j % 2 ? 1.0 : 2.0) / 3) / n,
                     t = (column + (j % 2 ? 2.0 : 1.0) / 3) / n;
          sum += part * pressure_at(pressures, a + s * (b - a) + t * (c - b));
        }
    }
    // The midpoint rule errs where p has its folds, on some 2 n of n² triangles by their size each: 1/n of 1/n.
    EXPECT_NEAR(push(water, loop).force, sum, 1e-3 * std::max(sum, 1.0)) << trial;
  }
}

TEST(AnyOutline, IsPressedNoLessAsWaterRises) {
  std::mt19937 random(7);
  for (int trial = 0; trial < 300; ++trial) {
    const DrainedLoop loop = random_outline(random);
    const WaterLaw law = trial % 2 ? WaterLaw::drained : WaterLaw::mid_height;
    Real before = 0;
    for (Real head = 8; head < 40; head += 0.5) {
      const Real now = force(with_head(head, law), loop);
      EXPECT_GE(now, before - 1e-6 * gamma_w) << trial << " at " << head;
      EXPECT_LE(now, force(with_head(head, WaterLaw::hydrostatic), loop) + 1e-6 * gamma_w);
      before = now;
    }
  }
}

// A corner that moves by δ changes the force by no more than some δ: ten times the hydrostatic pressure times the outline's length.
TEST(AnyOutline, IsPressedLittleOtherwiseWhenACornerMovesALittle) {
  std::mt19937 random(8);
  constexpr Real moved = 1e-6;
  for (int trial = 0; trial < 300; ++trial) {
    DrainedLoop loop = random_outline(random);
    const Water water = with_head(25);
    const Vec3 normal = normal_of(loop);
    const Real before = push(water, loop, normal).force;
    const Vec3 along = normalized(loop[1].at - loop[0].at);
    loop[trial % loop.size()].at += moved * along;
    const Real after = push(water, loop, normal).force;
    EXPECT_NEAR(after, before, 10 * moved * gamma_w * 20 * 60) << trial;
  }
}

}  // namespace
}  // namespace rockfold
