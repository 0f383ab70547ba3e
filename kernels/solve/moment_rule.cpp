#include <algorithm>
#include <cmath>
#include <utility>

#include "kernels/solve/part_table_kernel.hpp"
#include "src/arrays/shape_functions.hpp"
#include "src/base/vector.hpp"

namespace rockfold {
namespace {

using integrate::count_to;

/// Points of a regular grid that lie in the part.
std::vector<Vec3> candidates(const CellPart& part, int degree) {
  const int steps = 2 * degree + 2;
  std::vector<Vec3> found;
  for (int i = 0; i <= steps; ++i)
    for (int j = 0; j <= steps; ++j)
      for (int k = 0; k <= steps; ++k) {
        const Vec3 eta{Real(i) / steps - 0.5, Real(j) / steps - 0.5, Real(k) / steps - 0.5};
        const auto weight = part_weights(part, eta);
        if (std::all_of(weight.begin(), weight.begin() + part.nodes,
                        [](Real w) { return w > -1e-12; }))
          found.push_back(eta);
      }
  return found;
}

using Rows = std::vector<std::vector<Real>>;

/// Chooses as many points as there are monomials: each time the one whose row of monomials is the most independent of those
/// chosen (Gram–Schmidt with pivots, twice for rounding).
std::vector<Vec3> choose(const std::vector<Vec3>& points, int degree) {
  const int terms = count_to(degree);
  Rows row;
  for (const Vec3& eta : points) {
    row.emplace_back(terms);
    solve::fill_monomials(eta.data(), degree, row.back().data());
  }
  const auto square = [&](const std::vector<Real>& r) {
    return solve::dot_terms(r.data(), r.data(), terms);
  };
  std::vector<Vec3> chosen;
  for (int n = 0; n < terms; ++n) {
    const auto best = std::max_element(row.begin(), row.end(), [&](const auto& a, const auto& b) {
      return square(a) < square(b);
    });
    chosen.push_back(points[best - row.begin()]);
    std::vector<Real> unit = *best;
    const Real length = std::sqrt(square(unit));
    for (Real& u : unit) u /= length;
    for (int again = 0; again < 2; ++again)
      for (auto& r : row) {
        const Real along = solve::dot_terms(r.data(), unit.data(), terms);
        for (int m = 0; m < terms; ++m) r[m] -= along * unit[m];
      }
  }
  return chosen;
}

/// The inverse of a square matrix by Gauss–Jordan elimination with row pivots.
Rows inverse(Rows a) {
  const std::size_t n = a.size();
  for (std::size_t i = 0; i < n; ++i) {
    a[i].resize(2 * n, 0.0);
    a[i][n + i] = 1;
  }
  for (std::size_t j = 0; j < n; ++j) {
    std::size_t pivot = j;
    for (std::size_t i = j; i < n; ++i)
      if (std::abs(a[i][j]) > std::abs(a[pivot][j])) pivot = i;
    std::swap(a[j], a[pivot]);
    const Real scale = 1 / a[j][j];
    for (Real& x : a[j]) x *= scale;
    for (std::size_t i = 0; i < n; ++i) {
      if (i == j || a[i][j] == 0) continue;
      const Real factor = a[i][j];
      for (std::size_t k = 0; k < 2 * n; ++k) a[i][k] -= factor * a[j][k];
    }
  }
  for (auto& row : a) row.erase(row.begin(), row.begin() + static_cast<std::ptrdiff_t>(n));
  return a;
}

}  // namespace

MomentRule moment_rule(const CellPart& part, int degree) {
  const int terms = count_to(degree);
  MomentRule rule;
  rule.point = choose(candidates(part, degree), degree);
  // Σ_q w_q (η_q)^m = moment m
  Rows matrix(terms, std::vector<Real>(terms));
  for (int q = 0; q < terms; ++q) {
    std::vector<Real> monomial(terms);
    solve::fill_monomials(rule.point[q].data(), degree, monomial.data());
    for (int m = 0; m < terms; ++m) matrix[m][q] = monomial[m];
  }
  for (const auto& row : inverse(matrix))
    rule.weight.insert(rule.weight.end(), row.begin(), row.end());
  return rule;
}

}  // namespace rockfold
