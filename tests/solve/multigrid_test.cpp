#include <cmath>

#include <gtest/gtest.h>

#include "src/base/vector.hpp"
#include "tests/solve/systems/joints.hpp"

namespace rockfold {
namespace {

struct Solution {
  SolveReport report;
  std::vector<Vec3> x;
};

Solution solve_with(const SmallSystem& s, Preconditioner preconditioner, const std::vector<Vec3>& b,
                    const SystemCoefficients& c = {1, 0, 1}, Real tolerance = 1e-8) {
  CoverSystem system(s.covers(), piece_moments(s.covers()), s.materials, s.fixed, preconditioner);
  Solution solution{{}, std::vector<Vec3>(b.size())};
  SolveOptions options;
  options.tolerance = tolerance;
  options.max_iterations = 20000;
  solution.report = system.solve(c, b, solution.x, options);
  EXPECT_TRUE(solution.report.converged) << "residual " << solution.report.residual;
  EXPECT_EQ(solution.report.preconditioner, preconditioner);
  return solution;
}

std::vector<Vec3> weight_of(const SmallSystem& s) {
  return s.make().apply({0, 1, 0},
                        std::vector<Vec3>(s.covers().cover_node.size(), Vec3{0, 0, -10}));
}

TEST(Multigrid, EqualsADirectSolution) {
  SmallSystem s = cut_system();
  for (Vec3& v : s.fixed.value) v = {0, 0, 0};
  const SystemCoefficients c{1, 3, 1};  // some mass holds the second body
  // Forces as mass would have them: what is known of a sliver of no mass is little.
  const auto b = s.make().apply({0, 1, 0}, reference::scattered(s.covers().cover_node.size(), 3));
  const auto dense = reference::combine(
      1,
      reference::combine(c.stiffness, reference::assemble_stiffness(s.covers(), s.materials),
                         c.mass, reference::assemble_mass(s.covers(), s.materials)),
      c.springs, reference::assemble_springs(s.covers(), s.fixed));
  const auto expected = reference::solve(dense, b);
  const auto found = solve_with(s, Preconditioner::multigrid, b, c, 1e-13);
  EXPECT_LE(reference::largest_difference(found.x, expected), 1e-7 * reference::largest(expected));
}

TEST(Multigrid, TakesAsManyIterationsAtAnySpacing) {
  Index most = 0, least = 1000, blocks_before = 0;
  for (Index n : {6, 11, 16, 23}) {
    const SmallSystem s = held_cube(n);
    const auto b = weight_of(s);
    const auto grids = solve_with(s, Preconditioner::multigrid, b);
    const auto blocks = solve_with(s, Preconditioner::block_jacobi, b);
    most = std::max(most, grids.report.iterations);
    least = std::min(least, grids.report.iterations);
    EXPECT_GT(blocks.report.iterations, 1.2 * blocks_before);  // what is to be avoided
    blocks_before = blocks.report.iterations;
    // Both leave 1e-8 of the load; the condition is about n².
    EXPECT_LE(reference::largest_difference(grids.x, blocks.x),
              1e-8 * n * n * reference::largest(blocks.x));
  }
  EXPECT_LE(most, 20);
  EXPECT_LE(most, least + 6);
}

TEST(Multigrid, SolvesOnLatticesOfAnyShape) {
  for (const auto& [nx, ny, nz] : {std::array<Index, 3>{40, 3, 2}, std::array<Index, 3>{1, 1, 30},
                                   std::array<Index, 3>{17, 15, 1}}) {
    SmallSystem s = uncut_system(nx, ny, nz);
    s.materials = {{2000, 1e6, 0.3}};
    const auto b = reference::scattered(s.covers().cover_node.size(), 8);
    const SystemCoefficients c{1, 0.5, 1};
    const auto grids = solve_with(s, Preconditioner::multigrid, b, c);
    const auto blocks = solve_with(s, Preconditioner::block_jacobi, b, c, 1e-10);
    EXPECT_LE(reference::largest_difference(grids.x, blocks.x),
              1e-3 * reference::largest(blocks.x));
    EXPECT_LT(grids.report.iterations, 60) << nx << " " << ny << " " << nz;
  }
}

/// Three joints that are open over half of their area: the same place in the rock at any spacing.
TEST(Multigrid, HardlyMindsOpenJoints) {
  for (Index n : {12, 16, 24}) {
    const auto s = held_cube(n, [&](Index i, Index j, Index k) {
      return k % (n / 4) == 0 && k > 0 && k < n && i > n / 4 && j < 3 * n / 4;
    });
    const auto b = weight_of(s);
    const auto grids = solve_with(s, Preconditioner::multigrid, b);
    const auto blocks = solve_with(s, Preconditioner::block_jacobi, b, {1, 0, 1}, 1e-9);
    EXPECT_LE(grids.report.iterations, 36) << n;  // most where the slabs are three cells thick
    EXPECT_LE(reference::largest_difference(grids.x, blocks.x),
              1e-4 * reference::largest(blocks.x));
  }
}

TEST(Multigrid, HoldsManyBodiesApart) {
  SmallSystem s;
  std::vector<reference::Region> slabs;
  for (int i = 0; i < 5; ++i)
    slabs.push_back(reference::box({0, 0, 0.21 * i}, {1, 1, 0.21 * (i + 1)}, 0, i, i));
  s.covered = reference::cover_regions(
      reference::turned_lattice({0.03, 0.01, 0.02}, 0.11, 0.1, 0, {0.5, 0.5, 0.5}, 1.0), slabs);
  s.materials = {{2000, 1e6, 0.25}};
  const auto b = reference::scattered(s.covers().cover_node.size(), 4);
  const SystemCoefficients c{1, 1, 1};
  const auto grids = solve_with(s, Preconditioner::multigrid, b, c);
  const auto blocks = solve_with(s, Preconditioner::block_jacobi, b, c, 1e-10);
  EXPECT_LE(reference::largest_difference(grids.x, blocks.x), 1e-4 * reference::largest(blocks.x));
  EXPECT_LE(grids.report.iterations, 30);
}

/// A free body: rigid motions cost nothing, and the load moves none of them.
TEST(Multigrid, SolvesASingularSystemThatHasAnAnswer) {
  SmallSystem s = held_cube(12);
  s.fixed = {};
  const auto wanted = reference::scattered(s.covers().cover_node.size(), 7);
  const auto b = s.make().apply({1, 0, 0}, wanted);
  for (Preconditioner p : {Preconditioner::block_jacobi, Preconditioner::multigrid}) {
    const auto found = solve_with(s, p, b);
    // The answer is known up to a rigid motion: its forces are.
    EXPECT_LE(reference::largest_difference(s.make().apply({1, 0, 0}, found.x), b),
              1e-7 * reference::largest(b) * std::sqrt(Real(b.size())));
  }
}

TEST(Multigrid, IsNeitherBrokenNorSlowedBySlivers) {
  const Lattice lattice = reference::turned_lattice({0, 0, 0}, 0.25, 0, 0, {1, 0.5, 0.5}, 1.3);
  Index plain = 0;
  for (Real thickness : {0.0, 1e-6, 1e-12, 1e-18, 1e-30}) {
    SmallSystem s;
    s.covered = reference::cover_regions(
        lattice, {reference::box({0, 0, 0}, {thickness == 0 ? 2 : 2 + 1e-3, 1, 1})}, 0);
    CoverArrays& a = s.covered.arrays;
    if (thickness > 0)
      for (Index e = 0; e < a.cut_count(); ++e)
        if (a.lattice.cell_centre(a.element_cell[e])[0] > 2)
          for (Index v = a.vertex_begin[e]; v < a.vertex_begin[e + 1]; ++v) {
            Real& x = a.vertex_xyz[3 * v];
            x = -0.125 + (x + 0.125) * (thickness / 1e-3);
          }
    s.materials = {{2000, 1e6, 0.2}};
    s.fixed = reference::fix(
        s.covered, reference::corner_points(s.covered, [](const Vec3& x) { return x[0] < 1e-9; }),
        [](const Vec3&) { return Vec3{}; }, 1e6, false);
    const auto found = solve_with(s, Preconditioner::multigrid, weight_of(s));
    if (thickness == 0) plain = found.report.iterations;
    EXPECT_LE(found.report.iterations, plain + 6) << "thickness " << thickness;
    EXPECT_TRUE(std::isfinite(reference::largest(found.x)));
  }
}

TEST(Multigrid, IsChosenForLargeStaticSystemsAndNotForMassMatrices) {
  const SmallSystem small = held_cube(6), large = held_cube(14);
  const auto used = [](const SmallSystem& s, const SystemCoefficients& c) {
    CoverSystem system = s.make();
    std::vector<Vec3> x(s.covers().cover_node.size());
    return system.solve(c, weight_of(s), x).preconditioner;
  };
  EXPECT_EQ(used(small, {1, 0, 1}), Preconditioner::node_block_jacobi);
  EXPECT_EQ(used(large, {1, 0, 1}), Preconditioner::multigrid);
  EXPECT_EQ(used(large, {0, 1, 1}), Preconditioner::node_block_jacobi);
  EXPECT_EQ(used(large, {1, 1e9, 1}), Preconditioner::node_block_jacobi);
}

}  // namespace
}  // namespace rockfold
