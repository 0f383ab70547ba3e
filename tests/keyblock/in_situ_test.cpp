// Joints clamped by in-situ stress: the falling wedge of 3DEC's verification manual (case E9).
#include "host/keyblock/motions/in_situ.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "host/keyblock/keyblock.hpp"
#include "src/base/vector.hpp"
#include "tests/keyblock/models/turned_model.hpp"

namespace rockfold {
namespace {

using test::below;
using test::radians;
using test::Side;
using test::upward;

constexpr Real weight_per_volume = 2000 * 10;
const Real wedge_volume = std::sqrt(3.0) / 3;  // m³
const Real joint_area = 2 / std::sqrt(3.0);    // m²

/// A roof tetrahedron of height 1 m between joints that dip 60°.
BlockArrays roof_wedge() {
  test::BlockArraysBuilder builder;
  const Index roof = builder.solid_face("rock.zmin");
  std::vector<Side> sides{{{0, 0, -1}, {}, roof}};
  for (Index j = 0; j < 3; ++j)
    sides.push_back(
        below(upward(60, 30 + 120 * j), {0, 0, 1}, builder.joint("J" + std::to_string(j + 1))));
  builder.block(test::convex_block(sides));
  builder.rock();
  return builder.blocks;
}

/// Horizontal stress of 0.05 MPa all round.
Model stressed_model(Real friction_angle, Real stiffness_ratio) {
  Model model = test::model_with_joints(friction_angle);
  model.gravity = {0, 0, -10};
  model.joint_materials[0].normal_stiffness = 1e9;
  model.joint_materials[0].shear_stiffness = stiffness_ratio * 1e9;
  model.support->clamping = true;
  model.initial_stress.any = true;
  model.initial_stress.at = {-0.05e6, -0.05e6, 0, 0, 0, 0};
  return model;
}

/// The support that the wedge needs, over its weight.
Real needed(Real friction_angle, Real stiffness_ratio) {
  const auto report = find_keyblocks(roof_wedge(), stressed_model(friction_angle, stiffness_ratio));
  const auto& all = report.keyblocks.empty() ? report.stable : report.keyblocks;
  return all.at(0).sliding_force / all.at(0).weight;
}

TEST(InSituStress, OfTheFallingWedgeEqualsTheClosedForm) {
  const Real weight = weight_per_volume * wedge_volume, normal_stress = 0.0375e6;
  EXPECT_NEAR(weight, 11547.0, 0.01);
  for (const Real phi : {31.0, 33.0, 35.0, 40.0, 50.0})
    for (const Real k : {0.1, 1.0, 10.0}) {
      const Real a = radians(30), f = radians(phi);
      const Real expected =
          1 - 3 * normal_stress * joint_area * k * std::cos(a) * std::sin(f - a) /
                  (weight * std::cos(f) * (k * std::cos(a) + std::tan(f) * std::sin(a)));
      EXPECT_NEAR(needed(phi, k), expected, 1e-9) << phi << " " << k;
    }
  EXPECT_NEAR(needed(35, 1), 0.147617, 5e-7);
}

// What stress holds is lost where rock relaxes: it counts only where the model asks for it.
TEST(InSituStress, MakesNoBlockSaferUnlessClampingCounts) {
  Model model = stressed_model(50, 1);
  ASSERT_TRUE(find_keyblocks(roof_wedge(), model).keyblocks.empty());
  model.support->clamping = false;
  const auto report = find_keyblocks(roof_wedge(), model);
  ASSERT_EQ(report.keyblocks.size(), 1u);
  EXPECT_NEAR(report.keyblocks[0].sliding_force, report.keyblocks[0].weight, 1e-9);
  EXPECT_TRUE(std::isnan(report.keyblocks[0].factor_of_safety));
}

TEST(InSituStress, WithFrictionUpToTheHalfAngleOfTheWedgeHoldsNothing) {
  EXPECT_NEAR(needed(30, 1), 1, 1e-12);
  EXPECT_NEAR(needed(20, 1), 1, 1e-12);
  EXPECT_NEAR(needed(0, 1), 1, 1e-12);
}

TEST(InSituStress, HoldsTheWedgeFromTheCriticalFrictionAngleOn) {
  // The last one stands for rigid shear stiffness, ks/kn → ∞.
  const std::pair<Real, Real> critical[] = {
      {1, 35.8603}, {0.1, 59.0726}, {10, 34.3738}, {1e9, 34.2153}};
  for (const auto& [ratio, angle] : critical) {
    const auto held = [&, k = ratio](Real phi) {
      return find_keyblocks(roof_wedge(), stressed_model(phi, k)).keyblocks.empty();
    };
    EXPECT_TRUE(held(angle + 1e-4)) << ratio;
    EXPECT_FALSE(held(angle - 1e-4)) << ratio;
  }
}

TEST(InSituStress, ThatIsTensileHoldsNothing) {
  Model model = stressed_model(50, 1);
  for (Real& s : model.initial_stress.at) s = -s;
  const auto report = find_keyblocks(roof_wedge(), model);
  ASSERT_EQ(report.keyblocks.size(), 1u);
  EXPECT_TRUE(std::isnan(report.keyblocks[0].factor_of_safety));
  EXPECT_DOUBLE_EQ(report.keyblocks[0].sliding_force, report.keyblocks[0].weight);
}

TEST(InSituStress, GrowsWithDepthByItsGradient) {
  Model model = stressed_model(35, 1);
  model.initial_stress.at = {};
  model.initial_stress.reference_z = 100 + 1.0 / 3;  // the joints' centres are at z = 1/3
  model.initial_stress.gradient = {-500, -500, 0, 0, 0, 0};
  const auto report = find_keyblocks(roof_wedge(), model);
  EXPECT_NEAR(report.keyblocks.at(0).sliding_force / report.keyblocks.at(0).weight, 0.147617, 5e-7);
}

// A slab slides between side joints that the stress clamps and that it does not open: their friction
// adds to the base's.
TEST(InSituStress, OnSideJointsThatDoNotOpenAddsTheirFriction) {
  std::vector<ContactPlane> planes(3);
  const Real tangent = std::tan(radians(20));
  planes[0] = {.normal = -upward(40, 90), .area = 4, .friction = tangent};
  planes[1] = {.normal = {0, 1, 0},
               .area = 2,
               .friction = tangent,
               .clamping = 30,
               .normal_stiffness = 1e9,
               .shear_stiffness = 1e8};
  planes[2] = planes[1];
  planes[2].normal = {0, -1, 0};
  const Vec3 r{0, 0, -100};
  const auto bare = find_movement(planes, r);
  const Movement clamped = with_in_situ_stress(planes, *bare, r);
  EXPECT_NEAR(clamped.resisting - bare->resisting, 2 * 30 * tangent, 1e-9);
  EXPECT_NEAR(clamped.normal_force[0], bare->normal_force[0], 1e-9);
}

// A slab slides on its base away from a joint with cohesion at its back (a = s·x, t its complement). With
// d₀ = N₀/(k_n A a) the resistance from before it opens is min(k_s A t d₀, c A) t, and what it pushes along s is gone.
TEST(InSituStress, OnAJointWithCohesionHoldsUpToWhereItOpensHoweverTheModelLies) {
  const Real tangent = std::tan(radians(20)), dip = radians(35), area = 2.5;
  const Vec3 down{0, 0, -100};
  ContactPlane base{.normal = -upward(35, 90), .area = 4, .friction = tangent};
  ContactPlane back{.normal = {-1, 0, 0},
                    .area = area,
                    .friction = tangent,
                    .cohesion = 60,
                    .clamping = 30,
                    .normal_stiffness = 1e9 * area,
                    .shear_stiffness = 5e8 * area};
  const Real a = std::cos(dip), t = std::sin(dip);
  const Real opens = 30 / (1e9 * area * a);
  const Real held = 5e8 * area * t * opens;  // below its cohesion: stiffness decides
  ASSERT_LT(held, 60);
  const Real expected = 100 * std::cos(dip) * tangent + held * t;
  std::mt19937_64 random(5);
  std::normal_distribution<Real> normal;
  for (int i = 0; i < 200; ++i) {
    const Vec3 axis = normalized({normal(random), normal(random), normal(random)});
    const Real angle = i == 0 ? 0 : 3 * normal(random);
    std::vector<ContactPlane> planes{base, back};
    for (ContactPlane& p : planes) p.normal = test::rotated(p.normal, axis, angle);
    const Vec3 r = test::rotated(down, axis, angle);
    const Movement clamped = with_in_situ_stress(planes, *find_movement(planes, r), r);
    EXPECT_NEAR(clamped.resisting, expected, 1e-10 * expected) << i;
  }
}

// Symmetric joints that open together, as far as the last digit goes: each cohesion counts.
TEST(InSituStress, OnJointsThatOpenAtOnceHoldsByAllOfThem) {
  Model model = stressed_model(20, 1);
  model.joint_materials[0].cohesion = 1e9;
  const BlockArrays rock = roof_wedge();
  const auto all_of = [&](const BlockArrays& blocks, const Model& loads) {
    const auto report = find_keyblocks(blocks, loads);
    return (report.keyblocks.empty() ? report.stable : report.keyblocks).at(0);
  };
  // N = 0 where they open: all of the way's shear holds, 3 k_s A cos²α d₀ with d₀ = N₀/(k_n A sin α).
  const Real a = radians(30), clamped = 0.0375e6 * joint_area;
  const Real expected = 3 * clamped * std::cos(a) * std::cos(a) / std::sin(a);
  EXPECT_NEAR(all_of(rock, model).resisting_force, expected, 1e-9 * expected);
  for (int k = 1; k < 40; ++k) {
    BlockArrays turned = rock;
    Model loads = model;
    test::turn(turned, loads, normalized({0.3, -0.5, 0.1 * k}), 0.37 * k);
    EXPECT_NEAR(all_of(turned, loads).resisting_force, expected, 1e-9 * expected) << k;
  }
}

// Crawford & Bray (1983): the horizontal force H₀ on each side of a symmetric roof wedge presses its joints and holds them along the
// joint too, before the wedge moves.
TEST(InSituStress, WithTheShearThatWasThereIsThatOfCrawfordAndBraysRoofWedge) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<Real> unit(0, 1);
  for (int i = 0; i < 1000; ++i) {
    const Real a = radians(10 + 50 * unit(random)), f = a + (radians(80) - a) * unit(random);
    const Real push = 10 + 1000 * unit(random), kn = 1e9,
               ks = kn * std::pow(10, 4 * unit(random) - 2);
    const Real s = std::sin(a), c = std::cos(a);
    std::vector<ContactPlane> planes;
    for (const Real side : {-1.0, 1.0}) {
      const Vec3 normal{side * c, 0, s}, force{-side * push, 0, 0};
      planes.push_back({.normal = normal,
                        .area = 2,
                        .friction = std::tan(f),
                        .clamping = push * c,
                        .in_situ_shear = force + push * c * normal,
                        .normal_stiffness = 2 * kn,
                        .shear_stiffness = 2 * ks});
    }
    const Vec3 r{0, 0, -100};
    const Movement held = with_in_situ_stress(planes, *find_movement(planes, r), r);
    const Real pull = 2 * push * (ks * c * c + kn * s * s) * std::sin(f - a) /
                      (ks * c * std::cos(f) + kn * s * std::sin(f));
    EXPECT_NEAR(held.resisting, pull, 1e-9 * push) << i;
  }
}

// The whole way, in small steps, against the events alone; shear that pushes the block on is among it.
TEST(InSituStress, IsTheMostThatIsHeldAnywhereOnTheWay) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<Real> unit(0, 1);
  for (int i = 0; i < 200; ++i) {
    const Real a = radians(10 + 60 * unit(random)), friction = 2 * unit(random), kn = 1e9,
               ks = kn * std::pow(10, 2 * unit(random) - 1);
    const Real clamping = 100 * unit(random), along = 200 * (unit(random) - 0.5),
               cohesion = 20 * unit(random);
    const Real s = std::sin(a), c = std::cos(a);
    std::vector<ContactPlane> planes;
    for (const Real side : {-1.0, 1.0})
      planes.push_back({.normal = {side * c, 0, s},
                        .area = 1,
                        .friction = friction,
                        .cohesion = cohesion,
                        .clamping = clamping,
                        .in_situ_shear = along * Vec3{-side * s, 0, c},
                        .normal_stiffness = kn,
                        .shear_stiffness = ks});
    const Vec3 r{0, 0, -1000};
    const Movement held = with_in_situ_stress(planes, *find_movement(planes, r), r);
    const Real opens = clamping / (kn * s);
    Real most = 0;  // once all has opened
    for (int k = 0; k <= 20000; ++k) {
      const Real d = opens * k / 20000, n = clamping - kn * s * d,
                 strength = n * friction + cohesion;
      const Real shear = std::clamp(along + ks * c * d, -strength, strength);
      most = std::max(most, 2 * (shear * c - n * s));
    }
    EXPECT_GE(held.resisting, most - 1e-9) << i;
    EXPECT_NEAR(held.resisting, most, 0.02) << i;
  }
}

