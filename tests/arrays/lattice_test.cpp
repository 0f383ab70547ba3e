#include "src/arrays/lattice.hpp"

#include <map>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "src/base/vector.hpp"
#include "src/space/shape_functions.hpp"

namespace rockfold {
namespace {

constexpr LatticeKind lattices[] = {LatticeKind::tet5,  LatticeKind::tet5_mixed,
                                    LatticeKind::tet6,  LatticeKind::tet6_kuhn,
                                    LatticeKind::tet24, LatticeKind::hex8};

Vec3 place(const CellSplit& split, const CellPart& part, int a) {
  Vec3 x;
  for (int d = 0; d < 3; ++d) x[d] = 0.5 * split.node[part.node[a]][d] - 0.5;
  return x;
}

Real volume(const CellSplit& split, const CellPart& part) {
  if (part.nodes == 8) return 1;
  const Vec3 o = place(split, part, 0);
  return dot(place(split, part, 1) - o,
             cross(place(split, part, 2) - o, place(split, part, 3) - o)) /
         6;
}

TEST(Splits, FillTheCellOnceWithTheirShare) {
  for (const LatticeKind kind : lattices)
    for (const bool odd : {false, true}) {
      const CellSplit& split = cell_split(kind, odd);
      Real sum = 0;
      for (const CellPart& part : split.part) {
        EXPECT_GT(volume(split, part), 0);
        sum += split.share * volume(split, part);
      }
      EXPECT_NEAR(sum, 1, 1e-14);
    }
}

TEST(Splits, WeightsAreOneAtTheirOwnNodeAndZeroAtTheOthers) {
  for (const LatticeKind kind : lattices)
    for (const bool odd : {false, true}) {
      const CellSplit& split = cell_split(kind, odd);
      for (const CellPart& part : split.part)
        for (int b = 0; b < part.nodes; ++b) {
          const auto weight = part_weights(part, place(split, part, b));
          for (int a = 0; a < part.nodes; ++a) EXPECT_NEAR(weight[a], a == b, 1e-15);
        }
    }
}

TEST(Splits, WeightsSumToOneEverywhere) {
  std::mt19937 random(7);
  std::uniform_real_distribution<Real> unit(-0.5, 0.5);
  for (const LatticeKind kind : lattices)
    for (const CellPart& part : cell_split(kind).part)
      for (int i = 0; i < 20; ++i) {
        const Vec3 eta{unit(random), unit(random), unit(random)};
        Real sum = 0;
        for (const Real w : part_weights(part, eta)) sum += w;
        EXPECT_NEAR(sum, 1, 1e-14);
      }
}

// A facet is the set of its nodes; in a conforming tessellation each inner one belongs to two parts (of one form).
TEST(Splits, OfNeighbouringCellsMeetFacetToFacet) {
  for (const LatticeKind kind :
       {LatticeKind::tet5, LatticeKind::tet6, LatticeKind::tet6_kuhn, LatticeKind::tet24}) {
    Lattice lattice;
    lattice.kind = kind;
    lattice.edge = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    lattice.cells = {3, 3, 3};
    std::map<std::set<Index>, int> facets;
    for (Index c = 0; c < 27; ++c)
      for (const CellPart& part : lattice.split(c).part)
        for (int a = 0; a < 4; ++a) {
          std::set<Index> nodes;
          for (int b = 0; b < 4; ++b)
            if (b != a) nodes.insert(lattice.cell_node(c, part.node[b]));
          ++facets[nodes];
        }
    for (const auto& [nodes, count] : facets) {
      bool outside = false;
      for (int d = 0; d < 3; ++d)
        for (const Real side : {0.0, 3.0}) {
          bool all = true;
          for (const Index n : nodes) all = all && lattice.node_position(n)[d] == side;
          outside = outside || all;
        }
      EXPECT_EQ(count, outside ? 1 : 2);
    }
  }
}

TEST(Lattice, NodesOfACellLieWhereTheSplitSays) {
  Lattice lattice;
  lattice.kind = LatticeKind::tet24;
  lattice.origin = {3, -2, 11};
  lattice.edge = {{{0.5, 0.03, 0.0}, {-0.1, 0.6, 0.05}, {0.04, 0.02, 0.4}}};
  lattice.cells = {2, 3, 4};
  std::set<Index> seen;
  for (Index c = 0; c < 24; ++c)
    for (int n = 0; n < 15; ++n) {
      const Index node = lattice.cell_node(c, n);
      seen.insert(node);
      Vec3 eta;
      for (int d = 0; d < 3; ++d) eta[d] = 0.5 * lattice.split(c).node[n][d] - 0.5;
      const Vec3 x = lattice.node_position(node) - lattice.cell_centre(c);
      const Vec3 back = lattice.to_local(x);
      for (int d = 0; d < 3; ++d) EXPECT_NEAR(back[d], eta[d], 1e-13);
    }
  // corners, faces across each direction, centres
  EXPECT_EQ(seen.size(), 3u * 4 * 5 + (3 * 3 * 4 + 2 * 4 * 4 + 2 * 3 * 5) + 24);
}

}  // namespace
}  // namespace rockfold
