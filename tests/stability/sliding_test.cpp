#include "host/stability/sliding.hpp"

#include <gtest/gtest.h>

#include "host/stability/movement.hpp"
#include "src/base/vector.hpp"
#include "tests/stability/factors.hpp"
#include "tests/stability/planar_mass.hpp"

namespace rockfold {
namespace {

using test::bilinear_slope;
using test::block_on_plane;
using test::degree;
using test::PlanarMass;
using test::sliding_of;
using test::two_wedge_factor;

TEST(Sliding, OfABlockOnAPlaneIsTheRatioOfTheTangents) {
  for (const Real dip : {10.0, 30.0, 55.0}) {
    const Real expected = std::tan(35 * degree) / std::tan(dip * degree);
    EXPECT_NEAR(sliding_of(block_on_plane(dip * degree, std::tan(35 * degree))).factor, expected,
                1e-4 * expected)
        << dip;
  }
}

TEST(Sliding, CohesionAddsItsForce) {
  const Real weight = 4 * 25e3, dip = 40 * degree, cohesion = 12e3,
             friction = std::tan(20 * degree);
  const Real expected =
      (4 * cohesion + weight * std::cos(dip) * friction) / (weight * std::sin(dip));
  EXPECT_NEAR(sliding_of(block_on_plane(dip, friction, cohesion)).factor, expected,
              1e-3 * expected);
}

TEST(Sliding, OfABilinearSlopeIsThatOfTwoWedges) {
  for (const Real angle : {25.0, 35.0}) {
    const Real friction = std::tan(angle * degree), expected = two_wedge_factor(friction);
    EXPECT_NEAR(sliding_of(bilinear_slope(friction)).factor, expected, 1e-3 * expected) << angle;
  }
}

TEST(Sliding, TellsWhoPushesWhom) {
  const RigidMass mass = bilinear_slope(std::tan(25 * degree));
  const Sliding sliding = sliding_of(mass);
  const std::vector<MovingBlock> moving = moving_blocks(mass, sliding.mechanism, sliding.balance);
  ASSERT_EQ(moving.size(), 2U);
  const MovingBlock& toe = moving[moving[0].body == 0 ? 0 : 1];
  EXPECT_EQ(toe.pushed_by, std::vector<Index>{1});
  EXPECT_FALSE(toe.turns);
  EXPECT_NEAR(toe.velocity[2] / toe.velocity[0], -std::tan(15 * degree), 1e-6);
}

/// A wedge of 100 kN in a trough of two planes that dip by 45° to both sides and plunge by `plunge`.
RigidMass wedge(Real plunge, Real friction) {
  RigidMass mass;
  const Vec3 down{0, std::cos(plunge), -std::sin(plunge)},
      up{0, std::sin(plunge), std::cos(plunge)};
  mass.bodies.push_back({0, 2.0 * down + 0.6 * up, {0, 0, -100e3}, {}});
  for (const Real side : {1.0, -1.0}) {
    const Vec3 out = (1 / std::sqrt(2.0)) * (Vec3{side, 0, 0} + up);
    ContactArea area;
    area.body = {0, none};
    area.normal = (1 / std::sqrt(2.0)) * (Vec3{-side, 0, 0} + up);
    area.corner = {Vec3{}, 4.0 * down, 4.0 * down + out, out};
    area.friction = friction;
    area.joint = side > 0 ? "right" : "left";
    mass.contacts.push_back(area);
  }
  return mass;
}

// Two planes at right angles carry √2 of what one would: N₁ + N₂ = √2 W cos(plunge). Dilating slips would wedge it tighter.
TEST(Sliding, OfAWedgeIsThatOfBlockTheoryAndNotItsBound) {
  for (const Real plunge : {20 * degree, 35 * degree}) {
    const Real expected = std::sqrt(2.0) * 0.5 / std::tan(plunge);
    const RigidMass mass = wedge(plunge, 0.5);
    EXPECT_NEAR(sliding_of(mass).factor, expected, 1e-4 * expected);
    Progress silent;
    EXPECT_GT(find_bound(mass, silent).factor, 1.01 * expected);
  }
}

// Nothing presses it against the walls; forces that press enough would balance it at any friction, which is what its bound says.
TEST(Sliding, ABlockBetweenUprightWallsFalls) {
  PlanarMass hanging;
  hanging.add_block({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  hanging.add_contact(0, none, {0, 1}, {0, 0}, 0.7);
  hanging.add_contact(0, none, {1, 0}, {1, 1}, 0.7);
  const Sliding falls = sliding_of(hanging.mass());
  EXPECT_EQ(falls.answer, Sliding::Answer::falls);
  EXPECT_EQ(falls.factor, 0);
  EXPECT_NEAR(falls.mechanism.velocity[0].velocity[2], -1, 1e-6);
}

TEST(Sliding, WhatIsLevelStands) {
  const Sliding level = sliding_of(block_on_plane(0, 0.5));
  EXPECT_EQ(level.answer, Sliding::Answer::stands);
  EXPECT_TRUE(level.mechanism.velocity.empty());
}

TEST(Sliding, IsTheSameOfAMassThatIsTurnedAndLarger) {
  const RigidMass one = bilinear_slope(0.6);
  RigidMass other = one;
  const Real turn = 0.7, size = 30;
  const auto turned = [&](const Vec3& x) {
    return Vec3{std::cos(turn) * x[0] - std::sin(turn) * x[1],
                std::sin(turn) * x[0] + std::cos(turn) * x[1], x[2]};
  };
  for (RigidBody6& body : other.bodies) {
    body.centre = size * turned(body.centre);
    body.force = (size * size * size) * turned(body.force);
  }
  for (ContactArea& area : other.contacts) {
    area.normal = turned(area.normal);
    for (Vec3& x : area.corner) x = size * turned(x);
  }
  EXPECT_NEAR(sliding_of(other).factor, sliding_of(one).factor, 1e-3);
}

}  // namespace
}  // namespace rockfold
