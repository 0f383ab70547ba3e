// [cut] specks = "merge": blocks far smaller than the others go to a neighbour.
#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "src/base/vector.hpp"
#include "tests/cut/models/sample_models.hpp"
#include "tests/cut/oracles/complex_check.hpp"

namespace rockfold::test {
namespace {

const std::vector<std::string> no_faults;

Blocks cut_merging(Model model, std::optional<Real> min_volume = {}) {
  model.cut.specks = Specks::merge;
  model.cut.min_volume = min_volume;
  Blocks blocks = cut(model);
  EXPECT_EQ(faults_of(blocks.complex()), no_faults);
  EXPECT_NEAR(sum(blocks.arrays.volume) / blocks.cutting.totals.solid_volume, 1, 1e-12);
  return blocks;
}

const SpeckReport& report_of(const Blocks& blocks) {
  return *blocks.cutting.totals.specks;
}

Index block_at(const BlockArrays& a, const Vec3& centroid) {
  for (Index b = 0; b < a.block_count(); ++b)
    if (norm(a.centroid[b] - centroid) < 1e-9) return b;
  return none;
}

/// Three planes that miss a common line by `gap`: x = 2, z = 2 and x + z = 4 + gap, in a box of 4 m. Between them lies a prism with
/// two sides of `gap` and the third, on the inclined plane, of √2 gap.
Model three_planes(Real gap) {
  Model model = box_model({0, 0, 0}, {4, 4, 4});
  add_joint(model, Vec3{1, 0, 0}, {2, 0, 2});
  add_joint(model, Vec3{0, 0, 1}, {2, 0, 2});
  add_joint(model, Vec3{1, 0, 1}, {2 + gap, 0, 2});
  return model;
}

TEST(Specks, AreKeptUnlessTheModelSaysOtherwise) {
  const Blocks blocks = cut(three_planes(1e-3));
  EXPECT_EQ(blocks.arrays.block_count(), 7);
  EXPECT_FALSE(blocks.cutting.totals.specks);
}

// The prism of 2e-6 m³ is a fifth of a millionth of the mean block of 64/7 m³. Beyond its largest side lies the rest of the quarter.
TEST(Specks, GoToTheNeighbourWithWhichTheyShareMostArea) {
  const Blocks blocks = cut_merging(three_planes(1e-3));
  const BlockArrays& a = blocks.arrays;
  ASSERT_EQ(a.block_count(), 6);
  EXPECT_NEAR(report_of(blocks).limit, 1e-6 * 64 / 7, 1e-18);
  ASSERT_EQ(report_of(blocks).merged.size(), 1u);
  const Speck& speck = report_of(blocks).merged[0];
  EXPECT_NEAR(speck.volume, 2e-6, 1e-12);
  EXPECT_NEAR(speck.centroid[0], 2 + 1e-3 / 3, 1e-9);
  EXPECT_TRUE(report_of(blocks).left.empty());
  const Index quarter = block_at(a, {3, 2, 3});  // whole again: x and z from 2 to 4
  ASSERT_NE(quarter, none);
  EXPECT_EQ(speck.block, quarter);
  EXPECT_NEAR(a.volume[quarter], 16, 1e-12);
  EXPECT_EQ(face_count(a, quarter), 6);
  EXPECT_TRUE(a.convex[quarter]);
  EXPECT_EQ(a.dead_end_area[quarter], 0);
}

// The number of a speck is that which its block has where it is kept.
TEST(Specks, KeepTheNumberThatTheyHadAsBlocks) {
  const Model model = three_planes(1e-3);
  const Blocks kept = cut(model), merged = cut_merging(model);
  const Speck& speck = report_of(merged).merged.at(0);
  EXPECT_EQ(kept.arrays.volume[speck.id], speck.volume);
  EXPECT_LT(norm(kept.arrays.centroid[speck.id] - speck.centroid), 1e-12);
}

TEST(Specks, AreThoseBelowTheVolumeThatIsGiven) {
  EXPECT_EQ(cut_merging(three_planes(1e-3), 1e-6).arrays.block_count(), 7);
  EXPECT_EQ(cut_merging(three_planes(1e-3), 3e-6).arrays.block_count(), 6);
  EXPECT_EQ(cut_merging(three_planes(0.1)).arrays.block_count(), 7);
  const Blocks coarse = cut_merging(three_planes(0.1), 0.03);
  EXPECT_EQ(coarse.arrays.block_count(), 6);
  EXPECT_TRUE(report_of(coarse).limit_is_given);
}

// Two planes 1e-6 m apart: the slice between them shares as much with either side.
Model slice_at(Real x) {
  Model model = box_model({0, 0, 0}, {8, 1, 1});
  for (const Real at : {x, x + 1e-6}) add_joint(model, Vec3{1, 0, 0}, {at, 0, 0});
  return model;
}

TEST(Specks, BetweenEqualAreasGoToTheLargerBlock) {
  EXPECT_NEAR(cut_merging(slice_at(3)).arrays.volume[0], 3, 1e-12);  // not 3.000001
  EXPECT_NEAR(cut_merging(slice_at(5)).arrays.volume[0], 5.000001, 1e-12);
}

TEST(Specks, BetweenEqualBlocksGoToTheLowerCentroid) {
  EXPECT_NEAR(cut_merging(slice_at(4 - 0.5e-6)).arrays.volume[0], 4 + 0.5e-6, 1e-12);
}

// Ten slices on each other: those within touch no others than specks.
TEST(Specks, BehindSpecksGoWithThem) {
  Model model = box_model({0, 0, 0}, {8, 1, 1});
  for (int i = 0; i <= 10; ++i) add_joint(model, Vec3{1, 0, 0}, {3 + 1e-7 * i, 0, 0});
  const Blocks blocks = cut_merging(model);
  ASSERT_EQ(blocks.arrays.block_count(), 2);
  EXPECT_EQ(report_of(blocks).merged.size(), 10u);
  EXPECT_DOUBLE_EQ(blocks.cutting.totals.joint_area, 1);
  EXPECT_EQ(blocks.cutting.totals.dangling_joint_area, 0);
}

// 27 dice of a millimetre in the corner of a cube of a metre.
TEST(Specks, InACornerBecomeOneWithTheBlockOutsideIt) {
  Model model = box_model({0, 0, 0}, {1, 1, 1});
  for (const Vec3& normal : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}})
    add_set(model, normal, 1e-3, 2e-3 * normal, 3);  // at 1, 2 and 3 mm
  const Blocks blocks = cut_merging(model, 1e-7);
  EXPECT_TRUE(report_of(blocks).left.empty());
  EXPECT_EQ(report_of(blocks).merged.size(), 27u);
  EXPECT_EQ(blocks.arrays.block_count(), 64 - 27);
}

