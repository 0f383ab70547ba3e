// Joints with one block on both sides: covers go on across them where blocks touch each other, and end at them elsewhere.
#include <optional>

#include <gtest/gtest.h>

#include "tests/cover/covers.hpp"

namespace rockfold::test {
namespace {

/// A box from 0 to 4 that a plane cuts in two; `crack`: and an oblique rectangle in the upper block, wide enough to part stars of 2 m.
Model two_blocks(bool crack) {
  Model model = box_model({0, 0, 0}, {4, 4, 4});
  add_joint(model, DipOrientation{11, 40}, {2.1, 1.9, 1.1});
  if (!crack) return model;
  add_joint(model, Vec3{0.8, 0, 0.6}, {2, 0, 2});
  model.joints[1].polygon = {{2.9, -1, 0.8}, {2.9, 5, 0.8}, {0.95, 5, 3.4}, {0.95, -1, 3.4}};
  return model;
}

Covered covered(Model model, LatticeKind kind, std::optional<AnalysisType> type,
                JointTips tips = JointTips::keep) {
  if (type) {
    model.analysis.emplace();
    model.analysis->stages[0].type = *type;
  }
  CoverSpec spec = spacing(1);
  spec.lattice = kind;
  spec.joint_tips = tips;
  return cover(std::move(model), spec);
}

const LatticeKind kinds[] = {LatticeKind::tet5, LatticeKind::tet6, LatticeKind::tet6_kuhn,
                             LatticeKind::tet24, LatticeKind::hex8};

TEST(DeadEnds, HealWhereBlocksTouch) {
  for (const LatticeKind kind : kinds)
    for (const AnalysisType type : {AnalysisType::quasi_static, AnalysisType::dynamic})
      for (const JointTips tips : {JointTips::keep, JointTips::extend}) {
        const Covered without = covered(two_blocks(false), kind, type),
                      with = covered(two_blocks(true), kind, type, tips);
        ASSERT_EQ(with.blocks.arrays.block_count(), 2);
        EXPECT_GT(with.blocks.arrays.dead_end_area[0] + with.blocks.arrays.dead_end_area[1], 10);
        EXPECT_EQ(with.arrays().cover_node, without.arrays().cover_node) << lattice_name(kind);
      }
}

TEST(DeadEnds, PartCoversWhereBlocksDoNotTouch) {
  for (const LatticeKind kind : kinds)
    for (const std::optional<AnalysisType>& type :
         {std::optional<AnalysisType>{}, std::optional{AnalysisType::static_}})
      EXPECT_GT(covered(two_blocks(true), kind, type).arrays().cover_count(),
                covered(two_blocks(false), kind, type).arrays().cover_count())
          << lattice_name(kind);
}

/// There is no other block to touch.
TEST(DeadEnds, PartTheCoversOfALoneBlock) {
  const auto lone = [](bool crack) {
    Model model = two_blocks(crack);
    model.joints.erase(model.joints.begin());
    return covered(std::move(model), LatticeKind::tet6, AnalysisType::dynamic);
  };
  EXPECT_GT(lone(true).arrays().cover_count(), lone(false).arrays().cover_count());
}

}  // namespace
}  // namespace rockfold::test
