// A small linear programme solver, as an oracle.
#pragma once

#include <cmath>
#include <vector>

#include "src/base/types.hpp"

namespace rockfold::test {

/// max c·x, A x ≤ b, x ≥ 0 with b ≥ 0: the simplex method with Bland's rule on a dense tableau.
inline Real linear_program(std::vector<std::vector<Real>> rows, std::vector<Real> cost) {
  const std::size_t m = rows.size(), n = cost.size();
  constexpr Real zero = 1e-9;
  for (std::size_t i = 0; i < m; ++i) {  // slacks before the right-hand side
    const Real b = rows[i].back();
    rows[i].back() = 0;
    rows[i].resize(n + m + 1, 0);
    rows[i][n + i] = 1;
    rows[i].back() = b;
  }
  cost.resize(n + m + 1, 0);  // the last entry is −value
  while (true) {
    std::size_t column = 0;
    while (column < n + m && cost[column] <= zero) ++column;
    if (column == n + m) return -cost.back();
    std::size_t pivot = m;
    Real best = 0;
    for (std::size_t i = 0; i < m; ++i) {
      if (rows[i][column] <= zero) continue;
      const Real ratio = rows[i].back() / rows[i][column];
      if (pivot == m || ratio < best - 1e-12) {
        pivot = i;
        best = ratio;
      }
    }
    if (pivot == m) return INFINITY;
    const Real p = rows[pivot][column];
    for (Real& v : rows[pivot]) v /= p;
    const auto eliminate = [&](std::vector<Real>& row) {
      const Real factor = row[column];
      if (factor == 0) return;
      for (std::size_t j = 0; j < row.size(); ++j) row[j] -= factor * rows[pivot][j];
    };
    for (std::size_t i = 0; i < m; ++i)
      if (i != pivot) eliminate(rows[i]);
    eliminate(cost);
  }
}

}  // namespace rockfold::test
