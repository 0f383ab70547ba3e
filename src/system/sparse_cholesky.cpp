#include "src/system/sparse_cholesky.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "src/base/simd_versions.hpp"
#include "src/system/dissection.hpp"

namespace rockfold::solve {

SparseCholesky::SparseCholesky(const std::vector<Index>& begin, const std::vector<Index>& column)
    : order_(dissect(begin, column)) {
  const Index rows = static_cast<Index>(order_.size());
  place_.resize(rows);
  for (Index k = 0; k < rows; ++k) place_[order_[k]] = k;
  parent_.assign(rows, none);
  std::vector<Index> ancestor(rows, none);
  for (Index k = 0; k < rows; ++k)
    for (Index m = begin[order_[k]]; m < begin[order_[k] + 1]; ++m)
      for (Index i = place_[column[m]]; i != none && i < k;) {
        const Index next = std::exchange(ancestor[i], k);
        if (next == none) parent_[i] = k;
        i = next;
      }
  find_entries(begin, column);
  find_supernodes();
  work_.assign(3 * static_cast<std::size_t>(rows), 0);
  inverse_.resize(rows);
  diagonal_.resize(rows);
  entry_.resize(start_[rows]);
  at_.resize(rows);
}

void SparseCholesky::find_entries(const std::vector<Index>& begin,
                                  const std::vector<Index>& column) {
  const Index rows = static_cast<Index>(order_.size());
  std::vector<Index> seen_by(rows);
  // f(i, k) for each column i of L that has an entry in row k, rows ascending.
  const auto for_each_entry = [&](const auto& f) {
    std::fill(seen_by.begin(), seen_by.end(), none);
    for (Index k = 0; k < rows; ++k) {
      seen_by[k] = k;
      for (Index m = begin[order_[k]]; m < begin[order_[k] + 1]; ++m)
        for (Index i = place_[column[m]]; i < k && seen_by[i] != k; i = parent_[i]) {
          seen_by[i] = k;
          f(i, k);
        }
    }
  };
  start_.assign(rows + 1, 0);
  for_each_entry([&](Index i, Index) { ++start_[i + 1]; });
  for (Index k = 0; k < rows; ++k) start_[k + 1] += start_[k];
  row_.resize(start_[rows]);
  std::vector<std::size_t> end(start_.begin(), start_.end() - 1);
  for_each_entry([&](Index i, Index k) { row_[end[i]++] = k; });
}

void SparseCholesky::find_supernodes() {
  const Index rows = static_cast<Index>(order_.size());
  const auto below = [&](Index k) { return start_[k + 1] - start_[k]; };
  std::size_t most = 0;
  first_ = {0};
  for (Index k = 0; k < rows; ++k) {
    most = std::max(most, below(k));
    const bool goes_on = k + 1 < rows && parent_[k] == k + 1 && below(k) == below(k + 1) + 1;
    if (!goes_on) first_.push_back(k + 1);
  }
  below_.assign(3 * most, 0);
}

namespace {

constexpr int at_once = SparseCholesky::at_once;
using Columns = SparseCholesky::Columns;

constexpr int lanes = 4;
// NOLINTNEXTLINE(modernize-use-using): the attribute needs it
typedef Real Lanes __attribute__((vector_size(sizeof(Real) * lanes), aligned(sizeof(Real))));

/// to_s[i] −= Σ_j column_j[i] x[s][j], s < Sides, i < n.
template <int Sides>
[[gnu::always_inline]] inline void take_off(std::size_t n, const Columns& column,
                                            const Real (*x)[at_once], Real* const* to) {
  const Real *a0 = column[0], *a1 = column[1], *a2 = column[2], *a3 = column[3];
  for (int s = 0; s < Sides; ++s) {
    const Real x0 = x[s][0], x1 = x[s][1], x2 = x[s][2], x3 = x[s][3];
    Real* y = to[s];
    ROCKFOLD_NO_ALIAS
    for (std::size_t i = 0; i < n; ++i)
      y[i] -= (a0[i] * x0 + a1[i] * x1) + (a2[i] * x2 + a3[i] * x3);
  }
}

/// sum[s][j] += Σ_i column_j[i] y_s[i], s < Sides, i < n.
template <int Sides>
[[gnu::always_inline]] inline void add_dots(std::size_t n, const Columns& column,
                                            const Real* const* y, Real (*sum)[at_once]) {
  Lanes of[Sides][at_once] = {};
  std::size_t i = 0;
  for (; i + lanes <= n; i += lanes)
    for (int j = 0; j < at_once; ++j) {
      const Lanes& a = *reinterpret_cast<const Lanes*>(column[j] + i);
      for (int s = 0; s < Sides; ++s) of[s][j] += a * *reinterpret_cast<const Lanes*>(y[s] + i);
    }
  for (int s = 0; s < Sides; ++s)
    for (int j = 0; j < at_once; ++j) {
      Real rest = 0;
      for (std::size_t k = i; k < n; ++k) rest += column[j][k] * y[s][k];
      sum[s][j] += ((of[s][j][0] + of[s][j][1]) + (of[s][j][2] + of[s][j][3])) + rest;
    }
}

// A version for each instruction set, which templates cannot have.
ROCKFOLD_SIMD_VERSIONS
void take_off(int sides, std::size_t n, const Columns& column, const Real (*x)[at_once],
              Real* const* to) {
  if (sides == 1) return take_off<1>(n, column, x, to);
  if (sides == 2) return take_off<2>(n, column, x, to);
  take_off<3>(n, column, x, to);
}

ROCKFOLD_SIMD_VERSIONS
void add_dots(int sides, std::size_t n, const Columns& column, const Real* const* y,
              Real (*sum)[at_once]) {
  if (sides == 1) return add_dots<1>(n, column, y, sum);
  if (sides == 2) return add_dots<2>(n, column, y, sum);
  add_dots<3>(n, column, y, sum);
}

}  // namespace

/// Columns k … of a supernode that ends before `to`, at_once at most: their entries below all of them. What is missing repeats the last.
int SparseCholesky::columns_from(Index k, Index to, Columns& column) const {
  const int count = std::min(at_once, to - k);
  for (int j = 0; j < at_once; ++j) {
    const int of = std::min(j, count - 1);
    column[j] = entry_.data() + start_[k + of] + (count - 1 - of);
  }
  return count;
}

/// Where the rows of a supernode's columns stand: at_ of a row below column k, less at_ of k and one, is its entry's place in the column.
void SparseCholesky::locate_rows(std::size_t node) {
  const Index from = first_[node], to = first_[node + 1];
  Index at = 0;
  for (Index k = from; k < to; ++k) at_[k] = at++;
  for (std::size_t m = start_[to - 1]; m < start_[to]; ++m) at_[row_[m]] = at++;
}

/// The columns of a supernode, from which those before it have taken off what is theirs.
void SparseCholesky::factorise_columns(std::size_t node, Real negligible) {
  const Index from = first_[node], to = first_[node + 1];
  for (Index k = from; k < to; k += at_once) {
    Columns column;
    const int count = columns_from(k, to, column);
    for (int j = 0; j < count; ++j) {
      const bool resists = inverse_[k + j] > negligible * diagonal_[k + j];
      inverse_[k + j] = resists ? 1 / std::sqrt(inverse_[k + j]) : 0;
      Real* entry = entry_.data() + start_[k + j];
      for (Real* v = entry; v < entry_.data() + start_[k + j + 1]; ++v) *v *= inverse_[k + j];
      for (int l = j + 1; l < count; ++l) {
        const Real of_l = entry[l - j - 1];
        inverse_[k + l] -= of_l * of_l;
        Real* to_l = entry_.data() + start_[k + l];
        for (std::size_t i = 0; i < start_[k + l + 1] - start_[k + l]; ++i)
          to_l[i] -= entry[l - j + i] * of_l;
      }
    }
    for (Index l = k + count; l < to; ++l) {
      Real of_l[1][at_once] = {};
      for (int j = 0; j < count; ++j) {
        of_l[0][j] = *column[j]++;
        inverse_[l] -= of_l[0][j] * of_l[0][j];
      }
      for (int j = count; j < at_once; ++j) column[j] = column[count - 1];
      Real* const entries = entry_.data() + start_[l];
      take_off(1, start_[l + 1] - start_[l], column, of_l, &entries);
    }
  }
}

/// Takes a supernode's columns off those of its rows below.
void SparseCholesky::take_off_others(std::size_t node) {
  const Index from = first_[node], to = first_[node + 1];
  const std::size_t low = start_[to] - start_[to - 1];
  const Index* rows = row_.data() + start_[to - 1];
  std::size_t other = node;
  for (std::size_t j = 0; j < low; ++j) {
    const Index of = rows[j];
    if (of >= first_[other + 1]) {
      while (of >= first_[other + 1]) ++other;
      locate_rows(other);
    }
    std::fill_n(below_.data(), low - j, 0.0);
    for (Index k = from; k < to; k += at_once) {
      Columns column;
      const int count = columns_from(k, to, column);
      Real of_row[1][at_once] = {};
      for (int l = 0; l < at_once; ++l) {
        column[l] += to - k - count + j;
        if (l < count) of_row[0][l] = *column[l];
      }
      Real* const sums = below_.data();
      take_off(1, low - j, column, of_row, &sums);
    }
    inverse_[of] += below_[0];
    Real* const entries = entry_.data() + start_[of];
    for (std::size_t i = 1; i < low - j; ++i) entries[at_[rows[j + i]] - at_[of] - 1] += below_[i];
  }
}

void SparseCholesky::factorise(const std::vector<Index>& begin, const std::vector<Index>& column,
                               const std::vector<Real>& value, Real negligible) {
  std::fill(entry_.begin(), entry_.end(), 0.0);
  for (std::size_t node = 0; node + 1 < first_.size(); ++node) {
    locate_rows(node);
    for (Index k = first_[node]; k < first_[node + 1]; ++k)
      for (Index m = begin[order_[k]]; m < begin[order_[k] + 1]; ++m) {
        const Index i = place_[column[m]];
        if (i == k) inverse_[k] = diagonal_[k] = value[m];
        if (i > k) entry_[start_[k] + at_[i] - at_[k] - 1] = value[m];
      }
  }
  for (std::size_t node = 0; node + 1 < first_.size(); ++node) {
    factorise_columns(node, negligible);
    take_off_others(node);
  }
}

void SparseCholesky::eliminate(std::size_t node, int sides, Real* const* x) const {
  const Index from = first_[node], to = first_[node + 1];
  const std::size_t most = below_.size() / 3, low = start_[to] - start_[to - 1];
  const Index* rows = row_.data() + start_[to - 1];
  Real* below[3];
  for (int s = 0; s < sides; ++s) below[s] = std::fill_n(below_.data() + s * most, low, 0.0) - low;
  for (Index k = from; k < to; k += at_once) {
    Columns column;
    const int count = columns_from(k, to, column);
    Real y[3][at_once] = {};
    Real* beside[3];
    for (int s = 0; s < sides; ++s) {
      for (int j = 0; j < count; ++j) {
        y[s][j] = x[s][k + j] *= inverse_[k + j];
        for (int l = j + 1; l < count; ++l)
          x[s][k + l] -= entry_[start_[k + j] + l - j - 1] * y[s][j];
      }
      beside[s] = x[s] + k + count;
    }
    const std::size_t left = to - k - count;
    take_off(sides, left, column, y, beside);
    for (const Real*& a : column) a += left;
    take_off(sides, low, column, y, below);
  }
  for (int s = 0; s < sides; ++s)
    for (std::size_t i = 0; i < low; ++i) x[s][rows[i]] += below[s][i];
}

void SparseCholesky::substitute(std::size_t node, int sides, Real* const* x) const {
  const Index from = first_[node], to = first_[node + 1];
  const std::size_t most = below_.size() / 3, low = start_[to] - start_[to - 1];
  const Index* rows = row_.data() + start_[to - 1];
  Real* below[3];
  for (int s = 0; s < sides; ++s) {
    below[s] = below_.data() + s * most;
    for (std::size_t i = 0; i < low; ++i) below[s][i] = x[s][rows[i]];
  }
  for (Index k = to - 1 - (to - 1 - from) % at_once; k >= from; k -= at_once) {
    Columns column;
    const int count = columns_from(k, to, column);
    const Real* beside[3];
    for (int s = 0; s < sides; ++s) beside[s] = x[s] + k + count;
    Real sum[3][at_once] = {};
    const std::size_t left = to - k - count;
    add_dots(sides, left, column, beside, sum);
    for (const Real*& a : column) a += left;
    add_dots(sides, low, column, below, sum);
    for (int s = 0; s < sides; ++s)
      for (int j = count; j-- > 0;) {
        for (int l = j + 1; l < count; ++l)
          sum[s][j] += entry_[start_[k + j] + l - j - 1] * x[s][k + l];
        x[s][k + j] = inverse_[k + j] * (x[s][k + j] - sum[s][j]);
      }
  }
}

void SparseCholesky::solve(Real* const* r, int sides) const {
  const std::size_t rows = order_.size(), nodes = first_.size() - 1;
  Real* x[3];
  for (int s = 0; s < sides; ++s) {
    x[s] = work_.data() + s * rows;
    for (std::size_t k = 0; k < rows; ++k) x[s][k] = r[s][order_[k]];
  }
  for (std::size_t node = 0; node < nodes; ++node) eliminate(node, sides, x);
  for (std::size_t node = nodes; node-- > 0;) substitute(node, sides, x);
  for (int s = 0; s < sides; ++s)
    for (std::size_t k = 0; k < rows; ++k) r[s][order_[k]] = std::exchange(x[s][k], 0);
}

}  // namespace rockfold::solve