// A stress along the side joints presses on them by no more than rounding: nothing of their cohesion holds.
TEST(InSituStress, AlongAJointHoldsNothing) {
  Model model = stressed_model(20, 1);
  model.joint_materials[0].cohesion = 1e6;
  test::BlockArraysBuilder builder;
  const Index free = builder.solid_face("rock.zmin");
  builder.block(test::convex_block({{{0, 0, -1}, {0, 0, 0}, free},
                                    {{1, 0, 0}, {1, 0, 0}, builder.joint("J1")},
                                    {{-1, 0, 0}, {-1, 0, 0}, builder.joint("J2")},
                                    {{0, 1, 0}, {0, 1, 0}, builder.joint("J3")},
                                    {{0, -1, 0}, {0, -1, 0}, builder.joint("J4")},
                                    {{0, 0, 1}, {0, 0, 2}, builder.joint("top")}}));
  builder.rock();
  model.initial_stress.at = {0, 0, -1e6, 0, 0, 0};
  for (int k = 0; k < 40; ++k) {
    BlockArrays turned = builder.blocks;
    Model loads = model;
    test::turn(turned, loads, normalized({0.3, -0.5, 0.1 * k}), 0.37 * k);
    const auto report = find_keyblocks(turned, loads);
    ASSERT_EQ(report.keyblocks.size(), 1u) << k;
    EXPECT_NEAR(report.keyblocks[0].sliding_force, report.keyblocks[0].weight, 1e-3) << k;
  }
}

}  // namespace
}  // namespace rockfold
