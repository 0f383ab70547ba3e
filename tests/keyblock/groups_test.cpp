// Blocks that fail together, and stages of excavations.
#include "host/keyblock/groups.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "host/keyblock/keyblock.hpp"
#include "src/base/vector.hpp"
#include "tests/keyblock/models/half_space_block.hpp"

namespace rockfold {
namespace {

using test::model_with_joints;
using test::radians;

/// A row of unit cubes on a plane of dip 40 towards +x; the front one is rough below, the others
/// slick. `ids`: the order in which they are made, 0 = the front.
BlockArrays row_with_a_rough_toe(const std::vector<int>& ids) {
  test::BlockArraysBuilder builder;
  const Index slick = builder.joint("slick", 0), rough = builder.joint("rough", 1),
              cross = builder.joint("cross", 0), free = builder.solid_face("free");
  const Real c = std::cos(radians(40)), s = std::sin(radians(40));
  const Vec3 x{c, 0, -s}, z{s, 0, c}, y{0, 1, 0};
  for (const int column : ids)
    builder.block(test::convex_block({{x, -1.0 * column * x, column == 0 ? free : cross},
                                      {-x, (-1.0 * column - 1) * x, cross},
                                      {y, y, free},
                                      {-y, {}, free},
                                      {-z, {}, column == 0 ? rough : slick},
                                      {z, z, free}}));
  builder.rock();
  return builder.blocks;
}

Model rough_model(Real slick_angle, Real rough_angle, Index largest_group = 8) {
  Model model = model_with_joints(slick_angle);
  model.joint_materials.push_back(model.joint_materials[0]);
  model.joint_materials[1].name = "rough";
  model.joint_materials[1].friction_angle = rough_angle;
  model.support->rotation = false;
  model.support->largest_group = largest_group;
  return model;
}

// Two cubes: T = 2 W sin 40, R = W cos 40 (tan φ_rough + tan φ_slick).
TEST(Groups, OfADriverAndItsToeFailTogether) {
  const auto report = find_keyblocks(row_with_a_rough_toe({0, 1}), rough_model(10, 55));
  ASSERT_EQ(report.keyblocks.size(), 1u);
  const Keyblock& key = report.keyblocks[0];
  EXPECT_EQ(key.members, (std::vector<Index>{0, 1}));
  EXPECT_EQ(report.batch, (std::vector<Index>{1, 1, 0}));
  EXPECT_EQ(report.block_class[0], BlockClass::key);
  EXPECT_EQ(report.block_class[1], BlockClass::key);
  const Real weight = 2000 * 9.81;
  EXPECT_NEAR(key.weight, 2 * weight, 1e-6);
  EXPECT_NEAR(key.driving_force, 2 * weight * std::sin(radians(40)), 1e-6);
  EXPECT_NEAR(key.resisting_force,
              weight * std::cos(radians(40)) * (std::tan(radians(55)) + std::tan(radians(10))),
              1e-6);
  EXPECT_NEAR(key.free_area, 2 * 3 + 1, 1e-9);  // the face between the two is none of the group's
}

TEST(Groups, AreNoneWhereTheToeHoldsThem) {
  EXPECT_TRUE(find_keyblocks(row_with_a_rough_toe({0, 1}), rough_model(30, 60)).keyblocks.empty());
  EXPECT_TRUE(
      find_keyblocks(row_with_a_rough_toe({0, 1}), rough_model(10, 55, 1)).keyblocks.empty());
}

TEST(Groups, TakeAsManyBlocksAsItNeeds) {
  // tan 40 = 0.839; slick tan 38 = 0.781; rough tan 45 = 1: the toe's excess 0.161 needs three drivers
  // of 0.058 each.
  const auto report = find_keyblocks(row_with_a_rough_toe({0, 1, 2, 3, 4}), rough_model(38, 45));
  ASSERT_FALSE(report.keyblocks.empty());
  EXPECT_EQ(report.keyblocks[0].members, (std::vector<Index>{0, 1, 2, 3}));
  EXPECT_EQ(report.batch, (std::vector<Index>{1, 1, 1, 1, 2, 0}));  // the last one then by itself
  EXPECT_TRUE(find_keyblocks(row_with_a_rough_toe({0, 1, 2, 3, 4}), rough_model(38, 45, 3))
                  .keyblocks.empty());
}

TEST(Groups, DoNotDependOnIds) {
  std::mt19937_64 random(3);
  std::vector<int> order{0, 1, 2, 3, 4};
  for (int trial = 0; trial < 20; ++trial) {
    std::shuffle(order.begin(), order.end(), random);
    const auto report = find_keyblocks(row_with_a_rough_toe(order), rough_model(38, 45));
    for (std::size_t b = 0; b < order.size(); ++b) EXPECT_EQ(report.batch[b], order[b] < 4 ? 1 : 2);
  }
}

/// Slabs of 0.7 × 1 × `height` on each other on a plane of dip 25 towards +x; `ids`: from the bed upwards.
BlockArrays stack(const std::vector<int>& ids, Real height) {
  test::BlockArraysBuilder builder;
  const Index bed = builder.joint("bed"), cross = builder.joint("cross"),
              free = builder.solid_face("free");
  const Real c = std::cos(radians(25)), s = std::sin(radians(25));
  const Vec3 x{c, 0, -s}, z{s, 0, c}, y{0, 1, 0};
  const auto top = static_cast<int>(ids.size()) - 1;
  for (const int layer : ids)
    builder.block(
        test::convex_block({{x, 0.7 * x, free},
                            {-x, {}, free},
                            {y, y, free},
                            {-y, {}, free},
                            {-z, (layer * height) * z, layer == 0 ? bed : cross},
                            {z, ((layer + 1) * height) * z, layer == top ? free : cross}}));
  builder.rock();
  return builder.blocks;
}

// One slab stands (b/h/tan ψ = 1.25), two on each other topple as a column of both heights does: 0.63.
TEST(Groups, ThatToppleAsOneAreFound) {
  for (const auto& ids : {std::vector<int>{0, 1}, std::vector<int>{1, 0}}) {
    const auto report = find_keyblocks(stack(ids, 1.2), model_with_joints(80));
    ASSERT_EQ(report.keyblocks.size(), 1u);
    const Keyblock& key = report.keyblocks[0];
    EXPECT_EQ(key.members, (std::vector<Index>{0, 1}));
    EXPECT_EQ(key.mode, SlidingMode::rotation);
    EXPECT_EQ(key.planes, std::vector<std::string>{"bed"});
    EXPECT_NEAR(key.factor_of_safety, 0.7 / (2.4 * std::tan(radians(25))), 1e-9);
    EXPECT_NEAR(key.rotations[0].driving, key.weight * std::sin(radians(25)) * 1.2, 1e-6);
  }
  EXPECT_TRUE(find_keyblocks(stack({0, 1}, 0.7), model_with_joints(80)).keyblocks.empty());
}

// Four: the upper two topple first (as of b/h = 0.7/1.2), then the others.
TEST(Groups, ThatToppleGoByTheSmallestFirst) {
  const auto report = find_keyblocks(stack({0, 1, 2, 3}, 1.2), model_with_joints(80));
  EXPECT_EQ(report.batch, (std::vector<Index>{2, 2, 1, 1, 0}));
}

TEST(Stages, AreExcavatedInTheirOrder) {
  // The toe is excavated at stage 2: what it held slides then, one after the other.
  auto blocks = row_with_a_rough_toe({0, 1, 2});
  blocks.stage = {2, 0, 0, 0};
  const auto report = find_keyblocks(blocks, rough_model(10, 80));
  EXPECT_EQ(report.batches, (std::vector<Index>{1, 1}));
  EXPECT_EQ(report.batch_stage, (std::vector<Index>{2, 2}));
  EXPECT_EQ(report.batch, (std::vector<Index>{0, 1, 2, 0}));
  EXPECT_EQ(report.block_class[0], BlockClass::excavated);
  ASSERT_EQ(report.keyblocks.size(), 2u);
  EXPECT_EQ(report.keyblocks[0].stage, 2);
}

TEST(Stages, RockOfALaterStageHoldsUntilThen) {
  auto blocks = row_with_a_rough_toe({0, 1, 2});
  blocks.stage = {1, 2, 0, 0};
  const auto report = find_keyblocks(blocks, rough_model(10, 10));
  EXPECT_EQ(report.batch, (std::vector<Index>{0, 0, 1, 0}));  // excavated rock never is a key block
  EXPECT_EQ(report.batch_stage, std::vector<Index>{2});
}

TEST(Stages, WhatMovesBeforeAnyExcavationIsOfStageZero) {
  auto blocks = row_with_a_rough_toe({0, 1, 2});
  blocks.stage = {0, 0, 1, 0};
  const auto report = find_keyblocks(blocks, rough_model(10, 10));
  EXPECT_EQ(report.batch, (std::vector<Index>{1, 2, 0, 0}));
  EXPECT_EQ(report.batch_stage, (std::vector<Index>{0, 0}));
  EXPECT_EQ(report.block_class[2], BlockClass::excavated);
}

}  // namespace
}  // namespace rockfold
