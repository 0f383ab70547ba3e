// One block from its faces: published wedges with cohesion and water, classes, and input at its
// limits.
#include "host/keyblock/motions/single_block.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "host/keyblock/motions/least_support.hpp"
#include "src/base/vector.hpp"
#include "tests/keyblock/models/half_space_block.hpp"

namespace rockfold {
namespace {

using test::above;
using test::below;
using test::ConvexBlock;
using test::radians;
using test::Side;
using test::upward;

struct Strength {
  Real friction_angle = 0, cohesion = 0;
};
/// Faces of a convex block; `joints[origin]` is the strength of the sides of that origin, further
/// origins are free.
std::vector<BlockFace> faces_of(const ConvexBlock& block, const std::vector<Strength>& joints) {
  std::vector<BlockFace> faces;
  for (const auto& face : block.faces) {
    BlockFace f{.normal = face.side.normal, .area = face.area};
    const auto origin = static_cast<std::size_t>(face.side.origin);
    if (origin < joints.size()) {
      f.contact_area = face.area;
      f.friction = std::tan(radians(joints[origin].friction_angle));
      f.cohesion = joints[origin].cohesion;
    }
    faces.push_back(f);
  }
  return faces;
}
Real area_of(const ConvexBlock& block, Index origin) {
  Real area = 0;
  for (const auto& face : block.faces)
    if (face.side.origin == origin) area += face.area;
  return area;
}

// Hoek & Bray, Rock Slope Engineering (case E5): joints 45/105 and 70/235, face 65/185, upper slope 12/195,
// H1 = 100 ft; feet and pounds.
class HoekBray : public testing::Test {
 protected:
  const Vec3 n1 = upward(45, 105), n2 = upward(70, 235), face = upward(65, 185),
             upper = upward(12, 195);
  const Vec3 crack = upward(70, 165);
  const Vec3 toe{};
  /// Where joint 1 meets the crest: on joint 1 and the face, 100 ft above the toe.
  Vec3 crest = at_height(100);
  Vec3 at_height(Real height) const { return (height / cross(n1, face)[2]) * cross(n1, face); }
  const std::vector<Strength> strengths{{20, 500}, {30, 1000}, {0, 0}};
  static constexpr Real unit_weight = 160, water_unit_weight = 62.5;

