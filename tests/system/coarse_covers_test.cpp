#include "src/system/coarse_covers.hpp"

#include <map>
#include <set>

#include <gtest/gtest.h>

#include "tests/solve/systems/joints.hpp"

namespace rockfold {
namespace {

using solve::CoarseCovers;
using solve::coarsen_covers;

TEST(CoarseCovers, OfAnUncutLatticeAreTheLatticeOfDoubledSpacing) {
  const SmallSystem s = uncut_system(9, 6, 5);
  const auto places = solve::half_places(s.covers());
  const CoarseCovers coarse = coarsen_covers(s.covers(), 1000).front();
  // Five cells of doubled spacing lie over nine, three over five: they overhang.
  ASSERT_EQ(coarse.count(), 6 * 4 * 4);
  for (std::size_t p = 0; p < places.size(); ++p) {
    Real sum = 0;
    std::array<Real, 3> place{};
    int odd = 0;
    for (int d = 0; d < 3; ++d) odd += places[p][d] / 2 % 2;
    EXPECT_EQ(coarse.parent_begin[p + 1] - coarse.parent_begin[p], 1 << odd);
    for (Index k = coarse.parent_begin[p]; k < coarse.parent_begin[p + 1]; ++k) {
      sum += coarse.weight[k];
      for (int d = 0; d < 3; ++d)
        place[d] += coarse.weight[k] * 2 * coarse.place[coarse.parent[k]][d];
    }
    EXPECT_EQ(sum, 1);  // trilinear weights reproduce linear fields, here the place itself
    for (int d = 0; d < 3; ++d) EXPECT_EQ(place[d], places[p][d]);
  }
  Index couplings = 0;  // 3 in each direction, 2 at the ends
  for (Index p = 0; p < coarse.count(); ++p)
    couplings += coarse.column_begin[p + 1] - coarse.column_begin[p];
  EXPECT_EQ(couplings, (3 * 6 - 2) * (3 * 4 - 2) * (3 * 4 - 2));
}

TEST(CoarseCovers, ShrinkUntilEveryPartIsSmall) {
  const auto levels = coarsen_covers(uncut_system(16, 16, 16).covers(), 64);
  ASSERT_EQ(levels.size(), 3U);
  EXPECT_EQ(levels[1].count(), 125);
  EXPECT_EQ(levels[2].count(), 27);
  EXPECT_EQ(largest_part(levels[2]), 27);
}

TEST(CoarseCovers, AreNeverSharedByTwoBodies) {
  const SmallSystem s = cut_system();
  const auto levels = coarsen_covers(s.covers(), 1);
  std::vector<std::set<Index>> bodies;
  for (Index body : s.covered.cover_body) bodies.push_back({body});
  for (const CoarseCovers& coarse : levels) {
    std::vector<std::set<Index>> next(coarse.place.size());
    for (std::size_t p = 0; p < bodies.size(); ++p)
      for (Index k = coarse.parent_begin[p]; k < coarse.parent_begin[p + 1]; ++k)
        next[coarse.parent[k]].insert(bodies[p].begin(), bodies[p].end());
    bodies = next;
    for (const auto& found : bodies) EXPECT_EQ(found.size(), 1U);
    const auto part = connected_parts(coarse);
    EXPECT_EQ(std::set<Index>(part.begin(), part.end()).size(), 2U);
  }
}

/// A joint through the midst that ends inside the rock on all sides.
TEST(CoarseCovers, StayApartWhereAJointIsOpenAndAreOneWhereItEnds) {
  const auto open = [](Index i, Index j, Index k) {
    return k == 8 && i > 2 && i < 14 && j > 2 && j < 14;
  };
  const SmallSystem s = held_cube(16, open);
  const auto levels = coarsen_covers(s.covers(), 64);
  ASSERT_GE(levels.size(), 2U);
  Index spacing = 2;
  for (std::size_t l = 0; l < 2; ++l, spacing *= 2) {
    std::map<solve::HalfPlace, int> covers;
    for (const auto& place : levels[l].place) ++covers[place];
    for (const auto& [place, count] : covers) {
      const Index i = place[0] / 2 * spacing, j = place[1] / 2 * spacing,
                  k = place[2] / 2 * spacing;
      // Apart where the joint goes through all of the coarse star.
      const auto inside = [&](Index a) { return a - spacing >= 2 && a + spacing <= 14; };
      const bool apart = k == 8 && inside(i) && inside(j);
      const bool whole = k != 8 || i < 2 || i > 14 || j < 2 || j > 14;
      if (apart) {
        EXPECT_EQ(count, 2) << l << ": " << i << " " << j << " " << k;
      } else if (whole) {
        EXPECT_EQ(count, 1) << l << ": " << i << " " << j << " " << k;
      }
    }
  }
}

}  // namespace
}  // namespace rockfold
