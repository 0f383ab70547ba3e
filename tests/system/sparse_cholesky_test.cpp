#include "src/system/sparse_cholesky.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace rockfold {
namespace {

TEST(SparseCholesky, LeavesNoResidualOnAnyPattern) {
  // A ring and a star, each more than is left undivided, and a row by itself.
  constexpr Index ring = 61, star = 50, rows = ring + star + 1;
  std::vector<std::vector<Real>> dense(rows, std::vector<Real>(rows, 0));
  const auto couple = [&](Index i, Index j, Real by) { dense[i][j] = dense[j][i] = by; };
  for (Index i = 0; i < ring; ++i) couple(i, (i + 1) % ring, -1 - 0.1 * i);
  for (Index i = ring + 1; i < ring + star; ++i) couple(ring, i, 0.5 + 0.01 * i);
  std::vector<Index> begin{0}, column;
  std::vector<Real> value;
  for (Index i = 0; i < rows; ++i) {
    Real sum = 1e-3;
    for (const Real v : dense[i]) sum += std::abs(v);
    dense[i][i] = sum;
    for (Index j = 0; j < rows; ++j)
      if (dense[i][j] != 0) {
        column.push_back(j);
        value.push_back(dense[i][j]);
      }
    begin.push_back(static_cast<Index>(column.size()));
  }
  solve::SparseCholesky factors(begin, column);
  factors.factorise(begin, column, value);
  for (std::size_t columns = 1; columns <= 3; ++columns) {
    std::vector<std::vector<Real>> x(columns, std::vector<Real>(rows));
    std::vector<Real*> at_once;
    for (std::size_t c = 0; c < columns; ++c) {
      for (Index i = 0; i < rows; ++i) x[c][i] = std::sin(1 + i + 100.0 * static_cast<Real>(c));
      at_once.push_back(x[c].data());
    }
    const auto b = x;
    factors.solve(at_once.data(), static_cast<int>(columns));
    for (std::size_t c = 0; c < columns; ++c)
      for (Index i = 0; i < rows; ++i) {
        Real sum = 0, terms = 0;
        for (Index j = 0; j < rows; ++j) {
          sum += dense[i][j] * x[c][j];
          terms += std::abs(dense[i][j] * x[c][j]);
        }
        EXPECT_NEAR(sum, b[c][i], 1e-15 * terms);
      }
  }
}

/// Two layers of a square, each row coupled to those two away at most.
TEST(SparseCholesky, LeavesNoResidualOnASurface) {
  constexpr Index n = 23, rows = 2 * n * n;
  const auto row_at = [](Index x, Index y, Index z) { return x + n * (y + n * z); };
  std::vector<Index> begin{0}, column;
  std::vector<Real> value;
  for (Index z = 0; z < 2; ++z)
    for (Index y = 0; y < n; ++y)
      for (Index x = 0; x < n; ++x) {
        for (Index k = 0; k < 2; ++k)
          for (Index j = std::max(0, y - 2); j <= std::min(n - 1, y + 2); ++j)
            for (Index i = std::max(0, x - 2); i <= std::min(n - 1, x + 2); ++i) {
              const bool own = i == x && j == y && k == z;
              column.push_back(row_at(i, j, k));
              value.push_back(own ? 50.001 : -1 + 0.1 * ((i + x) * (j + y) % 7));
            }
        begin.push_back(static_cast<Index>(column.size()));
      }
  solve::SparseCholesky factors(begin, column);
  for (const Real times : {3.0, 1.0}) {  // anew with other values
    auto scaled = value;
    for (Real& v : scaled) v *= times;
    factors.factorise(begin, column, scaled);
  }
  std::vector<Real> x(rows);
  for (Index i = 0; i < rows; ++i) x[i] = std::sin(1 + i);
  const auto b = x;
  Real* const side = x.data();
  factors.solve(&side, 1);
  for (Index i = 0; i < rows; ++i) {
    Real sum = 0;
    for (Index m = begin[i]; m < begin[i + 1]; ++m) sum += value[m] * x[column[m]];
    EXPECT_NEAR(sum, b[i], 1e-12);
  }
}

/// Springs between rows in a chain that nothing holds: all of them but one have an answer, which leaves no residual of forces in balance.
TEST(SparseCholesky, LeavesOutWhatDependsOnTheRest) {
  constexpr Index rows = 60;
  std::vector<Index> begin{0}, column;
  std::vector<Real> value;
  for (Index i = 0; i < rows; ++i) {
    for (Index j = std::max(0, i - 1); j <= std::min(rows - 1, i + 1); ++j) {
      column.push_back(j);
      value.push_back(j != i ? -1 : i == 0 || i == rows - 1 ? 1 : 2);
    }
    begin.push_back(static_cast<Index>(column.size()));
  }
  solve::SparseCholesky factors(begin, column);
  factors.factorise(begin, column, value, 1e-12);
  std::vector<Real> x(rows, 0);
  x[3] = 1;
  x[50] = -1;
  const std::vector<Real> b = x;
  Real* const all = x.data();
  factors.solve(&all, 1);
  for (Index i = 0; i < rows; ++i) {
    Real sum = 0;
    for (Index m = begin[i]; m < begin[i + 1]; ++m) sum += value[m] * x[column[m]];
    EXPECT_NEAR(sum, b[i], 1e-12) << i;
  }
}

}  // namespace
}  // namespace rockfold