  std::vector<Side> sides() const {
    return {above(n1, toe, 0), above(n2, toe, 1), below(face, toe, 3), below(upper, crest, 3)};
  }
  /// A tension crack that meets joint 1 on the upper slope 40 ft behind the crest.
  std::vector<Side> sides_with_crack() const {
    Vec3 trace = normalized(cross(n1, upper));
    if (trace[2] < 0) trace = -trace;
    auto all = sides();
    all.push_back(above(crack, crest + 40.0 * trace, 2));
    return all;
  }
  Vec3 weight(const ConvexBlock& block) const { return {0, 0, -unit_weight * block.volume}; }
};

TEST_F(HoekBray, TheDryWedgeEqualsThePublishedFactorOfSafety) {
  const ConvexBlock block = test::convex_block(sides());
  EXPECT_NEAR(block.volume, 229925, 0.5);
  EXPECT_NEAR(area_of(block, 0), 9349.02, 5e-3);
  EXPECT_NEAR(area_of(block, 1), 9421.58, 5e-3);
  const auto verdict = judge_block(faces_of(block, strengths), weight(block), 0);
  EXPECT_EQ(verdict.block_class, BlockClass::stable);
  ASSERT_TRUE(verdict.movement);
  const Movement& m = *verdict.movement;
  EXPECT_EQ(m.mode, SlidingMode::two_planes);
  EXPECT_NEAR(m.normal_force[0], 29351.5e3, 100);
  EXPECT_NEAR(m.normal_force[1], 18020.0e3, 100);
  EXPECT_NEAR(m.factor_of_safety(), 1.8464, 1e-4);

  // The same by trigonometry: plunge ψ of the line, angles between the normals.
  const Real w = 160 * block.volume, c12 = dot(n1, n2), s2 = 1 - c12 * c12;
  const Real normal_1 = w * (n1[2] - c12 * n2[2]) / s2, normal_2 = w * (n2[2] - c12 * n1[2]) / s2;
  const Real plunge = std::asin(std::abs(normalized(cross(n1, n2))[2]));
  const Real closed_form = (normal_1 * std::tan(radians(20)) + normal_2 * std::tan(radians(30)) +
                            500 * area_of(block, 0) + 1000 * area_of(block, 1)) /
                           (w * std::sin(plunge));
  EXPECT_NEAR(m.factor_of_safety(), closed_form, 1e-10);
  EXPECT_NEAR(test::degrees(plunge), 31.197, 5e-4);
  EXPECT_NEAR(test::degrees(std::atan2(m.direction[0], m.direction[1])), 157.732, 5e-4);
}

// Cohesion counts for less in the larger wedge: volume and weight go by (H/100)³, areas by (H/100)².
TEST_F(HoekBray, TheDryWedgeOf130FeetIsLessSafe) {
  crest = at_height(130);
  const ConvexBlock block = test::convex_block(sides());
  EXPECT_NEAR(block.volume, 229925 * std::pow(1.3, 3), 2);
  const auto verdict = judge_block(faces_of(block, strengths), weight(block), 0);
  EXPECT_EQ(verdict.movement->mode, SlidingMode::two_planes);
  EXPECT_NEAR(verdict.movement->factor_of_safety(), 1.67566, 5e-6);
}

TEST_F(HoekBray, TheWedgeWithATensionCrackDryAndFullOfWater) {
  const ConvexBlock block = test::convex_block(sides_with_crack());
  EXPECT_NEAR(block.volume, 176701, 0.5);
  EXPECT_NEAR(area_of(block, 0), 5565.0, 0.05);
  EXPECT_NEAR(area_of(block, 1), 6428.1, 0.05);
  EXPECT_NEAR(area_of(block, 2), 1846.5, 0.05);
  const auto faces = faces_of(block, strengths);
  EXPECT_NEAR(judge_block(faces, weight(block), 0).movement->factor_of_safety(), 1.7356, 5e-5);
  const Real pressure = water_unit_weight * 52.045 / 3;
  const auto wet = judge_block(faces, weight(block), pressure);
  EXPECT_NEAR(wet.movement->factor_of_safety(), 1.1378, 5e-5);
}

TEST_F(HoekBray, EnoughWaterLiftsTheWedgeOffItsJoints) {
  const ConvexBlock block = test::convex_block(sides_with_crack());
  const auto verdict = judge_block(faces_of(block, strengths), weight(block), 1e4);
  EXPECT_EQ(verdict.block_class, BlockClass::key);
  EXPECT_EQ(verdict.movement->mode, SlidingMode::lifting);
}

// Case E9 without stress, G-2. 3DEC's falling wedge: roof tetrahedron between joints that dip 60°, apex 1 m above the roof, 20
// kN/m³.
TEST(RoofTetrahedron, FallsWithItsWeight) {
  const Vec3 apex{0, 0, 1};
  std::vector<Side> sides{{{0, 0, -1}, {}, 3}};
  for (Index j = 0; j < 3; ++j) sides.push_back(below(upward(60, 30 + 120 * j), apex, j));
  const ConvexBlock block = test::convex_block(sides);
  EXPECT_NEAR(block.volume, std::sqrt(3.0) / 3, 1e-14);
  EXPECT_NEAR(area_of(block, 0), 1.154701, 1e-6);
  const std::vector<Strength> joints(3, {35, 1e6});  // in vain: nothing presses on joints that open
  const auto verdict = judge_block(faces_of(block, joints), {0, 0, -20000 * block.volume}, 0);
  EXPECT_EQ(verdict.block_class, BlockClass::key);
  EXPECT_EQ(verdict.movement->mode, SlidingMode::lifting);
  EXPECT_NEAR(verdict.movement->sliding_force(), 11547.0,
              0.01);  // A0 / W = 1 without in-situ stress
  EXPECT_NEAR(verdict.free_area, std::sqrt(3.0), 1e-14);
  // p = γ H / 3 at F = 1.
  EXPECT_NEAR(least_support(verdict.planes, *verdict.movement, 1).force / verdict.free_area,
              20000.0 / 3, 1e-9);
}

// The classes, on a unit cube whose faces are named by where they look.
enum Face { east, west, north, south, top, bottom };
std::vector<BlockFace> cube(std::initializer_list<Face> in_contact) {
  const Vec3 normals[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  std::vector<BlockFace> faces;
  for (const Vec3& n : normals) faces.push_back({.normal = n, .area = 1});
  for (const Face f : in_contact) faces[f].contact_area = 1;
  return faces;
}
BlockClass class_of(const std::vector<BlockFace>& faces, const Vec3& load = {0, 0, -1}) {
  return judge_block(faces, load, 0).block_class;
}

TEST(BlockClasses, OfACube) {
  EXPECT_EQ(class_of(cube({east, west, north, south, top, bottom})), BlockClass::tapered);
  EXPECT_EQ(class_of(cube({east, west, north, south, bottom})),
            BlockClass::stable);  // could be pulled out
  EXPECT_EQ(class_of(cube({east, west, north, south, top})),
            BlockClass::key);  // falls out of the roof
  EXPECT_EQ(class_of(cube({east, west, north, top, bottom})), BlockClass::stable);  // in a wall
  EXPECT_EQ(class_of(cube({east, west, north, top, bottom}), {0, -1, 0}), BlockClass::key);
  EXPECT_EQ(class_of(cube({})), BlockClass::key);
  auto faces = cube({bottom});
  faces[west].continues = true;
  EXPECT_EQ(class_of(faces), BlockClass::infinite);
}

TEST(BlockClasses, AWedgeThatWidensInwardsIsTapered) {
  std::vector<BlockFace> faces{{.normal = {0, 0, 1}, .area = 1}};
  for (const Real azimuth : {0.0, 120.0, 240.0})
    faces.push_back({.normal = upward(80, azimuth), .area = 1, .contact_area = 1});
  faces.push_back({.normal = {0, 0, -1}, .area = 1, .contact_area = 1});
  EXPECT_EQ(class_of(faces), BlockClass::tapered);
  EXPECT_EQ(class_of(faces, {0, 0, 100}), BlockClass::tapered);
}

// Friction equal to the dip is no motion, however the model is turned.
TEST(BlockClasses, AtTheLimitOfEquilibriumIsStable) {
  std::mt19937_64 random(23);
  std::normal_distribution<Real> normal;
  for (int trial = 0; trial < 1000; ++trial) {
    const Vec3 axis = normalized({normal(random), normal(random), normal(random)});
    const Real turn = 180 * normal(random);
    const auto with = [&](Real friction_angle) {
      return class_of({{.normal = test::rotated(-upward(30, 70), axis, turn),
                        .area = 1,
                        .contact_area = 1,
                        .friction = std::tan(radians(friction_angle))},
                       {.normal = {0, 0, 1}, .area = 1}},
                      test::rotated({0, 0, -3e5}, axis, turn));
    };
    EXPECT_EQ(with(30), BlockClass::stable);
    EXPECT_EQ(with(29.9999), BlockClass::key);
  }
}

TEST(BlockFaces, OfOneOrientationAreOnePlane) {
  const Vec3 n = -upward(40, 90);
  const std::vector<BlockFace> steps{
      {.normal = n, .area = 3, .contact_area = 3, .friction = 0.2, .cohesion = 10},
      {.normal = n, .area = 1, .contact_area = 1, .friction = 0.6, .cohesion = 50},
      {.normal = {0, 0, 1}, .area = 2}};
  const auto planes = contact_planes(steps);
  ASSERT_EQ(planes.size(), 1u);
  EXPECT_DOUBLE_EQ(planes[0].area, 4);
  EXPECT_DOUBLE_EQ(planes[0].friction, 0.3);  // by area
  EXPECT_DOUBLE_EQ(planes[0].cohesion, 80);
  EXPECT_EQ(planes[0].face, 0);
  const auto verdict = judge_block(steps, {0, 0, -1000}, 0);
  EXPECT_EQ(verdict.movement->mode, SlidingMode::single_plane);
  EXPECT_NEAR(verdict.movement->resisting, 1000 * std::cos(radians(40)) * 0.3 + 80, 1e-10);
}

TEST(BlockFaces, InContactByAPartHoldByThatPart) {
  auto faces = cube({bottom});
  faces[bottom].contact_area = 0.25;
  faces[bottom].cohesion = 2;
  const auto verdict = judge_block(faces, {0.4, 0, -1}, 0);
  EXPECT_EQ(verdict.block_class, BlockClass::stable);
  EXPECT_DOUBLE_EQ(verdict.movement->resisting, 0.5);
  EXPECT_DOUBLE_EQ(verdict.free_area, 5.75);
  EXPECT_EQ(class_of(faces, {0.6, 0, -1}), BlockClass::key);
}

TEST(BlockFaces, WithoutAreaOrDirectionHoldNothing) {
  auto faces = cube({bottom});
  faces[bottom].friction = 0.5;
  const auto before = judge_block(faces, {1, 0, -1}, 1e-3);
  faces.push_back({.normal = {0, 0, 0}, .area = 1e-300, .contact_area = 1e-300, .friction = 0.5});
  faces.push_back({.normal = {std::nan(""), 0, 0}, .area = 0, .contact_area = 0});
  const auto after = judge_block(faces, {1, 0, -1}, 1e-3);
  EXPECT_EQ(after.planes.size(), 1u);
  EXPECT_EQ(before.movement->sliding_force(), after.movement->sliding_force());
}

TEST(BlockFaces, AsSmallAsDoublesGoGiveNumbers) {
  for (const Real area : {1e-18, 1e-9, 1e12}) {
    auto faces = cube({bottom, west});
    for (BlockFace& f : faces)
      f.area *= area, f.contact_area *= area, f.friction = 0.1, f.cohesion = 5;
    const auto verdict = judge_block(faces, {area, 0, -area}, 1e-2);
    EXPECT_TRUE(std::isfinite(verdict.movement->sliding_force()));
    EXPECT_TRUE(std::isfinite(verdict.free_area));
  }
}

// Water under a block whose weight it just carries: nothing is left to move it.
TEST(Water, ThatCarriesTheWholeWeightLeavesTheBlockAtRest) {
  const auto verdict = judge_block(cube({bottom}), {0, 0, -0.1}, 0.1);
  EXPECT_EQ(verdict.block_class, BlockClass::stable);
  EXPECT_FALSE(verdict.movement);
}
TEST(Water, ReducesTheNormalForce) {
  auto faces = cube({bottom});
  faces[bottom].friction = 0.5;
  const auto verdict = judge_block(faces, {0.1, 0, -1}, 0.9);
  EXPECT_NEAR(verdict.movement->resisting, 0.05, 1e-15);
  EXPECT_EQ(verdict.block_class, BlockClass::key);
}

}  // namespace
}  // namespace rockfold
