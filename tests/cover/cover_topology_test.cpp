// Physical covers are the connected parts of the stars (thesis 2.3): an uncut star gives one cover, a star cut in m parts m.
#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "tests/cover/covers.hpp"

#ifdef _OPENMP
#include <omp.h>
#endif

namespace rockfold::test {
namespace {

std::set<Index> nodes(const CoverArrays& a) {
  return {a.cover_node.begin(), a.cover_node.end()};
}

std::set<Index> covers_of_block(const CoverArrays& a, Index block) {
  std::set<Index> covers;
  for (Index r = 0; r < a.regular_count(); ++r)
    if (a.regular_block[r] == block)
      covers.insert(a.regular_cover.begin() + 8 * r, a.regular_cover.begin() + 8 * (r + 1));
  for (Index e = 0; e < a.cut_count(); ++e)
    if (a.piece_block[a.piece_begin[e]] == block)
      covers.insert(a.element_cover.begin() + 4 * e, a.element_cover.begin() + 4 * (e + 1));
  return covers;
}

TEST(Covers, OfUncutRockAlignedWithTheLatticeAreItsNodes) {
  const Covered c = cover(box_model({0, 0, 0}, {4, 6, 2}), spacing(1));
  EXPECT_EQ(c.arrays().regular_count(), 48);
  EXPECT_EQ(c.arrays().cut_count(), 0);
  EXPECT_EQ(c.arrays().cover_count(), 5 * 7 * 3);
}

TEST(Covers, OfBlocksAlignedWithTheLatticeAreEachBlocksOwnNodes) {
  Model model = box_model({0, 0, 0}, {4, 4, 4});
  add_set(model, DipOrientation{0, 0}, 2, {0, 0, 0});
  add_set(model, DipOrientation{90, 0}, 2, {0, 0, 0});
  const Covered c = cover(model, spacing(1));
  EXPECT_EQ(c.arrays().regular_count(), 64);
  EXPECT_EQ(c.arrays().cover_count(), 4 * 5 * 3 * 3);
  EXPECT_EQ(nodes(c.arrays()).size(), 125u);
}

TEST(Covers, CutByOneJointAreOneOnEitherSideOfIt) {
  Model model = box_model({0, 0, 0}, {4, 4, 4});
  add_joint(model, Vec3{1, 0, 0}, {2.1, 0, 0});
  const Covered c = cover(model, spacing(1));
  // Nodes at x = 0 … 3 see the left block (0 … 2.1), nodes at x = 2, 3, 4 the right one; 25 of each x.
  EXPECT_EQ(covers_of_block(c.arrays(), 0).size() + covers_of_block(c.arrays(), 1).size(),
            7u * 25u);
  EXPECT_EQ(c.arrays().cover_count(), 7 * 25);
}

TEST(Covers, OfWeldedJointsAreThoseOfTheRockWithoutJoints) {
  const Model intact = box_model({0, 0, 0}, {5, 4, 3});
  Model jointed = intact;
  add_set(jointed, DipOrientation{60, 100}, 0.9, {0.3, 0, 0});
  add_set(jointed, DipOrientation{0, 0}, 1, {0, 0, 0.5});
  add_set(jointed, DipOrientation{90, 90}, 1.25, {0, 0, 0});  // some of them on lattice planes
  CoverSpec welded = spacing(0.5);
  welded.origin = Vec3{0, 0, 0};
  const Covered plain = cover(intact, welded);
  welded.joints = JointTreatment::welded;
  const Covered c = cover(jointed, welded);
  EXPECT_GT(c.blocks.arrays.block_count(), 20);
  EXPECT_EQ(c.arrays().element_count(), plain.arrays().element_count());
  EXPECT_EQ(c.arrays().cover_node, plain.arrays().cover_node);
  EXPECT_NEAR(total_volume(c.arrays()), 60, 60e-13);
}

TEST(Covers, OfTwoLimbsOfOneBlockInOneStarAreTwo) {
  // A slot 0.2 wide and open at the top: above its bottom the stars of the nodes beside it hold two limbs.
  Model model = box_model({0, 0, 0}, {4, 4, 4});
  model.solids.push_back(box_solid("slot", {1.9, -1, 2}, {2.1, 5, 5}, false));
  const Covered c = cover(model, spacing(1));
  EXPECT_EQ(c.blocks.arrays.block_count(), 1);
  std::map<Index, int> count;
  for (const Index n : c.arrays().cover_node) ++count[n];
  for (const auto& [node, covers] : count) {
    const auto ijk = c.arrays().lattice.node_ijk(node);
    const Vec3 x = c.arrays().lattice.node_position(ijk);
    const bool beside_slot = std::abs(x[0] - 2) < 0.5;
    EXPECT_EQ(covers, beside_slot && x[2] > 2.5 ? 2 : 1) << x[0] << ' ' << x[1] << ' ' << x[2];
  }
}

TEST(Covers, OfSolidsOfTwoMaterialsSideBySideAreShared) {
  Model model = box_model({0, 0, 0}, {2.3, 2, 2});
  model.solids.push_back(box_solid("lining", {2.3, 0, 0}, {4, 2, 2}));
  model.solids[1].material = 1;
  model.materials.resize(2);
  model.cover = spacing(1);
  model.cover->origin = Vec3{0, 0, 0};
  const Blocks blocks = cut(model);
  Progress silent;
  const CoverArrays a = build_covers(blocks.cutting, model, silent).arrays;
  EXPECT_EQ(blocks.arrays.block_count(), 1);
  EXPECT_EQ(a.cover_count(), 5 * 3 * 3);
  for (Index e = 0; e < a.cut_count(); ++e) EXPECT_EQ(a.piece_begin[e + 1] - a.piece_begin[e], 1);
}

// Random slope-like model: inclined joints, a notch, a lattice with an odd origin.
Model random_model(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<Real> unit(0, 1);
  Model model = box_model({0, 0, 0}, {5, 4, 3});
  model.solids.push_back(box_solid("notch", {3, -1, 1.5}, {6, 5, 4}, false));
  for (int j = 0; j < 8; ++j)
    add_joint(model, DipOrientation{90 * unit(random), 360 * unit(random)},
              {5 * unit(random), 4 * unit(random), 3 * unit(random)});
  return model;
}

TEST(Covers, KeepTheVolumeOfEachBlock) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    CoverSpec spec = spacing(0.43);
    spec.origin = Vec3{0.01, 0.02, 0.03};
    const Covered c = cover(random_model(seed), spec);
    std::vector<Real> volume(c.blocks.arrays.block_count(), 0);
    for (Index r = 0; r < c.arrays().regular_count(); ++r)
      volume[c.arrays().regular_block[r]] += lattice_cell_volume(c.arrays());
    for (Index q = 0; q < c.arrays().piece_count(); ++q)
      volume[c.arrays().piece_block[q]] += piece_volume(c.arrays(), q);
    for (std::size_t b = 0; b < volume.size(); ++b)
      EXPECT_NEAR(volume[b], c.blocks.arrays.volume[b], 1e-12) << seed;
  }
}

