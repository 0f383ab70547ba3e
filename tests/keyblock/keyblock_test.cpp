// Key blocks of whole models, batch by batch.
#include "host/keyblock/keyblock.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "src/base/vector.hpp"
#include "tests/keyblock/models/half_space_block.hpp"
#include "tests/keyblock/models/turned_model.hpp"

namespace rockfold {
namespace {

using test::above;
using test::below;
using test::BlockArraysBuilder;
using test::model_with_joints;
using test::radians;
using test::Side;
using test::upward;

// 3DEC's sliding wedge as blocks: joints 40/130 and 60/220 under a horizontal top at 10 m, cut off
// by a face that dips 70 to 160.
BlockArrays wedge_in_a_slope() {
  BlockArraysBuilder builder;
  const Index j1 = builder.joint("J1"), j2 = builder.joint("J2"),
              ground = builder.solid_face("ground");
  builder.block(test::convex_block({above(upward(40, 130), {}, j1), above(upward(60, 220), {}, j2),
                                    below(upward(70, 160), {}, ground),
                                    below({0, 0, 1}, {0, 0, 10}, ground)}));
  builder.rock();
  return builder.blocks;
}

TEST(Keyblocks, OfAWedgeInASlope) {
  const BlockArrays blocks = wedge_in_a_slope();
  const KeyblockReport report = find_keyblocks(blocks, model_with_joints(20));
  EXPECT_EQ(report.block_class, (std::vector{BlockClass::key, BlockClass::infinite}));
  EXPECT_EQ(report.batch, (std::vector<Index>{1, 0}));
  EXPECT_EQ(report.batches, std::vector<Index>{1});
  ASSERT_EQ(report.keyblocks.size(), 1u);
  const Keyblock& key = report.keyblocks[0];
  const Real weight = 2000 * 9.81 * blocks.volume[0];
  EXPECT_EQ(key.block, 0);
  EXPECT_EQ(key.batch, 1);
  EXPECT_EQ(key.mode, SlidingMode::two_planes);
  EXPECT_EQ(key.planes, (std::vector<std::string>{"J1", "J2"}));
  EXPECT_NEAR(key.weight, weight, 1e-9 * weight);
  EXPECT_NEAR(key.sliding_force / weight, 0.269442, 1e-6);
  EXPECT_NEAR(key.factor_of_safety, std::tan(radians(20)) / std::tan(radians(33.3572)), 1e-5);
  EXPECT_NEAR(key.free_area, blocks.face_area[2] + blocks.face_area[3], 1e-9);
  EXPECT_GT(key.support_force, key.sliding_force / (1.5 + 0.4));
  EXPECT_DOUBLE_EQ(key.support_pressure, key.support_force / key.free_area);
}

TEST(Keyblocks, AWedgeAboveItsCriticalFrictionIsStable) {
  EXPECT_EQ(find_keyblocks(wedge_in_a_slope(), model_with_joints(33.3573)).block_class[0],
            BlockClass::stable);
  EXPECT_EQ(find_keyblocks(wedge_in_a_slope(), model_with_joints(33.3571)).block_class[0],
            BlockClass::key);
  EXPECT_EQ(find_keyblocks(wedge_in_a_slope(), model_with_joints(20, 1e6)).block_class[0],
            BlockClass::stable);
}

/// Without cohesion the wedge has tan φ / tan 33.3572°, at 40° 1.2748 and at its residual 25° 0.7084.
TEST(Keyblocks, HaveTheFactorOfJointsThatHaveSlippedBesideThatOfJointsThatHaveNot) {
  Model model = model_with_joints(40, 1e4);
  const auto only = [&] {
    const KeyblockReport report = find_keyblocks(wedge_in_a_slope(), model);
    EXPECT_EQ(report.keyblocks.size() + report.stable.size(), 1u);
    return report.keyblocks.empty() ? report.stable[0] : report.keyblocks[0];
  };
  model.joint_materials[0].residual_cohesion = 1e4;
  const Keyblock whole = only();
  EXPECT_EQ(whole.residual_factor_of_safety, whole.factor_of_safety);
  model.joint_materials[0].residual_cohesion = 0;
  model.joint_materials[0].residual_friction_angle = 25;
  const Keyblock brittle = only();
  EXPECT_EQ(brittle.factor_of_safety, whole.factor_of_safety);
  EXPECT_EQ(brittle.sliding_force, whole.sliding_force);
  EXPECT_GT(brittle.factor_of_safety, 1.3);
  EXPECT_NEAR(brittle.residual_factor_of_safety, std::tan(radians(25)) / std::tan(radians(33.3572)),
              1e-5);
}

TEST(Keyblocks, AreListedApartFromBlocksThatStayBelowTheTarget) {
  const Real critical = 33.3572;
  for (const Real friction : {36.0, 50.0}) {
    const KeyblockReport report = find_keyblocks(wedge_in_a_slope(), model_with_joints(friction));
    EXPECT_TRUE(report.keyblocks.empty());
    ASSERT_EQ(report.stable.size(), 1u);
    const Keyblock& block = report.stable[0];
    const Real safety = std::tan(radians(friction)) / std::tan(radians(critical));
    EXPECT_EQ(block.batch, 0);
    EXPECT_NEAR(block.factor_of_safety, safety, 1e-5);
    EXPECT_LT(block.sliding_force, 0);
    EXPECT_EQ(block.support_force > 0, safety < 1.5) << friction;
  }
}

TEST(Keyblocks, OfARoofFallAndNothingResists) {
  BlockArraysBuilder builder;
  const Index roof = builder.solid_face("rock.zmin");
  std::vector<Side> sides{{{0, 0, -1}, {}, roof}};
  for (Index j = 0; j < 3; ++j)
    sides.push_back(
        below(upward(60, 30 + 120 * j), {0, 0, 1}, builder.joint("J" + std::to_string(j + 1))));
  builder.block(test::convex_block(sides));
  builder.rock();
  const KeyblockReport report = find_keyblocks(builder.blocks, model_with_joints(35, 1e5));
  ASSERT_EQ(report.keyblocks.size(), 1u);
  const Keyblock& key = report.keyblocks[0];
  EXPECT_EQ(key.mode, SlidingMode::lifting);
  EXPECT_TRUE(key.planes.empty());
  EXPECT_TRUE(std::isnan(key.factor_of_safety));
  EXPECT_EQ(key.direction, (Vec3{0, 0, -1}));
  EXPECT_EQ(key.support_direction, (Vec3{0, 0, 1}));
  EXPECT_DOUBLE_EQ(key.sliding_force, key.weight);
  EXPECT_DOUBLE_EQ(key.support_force, 1.5 * key.weight);
  EXPECT_NEAR(key.support_pressure, 1.5 * 2000 * 9.81 / 3, 1e-9);  // F γ H / 3
}

// Case E10: thesis Table 5-1 in newtons, gravity along the first axis, no strength. Volumes
// to 5e-4 m³.
struct Row {
  int row;
  Real force, volume, printed_volume;
};
/// The block of a row: a prism of that volume lying on one plane, or hanging from it.
Keyblock row_block(const Row& row, const Vec3& out, const Vec3& along) {
  BlockArraysBuilder builder;
  const Index joint = builder.joint("J1"), face = builder.solid_face("free");
  const Vec3 across = cross(out, along);
  const auto side = [&](const Vec3& n, Real at, Index origin) { return Side{n, at * n, origin}; };
  builder.block(test::convex_block({side(out, 0, joint), side(-out, 2, face), side(along, 1, face),
                                    side(-along, 1, face), side(across, row.volume / 8, face),
                                    side(-across, row.volume / 8, face)}));
  builder.rock();
  Model model = model_with_joints(0);
  model.gravity = {9.8, 0, 0};
  const KeyblockReport report = find_keyblocks(builder.blocks, model);
  EXPECT_EQ(report.keyblocks.size(), 1u) << "row " << row.row;
  return report.keyblocks.at(0);
}
void expect_row(const Row& row, const Keyblock& key, const Vec3& direction, SlidingMode mode) {
  EXPECT_NEAR(key.volume, row.volume, 1e-9) << "row " << row.row;
  EXPECT_EQ(std::round(key.volume), row.printed_volume) << "row " << row.row;
  EXPECT_NEAR(key.sliding_force, row.force, 19600 * direction[0] * 5e-4 + 0.5) << "row " << row.row;
  EXPECT_NEAR(key.sliding_force, 19600 * key.volume * direction[0], 1e-6) << "row " << row.row;
  EXPECT_EQ(key.mode, mode) << "row " << row.row;
  EXPECT_LT(norm(key.direction - direction), 1e-12) << "row " << row.row;
}

TEST(Keyblocks, OfTable51) {
  const Row gentle[] = {
      {1, 194328, 99.641, 100}, {2, 61152, 31.356, 31},   {3, 165194, 84.703, 85},
      {4, 107312, 55.024, 55},  {5, 32395, 16.610, 17},   {6, 191689, 98.288, 98},
      {7, 79093, 40.555, 41},   {8, 93909, 48.152, 48},   {9, 21140, 10.840, 11},
      {10, 181233, 92.927, 93}, {11, 106188, 54.448, 54}, {14, 403603, 206.947, 207}};
  const Row steep{12, 600275, 43.312, 43};
  const Row falling[] = {
      {13, 239486, 12.2187, 12}, {15, 595424, 30.3788, 30}, {16, 156731, 7.9965, 8}};
  const Vec3 s = normalized({0.1, 0, 1});
  for (const Row& row : gentle)
    expect_row(row, row_block(row, normalized({1, 0, -0.1}), s), s, SlidingMode::single_plane);
  const Vec3 s12 = normalized({1, 1, 0});
  expect_row(steep, row_block(steep, normalized({1, -1, 0}), s12), s12, SlidingMode::single_plane);
  for (const Row& row : falling)
    expect_row(row, row_block(row, {-1, 0, 0}, {0, 0, 1}), {1, 0, 0}, SlidingMode::lifting);
}

/// A train of unit cubes on a plane of dip 30 towards +x: `length` cubes in a row, `layers` upon
/// each other, with rock under it and above its upper end. The cube in front slides first. Ids in
/// the order of `order`.
struct Train {
  BlockArrays blocks;
  std::vector<Index> column;  ///< [B] distance from the front; −1 for the rock
};
Train train(int length, int layers, const std::vector<int>& order) {
  BlockArraysBuilder builder;
  const Index base = builder.joint("base"), cross_joint = builder.joint("cross"),
              free = builder.solid_face("free");
  const Vec3 x = normalized({std::sqrt(3.0), 0, -1}), z = normalized({1, 0, std::sqrt(3.0)}),
             y{0, 1, 0};
  Train made;
  for (const int i : order) {
    const int floor = i / length;
    const Real column = i % length, layer = floor;
    builder.block(test::convex_block({{x, -column * x, column == 0 ? free : cross_joint},
                                      {-x, (-column - 1) * x, cross_joint},
                                      {y, y, free},
                                      {-y, {}, free},
                                      {-z, layer * z, base},
                                      {z, (layer + 1) * z, layer == layers - 1 ? free : base}}));
    made.column.push_back(i % length);
  }
  builder.rock();
  made.column.push_back(-1);
  made.blocks = builder.blocks;
  return made;
}
std::vector<int> ids(int count) {
  std::vector<int> order(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) order[static_cast<std::size_t>(i)] = i;
  return order;
}

TEST(Batches, OfATrainOfCubesGoFromTheFront) {
  const KeyblockReport report = find_keyblocks(train(5, 1, ids(5)).blocks, model_with_joints(10));
  EXPECT_EQ(report.batches, (std::vector<Index>{1, 1, 1, 1, 1}));
  EXPECT_EQ(report.batch, (std::vector<Index>{1, 2, 3, 4, 5, 0}));
  const Real tangent = std::tan(radians(10));
  for (const Keyblock& key : report.keyblocks) {
    EXPECT_EQ(key.planes, std::vector<std::string>{"base"});
    EXPECT_NEAR(key.sliding_force, key.weight * (0.5 - std::sqrt(0.75) * tangent), 1e-9);
    EXPECT_NEAR(key.free_area, 4,
                1e-12);  // top, two sides, and the front that the one before has left
  }
}

TEST(Batches, OfATrainInTwoLayersDoNotDependOnIds) {
  std::mt19937_64 random(2);
  std::vector<int> order = ids(12);
  for (int trial = 0; trial < 20; ++trial) {
    const Train t = train(6, 2, order);
    const KeyblockReport report = find_keyblocks(t.blocks, model_with_joints(10));
    EXPECT_EQ(report.batches, (std::vector<Index>{2, 2, 2, 2, 2, 2}));
    for (std::size_t b = 0; b + 1 < t.column.size(); ++b)
      EXPECT_EQ(report.batch[b], t.column[b] + 1);
    for (std::size_t k = 0; k < report.keyblocks.size(); ++k) {
      EXPECT_EQ(report.keyblocks[k].batch, static_cast<Index>(k / 2 + 1));
      if (k % 2) {
        EXPECT_LT(report.keyblocks[k - 1].block, report.keyblocks[k].block);
      }
    }
    std::shuffle(order.begin(), order.end(), random);
  }
}

TEST(Batches, StopAtABlockThatFrictionHolds) {
  const KeyblockReport report = find_keyblocks(train(5, 1, ids(5)).blocks, model_with_joints(31));
  EXPECT_TRUE(report.batches.empty());
  EXPECT_EQ(report.block_class[0], BlockClass::stable);
  EXPECT_EQ(report.block_class[5], BlockClass::infinite);
}

/// n³ unit cubes in rock, open above or below.
BlockArrays cubes_in_rock(int n, bool open_above) {
  BlockArraysBuilder builder;
  const Index joint = builder.joint("J"), free = builder.solid_face("free");
  const Vec3 axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (int i = 0; i < n * n * n; ++i) {
    const std::array<int, 3> at{i % n, i / n % n, i / n / n};
    std::vector<Side> sides;
    for (std::size_t d = 0; d < 3; ++d) {
      const bool top = d == 2 && open_above && at[d] == n - 1,
                 bottom = d == 2 && !open_above && at[d] == 0;
      sides.push_back({axes[d], (at[d] + 1) * axes[d], top ? free : joint});
      sides.push_back({-axes[d], at[d] * axes[d], bottom ? free : joint});
    }
    builder.block(test::convex_block(sides));
  }
  builder.rock();
  return builder.blocks;
}

TEST(Batches, OfARoofRiseLayerByLayer) {
  const KeyblockReport report = find_keyblocks(cubes_in_rock(3, false), model_with_joints(30));
  EXPECT_EQ(report.batches, (std::vector<Index>{9, 9, 9}));
  for (std::size_t b = 0; b < 27; ++b) EXPECT_EQ(report.batch[b], static_cast<Index>(b / 9 + 1));
}

TEST(Batches, OfAFloorAreNone) {
  const KeyblockReport report = find_keyblocks(cubes_in_rock(3, true), model_with_joints(0));
  EXPECT_TRUE(report.keyblocks.empty());
  for (std::size_t b = 0; b < 27; ++b)
    EXPECT_EQ(report.block_class[b], b < 18 ? BlockClass::tapered : BlockClass::stable);
}

// A slab lies on rock and on a block that slides away: the cohesion of what is left under it is too
// little.
TEST(Batches, APartlyFreedFaceHoldsByWhatIsLeft) {
  const Real sine = 0.5, cosine = std::sqrt(0.75);
  BlockArrays blocks;
  blocks.origins = {
      {.kind = FaceOrigin::Kind::joint, .name = "bed", .joint_material = 0},
      {.kind = FaceOrigin::Kind::joint, .name = "slick", .joint_material = 1},
      {.kind = FaceOrigin::Kind::solid_face, .name = "free", .solid = 0, .solid_face = 0},
      {.kind = FaceOrigin::Kind::solid_face,
       .name = "rock",
       .solid = 0,
       .solid_face = 1,
       .continues = true}};
  const Vec3 n{-sine, 0, -cosine};
  // Faces: slab 0 (under), 1 (free); block 2 (over), 3 (under), 4 (free); rock 5 (to slab), 6 (to
  // block), 7.
  blocks.face_begin = {0, 2, 5, 8};
  blocks.face_normal = {n, -n, -n, n, {1, 0, 0}, -n, -n, {0, 0, -1}};
  blocks.face_area = {2, 2, 1, 1, 1, 1, 1, 1};
  blocks.face_origin = {0, 2, 0, 1, 2, 0, 1, 3};
  blocks.volume = {1, 1, 1};
  blocks.mass = {2000, 2000, 2000};
  blocks.centroid = {{}, {}, {}};
  blocks.finite = {1, 1, 0};
  blocks.material = {0, 0, 0};
  blocks.interfaces = {{.block = {0, 1}, .face = {0, 2}, .area = 1},
                       {.block = {0, 2}, .face = {0, 5}, .area = 1},
                       {.block = {1, 2}, .face = {3, 6}, .area = 1}};
  Model model =
      model_with_joints(0, 7000);  // the slab drives with 9810 N: 2 m² hold it, 1 m² does not
  model.joint_materials.emplace_back().name = "slick";
  const KeyblockReport report = find_keyblocks(blocks, model);
  EXPECT_EQ(report.batch, (std::vector<Index>{2, 1, 0}));
  ASSERT_EQ(report.keyblocks.size(), 2u);
  EXPECT_NEAR(report.keyblocks[1].sliding_force, 9810 - 7000, 1e-9);
  EXPECT_NEAR(report.keyblocks[1].free_area, 3, 1e-12);
}

/// A model in which every load acts.
Model loaded_model(Real friction_angle) {
  Model model = model_with_joints(friction_angle, 2000);
  model.joint_materials[0].normal_stiffness = 2e9;
  model.joint_materials[0].shear_stiffness = 1e9;
  model.support->water_pressure = 1500;
  model.support->seismic_coefficient = {0.05, -0.1, 0.02};
  PointLoad load;
  load.force = {2e4, -1e4, 1e4};
  model.point_loads.push_back(load);
  Water water;
  water.joints = {"J1"};
  water.level = WaterTable{{0, 0, 6}, upward(20, 40)};
  model.waters.push_back(water);
  model.support->clamping = true;
  model.initial_stress.any = true;
  model.initial_stress.at = {-3e4, -2e4, -6e4, 5e3, -4e3, 0};
  return model;
}

// Lifting, sliding and rotation of the wedge, and its support, whichever way the model looks.
TEST(Keyblocks, OfATurnedModelAreTheSame) {
  std::set<SlidingMode> modes;
  std::mt19937_64 random(29);
  std::normal_distribution<Real> normal;
  for (const bool rotation : {false, true})
    for (int trial = 0; trial < 100; ++trial) {
      BlockArrays blocks = wedge_in_a_slope();
      Model model = loaded_model(20);
      model.point_loads[0].point = blocks.centroid[0] + Vec3{0.2, -0.1, 0.1};
      model.support->rotation = rotation;
      if (trial % 3 == 0) model.support->water_pressure = 2e5;
      const Keyblock before = find_keyblocks(blocks, model).keyblocks.at(0);
      const Vec3 axis = normalized({normal(random), normal(random), normal(random)});
      const Real angle = 180 * normal(random);
      test::turn(blocks, model, axis, angle);
      const Keyblock after = find_keyblocks(blocks, model).keyblocks.at(0);
      modes.insert(before.mode);
      EXPECT_EQ(after.mode, before.mode);
      EXPECT_EQ(after.planes, before.planes);
      EXPECT_NEAR(after.sliding_force, before.sliding_force, 1e-10 * before.weight);
      if (std::isfinite(before.factor_of_safety)) {
        EXPECT_NEAR(after.factor_of_safety, before.factor_of_safety, 1e-10);
      }
      EXPECT_NEAR(after.support_force, before.support_force, 1e-10 * before.weight);
      EXPECT_LT(norm(after.direction - test::rotated(before.direction, axis, angle)), 1e-10);
      EXPECT_LT(
          norm(after.support_direction - test::rotated(before.support_direction, axis, angle)),
          1e-10);
    }
  EXPECT_GE(modes.size(), 2u);
}

/// A cube in the open that stands on nothing but a face of the solid.
BlockArrays standing_cube() {
  BlockArraysBuilder builder;
  const Index zmin = builder.solid_face("rock.zmin", 4), other = builder.solid_face("rock.zmax", 5);
  builder.block(test::convex_block({{{0, 0, -1}, {0, 0, 0}, zmin},
                                    {{0, 0, 1}, {0, 0, 1}, other},
                                    {{1, 0, 0}, {1, 0, 0}, other},
                                    {{-1, 0, 0}, {0, 0, 0}, other},
                                    {{0, 1, 0}, {0, 1, 0}, other},
                                    {{0, -1, 0}, {0, 0, 0}, other}}));
  return builder.blocks;
}

TEST(JointFacesOnly, LetsABlockFallThroughAFixedFaceUnlessFalse) {
  Model model = model_with_joints(30);
  Fixed fixed;
  fixed.where = FaceRegion{.solid = 0, .faces = {4}};
  model.fixed.push_back(fixed);
  EXPECT_EQ(find_keyblocks(standing_cube(), model).block_class[0], BlockClass::key);
  model.support->joint_faces_only = false;
  EXPECT_EQ(find_keyblocks(standing_cube(), model).block_class[0], BlockClass::infinite);
  model.fixed.clear();
  EXPECT_EQ(find_keyblocks(standing_cube(), model).block_class[0], BlockClass::key);
}

TEST(Loads, AnEarthquakeMovesABlockThatFrictionHeld) {
  Model model = model_with_joints(31);
  const BlockArrays blocks = train(1, 1, ids(1)).blocks;
  EXPECT_TRUE(find_keyblocks(blocks, model).keyblocks.empty());
  model.support->seismic_coefficient = {0.1, 0, 0};
  const auto report = find_keyblocks(blocks, model);
  ASSERT_EQ(report.keyblocks.size(), 1u);
  const Keyblock& key = report.keyblocks[0];
  const Real c = std::sqrt(0.75), driving = 0.5 + 0.1 * c, normal = c - 0.05;
  EXPECT_NEAR(key.sliding_force / key.weight, driving - normal * std::tan(radians(31)), 1e-12);
}

TEST(Loads, WithoutAnyNothingMoves) {
  Model model = model_with_joints(0);
  model.gravity = {};
  EXPECT_TRUE(find_keyblocks(train(3, 1, ids(3)).blocks, model).keyblocks.empty());
}

TEST(Keyblocks, AreNoneAmongBlocksThatAreNotFinite) {
  BlockArrays blocks = train(1, 1, ids(1)).blocks;
  blocks.finite[0] = 0;
  EXPECT_EQ(find_keyblocks(blocks, model_with_joints(0)).block_class[0], BlockClass::infinite);
}

TEST(Keyblocks, OfNoBlocksAreNone) {
  EXPECT_TRUE(find_keyblocks(BlockArrays{}, model_with_joints(0)).batches.empty());
  BlockArrays blocks;
  blocks.face_begin = {0};
  EXPECT_TRUE(find_keyblocks(blocks, model_with_joints(0)).keyblocks.empty());
}

}  // namespace
}  // namespace rockfold
