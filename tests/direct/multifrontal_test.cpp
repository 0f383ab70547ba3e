#include "host/direct/multifrontal.hpp"

#include <cmath>
#include <limits>
#include <random>

#include <Eigen/Dense>
#include <gtest/gtest.h>
#include <omp.h>

namespace rockfold::host {
namespace {

constexpr Real least_pivot = 1e-12;

struct Grid {
  BlockMatrix sparse;
  Eigen::MatrixXd dense;
};

/// A box of n × n × n rows, each coupled to its 26 neighbours by random blocks; BᵀB of them is positive. `repeat`: the last function of each row
/// is the first one again, so that the matrix is singular.
Grid random_grid(Index n, int width, bool repeat = false) {
  std::mt19937 random(7);
  std::uniform_real_distribution<Real> any(-1, 1);
  const Index rows = n * n * n;
  const auto at = [&](Index i, int e) { return static_cast<Eigen::Index>(i) * width + e; };
  const auto near = [&](Index i, Index j) {
    const auto close = [&](Index p, Index q) { return std::abs(p - q) <= 1; };
    return close(i % n, j % n) && close(i / n % n, j / n % n) && close(i / n / n, j / n / n);
  };
  // Elements: the couplings of each row with itself and with the next along x, y and z.
  Grid grid;
  grid.dense = Eigen::MatrixXd::Zero(at(rows, 0), at(rows, 0));
  for (Index i = 0; i < rows; ++i)
    for (Index j = i; j < rows; ++j) {
      if (!near(i, j)) continue;
      Eigen::MatrixXd f(width, 2 * width);
      for (int r = 0; r < f.rows(); ++r)
        for (int c = 0; c < f.cols(); ++c) f(r, c) = any(random);
      if (repeat) f.col(width - 1) = f.col(0), f.col(2 * width - 1) = f.col(width);
      const Eigen::MatrixXd k = f.transpose() * f;
      const Eigen::Index from[2] = {at(i, 0), at(j, 0)};
      for (int r = 0; r < 2; ++r)
        for (int c = 0; c < 2; ++c)
          grid.dense.block(from[r], from[c], width, width) +=
              k.block(r * width, c * width, width, width);
    }
  BlockMatrix& a = grid.sparse;
  a.width = width;
  a.begin = {0};
  for (Index i = 0; i < rows; ++i) {
    for (Index j = 0; j < rows; ++j) {
      if (!near(i, j)) continue;
      a.column.push_back(j);
      for (int e = 0; e < width; ++e)
        for (int d = 0; d < width; ++d) a.value.push_back(grid.dense(at(i, d), at(j, e)));
    }
    a.begin.push_back(static_cast<Index>(a.column.size()));
  }
  return grid;
}

std::vector<Real> scattered(Eigen::Index size) {
  std::mt19937 random(3);
  std::uniform_real_distribution<Real> any(-1, 1);
  std::vector<Real> values(size);
  for (Real& v : values) v = any(random);
  return values;
}

Eigen::Map<const Eigen::VectorXd> as_vector(const std::vector<Real>& v) {
  return {v.data(), static_cast<Eigen::Index>(v.size())};
}

TEST(DirectSolver, GivesTheAnswerOfADenseFactorisation) {
  for (int width : {3, 12}) {
    const Grid grid = random_grid(width == 3 ? 6 : 4, width);
    const auto solver = make_direct_solver();
    ASSERT_TRUE(solver->analyse(grid.sparse));
    ASSERT_TRUE(solver->factorise(grid.sparse, least_pivot));
    const std::vector<Real> r = scattered(grid.dense.rows());
    std::vector<Real> z = r;
    solver->solve(z);
    const Eigen::VectorXd expected = grid.dense.llt().solve(as_vector(r));
    EXPECT_LE((as_vector(z) - expected).norm(), 1e-9 * expected.norm()) << width;
  }
}

TEST(DirectSolver, TakesOtherValuesInTheSamePlaces) {
  Grid grid = random_grid(4, 3);
  const auto solver = make_direct_solver();
  ASSERT_TRUE(solver->analyse(grid.sparse));
  ASSERT_TRUE(solver->factorise(grid.sparse, least_pivot));
  for (Real& v : grid.sparse.value) v *= 4;
  ASSERT_TRUE(solver->factorise(grid.sparse, least_pivot));
  const std::vector<Real> r = scattered(grid.dense.rows());
  std::vector<Real> z = r;
  solver->solve(z);
  const Eigen::VectorXd expected = 0.25 * grid.dense.llt().solve(as_vector(r));
  EXPECT_LE((as_vector(z) - expected).norm(), 1e-9 * expected.norm());
}

TEST(DirectSolver, BalancesForcesOfASingularMatrix) {
  const Grid grid = random_grid(4, 4, true);
  const auto solver = make_direct_solver();
  ASSERT_TRUE(solver->analyse(grid.sparse));
  ASSERT_TRUE(solver->factorise(grid.sparse, least_pivot));
  const Eigen::VectorXd force = grid.dense * as_vector(scattered(grid.dense.rows()));
  std::vector<Real> z(force.data(), force.data() + force.size());
  solver->solve(z);
  EXPECT_LE((grid.dense * as_vector(z) - force).norm(), 1e-10 * force.norm());
  Index at_rest = 0;
  for (Real v : z) at_rest += v == 0;
  EXPECT_EQ(at_rest, grid.sparse.rows());  // of each pair of the same function one
}

TEST(DirectSolver, GivesTheSameBitsOnAnyNumberOfThreads) {
  const Grid grid = random_grid(9, 4, true);
  const std::vector<Real> r = scattered(grid.dense.rows());
  const int before = omp_get_max_threads();
  std::vector<std::vector<Real>> answers;
  for (const int threads : {1, 2, 5}) {
    omp_set_num_threads(threads);
    const auto solver = make_direct_solver();
    ASSERT_TRUE(solver->analyse(grid.sparse));
    ASSERT_TRUE(solver->factorise(grid.sparse, least_pivot));
    answers.push_back(r);
    solver->solve(answers.back());
  }
  omp_set_num_threads(before);
  EXPECT_EQ(answers[1], answers[0]);
  EXPECT_EQ(answers[2], answers[0]);
}

TEST(DirectSolver, IsSymmetric) {
  const Grid grid = random_grid(3, 4, true);
  const auto solver = make_direct_solver();
  ASSERT_TRUE(solver->analyse(grid.sparse));
  ASSERT_TRUE(solver->factorise(grid.sparse, 0.3));  // many functions without an answer
  const Eigen::Index n = grid.dense.rows();
  Eigen::MatrixXd inverse(n, n);
  for (Eigen::Index j = 0; j < n; ++j) {
    std::vector<Real> e(n);
    e[j] = 1;
    solver->solve(e);
    inverse.col(j) = as_vector(e);
  }
  EXPECT_LE((inverse - inverse.transpose()).norm(), 1e-12 * inverse.norm());
  EXPECT_GE(inverse.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(),
            -1e-12 * inverse.norm());
}

TEST(DirectSolver, RefusesWhatWouldTakeTooMuch) {
  const Grid grid = random_grid(5, 3);
  EXPECT_FALSE(make_direct_solver({1e9, 1e4})->analyse(grid.sparse));
  EXPECT_FALSE(make_direct_solver({1e4, 1e9})->analyse(grid.sparse));
  EXPECT_TRUE(make_direct_solver({1e9, 1e9})->analyse(grid.sparse));
}

TEST(DirectSolver, LeavesFrontsWithoutAnyPivotToThemselves) {
  for (const Real nothing : {0.0, std::numeric_limits<Real>::quiet_NaN()}) {
    Grid grid = random_grid(5, 3);
    for (Index m = grid.sparse.begin[0]; m < grid.sparse.begin[62]; ++m)
      for (int k = 0; k < 9; ++k) grid.sparse.value[static_cast<std::size_t>(m) * 9 + k] = nothing;
    const auto solver = make_direct_solver();
    ASSERT_TRUE(solver->analyse(grid.sparse));
    ASSERT_TRUE(solver->factorise(grid.sparse, least_pivot));
    std::vector<Real> x = scattered(grid.dense.rows());
    solver->solve(x);
    EXPECT_EQ(x[0], 0);
  }
}

}  // namespace
}  // namespace rockfold::host