TEST(Specks, WithoutANeighbourStay) {
  Model model = box_model({0, 0, 0}, {4, 4, 4});
  model.solids.push_back(box_solid("pebble", {6, 0, 0}, {6.001, 0.001, 0.001}));
  const Blocks blocks = cut_merging(model);
  EXPECT_EQ(blocks.arrays.block_count(), 2);
  EXPECT_TRUE(report_of(blocks).merged.empty());
  EXPECT_EQ(report_of(blocks).left,
            std::vector<Index>{block_at(blocks.arrays, {6.0005, 0.0005, 0.0005})});
}

// A heading of x > 2, and a joint that cuts a slice of 1e-6 m off its face: what stays and what goes never are one.
TEST(Specks, StayInTheirStageOfExcavation) {
  Model model = box_model({0, 0, 0}, {8, 1, 1});
  Excavation heading;
  heading.name = "heading";
  heading.stage = 1;
  heading.shape = BoxShape{{2, 0, 0}, {8, 1, 1}};
  model.excavations.push_back(heading);
  for (const Real at : {2 + 1e-6, 2 - 2e-6}) {
    model.joints.clear();
    add_joint(model, Vec3{1, 0, 0}, {at, 0, 0});
    const Blocks blocks = cut_merging(model);
    ASSERT_EQ(blocks.arrays.block_count(), 2);
    EXPECT_NEAR(blocks.arrays.volume[0], 2, 1e-12);
    EXPECT_EQ(blocks.arrays.stage, (std::vector<Index>{0, 1}));
  }
}

// Beside a lining with an interface; the joint leaves a slice of rock between them that has only the lining as a neighbour over the
// larger area, and takes the rock above it over the smaller.
TEST(Specks, StayInTheirSolid) {
  Model model = box_model({0, 0, 0}, {1, 1, 1});
  model.joint_materials.resize(1);
  model.solids.push_back(box_solid("lining", {1, 0, 0}, {3, 1, 1}));
  model.solids[1].interface = 0;
  add_joint(model, Vec3{1, 0, 0}, {1 - 1e-7, 0, 0});
  Blocks blocks = cut_merging(model);
  ASSERT_EQ(blocks.arrays.block_count(), 2);
  EXPECT_NEAR(blocks.arrays.volume[0], 1, 1e-12);  // although the lining is larger
  // Where rock is no more than that slice there is no other rock.
  model.solids[0] = box_solid("rock", {1 - 1e-7, 0, 0}, {1, 1, 1});
  model.joints.clear();
  blocks = cut_merging(model);
  EXPECT_EQ(blocks.arrays.block_count(), 2);
  EXPECT_EQ(report_of(blocks).left.size(), 1u);
}

// A slice at a face beyond which the rock goes on would make a removable block immovable.
TEST(Specks, ThatContinueGoToBlocksThatDo) {
  Model model = box_model({0, 0, 0}, {8, 1, 1});
  model.solids[0].continues[0] = true;  // x = 0
  add_joint(model, Vec3{1, 0, 0}, {1e-6, 0, 0});
  Blocks blocks = cut_merging(model);
  ASSERT_EQ(blocks.arrays.block_count(), 2);
  EXPECT_EQ(blocks.arrays.finite, (std::vector<std::uint8_t>{0, 1}));
  EXPECT_EQ(report_of(blocks).left, std::vector<Index>{0});
  // One that does not continue may go to a block that does.
  add_joint(model, Vec3{1, 0, 0}, {7, 0, 0});
  add_joint(model, Vec3{1, 0, 0}, {5, 0, 0});
  add_joint(model, Vec3{1, 0, 0}, {5 - 1e-6, 0, 0});
  model.joints.erase(model.joints.begin());
  blocks = cut_merging(model);
  EXPECT_NEAR(blocks.arrays.volume[0], 5, 1e-12);
  EXPECT_EQ(blocks.arrays.finite, (std::vector<std::uint8_t>{0, 1, 1}));
  EXPECT_TRUE(report_of(blocks).left.empty());
}

// Two joints cut the prism in three, the middle one a wedge that goes to one of the others before both go out of the prism: what is left of
// the joints between the three is no dead end.
TEST(Specks, LeaveNoDeadEndsBehind) {
  Model model = three_planes(1e-3);
  add_joint(model, Vec3{0, 1, 0}, {0, 2, 0});
  add_joint(model, Vec3{0, 1, 0.2}, {0, 2, 2});
  const Blocks blocks = cut_merging(model, 1e-5);
  EXPECT_EQ(report_of(blocks).merged.size(), 3u);
  EXPECT_EQ(blocks.cutting.totals.dangling_joint_area, 0);
}

}  // namespace
}  // namespace rockfold::test
