// Blocks that lean on lips: told by block, joint, area and force.
#include "host/keyblock/thin_contacts.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/keyblock/models/half_space_block.hpp"

namespace rockfold {
namespace {

/// A box [0,2]×[0,3]×[1,5] on a joint "base", whose lower edge along x is cut off by a joint "lip" of 45°, `lip` wide and high.
BlockArrays box_on_a_lip(Real lip) {
  test::BlockArraysBuilder builder;
  const Index base = builder.joint("base"), edge = builder.joint("lip"),
              free = builder.solid_face("free");
  const Vec3 low{0, 0, 1}, high{2, 3, 5};
  const Real half = 1 / std::sqrt(2.0);
  builder.block(test::convex_block({{{0, 0, -1}, low, base},
                                    {{0, -half, -half}, {0, lip, 1}, edge},
                                    {{-1, 0, 0}, low, free},
                                    {{1, 0, 0}, high, free},
                                    {{0, -1, 0}, low, free},
                                    {{0, 1, 0}, high, free},
                                    {{0, 0, 1}, high, free}}));
  builder.rock();
  return builder.blocks;
}

/// Under a gravity of g (0.5, −0.5, −0.7): along x it slides, in y it leans on the lip with 0.5 √2 of m g, on the base with 0.2.
KeyblockReport report_of(const BlockArrays& blocks) {
  Model model = test::model_with_joints(10);
  model.gravity = {0.5 * 9.81, -0.5 * 9.81, -0.7 * 9.81};
  model.support->rotation = false;
  return find_keyblocks(blocks, model);
}

TEST(ThinContacts, AreThoseThatCarryABlockOnLessThanTwoPercentOfItsJoints) {
  const BlockArrays blocks = box_on_a_lip(0.03);
  const auto thin = thin_contacts(report_of(blocks));
  ASSERT_EQ(thin.size(), 1u);
  EXPECT_EQ(thin[0].block, 0);
  EXPECT_EQ(thin[0].joint, "lip");
  const Real area = 2 * 0.03 * std::sqrt(2.0);
  EXPECT_NEAR(thin[0].area, area, 1e-12);
  EXPECT_NEAR(thin[0].share, area / (area + 2 * 2.97), 1e-12);
  EXPECT_NEAR(thin[0].normal_force, blocks.mass[0] * 9.81 * std::sqrt(0.5), 1e-6);
}

TEST(ThinContacts, AreNoneOfAWiderOne) {
  EXPECT_TRUE(thin_contacts(report_of(box_on_a_lip(0.05))).empty());
}

}  // namespace
}  // namespace rockfold