// Independent of how connect() works: a cover belongs to one block, and all elements round one node of a block that are
// joined by facets with area (found here by comparing piece faces in double precision) share a cover.
TEST(Covers, AreNeverSharedByTwoBlocks) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const Covered c = cover(random_model(seed), spacing(0.61));
    std::set<Index> seen;
    for (Index b = 0; b < c.blocks.arrays.block_count(); ++b)
      for (const Index p : covers_of_block(c.arrays(), b))
        EXPECT_TRUE(seen.insert(p).second) << seed;
    EXPECT_EQ(static_cast<Index>(seen.size()), c.arrays().cover_count()) << seed;
  }
}

TEST(Covers, OfConvexBlocksAreOnePerNodeAndBlock) {
  // The star of a node is convex, so is its part in a convex block: one cover for each node and block that meet.
  for (unsigned seed = 1; seed <= 10; ++seed) {
    Model model = random_model(seed);
    model.solids.pop_back();
    const Covered c = cover(model, spacing(0.61));
    for (Index b = 0; b < c.blocks.arrays.block_count(); ++b) {
      std::set<Index> at;
      for (const Index p : covers_of_block(c.arrays(), b))
        EXPECT_TRUE(at.insert(c.arrays().cover_node[p]).second) << seed;
    }
  }
}

TEST(Covers, AreTheSameForAnyNumberOfThreadsAndOrderOfJoints) {
#ifdef _OPENMP
  const int before = omp_get_max_threads();
  Model model = random_model(3);
  omp_set_num_threads(1);
  const Covered one = cover(model, spacing(0.43));
  std::reverse(model.joints.begin(), model.joints.end());
  omp_set_num_threads(4);
  const Covered four = cover(model, spacing(0.43));
  omp_set_num_threads(before);
  EXPECT_EQ(one.arrays().cover_node, four.arrays().cover_node);
  EXPECT_EQ(one.arrays().element_cover, four.arrays().element_cover);
  EXPECT_EQ(one.arrays().regular_cover, four.arrays().regular_cover);
  EXPECT_EQ(one.arrays().vertex_xyz, four.arrays().vertex_xyz);
  EXPECT_EQ(one.arrays().triangle_vertex, four.arrays().triangle_vertex);
#endif
}

TEST(Covers, RefuseALatticeOfMoreNodesThanCanBeNumbered) {
  Model model = box_model({0, 0, 0}, {4, 4, 4});
  EXPECT_THROW(cover(model, spacing(1e-4)), Error);
}

}  // namespace
}  // namespace rockfold::test
