#include "src/run/records/block_motion.hpp"

#include <gtest/gtest.h>

#include "kernels/integrate/moments.hpp"
#include "src/base/vector.hpp"
#include "tests/reference/box_covers.hpp"
#include "tests/solve/systems/spaces.hpp"

namespace rockfold {
namespace {

class BlockAverages : public testing::TestWithParam<Space> {};
INSTANTIATE_TEST_SUITE_P(EveryLattice, BlockAverages, testing::ValuesIn(spaces(true)), space_name);

/// Two blocks that turn together by a small rotation vector: each is displaced as its centroid and turned by that vector.
TEST_P(BlockAverages, OfARigidMotionAreItsRotationAndTheDisplacementOfTheCentroid) {
  const auto [kind, order] = GetParam();
  Lattice lattice =
      reference::turned_lattice({0.11, -0.23, 0.37}, 0.4, 0.3, 0.2, {0.57, 0.5, 0.46}, 0.9);
  lattice.kind = kind;
  if (kind == LatticeKind::block) {
    lattice.cells = {0, 0, 0};
    lattice.block_origin = {{0.3, 0.4, 0.4}, {0.8, 0.6, 0.5}};
  }
  auto covered =
      reference::cover_regions(lattice, {reference::box({0, 0, 0}, {0.5, 0.9, 0.8}, 0, 0, 0),
                                         reference::box({0.5, 0, 0}, {1.1, 0.9, 0.8}, 0, 1, 1)});
  CoverArrays& a = covered.arrays;
  a.order = order;
  const Vec3 shift{0.3, -0.2, 0.1}, turn{1e-3, 2e-3, -3e-3};
  const auto motion = [&](const Vec3& x) { return shift + cross(turn, x); };
  std::vector<Vec3> d = reference::sample_at_nodes(a, motion);
  if (kind == LatticeKind::block)  // the gradient stands in the cover's own linear functions
    for (Index p = 0; p < 2; ++p)
      for (int k = 0; k < 3; ++k) d[(1 + k) * 2 + p] = cross(turn, lattice.edge[k]);
  const auto blocks = average_block_motion(a, piece_moments(a), d, 2);
  const Vec3 centroid[2] = {{0.25, 0.45, 0.4}, {0.8, 0.45, 0.4}};
  const Real volume[2] = {0.5 * 0.9 * 0.8, 0.6 * 0.9 * 0.8};
  for (int b = 0; b < 2; ++b) {
    EXPECT_NEAR(blocks[b].volume, volume[b], 1e-12);
    EXPECT_LE(norm(blocks[b].displacement - motion(centroid[b])), 1e-12);
    EXPECT_LE(norm(blocks[b].rotation - turn), 1e-12);
  }
  // The corner that moves furthest, found among the vertices of elements.
  const LargestDisplacement largest = find_largest_displacement(a, piece_moments(a), d);
  Real most = 0;
  for (int c = 0; c < 8; ++c)
    most = std::max(most, norm(motion({1.1 * (c & 1), 0.9 * (c >> 1 & 1), 0.8 * (c >> 2)})));
  EXPECT_NEAR(largest.length, most, 1e-12);
}

/// A block of 1e-6 of its neighbour's volume is rock as well, not a sliver.
TEST(LargestDisplacement, OfASmallBlockBesideALargeOneIsFound) {
  for (const LatticeKind kind : {LatticeKind::block, LatticeKind::tet6}) {
    Lattice lattice = reference::turned_lattice({-0.3, -0.3, -0.3}, 2, 0, 0, {0.5, 0.5, 0.5}, 0.9);
    lattice.kind = kind;
    if (kind == LatticeKind::block) {
      lattice.cells = {0, 0, 0};
      lattice.block_origin = {{0.5, 0.5, 0.5}, {1.005, 0.005, 0.005}};
    }
    auto covered =
        reference::cover_regions(lattice, {reference::box({0, 0, 0}, {1, 1, 1}, 0, 0, 0),
                                           reference::box({1, 0, 0}, {1.01, 0.01, 0.01}, 0, 1, 1)});
    CoverArrays& a = covered.arrays;
    std::vector<Vec3> d(a.unknown_count(), Vec3{});
    for (Index e = 0; e < a.cut_count(); ++e)
      if (a.piece_block[a.piece_begin[e]] == 1)
        for (int k = 0; k < a.nodes_per_part(); ++k)
          d[a.element_cover[a.nodes_per_part() * e + k]] = {0, 0, -2};
    const LargestDisplacement largest = find_largest_displacement(a, piece_moments(a), d);
    EXPECT_EQ(largest.block, 1);
    EXPECT_NEAR(largest.length, 2, 1e-9);
  }
}

}  // namespace
}  // namespace rockfold
