// Multigrid with contact: joints that separate rock on all levels, and points on them that hold it together.
#include <gtest/gtest.h>

#include "src/base/vector.hpp"
#include "tests/solve/systems/jointed_cube.hpp"

namespace rockfold {
namespace {

struct Solution {
  SolveReport report;
  std::vector<Vec3> x;
};

Solution solve_with(CoverSystem& system, Preconditioner preconditioner, const std::vector<Vec3>& b,
                    Real tolerance = 1e-8) {
  Solution solution{{}, std::vector<Vec3>(b.size())};
  solution.report = system.solve({1, 0, 1}, b, solution.x, {tolerance, 20000});
  EXPECT_TRUE(solution.report.converged) << "residual " << solution.report.residual;
  EXPECT_EQ(solution.report.preconditioner, preconditioner);
  return solution;
}

Solution solve_with(const JointedCube& cube, Preconditioner preconditioner,
                    const std::vector<Vec3>& b, Real tolerance = 1e-8) {
  const SmallSystem& s = cube.system;
  CoverSystem system(s.covers(), piece_moments(s.covers()), s.materials, s.fixed, preconditioner);
  system.set_contacts(cube.points, cube.tangent);
  return solve_with(system, preconditioner, b, tolerance);
}

std::vector<Vec3> weight_of(const SmallSystem& s) {
  std::vector<Vec3> x(s.covers().unknown_count());
  for (Index p = 0; p < s.covers().cover_count(); ++p) x[p] = {3, 0, -10};
  return s.make().apply({0, 1, 0}, x);
}

/// Functions may be dependent: solutions are compared by their forces of inertia.
void expect_same_motion(const SmallSystem& s, const std::vector<Vec3>& a,
                        const std::vector<Vec3>& b, Real tolerance) {
  const auto of_a = s.make().apply({0, 1, 0}, a), of_b = s.make().apply({0, 1, 0}, b);
  EXPECT_LE(reference::largest_difference(of_a, of_b), tolerance * reference::largest(of_b));
}

TEST(ContactLevels, FindTheAnswerOfTheBlocks) {
  for (const LatticeKind kind : {LatticeKind::tet6, LatticeKind::hex8})
    for (const int order : {0, 1}) {
      SCOPED_TRACE(testing::Message() << "lattice " << int(kind) << ", order " << order);
      const JointedCube cube = jointed_cube(6, order, kind, partly_open(6, 5));
      const auto b = weight_of(cube.system);
      const auto grids = solve_with(cube, Preconditioner::multigrid, b, 1e-11);
      const auto blocks = solve_with(cube, Preconditioner::node_block_jacobi, b, 1e-11);
      EXPECT_LT(3 * grids.report.iterations, blocks.report.iterations);
      expect_same_motion(cube.system, grids.x, blocks.x, 1e-6);
    }
}

/// The coarsest level would otherwise know nothing of what holds the upper parts.
TEST(ContactLevels, TakeAsManyCyclesAtAnySpacing) {
  for (const bool open : {false, true})
    for (const Index n : {8, 15, 24}) {
      const JointedCube cube =
          jointed_cube(n, 0, LatticeKind::tet6, open ? partly_open(n, 10) : closed(n, 10));
      const auto grids = solve_with(cube, Preconditioner::multigrid, weight_of(cube.system));
      EXPECT_LE(grids.report.iterations, 18) << n << (open ? ", partly open" : "");
    }
}

/// Of the rock of a cell: a thousandth to eight times.
TEST(ContactLevels, HardlyMindHowStiffJointsAre) {
  for (const Real stiffness : {0.01, 1.0, 100.0}) {
    const JointedCube cube = jointed_cube(12, 0, LatticeKind::tet6, closed(12, stiffness));
    const auto grids = solve_with(cube, Preconditioner::multigrid, weight_of(cube.system));
    EXPECT_LE(grids.report.iterations, 24) << stiffness;
  }
}

/// Newton's iterations change tangents, detections change points.
TEST(ContactLevels, FollowTangentsAndPointsThatChange) {
  const JointedCube first = jointed_cube(6, 0, LatticeKind::tet6, closed(6, 5)),
                    next = jointed_cube(6, 0, LatticeKind::tet6, partly_open(6, 50));
  const SmallSystem& s = first.system;
  const auto b = weight_of(s);
  CoverSystem system(s.covers(), piece_moments(s.covers()), s.materials, s.fixed,
                     Preconditioner::multigrid);
  system.set_contacts(first.points, first.tangent);
  solve_with(system, Preconditioner::multigrid, b);
  system.set_contacts(next.points, next.tangent);
  const auto again = solve_with(system, Preconditioner::multigrid, b);
  const auto alone = solve_with(next, Preconditioner::multigrid, b);
  EXPECT_EQ(again.x, alone.x);
  EXPECT_EQ(again.report.iterations, alone.report.iterations);
}

}  // namespace
}  // namespace rockfold
