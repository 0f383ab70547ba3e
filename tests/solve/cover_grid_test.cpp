// Multigrid for covers of order 1 and 2.
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

/// The mass of the rock times a motion of its constant functions.
std::vector<Vec3> forces(const SmallSystem& s, const std::vector<Vec3>& motion) {
  std::vector<Vec3> x(s.covers().unknown_count());
  for (Index p = 0; p < s.covers().cover_count(); ++p) x[p] = motion[p];
  return s.make().apply({0, 1, 0}, x);
}

std::vector<Vec3> weight_of(const SmallSystem& s) {
  return forces(s, std::vector<Vec3>(s.covers().cover_count(), Vec3{0, 0, -10}));
}

SmallSystem cube_of_order(Index n, int order,
                          const std::function<bool(Index, Index, Index)>& open = {}) {
  SmallSystem s = held_cube(n, open);
  s.covered.arrays.order = order;  // the springs hold the constant functions
  return s;
}

/// Functions are dependent: solutions are compared by their forces of inertia, which are those of the displacement.
void expect_same_motion(const SmallSystem& s, const std::vector<Vec3>& a,
                        const std::vector<Vec3>& b, Real tolerance) {
  const auto of_a = s.make().apply({0, 1, 0}, a), of_b = s.make().apply({0, 1, 0}, b);
  EXPECT_LE(reference::largest_difference(of_a, of_b), tolerance * reference::largest(of_b));
}

TEST(LongCoverGrid, FindsTheAnswerOfTheBlocksOnEveryLattice) {
  for (const LatticeKind kind : {LatticeKind::tet5, LatticeKind::tet5_mixed, LatticeKind::tet6,
                                 LatticeKind::tet6_kuhn, LatticeKind::tet24, LatticeKind::hex8})
    for (const int order : {1, 2}) {
      SCOPED_TRACE(testing::Message() << "lattice " << int(kind) << ", order " << order);
      SmallSystem s = uncut_system(3, 3, 2, kind, order);
      const auto b = forces(s, reference::scattered(s.covers().cover_count(), 3));
      const SystemCoefficients c{1, 2, 1};
      const auto grids = solve_with(s, Preconditioner::multigrid, b, c, 1e-11);
      const auto blocks = solve_with(s, Preconditioner::node_block_jacobi, b, c, 1e-11);
      expect_same_motion(s, grids.x, blocks.x, 1e-7);
    }
}

TEST(LongCoverGrid, FindsTheAnswerOfTheBlocksInCutRock) {
  const SmallSystem s = cut_system(LatticeKind::tet6, 1);
  const SystemCoefficients c{1, 3, 1};  // some mass holds the second body
  const auto b = forces(s, reference::scattered(s.covers().cover_count(), 3));
  const auto grids = solve_with(s, Preconditioner::multigrid, b, c, 1e-11);
  const auto blocks = solve_with(s, Preconditioner::node_block_jacobi, b, c, 1e-11);
  expect_same_motion(s, grids.x, blocks.x, 1e-7);
}

TEST(LongCoverGrid, TakesAsManyIterationsAtAnySpacing) {
  Index blocks_before = 0;
  for (const Index n : {4, 8, 13}) {
    const SmallSystem s = cube_of_order(n, 1);
    const auto b = weight_of(s);
    const auto grids = solve_with(s, Preconditioner::multigrid, b);
    const auto blocks = solve_with(s, Preconditioner::node_block_jacobi, b);
    RecordProperty("iterations_" + std::to_string(n), grids.report.iterations);
    EXPECT_LE(grids.report.iterations, 24) << n;
    EXPECT_GT(blocks.report.iterations, 1.3 * blocks_before);  // what is to be avoided
    blocks_before = blocks.report.iterations;
    expect_same_motion(s, grids.x, blocks.x, 1e-5);
  }
}

TEST(CoverGrid, SavesIterationsAtOrderTwo) {
  const SmallSystem s = cube_of_order(4, 2);
  const auto b = weight_of(s);
  const auto grids = solve_with(s, Preconditioner::multigrid, b);
  const auto blocks = solve_with(s, Preconditioner::node_block_jacobi, b);
  EXPECT_LT(5 * grids.report.iterations, blocks.report.iterations);
  expect_same_motion(s, grids.x, blocks.x, 1e-5);
}

TEST(LongCoverGrid, FollowsOpenJoints) {
  const Index n = 8;
  const SmallSystem s = cube_of_order(n, 1, [&](Index i, Index j, Index k) {
    return k % 2 == 0 && k > 0 && i > n / 4 && j < 3 * n / 4;
  });
  const auto b = weight_of(s);
  const auto grids = solve_with(s, Preconditioner::multigrid, b);
  const auto blocks = solve_with(s, Preconditioner::node_block_jacobi, b);
  EXPECT_LT(5 * grids.report.iterations, blocks.report.iterations);
  expect_same_motion(s, grids.x, blocks.x, 1e-4);
}

}  // namespace
}  // namespace rockfold
