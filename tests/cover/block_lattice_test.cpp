// Lattices of kind `block`: which pieces are tried for a point, and what moves with which block.
#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "host/cover/lattice/piece_index.hpp"
#include "host/cover/points/locate.hpp"
#include "tests/cover/covers.hpp"

namespace rockfold::test {
namespace {

/// Off the origin, cut by three sets of planes about a metre apart.
Model jointed_box(const Vec3& size) {
  const Vec3 corner{3, -2, 5};
  Model model = box_model(corner, corner + size);
  add_set(model, DipOrientation{60, 90}, 1, {0.01, 0.02, 0.03});
  add_set(model, DipOrientation{70, 200}, 1.1, {0.01, 0.02, 0.03});
  add_set(model, DipOrientation{20, 320}, 0.9, {0.01, 0.02, 0.03});
  return model;
}

CoverSpec block_lattice() {
  CoverSpec spec;
  spec.lattice = LatticeKind::block;
  spec.order = 1;
  return spec;
}

/// Two materials, welded at half of the height: joints cut both.
Covered two_layers() {
  Model model = jointed_box({4, 3, 2});
  model.solids.push_back(box_solid("upper", {3, -2, 7}, {7, 1, 9}));
  model.solids.back().material = 1;
  model.cover = block_lattice();
  model.materials = {{"rock", 2700, 30e9, 0.25, {}}, {"soft", 2500, 10e9, 0.25, {}}};
  Covered c{std::move(model), {}, {}};
  c.blocks = cut(c.model);
  Progress silent;
  c.covering = build_covers(c.blocks.cutting, c.model, silent);
  return c;
}

Vec3 piece_centre(const CoverArrays& a, Index q) {
  Vec3 sum{};
  for (Index v = a.vertex_begin[q]; v < a.vertex_begin[q + 1]; ++v) sum += vertex(a, v);
  return a.lattice.cell_centre(a.piece_block[q]) +
         (1.0 / (a.vertex_begin[q + 1] - a.vertex_begin[q])) * sum;
}

/// How many pieces are tried for the centres of all pieces, a piece in the mean.
Real tried(const Covered& c) {
  const CoverArrays& a = c.arrays();
  std::size_t sum = 0;
  for (Index q = 0; q < a.piece_count(); ++q) {
    const std::vector<Index> near = c.covering.pieces->piece_tree.at(piece_centre(a, q));
    EXPECT_TRUE(std::binary_search(near.begin(), near.end(), q));
    sum += near.size();
  }
  return static_cast<Real>(sum) / a.piece_count();
}

// The boxes of neighbours overlap: some two hold a centre.
TEST(BlockLattice, TriesAsManyPiecesForAPointHoweverManyBlocksThereAre) {
  const Covered small = cover(jointed_box({5, 5, 5}), block_lattice());
  const Covered large = cover(jointed_box({13, 13, 13}), block_lattice());
  EXPECT_GT(large.arrays().piece_count(), 10 * small.arrays().piece_count());
  EXPECT_LT(tried(large), 3);
  EXPECT_LT(tried(small), 3);
}

TEST(BlockLattice, PointsAreFoundInTheirOwnPiece) {
  const Covered c = two_layers();
  const CoverArrays& a = c.arrays();
  std::vector<Vec3> centres;
  for (Index q = 0; q < a.piece_count(); ++q) centres.push_back(piece_centre(a, q));
  const MaterialPoints points = locate_points(c.covering, centres);
  for (Index q = 0; q < a.piece_count(); ++q)
    EXPECT_EQ(points.element[q], c.covering.pieces->piece_element[q]);
}

TEST(BlockLattice, WhatABlockHasOfAMaterialIsAnElement) {
  const Covered c = two_layers();
  const CoverArrays& a = c.arrays();
  std::set<std::pair<Index, Index>> seen;  // block, material
  for (Index e = 0; e < a.cut_count(); ++e)
    EXPECT_TRUE(seen.emplace(a.element_cell[e], a.element_material[e]).second);
  EXPECT_GT(a.cut_count(), a.cover_count());
  EXPECT_EQ(a.cover_count(), c.blocks.arrays.block_count());
}

TEST(BlockLattice, VerticesMoveWithTheirOwnBlock) {
  const Covered c = two_layers();
  const CoverArrays& a = c.arrays();
  const BlockArrays& blocks = c.blocks.arrays;
  const MaterialPoints points = locate_block_vertices(c.covering, blocks);
  ASSERT_EQ(points.size(), blocks.vertex.size());
  for (Index b = 0; b < blocks.block_count(); ++b)
    for (Index v = blocks.vertex_begin[b]; v < blocks.vertex_begin[b + 1]; ++v) {
      ASSERT_NE(points.element[v], none);
      EXPECT_EQ(a.element_cell[points.element[v]], b);
      EXPECT_EQ(a.cover_node[points.unknown[points.begin[v]]], b);
      const bool upper = a.element_material[points.element[v]] == 1;
      EXPECT_TRUE(upper ? blocks.vertex[v][2] > 7 - 1e-6 : blocks.vertex[v][2] < 7 + 1e-6);
    }
}

/// Five planes within 1e-8 m of one point: corners nearer than the tolerance (1.7e-8 m) are one vertex.
TEST(BlockLattice, VerticesThatStandForSeveralCornersMoveWithTheirBlockAndLieInIt) {
  Model model = box_model({0, 0, 0}, {10, 10, 10});
  add_joint(model, DipOrientation{30.1, 197.6}, {5, 5, 5.00000001});
  add_joint(model, DipOrientation{57.2, 116.9}, {5, 5, 5.000000001});
  add_joint(model, DipOrientation{82.6, 85.8}, {5, 5, 5});
  add_joint(model, DipOrientation{70.4, 236.8}, {5, 5, 5});
  add_joint(model, DipOrientation{50.4, 134.7}, {5, 5, 5.000000001});
  const Covered c = cover(model, block_lattice());
  const BlockArrays& blocks = c.blocks.arrays;
  const MaterialPoints points = locate_block_vertices(c.covering, blocks);
  for (Index b = 0; b < blocks.block_count(); ++b)
    for (Index v = blocks.vertex_begin[b]; v < blocks.vertex_begin[b + 1]; ++v) {
      EXPECT_EQ(points.element[v], b);
      EXPECT_TRUE(Locator(c.covering).find(blocks.vertex[v], b).found());
    }
}

/// Two solids of different materials whose faces are 1e-9 m apart, and a joint there: what lies between has no element of its own.
TEST(BlockLattice, SliversBelongToAnElementOfTheirBlock) {
  Model model = box_model({0, 0, 0}, {2, 2, 2});
  model.solids.push_back(box_solid("upper", {0, 0, 2}, {2, 2, 4}));
  model.solids.back().material = 1;
  add_joint(model, Vec3{0, 0, 1}, {0, 0, 2 + 2e-9});
  model.cover = block_lattice();
  model.materials = {{"rock", 2700, 30e9, 0.25, {}}, {"soft", 2500, 10e9, 0.25, {}}};
  const Cutting cutting = cut(model).cutting;
  ASSERT_EQ(cutting.complex->block_count, 2);
  ASSERT_EQ(cutting.complex->cells.size(), 3);
  Progress silent;
  const CoverArrays a = build_covers(cutting, model, silent).arrays;
  EXPECT_EQ(a.cut_count(), 2);
  EXPECT_EQ(a.piece_count(), 3);
}

TEST(BlockLattice, HoldsOfAFixedBlockItsOwnUnknownsAlone) {
  Model model = jointed_box({4, 3, 2});
  for (const Vec3& x : {Vec3{4.1, -1.2, 6.3}, Vec3{5.7, 0.1, 5.9}, Vec3{6.2, 0.4, 6.6}}) {
    Fixed fixed;
    fixed.where = BlockRegion{x};
    fixed.components = {true, true, true};
    model.fixed.push_back(fixed);
  }
  const Covered c = cover(model, block_lattice());
  const CoverArrays& a = c.arrays();
  const FixedPoints f = fixed_points(c.blocks.cutting, c.covering, c.model);
  ASSERT_EQ(f.points.size(), 12u);  // four functions each
  for (std::size_t n = 0; n < 12; ++n) {
    const Index cover = f.points.unknown[f.points.begin[n]] % a.cover_count();
    EXPECT_EQ(f.points.begin[n + 1] - f.points.begin[n], 1);
    EXPECT_EQ(f.points.element[n], cover);
    EXPECT_EQ(f.condition[n], static_cast<Index>(n / 4));
  }
}

}  // namespace
}  // namespace rockfold::test
