// Boxes cut by three sets of planes into equal bricks, wherever the box lies and however the planes are given.
#include <cmath>

#include <gtest/gtest.h>

#include "src/base/vector.hpp"
#include "tests/cut/models/sample_models.hpp"
#include "tests/cut/oracles/complex_check.hpp"

namespace rockfold::test {
namespace {

const DipOrientation flat{0, 0}, north{90, 0}, east{90, 90};

Model grid(const Vec3& low, Real edge, Real spacing, const Vec3& origin) {
  Model model = box_model(low, low + Vec3{edge, edge, edge});
  for (const DipOrientation& orientation : {flat, north, east})
    add_set(model, orientation, spacing, origin);
  return model;
}

void expect_bricks(const Blocks& blocks, Index count, Real volume, Real tolerance) {
  const BlockArrays& a = blocks.arrays;
  ASSERT_EQ(a.block_count(), count);
  for (Index b = 0; b < count; ++b) {
    ASSERT_EQ(counts_of(a, b), (Counts{8, 12, 6})) << "block " << b;
    ASSERT_NEAR(a.volume[b], volume, tolerance * volume) << "block " << b;
    ASSERT_TRUE(a.convex[b] && a.genus[b] == 0 && a.shell_count[b] == 1);
  }
  EXPECT_EQ(faults_of(blocks.complex(), {.whole_faces = true}), std::vector<std::string>{});
}

TEST(RegularGrid, OfSpacingOneIsAThousandUnitCubes) {
  const Blocks blocks = cut(grid({0, 0, 0}, 10, 1, {0, 0, 0}));
  expect_bricks(blocks, 1000, 1, 1e-12);
  EXPECT_EQ(blocks.cutting.totals.cells, 1000);
  EXPECT_NEAR(blocks.cutting.totals.joint_area, 27 * 100, 1e-9);
  EXPECT_EQ(blocks.cutting.totals.dangling_joint_area, 0);
  EXPECT_EQ(blocks.arrays.interfaces.size(), 2700u);
  EXPECT_EQ(blocks.cutting.totals.intent.doubts, 0);
}

// Ordered by z, then y, then x.
TEST(RegularGrid, NumbersItsBricksByCentroid) {
  const BlockArrays a = cut(grid({0, 0, 0}, 10, 1, {0, 0, 0})).arrays;
  for (Index b = 0; b < 1000; ++b) {
    const Index x = b % 10, y = b / 10 % 10, z = b / 100;
    const Vec3 expected{x + 0.5, y + 0.5, z + 0.5};
    for (int d = 0; d < 3; ++d) EXPECT_NEAR(a.centroid[b][d], expected[d], 1e-12);
  }
}

// 0.1 is not a double: plane 3 is not at 0.3. The faces at 1 are met to rounding.
TEST(RegularGrid, OfSpacingOneTenthIsAThousandCubes) {
  expect_bricks(cut(grid({0, 0, 0}, 1, 0.1, {0, 0, 0})), 1000, 1e-3, 1e-12);
}

TEST(RegularGrid, MayHaveItsOriginAnywhere) {
  expect_bricks(cut(grid({0, 0, 0}, 10, 1, {3, -7, 1000})), 1000, 1, 1e-12);
  expect_bricks(cut(grid({0, 0, 0}, 1, 0.1, {0.7, 0.3, -0.1})), 1000, 1e-3, 1e-12);
}

// L = 17.3 m: planes are one within 1.7e-9 m. The noise is below that, but far above the rounding of 0 … 10.
TEST(RegularGrid, OfNoisyOriginIsAThousandUnitCubes) {
  expect_bricks(cut(grid({0, 0, 0}, 10, 1, {1e-10, -1e-10, 1e-11})), 1000, 1, 1e-9);
}

TEST(RegularGrid, AtMapCoordinatesIsAThousandUnitCubes) {
  const Vec3 corner{5e6, 4e6, 1e3};
  expect_bricks(cut(grid(corner, 10, 1, corner)), 1000, 1, 1e-12);
  expect_bricks(cut(grid(corner, 10, 1, {0, 0, 0})), 1000, 1, 1e-12);
  // The next double after 5e6 is 9.3e-10 m away: noise of the last digit.
  const Vec3 noisy{std::nextafter(corner[0], 1e9), std::nextafter(corner[1], 0.0), corner[2]};
  expect_bricks(cut(grid(corner, 10, 1, noisy)), 1000, 1, 1e-8);
}

TEST(RegularGrid, MayBeCutByACountOfPlanes) {
  Model model = box_model({0, 0, 0}, {10, 10, 10});
  add_set(model, flat, 2, {5, 5, 5}, 3);  // z = 3, 5, 7
  EXPECT_EQ(cut(model).arrays.block_count(), 4);
  model.joint_sets[0].count = 0;
  EXPECT_EQ(cut(model).arrays.block_count(), 1);
}

TEST(JointsOnTheFacesOfASolid, AddNothing) {
  Model model = box_model({0, 0, 0}, {10, 10, 10});
  add_joint(model, DipOrientation{0, 0}, {3, 3, 0});
  add_joint(model, DipOrientation{0, 0}, {5, 5, 10});
  add_joint(model, DipOrientation{90, 0}, {1, 10, 2});
  add_joint(model, DipOrientation{90, 180}, {1, 0, 2});
  add_joint(model, Vec3{-3, 0, 0}, {10, 4, 4});
  const Blocks blocks = cut(model);
  expect_bricks(blocks, 1, 1000, 1e-13);
  EXPECT_EQ(blocks.cutting.totals.cells, 1);
  EXPECT_EQ(blocks.cutting.totals.joint_area, 0);
  EXPECT_EQ(blocks.cutting.totals.intent.planes_identified, 5);
  for (const Index origin : blocks.arrays.face_origin)
    EXPECT_EQ(blocks.arrays.origins[origin].kind, FaceOrigin::Kind::solid_face);
}

TEST(JointsGivenTwice, AreOne) {
  Model model = box_model({0, 0, 0}, {10, 10, 10});
  add_joint(model, DipOrientation{37, 122}, {5, 5, 5});
  const Blocks once = cut(model);
  add_joint(model, DipOrientation{37, 122}, {5, 5, 5});
  const Blocks twice = cut(model);
  EXPECT_EQ(once.arrays.block_count(), 2);
  EXPECT_EQ(twice.arrays.volume, once.arrays.volume);
  EXPECT_EQ(twice.arrays.vertex, once.arrays.vertex);
  EXPECT_EQ(twice.cutting.totals.joint_area, once.cutting.totals.joint_area);
  EXPECT_EQ(twice.cutting.totals.intent.planes_identified, 1);
}

TEST(JointsThatMissTheSolids, AddNothing) {
  Model model = box_model({0, 0, 0}, {10, 10, 10});
  add_joint(model, DipOrientation{45, 90}, {30, 0, 0});
  add_joint(model, Vec3{1, 1, 1}, {0, 0, 0});    // touches a corner
  add_joint(model, Vec3{1, 1, 0}, {10, 10, 3});  // touches an edge
  const Blocks blocks = cut(model);
  expect_bricks(blocks, 1, 1000, 1e-13);
  EXPECT_EQ(blocks.cutting.totals.joint_area, 0);
}

TEST(JointNormals, MayHaveAnyLength) {
  Model reference = box_model({0, 0, 0}, {1, 2, 3});
  const Vec3 normals[] = {{1, 2, 3}, {-2, 1, 0.5}, {0, 1, -1}};
  for (const Vec3& n : normals) add_joint(reference, n, {0.4, 0.9, 1.3});
  const Blocks expected = cut(reference);
  for (const int exponent : {-660, -400, -3, 5, 400, 660}) {  // up to 1e±200
    Model model = box_model({0, 0, 0}, {1, 2, 3});
    for (const Vec3& n : normals) add_joint(model, std::ldexp(1.0, exponent) * n, {0.4, 0.9, 1.3});
    const Blocks blocks = cut(model);
    const BlockArrays &found = blocks.arrays, &wanted = expected.arrays;
    ASSERT_EQ(found.volume.size(), wanted.volume.size()) << exponent;
    for (std::size_t b = 0; b < wanted.volume.size(); ++b)
      EXPECT_NEAR(found.volume[b], wanted.volume[b], 1e-14 * wanted.volume[b]) << exponent;
    EXPECT_EQ(found.corner_vertex, wanted.corner_vertex) << exponent;
    ASSERT_EQ(found.vertex.size(), wanted.vertex.size()) << exponent;
    for (std::size_t v = 0; v < wanted.vertex.size(); ++v)
      EXPECT_LT(norm(found.vertex[v] - wanted.vertex[v]), 4e-15) << exponent;
  }
  for (const Real length : {1e-200, 1e200}) {
    Model model = box_model({0, 0, 0}, {1, 2, 3});
    for (const Vec3& n : normals) add_joint(model, length * n, {0.4, 0.9, 1.3});
    EXPECT_EQ(cut(model).arrays.block_count(), expected.arrays.block_count()) << length;
  }
}

}  // namespace
}  // namespace rockfold::test
