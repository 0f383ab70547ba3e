// What pages do block theory again from: geometry and loads of removable blocks, without earthquake and water.
#include "host/keyblock/first_look.hpp"

#include <gtest/gtest.h>

#include "src/base/vector.hpp"
#include "tests/keyblock/models/half_space_block.hpp"

namespace rockfold {
namespace {

using test::model_with_joints;

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

TEST(FirstLook, HoldsTheFacesInContactAndTheirCorners) {
  const FirstLookArrays looks = find_first_looks(leaning_box(), model_with_joints(30));
  ASSERT_EQ(looks.block, std::vector<Index>{0});
  EXPECT_EQ(looks.face_begin, (std::vector<Index>{0, 2}));
  EXPECT_EQ(looks.loop_begin, (std::vector<Index>{0, 1, 2}));
  EXPECT_EQ(looks.corner_begin, (std::vector<Index>{0, 4, 8}));
  EXPECT_DOUBLE_EQ(looks.contact_area[0], 12);
  EXPECT_DOUBLE_EQ(looks.contact_area[1], 6);
  EXPECT_DOUBLE_EQ(looks.share[0], 1);
  EXPECT_DOUBLE_EQ(looks.free_area[0], 2 * 8 + 12 + 6);
  EXPECT_EQ(looks.neighbour, std::vector<Index>{1});
  EXPECT_EQ(looks.looked_at_stage, std::vector<Index>{0});
}

TEST(FirstLook, HoldsInertiaAndContactsToTurnAboutUnlessRotationIsOff) {
  Model model = model_with_joints(30);
  const FirstLookArrays looks = find_first_looks(leaning_box(), model);
  EXPECT_EQ(looks.patch_begin, (std::vector<Index>{0, 2}));
  EXPECT_EQ(looks.patch_corner_begin, (std::vector<Index>{0, 4, 8}));
  const Real mass = looks.mass[0];
  EXPECT_NEAR(looks.inertia[0][0][0], mass / 12 * (3 * 3 + 4 * 4), 1e-9 * mass);
  model.support = SupportSpec{};
  model.support->rotation = false;
  const FirstLookArrays still = find_first_looks(leaning_box(), model);
  EXPECT_TRUE(still.patch_face.empty());
  EXPECT_EQ(still.inertia[0], Mat3{});
}

TEST(FirstLook, HasNoEarthquakeAndNoWaterInItsLoads) {
  Model model = model_with_joints(30);
  Water water;
  water.level = WaterHead{4};
  model.waters.push_back(water);
  model.support = SupportSpec{};
  model.support->seismic_coefficient = {0.2, -0.1, 0};
  model.support->water_pressure = 5e4;
  const FirstLookArrays looks = find_first_looks(leaning_box(), model);
  EXPECT_EQ(looks.load[0], looks.mass[0] * model.gravity);
  EXPECT_EQ(looks.moment[0], Vec3{});
}

TEST(FirstLook, SaysWhetherGroupsMayMove) {
  Model model = model_with_joints(30);
  EXPECT_EQ(find_first_looks(leaning_box(), model).groups_may_move, std::vector<std::uint8_t>{1});
  model.support = SupportSpec{};
  model.support->largest_group = 1;
  EXPECT_EQ(find_first_looks(leaning_box(), model).groups_may_move, std::vector<std::uint8_t>{0});
}

TEST(FirstLook, IsLeftOutWithInSituStress) {
  Model model = model_with_joints(30);
  model.initial_stress.any = true;
  EXPECT_FALSE(has_first_looks(model));
  EXPECT_TRUE(find_first_looks(leaning_box(), model).block.empty());
}

}  // namespace
}  // namespace rockfold
