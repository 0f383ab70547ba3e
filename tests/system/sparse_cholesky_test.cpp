#include "src/system/sparse_cholesky.hpp"

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

}  // namespace
}  // namespace rockfold
