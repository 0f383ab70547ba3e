// Loads of whole models: water by pressure, table and head, forces at points.
#include <cmath>

#include <gtest/gtest.h>

#include "host/keyblock/bodies.hpp"
#include "host/keyblock/keyblock.hpp"
#include "src/base/vector.hpp"
#include "tests/keyblock/models/half_space_block.hpp"

namespace rockfold {
namespace {

using test::model_with_joints;
using test::radians;

constexpr Real weight_of_water = 1000 * 9.81;

/// A box [0,2]×[0,3]×[1,5] that leans on rock at its west side (joint "back") and below ("base").
BlockArrays leaning_box() {
  test::BlockArraysBuilder builder;
  const Index back = builder.joint("back"), base = builder.joint("base"),
              free = builder.solid_face("free");
  const Vec3 low{0, 0, 1}, high{2, 3, 5};
  builder.block(test::convex_block({{{-1, 0, 0}, low, back},
                                    {{1, 0, 0}, high, free},
                                    {{0, -1, 0}, low, free},
                                    {{0, 1, 0}, high, free},
                                    {{0, 0, -1}, low, base},
                                    {{0, 0, 1}, high, free}}));
  builder.rock();
  return builder.blocks;
}

RockBody body_under(const Model& model) {
  const auto blocks = leaning_box();
  return Bodies(blocks, model).body({0}, {0, 0});
}

/// Water that no edge drains: hydrostatic all over.
Water held_in() {
  Water water;
  water.drains = false;
  return water;
}

/// Water on the faces of a name.
Real water_on(const RockBody& body, const Vec3& normal) {
  Real sum = 0;
  for (const BlockFace& face : body.faces)
    if (norm(face.normal - normal) < 1e-12) sum += norm(face.water);
  return sum;
}

Model wet_model(const Water& water) {
  Model model = model_with_joints(30);
  model.waters.push_back(water);
  return model;
}

TEST(Water, BelowATableIsHydrostaticWhereNoEdgeDrains) {
  Water water = held_in();
  water.level = WaterTable{{100, 100, 4}, {0, 0, 1}};  // 3 m deep at the base, 1 m of the back dry
  const RockBody body = body_under(wet_model(water));
  EXPECT_NEAR(water_on(body, {-1, 0, 0}), weight_of_water * 3 * 3 / 2 * 3, 1e-6);
  EXPECT_NEAR(water_on(body, {0, 0, -1}), weight_of_water * 3 * 6, 1e-6);
  // Moments about the centroid (1, 1.5, 3): the back's push acts 1 m above the base.
  EXPECT_NEAR(body.moment[1], weight_of_water * 13.5 * (2 - 3), 1e-6);
  EXPECT_NEAR(body.moment[0], 0, 1e-6);
}

TEST(Water, ByItsHeadIsThatOfALevelTable) {
  Water head, table;
  head.level = WaterHead{4};
  table.level = WaterTable{{0, 0, 4}, {0, 0, 1}};
  const RockBody a = body_under(wet_model(head)), b = body_under(wet_model(table));
  EXPECT_NEAR(water_on(a, {-1, 0, 0}), water_on(b, {-1, 0, 0}), 1e-6);
  EXPECT_NEAR(water_on(a, {0, 0, -1}), water_on(b, {0, 0, -1}), 1e-6);
}

TEST(Water, BelowAnInclinedTableGoesByTheVerticalDepth) {
  Water water =
      held_in();  // through z = 9 at x = 0, 45° down to +x: depth at the base from 8 to 6 m
  water.level = WaterTable{{0, 0, 9}, test::upward(45, 90)};
  EXPECT_NEAR(water_on(body_under(wet_model(water)), {0, 0, -1}), weight_of_water * 7 * 6, 1e-5);
}

TEST(Water, OfNamedJointsIsTheirsAlone) {
  Water back, others;
  back.joints = {"back"};
  back.level = WaterPressure{5e3};
  others.level = WaterPressure{1e3};
  Model model = wet_model(back);
  model.support->water_pressure = 700;
  EXPECT_NEAR(water_on(body_under(model), {-1, 0, 0}), 5e3 * 12, 1e-9);
  EXPECT_NEAR(water_on(body_under(model), {0, 0, -1}), 700 * 6, 1e-9);
  model.waters.push_back(others);
  EXPECT_NEAR(water_on(body_under(model), {0, 0, -1}), 1e3 * 6, 1e-9);
}

// The base drains at the front, x = 2: from γ·3 m at its back to nothing. The ends y = 0 and 3 are those of a slice.
TEST(Water, FallsToNothingWhereTheBaseDrains) {
  Water water;
  water.level = WaterHead{4};
  const RockBody body = body_under(wet_model(water));
  EXPECT_NEAR(water_on(body, {-1, 0, 0}), weight_of_water * 3 * 3 / 2 * 3, 1e-6);
  EXPECT_NEAR(water_on(body, {0, 0, -1}), weight_of_water * 3 / 2 * 6, 1e-6);
  // About (1, 1.5, 3): the back's push 1 m above the base, the uplift a third of the way from the back.
  EXPECT_NEAR(body.moment[1], weight_of_water * (13.5 * (2 - 3) + 9 * (1 - 2 / 3.0)), 1e-6);
  EXPECT_NEAR(body.moment[0], 0, 1e-6);
}

TEST(Water, HasThePressureOfAPondWhereItMeetsOne) {
  Water water;
  water.level = WaterHead{4};
  Model model = wet_model(water);
  Traction pond;
  pond.where = PlaneRegion{{2, 0, 0}, {1, 0, 0}, 1e-9};
  pond.pressure = true;
  pond.head = 2;  // 1 m above the base
  model.tractions.push_back(pond);
  EXPECT_NEAR(water_on(body_under(model), {0, 0, -1}), weight_of_water * (3 + 1) / 2 * 6, 1e-6);
  model.tractions[0].head = {};  // a pressure that may be water's: nothing drains there
  model.tractions[0].value = {1e4, 0, 0};
  EXPECT_NEAR(water_on(body_under(model), {0, 0, -1}), weight_of_water * 3 * 6, 1e-6);
}

TEST(Water, PushesABlockOff) {
  Water water;
  water.level = WaterTable{{0, 0, 5}, {0, 0, 1}};
  Model model = wet_model(water);
  model.support->rotation = false;
  const auto report = find_keyblocks(leaning_box(), model);
  ASSERT_EQ(report.keyblocks.size(), 1u);
  const Real push = weight_of_water * 8 * 3, uplift = weight_of_water * 4 / 2 * 6;
  const Keyblock& key = report.keyblocks[0];
  EXPECT_EQ(key.mode, SlidingMode::single_plane);
  EXPECT_NEAR(key.driving_force, push, 1e-6);
  EXPECT_NEAR(key.normal_forces.at(0), key.weight - uplift, 1e-6);
}

TEST(PointLoads, ActOnTheBlockThatHoldsThem) {
  Model model = model_with_joints(30);
  PointLoad load;
  load.point = {1, 1.5, 5};  // on the top
  load.force = {1e6, 0, 0};
  model.point_loads.push_back(load);
  model.support->rotation = false;
  const auto report = find_keyblocks(leaning_box(), model);
  ASSERT_EQ(report.keyblocks.size(), 1u);
  EXPECT_NEAR(report.keyblocks[0].driving_force, 1e6, 1e-6);
  model.support->rotation = true;  // its arm about the toe is 4 m, the weight's 1 m
  const auto turning = find_keyblocks(leaning_box(), model);
  EXPECT_EQ(turning.keyblocks.at(0).mode, SlidingMode::rotation);
  EXPECT_NEAR(turning.keyblocks[0].rotations[0].driving, 4e6, 1e-3);
  EXPECT_NEAR(turning.keyblocks[0].rotations[0].resisting, turning.keyblocks[0].weight, 1e-3);
}

TEST(PointLoads, OutsideTheRockAreRefused) {
  Model model = model_with_joints(30);
  PointLoad load;
  load.point = {1, 1.5, 7};
  load.place = {"m.toml", 12, 1, "point_load[1]"};
  model.point_loads.push_back(load);
  try {
    find_keyblocks(leaning_box(), model);
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.diagnostics()[0].place.key, "point_load[1].point");
    EXPECT_EQ(error.diagnostics()[0].place.line, 12);
  }
}

TEST(BlockAt, FindsTheBlockOfAPointInsideAndOnItsBoundary) {
  const auto blocks = leaning_box();
  for (const Vec3& x : {Vec3{1, 1, 2}, Vec3{2, 1, 2}, Vec3{2, 3, 2}, Vec3{2, 3, 5}, Vec3{1, 1, 5}})
    EXPECT_EQ(block_at(blocks, x), 0) << x[0] << " " << x[1] << " " << x[2];
  EXPECT_EQ(block_at(blocks, {2.1, 1, 2}), none);
  EXPECT_EQ(block_at(blocks, {1, 1, 5.001}), none);
}

/// A strip of the east face, x = 2, y from 0 to 3, between two elevations.
Traction on_strip(Real low, Real high) {
  Traction traction;
  traction.where = BoxRegion{{2, 0, low}, {2, 3, high}};
  traction.pressure = true;
  return traction;
}

Model pressed_model(const Traction& traction) {
  Model model = model_with_joints(30);
  model.tractions.push_back(traction);
  return model;
}

TEST(Tractions, OfABoxActOnWhatLiesInIt) {
  Traction strip = on_strip(2, 2.5);
  strip.value = {1e5, 0, 0};
  const RockBody dry = body_under(model_with_joints(30)), body = body_under(pressed_model(strip));
  const Vec3 push = body.load - dry.load;
  EXPECT_NEAR(push[0], -1e5 * 1.5, 1e-6);
  EXPECT_NEAR(norm(push), 1e5 * 1.5, 1e-6);
  // At z = 2.25, 0.75 m below the centroid (1, 1.5, 3).
  EXPECT_NEAR(body.moment[1], -1e5 * 1.5 * -0.75, 1e-6);
  EXPECT_NEAR(body.moment[0], 0, 1e-6);
  EXPECT_NEAR(body.moment[2], 0, 1e-6);
}

TEST(Tractions, UpToAHeadAreHydrostatic) {
  Traction water = on_strip(0, 9);
  water.head = 4;
  const RockBody dry = body_under(model_with_joints(30)), body = body_under(pressed_model(water));
  EXPECT_NEAR((body.load - dry.load)[0], -weight_of_water * 3 * 3 / 2 * 3, 1e-6);
  EXPECT_NEAR(body.moment[1], -weight_of_water * 13.5 * (2 - 3), 1e-6);  // 1 m above the base
}

TEST(Tractions, ThatAreVectorsActAsTheyAreGivenAndTablesAtOneSecond) {
  Traction shear;
  shear.where = PlaneRegion{{0, 0, 5}, {0, 0, 1}, 1e-9};
  shear.table = {{0, 1, 2}, {{0, 0, 0}, {100, -200, 300}, {9, 9, 9}}};
  const RockBody dry = body_under(model_with_joints(30)), body = body_under(pressed_model(shear));
  EXPECT_NEAR(norm(body.load - dry.load - 6.0 * Vec3{100, -200, 300}), 0, 1e-8);
}

TEST(Tractions, OnNoFreeFaceAreRefused) {
  Traction strip = on_strip(6, 7);
  strip.place.key = "traction[1]";
  try {
    body_under(pressed_model(strip));
    FAIL() << "not refused";
  } catch (const Error& error) {
    EXPECT_EQ(error.diagnostics().front().place.key, "traction[1].where");
  }
}

}  // namespace
}  // namespace rockfold
