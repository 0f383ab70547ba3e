// Capacities of bolts and blocks held by them, against closed forms.
#include "host/bolting/held_block.hpp"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "host/bolting/bolt_capacity.hpp"
#include "src/base/vector.hpp"

namespace rockfold {
namespace {

constexpr Real degree = std::numbers::pi / 180;

// 5 kN of in-situ stress on its joints hold a falling block with the bolt.
TEST(HeldBlock, OfAFallingBlockAddsTheBoltToWhatStressHolds) {
  Movement falling = *find_movement({}, {0, 0, -15e3});
  falling.resisting = 5e3;
  const std::vector<SupportElement> bolt{{{0, 0, 20e3}, false, 1}};
  EXPECT_NEAR(hold({}, falling, bolt, 2).factor_of_safety, 25.0 / 15, 1e-12);
  EXPECT_NEAR(hold({}, falling, bolt, 2).missing_force, 5e3, 1e-9);
}

// Case G-4: 120 of 180 kN are 66.7 %, 8 of 25 mm are 32 %.
TEST(HeldBlock, MobilisesABoltByWhatTheBlockNeeds) {
  const Movement falling = *find_movement({}, {0, 0, -120e3});
  const std::vector<SupportElement> bolt{{{0, 0, 180e3}, false, 120e3 / 8e-3}};
  const HeldBlock held = hold({}, falling, bolt, 1.5);
  EXPECT_NEAR(held.mobilised[0], 0.6667, 1e-4);
  EXPECT_NEAR(held.displacement / 25e-3, 0.32, 1e-9);
}

// Bolts of 100 kN with 10 and 5 MN/m: the stiffer one yields at 10 mm and carries 100 kN, the other 50 kN there.
TEST(HeldBlock, SharesTheLoadByStiffnessUntilBoltsYield) {
  const std::vector<SupportElement> bolts{{{0, 0, 100e3}, false, 10e6},
                                          {{0, 0, 100e3}, false, 5e6}};
  const auto of_weight = [&](Real weight) {
    return hold({}, *find_movement({}, {0, 0, -weight}), bolts, 1);
  };
  EXPECT_NEAR(of_weight(75e3).displacement, 5e-3, 1e-12);
  EXPECT_NEAR(of_weight(75e3).mobilised[1], 0.25, 1e-9);
  EXPECT_NEAR(of_weight(180e3).displacement, 16e-3, 1e-12);
  EXPECT_NEAR(of_weight(180e3).mobilised[0], 1, 0);
  EXPECT_NEAR(of_weight(180e3).mobilised[1], 0.8, 1e-9);
  EXPECT_FALSE(of_weight(201e3).in_balance);
  EXPECT_TRUE(std::isinf(of_weight(201e3).displacement));
}

// A block of 100 kN whose weight is 0.5 m in front of its toe, with a moment of 20 kN m that resists, held by a level bolt
// 2 m above the toe: F = (20 + 2 T) / 50.
TEST(HeldBlock, ThatTurnsIsHeldByMoments) {
  const Turning turning{{3, 1, 0}, {0, 1, 0}, 50e3, 20e3, 1};
  // Counter-clockwise about y: the top goes to +x, the bolt pulls back.
  const std::vector<SupportElement> bolt{{{-30e3, 0, 0}, false, 10e6, {3, 4, 2}}};
  const HeldBlock held = hold(turning, bolt, 1.5);
  EXPECT_NEAR(held.factor_of_safety, 80.0 / 50, 1e-12);
  EXPECT_TRUE(held.adequate);
  EXPECT_NEAR(held.mobilised[0], 15.0 / 30, 1e-9);  // 30 kN m are missing: 15 kN at 2 m
  EXPECT_NEAR(held.moved[0], 15e3 / 10e6, 1e-12);
  EXPECT_NEAR(held.displacement, 15e3 / 10e6 / 2, 1e-12);  // at 1 m
  EXPECT_NEAR(hold(turning, {}, 1.5).missing_force, (75e3 - 20e3) / 1.5, 1e-6);
}

BoltType bolt_of(Real tensile, Real plate, Real bond) {
  BoltType type;
  type.force_capacity = tensile;
  type.plate_capacity = plate;
  type.bond_strength = bond;
  return type;
}

// Case G-3.
TEST(BoltCapacity, IsTheLeastOfSteelPlateAndBond) {
  const BoltType type = bolt_of(200, 50, 100);
  EXPECT_EQ(axial_capacity(type, {4, 1, 3, true}), 150);
  EXPECT_EQ(axial_capacity(type, {2, 1, 1, true}), 100);
  EXPECT_EQ(axial_capacity(type, {5, 2, 3, true}), 200);
  EXPECT_EQ(axial_capacity(type, {4, 1, 3, false}), 100);  // the plate is on another block
  EXPECT_EQ(axial_capacity(type, {1, 1, 0, true}), 0);     // ends in the block
}

TEST(BoltCapacity, OfADiscreteBoltIsThatOfItsPlateAndOfItsAnchorBeyondTheBlock) {
  BoltType type = bolt_of(200, 180, 100);
  type.coupling = Coupling::dmfc;
  EXPECT_EQ(axial_capacity(type, {6, 2, 4, true, 1.5}), 150);
  EXPECT_EQ(axial_capacity(type, {6, 5, 1, true, 1}), 100);
  EXPECT_EQ(axial_capacity(type, {6, 2, 4, false, 1.5}), 0);
  EXPECT_EQ(axial_capacity(type, {6, 2, 4, true, 3}), 180);
  EXPECT_EQ(axial_capacity(type, {6, 2, 2, true, 0}), 0);  // the anchor is in air
  type.bond_strength.reset();
  EXPECT_EQ(axial_capacity(type, {6, 2, 2, true, 0}), 0);
  EXPECT_EQ(axial_capacity(type, {6, 2, 2, true, 1e-3}), 180);
}

TEST(BoltForce, IsTheMostWorkOnTheEllipseOfTensionAndShear) {
  BoltType type = bolt_of(200, 200, 1e9);
  type.shear_capacity = 80;
  const Vec3 axis{0, 0, 1};
  for (const Real angle : {0.0, 20.0, 55.0, 90.0}) {
    SCOPED_TRACE(angle);
    const Vec3 motion{std::sin(angle * degree), 0, -std::cos(angle * degree)};
    const BoltForce force = bolt_force(type, axis, 200, motion);
    EXPECT_NEAR(force.angle, angle * degree, 1e-12);
    EXPECT_NEAR(std::pow(force.axial / 200, 2) + std::pow(force.shear / 80, 2), 1, 1e-12);
    Real most = 0;  // over the ellipse, by trial
    for (int i = 0; i <= 9000; ++i) {
      const Real t = i * 0.01 * degree;
      most = std::max(most, 200 * std::cos(t) * std::cos(angle * degree) +
                                80 * std::sin(t) * std::sin(angle * degree));
    }
    EXPECT_NEAR(-dot(force.force, motion), most, 1e-4);
  }
  // The last digit of 90° decides nothing.
  type.shear_capacity = 0;
  for (const Real beside : {-1e-10, 0.0, 1e-10}) {
    const BoltForce force = bolt_force(type, axis, 200, {std::cos(beside), 0, std::sin(beside)});
    EXPECT_NEAR(norm(force.force - Vec3{0, 0, 200}), 0, 1e-9);
  }
  EXPECT_EQ(norm(bolt_force(type, axis, 200, {std::cos(1e-8), 0, std::sin(1e-8)}).force), 0);
  type.shear_capacity = 80;
  const BoltForce pushed = bolt_force(type, axis, 200, {std::sin(1.0), 0, std::cos(1.0)});
  EXPECT_EQ(pushed.axial, 0);
  EXPECT_NEAR(norm(pushed.force - Vec3{-80, 0, 0}), 0, 1e-9);
  EXPECT_EQ(norm(bolt_force(type, axis, 200, {0, 0, 1}).force), 0);
}

TEST(BoltForce, WithCosineEfficiencyLosesTensionWithTheAngle) {
  BoltType type = bolt_of(200, 200, 1e9);
  const Vec3 motion{std::sin(60 * degree), 0, -std::cos(60 * degree)};
  EXPECT_NEAR(bolt_force(type, {0, 0, 1}, 200, motion).axial, 200, 1e-12);
  type.efficiency = BoltEfficiency::cosine;
  EXPECT_NEAR(bolt_force(type, {0, 0, 1}, 200, motion).axial, 100, 1e-12);
}

// Case G-2: a falling tetrahedron of 15.588 kN with 9 kPa, F = 2, bolts of 100 kN.
TEST(BoltCapacity, SaysHowManyBoltsAndHowFarApart) {
  EXPECT_EQ(bolts_needed(2 * 15.588, 100), 1);
  EXPECT_EQ(bolts_needed(400, 200), 2);
  EXPECT_EQ(bolts_needed(489.98, 200), 3);
  EXPECT_NEAR(square_spacing(100, 2 * 9), 2.357, 5e-4);
}

TEST(BoltCategory, FollowsTheLength) {
  BoltType type;
  EXPECT_EQ(bolt_category(type, 3), BoltCategory::rock_bolt);
  EXPECT_EQ(bolt_category(type, 3.1), BoltCategory::cable_bolt);
  EXPECT_EQ(bolt_category(type, 12), BoltCategory::cable_bolt);
  EXPECT_EQ(bolt_category(type, 16), BoltCategory::ground_anchor);
  type.coupling = Coupling::dmfc;
  EXPECT_EQ(bolt_category(type, 12), BoltCategory::ground_anchor);
}

}  // namespace
}  // namespace rockfold
