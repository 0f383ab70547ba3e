// What lies behind slivers and narrow voids: rules 4 to 6 on models that can be checked by hand. L is the diagonal of the box of the
// solids that are added; what is narrower than 1e-9·L neither parts nor joins blocks.
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "src/base/vector.hpp"
#include "tests/cut/models/nef_models.hpp"
#include "tests/cut/oracles/conservation.hpp"
#include "tests/cut/oracles/cutting_rules.hpp"

namespace rockfold::test {
namespace {

const Faults no_faults;

// Σ volumes is that of the solids to 1e-12, and each block's shown surface is closed.
Blocks sound_cut(const Model& model) {
  Blocks blocks = cut(model);
  Faults faults;
  check_volumes(blocks, faults);
  check_surfaces(blocks.arrays, faults);
  EXPECT_EQ(faults, no_faults);
  return blocks;
}

Real contact_area(const BlockArrays& a) {
  Real area = 0;
  for (const auto& i : a.interfaces) area += i.area;
  return area;
}

// ---- 1. two boxes with a gap between them

const Real size_of_boxes = std::sqrt(6.0);

// Unit cubes beside each other, `gap` times L apart along x.
Model two_boxes(Real gap) {
  Model model = box_model({0, 0, 0}, {1, 1, 1});
  const Real from = 1 + gap * size_of_boxes;
  model.solids.push_back(box_solid("beside", {from, 0, 0}, {2, 1, 1}));
  return model;
}

const Real narrow_gaps[] = {1e-16, 1e-12, 1e-11, 0.99e-10, 1.01e-10, 3e-10, 0.9e-9};

TEST(NarrowGap, IsWelded) {
  for (const Real gap : narrow_gaps) {
    SCOPED_TRACE(gap);
    const Blocks blocks = sound_cut(two_boxes(gap));
    ASSERT_EQ(blocks.arrays.block_count(), 1);
    EXPECT_NEAR(blocks.arrays.volume[0], 2, 1.01 * gap * size_of_boxes + 1e-15);
    // Twelve corners: four sides are two faces each, since solids name them.
    EXPECT_EQ(counts_of(blocks.arrays, 0), (Counts{12, 20, 10}));
    EXPECT_EQ(blocks.arrays.shell_count[0], 1);
    EXPECT_NEAR(surface_area(blocks.arrays, 0), 10, 1e-8);
    EXPECT_EQ(blocks.cutting.totals.joint_area, 0);
    EXPECT_TRUE(blocks.arrays.interfaces.empty());
  }
}

TEST(NarrowGap, WithAnInterfaceIsOneContact) {
  for (const Real gap : narrow_gaps) {
    SCOPED_TRACE(gap);
    Model model = two_boxes(gap);
    model.joint_materials.resize(2);
    model.solids[1].interface = 1;
    const BlockArrays a = sound_cut(model).arrays;
    ASSERT_EQ(a.block_count(), 2);
    ASSERT_EQ(a.interfaces.size(), 1u);
    EXPECT_NEAR(a.interfaces[0].area, 1, 1e-12);
    for (const Index face : a.interfaces[0].face) {
      EXPECT_EQ(a.origins[a.face_origin[face]].name, "beside.interface");
      EXPECT_EQ(a.origins[a.face_origin[face]].joint_material, 1);
      EXPECT_NEAR(a.face_area[face], 1, 1e-12);
    }
    EXPECT_EQ(sum_of_counts(a), (Counts{16, 24, 12}));
  }
}

TEST(NarrowGap, IsPartedByAJointInIt) {
  for (const Real gap : narrow_gaps) {
    SCOPED_TRACE(gap);
    Model model = two_boxes(gap);
    add_joint(model, Vec3{1, 0, 0}, {1 + 0.5 * gap * size_of_boxes, 0, 0});
    const BlockArrays a = sound_cut(model).arrays;
    ASSERT_EQ(a.block_count(), 2);
    ASSERT_EQ(a.interfaces.size(), 1u);
    EXPECT_NEAR(a.interfaces[0].area, 1, 1e-12);
    for (const Index face : a.interfaces[0].face)
      EXPECT_EQ(a.origins[a.face_origin[face]].name, "F1");
    EXPECT_EQ(sum_of_counts(a), (Counts{16, 24, 12}));
  }
}

// A joint through half of the gap holds nothing apart: the other half is welded.
TEST(NarrowGap, IsWeldedBesideAJointThatEndsInIt) {
  for (const Real gap : narrow_gaps) {
    SCOPED_TRACE(gap);
    Model model = two_boxes(gap);
    const Real x = 1 + 0.5 * gap * size_of_boxes;
    add_corners(model, {{x, -1, -1}, {x, 0.5, -1}, {x, 0.5, 2}, {x, -1, 2}});
    const Blocks blocks = sound_cut(model);
    EXPECT_EQ(blocks.arrays.block_count(), 1);
    EXPECT_TRUE(blocks.arrays.interfaces.empty());
  }
}

TEST(WideGap, IsNoContact) {
  for (const Real gap : {1.1e-9, 1e-8, 1e-6})
    for (const bool interface : {false, true}) {
      SCOPED_TRACE(gap);
      Model model = two_boxes(gap);
      model.joint_materials.resize(1);
      if (interface) model.solids[1].interface = 0;
      const Blocks blocks = sound_cut(model);
      EXPECT_EQ(blocks.arrays.block_count(), 2);
      EXPECT_EQ(sum_of_counts(blocks.arrays), (Counts{16, 24, 12}));
      EXPECT_TRUE(blocks.arrays.interfaces.empty());
    }
}

// ---- 2, 3. joints beside each other, closer than a block is wide

const Real size_of_cube = std::sqrt(3.0);

TEST(JointsBesideEachOther, AreOneContactAndTwiceTheArea) {
  for (const Real apart : {1.01e-10, 5e-10, 0.99e-9}) {
    SCOPED_TRACE(apart);
    Model model = box_model({0, 0, 0}, {1, 1, 1});
    add_joint(model, Vec3{1, 0, 0}, {0.5, 0, 0});
    add_joint(model, Vec3{1, 0, 0}, {0.5 + apart * size_of_cube, 0, 0});
    const Blocks blocks = sound_cut(model);
    ASSERT_EQ(blocks.arrays.block_count(), 2);
    EXPECT_EQ(sum_of_counts(blocks.arrays), (Counts{16, 24, 12}));
    EXPECT_NEAR(contact_area(blocks.arrays), 1, 1e-12);
    EXPECT_EQ(blocks.arrays.interfaces.size(), 1u);
    EXPECT_NEAR(blocks.cutting.totals.joint_area, 2, 1e-12);
    EXPECT_EQ(blocks.cutting.totals.dangling_joint_area, 0);
    EXPECT_TRUE(blocks.arrays.dead_end_block.empty());
  }
}

TEST(JointsBesideEachOther, MayBeAStack) {
  for (const int joints : {3, 8, 40}) {
    SCOPED_TRACE(joints);
    Model model = box_model({0, 0, 0}, {1, 1, 1});
    for (int i = 0; i < joints; ++i)
      add_joint(model, Vec3{1, 0, 0}, {0.5 + 3e-10 * i * size_of_cube, 0, 0});
    const Blocks blocks = sound_cut(model);
    ASSERT_EQ(blocks.arrays.block_count(), 2);
    EXPECT_EQ(sum_of_counts(blocks.arrays), (Counts{16, 24, 12}));
    EXPECT_NEAR(contact_area(blocks.arrays), 1, 1e-12);
    EXPECT_NEAR(blocks.cutting.totals.joint_area, joints, 1e-11);
    EXPECT_EQ(blocks.cutting.totals.intent.slivers, joints - 1);
  }
}

// It ends at y = 1/2; it makes no block, and the contact is whole.
TEST(FiniteJointBesideAThroughGoingOne, MakesNoBlock) {
  for (const Real apart : {-0.99e-9, -5e-10, -1.01e-10, 0.0, 1e-12, 1.01e-10, 5e-10, 0.99e-9}) {
    SCOPED_TRACE(apart);
    Model model = box_model({0, 0, 0}, {1, 1, 1});
    add_joint(model, Vec3{1, 0, 0}, {0.5, 0, 0});
    const Real x = 0.5 + apart * size_of_cube;
    add_corners(model, {{x, -1, -1}, {x, 0.5, -1}, {x, 0.5, 2}, {x, -1, 2}});
    const Blocks blocks = sound_cut(model);
    const BlockArrays& a = blocks.arrays;
    ASSERT_EQ(a.block_count(), 2);
    EXPECT_NEAR(a.volume[0], 0.5, 1.01 * std::abs(apart) * size_of_cube + 1e-15);
    EXPECT_NEAR(contact_area(a), 1, 1e-12);
    for (Index b = 0; b < 2; ++b) {
      EXPECT_NEAR(surface_area(a, b), 4, 1e-8);
      // A face may be in two, where its halves are of two joints.
      const Counts c = counts_of(a, b);
      EXPECT_TRUE(c == (Counts{8, 12, 6}) || c == (Counts{10, 15, 7})) << c;
      EXPECT_TRUE(a.convex[b]);
    }
  }
}

// ---- 4. windows in a joint

// Four strips across the unit cube at z = 1/2, with a window in their middle.
void add_frame(Model& model, Real width_x, Real width_y) {
  const Real x0 = 0.5 - width_x / 2, x1 = 0.5 + width_x / 2, y0 = 0.5 - width_y / 2,
             y1 = 0.5 + width_y / 2;
  const auto strip = [&](Real xa, Real xb, Real ya, Real yb) {
    add_corners(model, {{xa, ya, 0.5}, {xb, ya, 0.5}, {xb, yb, 0.5}, {xa, yb, 0.5}});
  };
  strip(-1, 2, -1, y0);
  strip(-1, 2, y1, 2);
  strip(-1, x0, y0, y1);
  strip(x1, 2, y0, y1);
}

TEST(Window, IsClosedByAPatchCloselyBeforeIt) {
  for (const Real before : {1e-16, 1e-13, 1e-12, 1e-11, 0.99e-10, 1.01e-10, 3e-10, 5e-10, 0.9e-9})
    for (const Real side : {-1.0, 1.0}) {
      SCOPED_TRACE(side * before);
      Model model = box_model({0, 0, 0}, {1, 1, 1});
      add_frame(model, 0.4, 0.4);
      const Real z = 0.5 + side * before * size_of_cube;
      add_corners(model, {{0.2, 0.2, z}, {0.8, 0.2, z}, {0.8, 0.8, z}, {0.2, 0.8, z}});
      const Blocks blocks = sound_cut(model);
      ASSERT_EQ(blocks.arrays.block_count(), 2);
      EXPECT_NEAR(blocks.arrays.volume[0], 0.5, 1.01 * before * size_of_cube);
      EXPECT_NEAR(contact_area(blocks.arrays), 1, 1e-8);
    }
}

// Before it by more than the tolerance, the patch leaves a slot all round.
TEST(Window, StaysOpenBehindAPatchFartherBeforeIt) {
  for (const Real before : {1.1e-9, 1e-8, 1e-6}) {
    SCOPED_TRACE(before);
    Model model = box_model({0, 0, 0}, {1, 1, 1});
    add_frame(model, 0.4, 0.4);
    const Real z = 0.5 + before * size_of_cube;
    add_corners(model, {{0.2, 0.2, z}, {0.8, 0.2, z}, {0.8, 0.8, z}, {0.2, 0.8, z}});
    const Blocks blocks = sound_cut(model);
    EXPECT_EQ(blocks.arrays.block_count(), 1);
    EXPECT_TRUE(blocks.arrays.interfaces.empty());
  }
}

// A patch that covers the window but for a strip.
TEST(Window, StaysOpenBesideAPatchCloselyBeforeIt) {
  for (const Real before : {1e-12, 1e-10, 5e-10}) {
    SCOPED_TRACE(before);
    Model model = box_model({0, 0, 0}, {1, 1, 1});
    add_frame(model, 0.4, 0.4);
    const Real z = 0.5 + before * size_of_cube;
    add_corners(model, {{0.2, 0.2, z}, {0.69, 0.2, z}, {0.69, 0.8, z}, {0.2, 0.8, z}});
    EXPECT_EQ(sound_cut(model).arrays.block_count(), 1);
  }
}

TEST(Window, StaysOpenIfItIsWiderThanTheTolerance) {
  for (const Real width : {1.1e-9, 1e-8, 1e-6})
    for (const bool slot : {false, true}) {
      SCOPED_TRACE(width);
      Model model = box_model({0, 0, 0}, {1, 1, 1});
      add_frame(model, width * size_of_cube, slot ? 0.4 : width * size_of_cube);
      const Blocks blocks = sound_cut(model);
      EXPECT_EQ(blocks.arrays.block_count(), 1);
      EXPECT_NEAR(blocks.cutting.totals.dangling_joint_area, 1, 1e-5);
    }
}

TEST(Window, IsClosedIfItIsNarrower) {
  for (const Real width : {1e-16, 1e-12, 1e-11, 1.01e-10, 3e-10, 0.9e-9})
    for (const bool slot : {false, true}) {
      SCOPED_TRACE(width);
      Model model = box_model({0, 0, 0}, {1, 1, 1});
      add_frame(model, width * size_of_cube, slot ? 0.4 : width * size_of_cube);
      const Blocks blocks = sound_cut(model);
      ASSERT_EQ(blocks.arrays.block_count(), 2);
      EXPECT_NEAR(blocks.arrays.volume[0], 0.5, 1e-14);
      EXPECT_NEAR(contact_area(blocks.arrays), 1, 1e-8);
    }
}

// ---- 5. a box of six rectangles that leaks along its edges

// Unit cube in a cube of 3 m, L = 3·√3: each rectangle ends `leak` times L before its edges; all of it turned by a quarter circle's
// tenths about two axes, or straight.
Model leaking_box(Real leak, bool turned) {
  const Frame straight{{1, 1, 1}, {1, 0, 0}, {0, 1, 0}};
  const Real c = std::cos(0.3), s = std::sin(0.3);
  const Vec3 u = turned ? Vec3{c, s, 0} : straight.u,
             v = turned ? Vec3{-s * c, c * c, s} : straight.v, w = cross(u, v),
             middle{1.5, 1.5, 1.5};
  Model model = box_model({0, 0, 0}, {3, 3, 3});
  const Real half = 0.5 - leak * 3 * size_of_cube;
  const Vec3 axes[] = {u, v, w};
  for (int d = 0; d < 3; ++d)
    for (const Real side : {-0.5, 0.5}) {
      const Vec3 p = half * axes[(d + 1) % 3], q = half * axes[(d + 2) % 3],
                 o = middle + side * axes[d];
      add_corners(model, {o - p - q, o + p - q, o + p + q, o - p + q});
    }
  return model;
}

TEST(LeakingBox, IsClosed) {
  for (const bool turned : {false, true})
    for (const Real leak : {0.0, 1e-16, 1e-15, 1e-14, 1e-13, 1e-12, 1e-11, 0.7e-10, 1e-10}) {
      SCOPED_TRACE(testing::Message() << "leak " << leak << (turned ? ", turned" : ""));
      const Blocks blocks = sound_cut(leaking_box(leak, turned));
      const BlockArrays& a = blocks.arrays;
      ASSERT_EQ(a.block_count(), 2);
      const Index inner = a.volume[0] < a.volume[1] ? 0 : 1;
      EXPECT_NEAR(a.volume[inner], 1, 1e-8);
      EXPECT_EQ(counts_of(a, inner), (Counts{8, 12, 6}));
      EXPECT_EQ(a.shell_count[1 - inner], 2);
      EXPECT_NEAR(contact_area(a), 6, 1e-7);
    }
}

// Leaks are as wide as they are oblique: these are clearly open.
TEST(LeakingBox, IsNoBlockIfItsLeaksAreWide) {
  for (const bool turned : {false, true})
    for (const Real leak : {2e-9, 1e-8, 1e-6}) {
      SCOPED_TRACE(leak);
      EXPECT_EQ(sound_cut(leaking_box(leak, turned)).arrays.block_count(), 1);
    }
}

// ---- 6. skins of rock

// A pit from the top of the unit cube, 0.6 wide and 0.7 deep, but for a skin of rock on it.
TEST(SkinOfRock, IsNoLidOnAPit) {
  for (const Real skin : {0.0, 1e-16, 1e-12, 1e-11, 0.99e-10, 1.01e-10, 3e-10, 0.99e-9}) {
    SCOPED_TRACE(skin);
    Model model = box_model({0, 0, 0}, {1, 1, 1});
    const Real top = 1 - skin * size_of_cube;
    model.solids.push_back(box_solid("pit", {0.2, 0.2, 0.3}, {0.8, 0.8, top}, false));
    const Blocks blocks = sound_cut(model);
    const BlockArrays& a = blocks.arrays;
    ASSERT_EQ(a.block_count(), 1);
    EXPECT_NEAR(a.volume[0], 1 - 0.36 * 0.7, 1e-8);
    EXPECT_EQ(a.shell_count[0], 1);
    EXPECT_EQ(a.genus[0], 0);
    EXPECT_EQ(counts_of(a, 0), (Counts{16, 24, 11}));
    EXPECT_NEAR(surface_area(a, 0), 6 + 4 * 0.6 * 0.7, 1e-8);
  }
}

TEST(SkinOfRock, IsALidIfItIsWiderThanTheTolerance) {
  for (const Real skin : {1.01e-9, 1e-8, 1e-6}) {
    SCOPED_TRACE(skin);
    Model model = box_model({0, 0, 0}, {1, 1, 1});
    const Real top = 1 - skin * size_of_cube;
    model.solids.push_back(box_solid("pit", {0.2, 0.2, 0.3}, {0.8, 0.8, top}, false));
    const BlockArrays a = sound_cut(model).arrays;
    ASSERT_EQ(a.block_count(), 1);
    EXPECT_EQ(a.shell_count[0], 2);
    EXPECT_EQ(counts_of(a, 0), (Counts{16, 24, 12}));
  }
}

// All of a side of the rock but for a skin: nothing of it is left to see.
TEST(SkinOfRock, BesideASlotIsNoWall) {
  for (const Real skin : {1e-12, 1e-11, 1.01e-10, 5e-10}) {
    SCOPED_TRACE(skin);
    Model model = box_model({0, 0, 0}, {1, 1, 1});
    const Real top = 1 - skin * size_of_cube;
    model.solids.push_back(box_solid("slot", {-1, 0.4, 0.3}, {2, 0.6, top}, false));
    const BlockArrays a = sound_cut(model).arrays;
    ASSERT_EQ(a.block_count(), 1);
    EXPECT_EQ(counts_of(a, 0), (Counts{16, 24, 10}));
    EXPECT_EQ(a.genus[0], 0);
  }
}

// ---- rock with no wide rock beside it

// A needle above the rock that touches nothing: it belongs to no other block.
TEST(Speck, IsABlockOfItsOwn) {
  Model model = box_model({0, 0, 0}, {10, 10, 10});
  Solid solid = box_solid("speck", {}, {});
  const Real e = 1e-11;
  solid.shape = MeshShape{"speck.obj", std::make_shared<TriangleSurface>(TriangleSurface{
                                           {{0, 0, 11}, {e, 0, 11}, {0, e, 11}, {0, 0, 12}},
                                           {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}})};
  model.solids.push_back(solid);
  const Blocks blocks = cut(model);
  ASSERT_EQ(blocks.arrays.block_count(), 2);
  EXPECT_EQ(counts_of(blocks.arrays, 0), (Counts{8, 12, 6}));
  EXPECT_NEAR(blocks.arrays.volume[0], 1000, 1e-9);
  EXPECT_NEAR(blocks.arrays.volume[1] / (e * e / 6), 1, 1e-3);
  EXPECT_TRUE(blocks.arrays.interfaces.empty());
}

}  // namespace
}  // namespace rockfold::test
