// Dependent functions: order 1 and more on tetrahedra. N_a (c_a + C_a·ξ) summed over the nodes vanishes where all c_a = 0 and
// (C_a − C_b) is normal to each edge ab: where C is a rigid motion of the framework of edges, six for each component.
#include <gtest/gtest.h>

#include "tests/solve/systems/systems.hpp"

namespace rockfold {
namespace {

using reference::Dense;

/// The operator as a matrix, column by column.
Dense matrix(const CoverSystem& system, const SystemCoefficients& c) {
  Dense a(3 * static_cast<std::size_t>(system.unknowns()));
  std::vector<Vec3> unit(system.unknowns());
  for (std::size_t j = 0; j < a.n; ++j) {
    unit[j / 3][j % 3] = 1;
    const auto column = system.apply(c, unit);
    unit[j / 3][j % 3] = 0;
    for (std::size_t i = 0; i < a.n; ++i) a(i, j) = column[i / 3][i % 3];
  }
  return a;
}

int zeros(const Dense& a) {
  const auto values = reference::eigenvalues(a);
  int count = 0;
  for (const Real v : values) {
    EXPECT_GT(v, -1e-12 * values.back());
    if (v < 1e-10 * values.back()) ++count;
  }
  return count;
}

TEST(NullSpace, OfOrderOneOnTetrahedraHasEighteenDimensionsBesideTheRigidMotions) {
  for (const LatticeKind kind : {LatticeKind::tet6, LatticeKind::tet5, LatticeKind::tet24})
    for (const Index cells : {1, 2}) {
      const CoverSystem system = uncut_system(cells, 1, 1, kind, 1).make();
      EXPECT_EQ(zeros(matrix(system, {0, 1, 0})), 18);
      EXPECT_EQ(zeros(matrix(system, {1, 0, 0})), 24);
    }
}

TEST(NullSpace, OfOrderOneOnABlockIsTheRigidMotions) {
  SmallSystem s;
  Lattice lattice;
  lattice.kind = LatticeKind::block;
  lattice.edge = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  lattice.block_origin = {{0.4, 0.5, 0.3}};
  s.covered = reference::cover_regions(lattice, {reference::box({0, 0, 0}, {1, 0.8, 0.6})});
  s.materials = {{2000, 1e3, 0.25}};
  for (const int order : {1, 2}) {
    s.covered.arrays.order = order;
    EXPECT_EQ(zeros(matrix(s.make(), {0, 1, 0})), 0);
    EXPECT_EQ(zeros(matrix(s.make(), {1, 0, 0})), 6);
  }
}

TEST(NullSpace, OfOrderTwoAddsTheRigidMotionsAlone) {
  const CoverSystem system = uncut_system(1, 1, 1, LatticeKind::tet6, 2).make();
  const int dependent = zeros(matrix(system, {0, 1, 0}));
  EXPECT_GT(dependent, 18);
  EXPECT_EQ(zeros(matrix(system, {1, 0, 0})), dependent + 6);
}

/// A load that no dependent combination feels is met to the tolerance, although the matrix is singular.
TEST(NullSpace, LetsConsistentSystemsConverge) {
  for (const int order : {1, 2}) {
    SmallSystem s = cut_system(LatticeKind::tet6, order);
    CoverSystem system = s.make();
    const auto load =
        system.apply({0, 1, 0}, reference::sample_at_nodes(s.covers(), [](const Vec3& x) {
                       return Vec3{0, x[0], -9.81};
                     }));
    // Body 1 is held by nothing: mass makes it heavy instead, but not its dependent functions.
    std::vector<Vec3> x(load.size());
    const SolveReport report = system.solve({1, 10, 1}, load, x, {1e-10, 5000});
    EXPECT_TRUE(report.converged);
    EXPECT_LE(report.residual, 1e-10);
    EXPECT_LT(report.iterations, 1500);
    RecordProperty("iterations", report.iterations);
  }
}

}  // namespace
}  // namespace rockfold
