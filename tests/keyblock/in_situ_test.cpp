// Joints clamped by in-situ stress: the falling wedge of 3DEC's verification manual (REFERENCES E9).
#include "host/keyblock/in_situ.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "host/keyblock/keyblock.hpp"
#include "src/base/vector.hpp"
#include "tests/keyblock/half_space_block.hpp"

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

}  // namespace
}  // namespace rockfold
