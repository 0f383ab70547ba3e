#include "host/stability/bound.hpp"

#include <gtest/gtest.h>

#include "tests/stability/factors.hpp"
#include "tests/stability/planar_mass.hpp"

namespace rockfold {
namespace {

using test::bilinear_slope;
using test::block_on_plane;
using test::bound_of;
using test::degree;
using test::PlanarMass;
using test::Point2;
using test::two_wedge_factor;

TEST(Bound, OfABlockOnAPlaneIsTheRatioOfTheTangents) {
  for (const Real dip : {10.0, 30.0, 55.0}) {
    const Real expected = std::tan(35 * degree) / std::tan(dip * degree);
    EXPECT_NEAR(bound_of(block_on_plane(dip * degree, std::tan(35 * degree))).factor, expected,
                1e-5 * expected)
        << dip;
  }
}

TEST(Bound, CohesionAddsItsForce) {
  const Real weight = 4 * 25e3, dip = 40 * degree, cohesion = 12e3;
  const Real expected =
      (4 * cohesion + weight * std::cos(dip) * std::tan(20 * degree)) / (weight * std::sin(dip));
  EXPECT_NEAR(bound_of(block_on_plane(dip, std::tan(20 * degree), cohesion)).factor, expected,
              1e-5 * expected);
  EXPECT_NEAR(bound_of(block_on_plane(dip, 0, cohesion)).factor,
              4 * cohesion / (weight * std::sin(dip)), 1e-5);
}

TEST(Bound, IsInfiniteWhereNothingMovesWithoutFriction) {
  const Bound level = bound_of(block_on_plane(0, 0.5));
  EXPECT_TRUE(std::isinf(level.factor));
  EXPECT_TRUE(level.above.velocity.empty());
}

TEST(Bound, IsZeroWhereNoStrengthHelps) {
  // It hangs under a roof; and tips over the edge of a table.
  PlanarMass hanging;
  hanging.add_block({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  hanging.add_contact(0, none, {1, 1}, {0, 1}, 0.7);
  EXPECT_EQ(bound_of(hanging.mass()).factor, 0);

  PlanarMass tipping;
  tipping.add_block({{0, 0}, {2, 0}, {2, 1}, {0, 1}});
  tipping.add_contact(0, none, {0, 0}, {0.99, 0}, 0.7);
  EXPECT_EQ(bound_of(tipping.mass()).factor, 0);
}

TEST(Bound, TensionHoldsABlockUnderARoof) {
  PlanarMass hanging;
  hanging.add_block({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  hanging.add_contact(0, none, {1, 1}, {0, 1}, 0.5, 100e3, 40e3);
  EXPECT_NEAR(bound_of(hanging.mass()).factor, 40e3 / 25e3, 1e-5);
}

// Cohesion and friction divided by the same factor leave the cone's apex, c / tan φ, where it is: tension strength counts up to there.
TEST(Bound, TensionHoldsABlockUnderARoofUpToTheApexOfTheCone) {
  const auto factor_of = [](Real cohesion, Real tension) {
    PlanarMass hanging;
    hanging.add_block({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
    hanging.add_contact(0, none, {1, 1}, {0, 1}, 0.5, cohesion, tension);
    return bound_of(hanging.mass()).factor;
  };
  EXPECT_NEAR(factor_of(20e3, 60e3), 60e3 / 25e3, 1e-4);  // apex at 40 kPa, weight 25 kPa
  EXPECT_EQ(factor_of(12e3, 60e3), 0);                    // apex at 24 kPa
}

// It leans on a bonded wall: what the joint bears in shear grows as its tension is cut off lower, t / F.
TEST(Bound, ShearBesideTensionIsThatOfTheConeAtTheFactor) {
  PlanarMass leaning;
  leaning.add_block({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  leaning.add_contact(0, none, {0, 0}, {0, 1}, 0.5, 60e3, 20e3);
  RigidMass mass = leaning.mass();
  mass.contacts[0].normal = {1, 0, 0};
  mass.bodies[0].centre = {0, 0.5, 0.5};  // weight without a moment
  mass.bodies[0].force = {10e3, 0, -25e3};
  // At F: normal −10 kN of at most 20 kN / F, shear 25 kN = (60 − 0.5 · 10) kN / F, or the cut-off at F = 2 first.
  EXPECT_NEAR(bound_of(mass).factor, 2, 1e-4);
  mass.bodies[0].force = {10e3, 0, -40e3};
  EXPECT_NEAR(bound_of(mass).factor, 55e3 / 40e3, 1e-4);
}

TEST(Bound, OfABilinearSlopeIsThatOfTwoWedges) {
  for (const Real angle : {25.0, 35.0}) {
    const Real friction = std::tan(angle * degree), expected = two_wedge_factor(friction);
    EXPECT_NEAR(bound_of(bilinear_slope(friction)).factor, expected, 1e-4) << angle;
  }
  EXPECT_NEAR(two_wedge_factor(std::tan(25 * degree)), 0.821, 1e-3);
  EXPECT_NEAR(two_wedge_factor(std::tan(35 * degree)), 1.2333, 1e-3);
}

/// A circular arch of mean radius 1 m from 90° − half to 90° + half, with radial joints.
RigidMass arch(Index voussoirs, Real thickness, Real half, Real seismic = 0) {
  PlanarMass planar(25e3, seismic);
  constexpr Real no_slip = 2;  // tan φ: the thrust leans less
  const auto at = [&](Real radius, Index k) {
    const Real angle = 90 * degree - half + 2 * half * k / voussoirs;
    return Point2{radius * std::cos(angle), radius * std::sin(angle)};
  };
  const Real inner = 1 - thickness / 2, outer = 1 + thickness / 2;
  // Sectors of a ring: their areas, and how far out their centres lie.
  const Real turn = 2 * half / voussoirs;
  const Real area = turn * (outer * outer - inner * inner) / 2;
  const Real out = std::sin(turn / 2) / (turn / 2) * (2.0 / 3) *
                   (std::pow(outer, 3) - std::pow(inner, 3)) / (outer * outer - inner * inner);
  for (Index k = 0; k < voussoirs; ++k) {
    const Real angle = 90 * degree - half + turn * (k + 0.5);
    planar.add_block(area, {out * std::cos(angle), out * std::sin(angle)});
  }
  for (Index k = 0; k < voussoirs; ++k)
    planar.add_contact(k, k - 1 < 0 ? none : k - 1, at(inner, k), at(outer, k), no_slip);
  planar.add_contact(voussoirs - 1, none, at(outer, voussoirs), at(inner, voussoirs), no_slip);
  return planar.mass();
}

// Semicircular arches of N equal voussoirs that cannot slip stand from a thickness of so much of the radius on; of many
// voussoirs 0.1075 (Milankovitch 1907).
TEST(Bound, ArchesStandFromTheirLeastThicknessOn) {
  const std::vector<std::pair<Index, Real>> least{
      {6, 0.105098}, {7, 0.096245}, {10, 0.10746}, {15, 0.106265}, {21, 0.10679}};
  for (const auto& [voussoirs, thickness] : least) {
    EXPECT_GT(bound_of(arch(voussoirs, thickness + 3e-5, 90 * degree)).factor, 1) << voussoirs;
    EXPECT_EQ(bound_of(arch(voussoirs, thickness - 3e-5, 90 * degree)).factor, 0) << voussoirs;
  }
}

// Oppenheim (1992): 157.5°, seven voussoirs, t/R 0.15: it becomes a mechanism at 0.37 g.
TEST(Bound, OppenheimsArchStandsUpToItsGroundAcceleration) {
  EXPECT_GT(bound_of(arch(7, 0.15, 78.75 * degree, 0.36)).factor, 1);
  EXPECT_EQ(bound_of(arch(7, 0.15, 78.75 * degree, 0.38)).factor, 0);
}

TEST(Bound, IsTheSameOfAMassThatIsTurnedAndLarger) {
  const RigidMass one = bilinear_slope(0.6);
  const Real turn = 0.7, size = 30;
  const auto turned = [&](const Vec3& x) {
    return Vec3{std::cos(turn) * x[0] - std::sin(turn) * x[1],
                std::sin(turn) * x[0] + std::cos(turn) * x[1], x[2]};
  };
  RigidMass other = one;
  for (RigidBody6& body : other.bodies) {
    body.centre = size * turned(body.centre);
    body.force = (size * size * size) * turned(body.force);
  }
  for (ContactArea& area : other.contacts) {
    area.normal = turned(area.normal);
    for (Vec3& x : area.corner) x = size * turned(x);
  }
  EXPECT_NEAR(bound_of(other).factor, bound_of(one).factor, 1e-5);
}

TEST(Bound, OfAStackOfBricksIsBetweenItsProofs) {
  // A tall tower leans on a low one: it would tip over if that did not hold it.
  PlanarMass planar;
  planar.add_block({{0, 0}, {1, 0}, {1, 1.5}, {0, 1.5}});
  planar.add_block({{1, 0}, {2, 0}, {2, 3}, {1, 3}});
  planar.add_contact(0, none, {0, 0}, {1, 0}, 0.6);
  planar.add_contact(1, none, {1, 0}, {2, 0}, 0.6);
  planar.add_contact(0, 1, {1, 0}, {1, 1.5}, 0.6);
  RigidMass mass = planar.mass();
  for (RigidBody6& body : mass.bodies) body.force[0] = 0.3 * body.force[2];
  const Bound bound = bound_of(mass);
  EXPECT_LT(bound.below.factor, 0.6 / 0.3);
  EXPECT_GT(bound.below.factor, 0.5);
}

}  // namespace
}  // namespace rockfold
