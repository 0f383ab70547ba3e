#include "src/run/rigid_motion.hpp"

#include <gtest/gtest.h>

#include "kernels/integrate/moments.hpp"
#include "src/base/vector.hpp"
#include "src/run/records/block_stress.hpp"
#include "src/space/shape_functions.hpp"
#include "tests/reference/box_covers.hpp"

namespace rockfold {
namespace {

constexpr Vec3 low{0.05, 0.02, 0.03}, high{2.1, 1.3, 1.2};
const Vec3 velocity{1, -2, 0.5}, spin{0.3, 0.7, -1.1};

/// Two welded boxes of unlike densities, or two of their own; block 1 lies on block 0.
reference::CoveredRegions two_boxes(Index body_of_second) {
  const Vec3 middle{high[0], high[1], 0.6}, middle_low{low[0], low[1], 0.6};
  return reference::cover_regions(
      reference::turned_lattice({0.11, -0.23, 0.37}, 0.45, 0.3, 0.2, {1, 0.6, 0.6}, 1.5),
      {reference::box(low, middle, 0, 0, 0),
       reference::box(middle_low, high, 1, 1, body_of_second)});
}

const std::vector<ElasticMaterial> materials{{2000, 1e8, 0.2}, {3000, 1e8, 0.2}};

/// A point of the material for covers of any order.
MaterialPoints point_of(const reference::CoveredRegions& covered, const Vec3& x, Index body) {
  MaterialPoints point;
  add_material_point(covered.arrays, x, reference::locate(covered, {x}, body).element[0], point);
  return point;
}

TEST(InitialMotion, IsRigidAboutTheMassCentreWithCoversOfAnyOrder) {
  for (int order = 0; order < 3; ++order) {
    auto covered = two_boxes(0);
    const PieceMoments moments = piece_moments(covered.arrays);
    covered.arrays.order = order;
    const StateArrays state =
        initial_motion(covered.arrays, moments, materials, {{{0, 1}, velocity, spin}});
    ASSERT_EQ(state.velocity.size(), std::size_t(covered.arrays.unknown_count()));
    // Heights 0.57 and 0.6 of densities 2 and 3.
    const Vec3 centre{(low[0] + high[0]) / 2, (low[1] + high[1]) / 2,
                      (2 * 0.57 * 0.315 + 3 * 0.6 * 0.9) / (2 * 0.57 + 3 * 0.6)};
    for (const Vec3& x : {Vec3{0.3, 0.4, 0.2}, Vec3{2, 1.2, 1.1}, Vec3{1, 0.1, 0.7}}) {
      const Vec3 v = interpolate(point_of(covered, x, 0), 0, state.velocity);
      EXPECT_NEAR(norm(v - (velocity + cross(spin, x - centre))), 0, 1e-11) << order;
    }
  }
}

TEST(InitialMotion, MovesTheBlocksItNamesAlone) {
  const auto covered = two_boxes(1);
  const StateArrays state = initial_motion(covered.arrays, piece_moments(covered.arrays), materials,
                                           {{{1}, velocity, {}}});
  const Vec3 below = interpolate(point_of(covered, {1, 0.5, 0.3}, 0), 0, state.velocity);
  const Vec3 above = interpolate(point_of(covered, {1, 0.5, 0.9}, 1), 0, state.velocity);
  EXPECT_EQ(norm(below), 0);
  EXPECT_NEAR(norm(above - velocity), 0, 1e-14);
}

TEST(Reactions, OfAConditionAreForceAndMomentOfItsPoints) {
  const auto covered = two_boxes(0);
  const std::vector<Vec3> points{{0.3, 0.4, 0.2}, {2, 1.2, 1.1}, {1, 0.1, 0.7}};
  FixedPoints fixed = reference::fix(
      covered, points, [](const Vec3&) { return Vec3{}; }, 1, false);
  fixed.condition = {1, 0, 1};
  const std::vector<Vec3> forces{{1, 2, 3}, {-4, 5, 6}, {7, -8, 9}};
  const auto sums = sum_reactions(covered.arrays, fixed, forces, {}, 3);
  ASSERT_EQ(sums.size(), 3u);
  EXPECT_NEAR(norm(sums[0].force - forces[1]), 0, 1e-12);
  EXPECT_NEAR(norm(sums[0].moment - cross(points[1], forces[1])), 0, 1e-12);
  EXPECT_NEAR(norm(sums[1].force - (forces[0] + forces[2])), 0, 1e-12);
  EXPECT_NEAR(norm(sums[1].moment - (cross(points[0], forces[0]) + cross(points[2], forces[2]))), 0,
              1e-12);
  EXPECT_EQ(norm(sums[2].force), 0);
}

/// Volumes of 2:1, say, and a stress that is the height of each element's centroid: the mean over a box is its mid-height.
TEST(BlockStress, IsTheMeanOverTheVolume) {
  const auto covered = two_boxes(1);
  const CoverArrays& covers = covered.arrays;
  const PieceMoments moments = piece_moments(covers);
  std::vector<Stress> stress(covers.element_count());
  for (Index e = 0; e < covers.cut_count(); ++e) {
    Real volume = 0, height = 0;
    for (Index q = covers.piece_begin[e]; q < covers.piece_begin[e + 1]; ++q) {
      volume += moments.volume[q];
      height += moments.first[q][2] +
                moments.volume[q] * covers.lattice.cell_centre(covers.element_cell[e])[2];
    }
    stress[6 * covers.regular_count() + e][2] = height / volume;
  }
  for (Index r = 0; r < covers.regular_count(); ++r)
    for (int t = 0; t < 6; ++t)  // the mean over the six is the cell's
      stress[6 * r + t][2] = covers.lattice.cell_centre(covers.regular_cell[r])[2];
  const auto means = average_block_stress(covers, moments, stress, 2);
  EXPECT_NEAR(means[0][2], (0.03 + 0.6) / 2, 1e-12);
  EXPECT_NEAR(means[1][2], (0.6 + 1.2) / 2, 1e-12);
  EXPECT_EQ(means[0][0], 0);
}

}  // namespace
}  // namespace rockfold
