// Functions of parts against the host's weights and cover functions, which evaluate them without any expansion.
#include "kernels/operator/elements/part_functions.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "kernels/integrate/moments.hpp"
#include "src/base/vector.hpp"
#include "src/space/shape_functions.hpp"

namespace rockfold {
namespace {

constexpr LatticeKind kinds[] = {LatticeKind::tet5,      LatticeKind::tet5_mixed, LatticeKind::tet6,
                                 LatticeKind::tet6_kuhn, LatticeKind::tet24,      LatticeKind::hex8,
                                 LatticeKind::block};

Lattice oblique(LatticeKind kind) {
  Lattice lattice;
  lattice.kind = kind;
  lattice.edge = {{{2.0, 0.3, -0.2}, {-0.4, 1.1, 0.5}, {0.1, -0.3, 0.7}}};
  lattice.cells = {2, 2, 2};
  lattice.block_origin = {{1, 2, 3}};
  return lattice;
}

Vec3 place(const CellSplit& split, int node) {
  const HalfSteps& at = split.node[node];
  return {0.5 * at[0] - 0.5, 0.5 * at[1] - 0.5, 0.5 * at[2] - 0.5};
}

/// φ_ak at η.
Real direct(const CellSplit& split, const CellPart& part, int a, int k, int functions,
            const Vec3& eta) {
  return part_weights(part, eta)[a] *
         cover_functions(eta - place(split, part.node[a]), functions)[k];
}

TEST(PartFunctions, AreWeightsTimesCoverFunctionsInEveryLattice) {
  for (const LatticeKind kind : kinds)
    for (int order = 0; order < 3; ++order) {
      const Lattice lattice = oblique(kind);
      const LatticeFunctions all = lattice_functions(lattice, order);
      for (int p = 0; p < all.forms * all.parts; ++p) {
        const CellSplit& split = cell_split(kind, p >= all.parts);
        const CellPart& part = split.part[p % all.parts];
        const Vec3 eta{0.31, -0.17, 0.05};
        const auto value = all.values(p, eta);
        const auto gradient = all.gradients(p, eta);
        for (int a = 0; a < all.nodes; ++a)
          for (int k = 0; k < all.functions; ++k) {
            const int f = a * all.functions + k;
            EXPECT_NEAR(value[f], direct(split, part, a, k, all.functions, eta), 1e-14);
            for (int d = 0; d < 3; ++d) {
              Vec3 step{};
              step[d] = 1e-4;
              const Vec3 change = lattice.to_local(step);
              const Real slope = (direct(split, part, a, k, all.functions, eta + change) -
                                  direct(split, part, a, k, all.functions, eta - change)) /
                                 2e-4;
              EXPECT_NEAR(gradient[f][d], slope, 2e-7) << "order " << order;
            }
          }
      }
    }
}

TEST(PartFunctions, WeightsAreAPartitionOfUnityOverWholeCells) {
  for (const LatticeKind kind : kinds) {
    const LatticeFunctions all = lattice_functions(oblique(kind), 0);
    for (int p = 0; p < all.forms * all.parts; ++p)
      for (const Vec3& eta : {Vec3{0, 0, 0}, Vec3{0.5, -0.5, 0.25}, Vec3{-0.4, 0.1, 0.3}}) {
        Real sum = 0;
        const auto value = all.values(p, eta);
        const auto gradient = all.gradients(p, eta);
        for (int a = 0; a < all.nodes; ++a) sum += value[a];
        EXPECT_NEAR(sum, 1, 1e-14);
        for (int d = 0; d < 3; ++d) {
          Real slope = 0;
          for (int a = 0; a < all.nodes; ++a) slope += gradient[a][d];
          EXPECT_NEAR(slope, 0, 1e-14);
        }
      }
  }
}

TEST(PartFunctions, PartsOfACellFillItOnce) {
  for (const LatticeKind kind : kinds) {
    if (kind == LatticeKind::block) continue;  // there is no whole part
    const Lattice lattice = oblique(kind);
    const Real volume = dot(lattice.edge[0], cross(lattice.edge[1], lattice.edge[2]));
    const LatticeFunctions all = lattice_functions(lattice, 2);
    for (int form = 0; form < all.forms; ++form) {
      Real sum[3] = {};
      for (int p = 0; p < all.parts; ++p) {
        const auto& moment = all.part[form * all.parts + p].moment;
        EXPECT_GT(moment[0], 0);
        sum[0] += moment[0];
        sum[1] += moment[monomial_index(1, 2, 0)];
        sum[2] += moment[monomial_index(2, 0, 4)];
      }
      EXPECT_NEAR(sum[0] / volume, 1, 1e-14);
      EXPECT_NEAR(sum[1] / volume, 0, 1e-16);
      EXPECT_NEAR(sum[2] / volume, 1.0 / 12 / 80, 1e-17);
    }
  }
}

}  // namespace
}  // namespace rockfold
