#include "src/system/sparse_cholesky.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rockfold::solve {
namespace {

/// The order of nested dissection.
class Dissection {
 public:
  Dissection(const std::vector<Index>& begin, const std::vector<Index>& column)
      : begin_(begin), column_(column), level_(begin.size() - 1, none), part_(level_.size(), 0) {}

  std::vector<Index> run() {
    std::vector<Index> all(level_.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<Index>(i);
    std::vector<std::vector<Index>> open;
    open.push_back(std::move(all));
    // From the end: what divides a part comes after it.
    while (!open.empty()) {
      std::vector<Index> rows = std::move(open.back());
      open.pop_back();
      if (rows.empty()) continue;
      if (rows.size() <= small) {
        order_.insert(order_.end(), rows.begin(), rows.end());
        continue;
      }
      divide(rows, open);
    }
    std::reverse(order_.begin(), order_.end());
    return std::move(order_);
  }

 private:
  static constexpr std::size_t small = 24;  ///< rows that are not divided

  /// Breadth first from `from` within the part of its rows: those met, by level.
  std::vector<Index> levels_from(Index from, Index part) {
    std::vector<Index> met{from};
    level_[from] = 0;
    for (std::size_t at = 0; at < met.size(); ++at)
      for (Index m = begin_[met[at]]; m < begin_[met[at] + 1]; ++m)
        if (const Index j = column_[m]; part_[j] == part && level_[j] == none) {
          level_[j] = level_[met[at]] + 1;
          met.push_back(j);
        }
    return met;
  }

  /// Puts the level in the midst of a part last, and what is left of it on both sides among the open ones.
  void divide(const std::vector<Index>& rows, std::vector<std::vector<Index>>& open) {
    const Index part = ++parts_;
    for (const Index i : rows) part_[i] = part, level_[i] = none;
    std::vector<Index> met = levels_from(rows.front(), part);
    if (met.size() < rows.size()) {  // another piece
      std::vector<Index> rest;
      for (const Index i : rows)
        if (level_[i] == none) rest.push_back(i);
      open.push_back(std::move(rest));
      open.push_back(std::move(met));
      return;
    }
    for (const Index i : rows) level_[i] = none;
    met = levels_from(met.back(), part);  // from its end
    const Index middle = level_[met[met.size() / 2]];
    std::vector<Index> before, after;
    for (const Index i : met) {
      if (level_[i] < middle)
        before.push_back(i);
      else if (level_[i] > middle)
        after.push_back(i);
      else
        order_.push_back(i);
    }
    open.push_back(std::move(before));
    open.push_back(std::move(after));
  }

  const std::vector<Index>&begin_, &column_;
  std::vector<Index> level_, part_, order_;
  Index parts_ = 0;
};

}  // namespace

SparseCholesky::SparseCholesky(const std::vector<Index>& begin, const std::vector<Index>& column)
    : order_(Dissection(begin, column).run()) {
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
  mark_.assign(rows, none);
  reached_.resize(rows);
  work_.assign(3 * static_cast<std::size_t>(rows), 0);
  inverse_.resize(rows);
  start_.assign(rows + 1, 0);
  for (Index k = 0; k < rows; ++k)
    for (Index i = reach(k, begin, column); i < rows; ++i) ++start_[reached_[i] + 1];
  for (Index k = 0; k < rows; ++k) start_[k + 1] += start_[k];
  find_supernodes();
  row_.resize(start_[rows]);
  entry_.resize(start_[rows]);
}

Index SparseCholesky::reach(Index k, const std::vector<Index>& begin,
                            const std::vector<Index>& column) {
  const Index rows = static_cast<Index>(order_.size());
  Index top = rows;
  mark_[k] = k;
  for (Index m = begin[order_[k]]; m < begin[order_[k] + 1]; ++m) {
    Index length = 0;
    for (Index i = place_[column[m]]; i < k && mark_[i] != k; i = parent_[i]) {
      reached_[length++] = i;
      mark_[i] = k;
    }
    while (length > 0) reached_[--top] = reached_[--length];
  }
  return top;
}

void SparseCholesky::factorise(const std::vector<Index>& begin, const std::vector<Index>& column,
                               const std::vector<Real>& value) {
  const Index rows = static_cast<Index>(order_.size());
  std::fill(mark_.begin(), mark_.end(), none);
  std::vector<std::size_t> end(start_.begin(), start_.end() - 1);
  std::vector<Real>& x = work_;
  for (Index k = 0; k < rows; ++k) {
    const Index top = reach(k, begin, column);
    Real diagonal = 0;
    for (Index m = begin[order_[k]]; m < begin[order_[k] + 1]; ++m)
      if (const Index i = place_[column[m]]; i < k)
        x[i] = value[m];
      else if (i == k)
        diagonal = value[m];
    for (Index at = top; at < rows; ++at) {
      const Index i = reached_[at];
      const Real l = std::exchange(x[i], 0) * inverse_[i];
      for (std::size_t p = start_[i]; p < end[i]; ++p) x[row_[p]] -= entry_[p] * l;
      diagonal -= l * l;
      row_[end[i]] = k;
      entry_[end[i]++] = l;
    }
    inverse_[k] = 1 / std::sqrt(diagonal);
  }
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

/// x · y in four sums, which is how it is as fast as a processor adds.
Real dot(const Real* x, const Real* y, std::size_t n) {
  Real sum[4] = {0, 0, 0, 0};
  std::size_t i = 0;
  for (; i + 4 <= n; i += 4)
    for (int k = 0; k < 4; ++k) sum[k] += x[i + k] * y[i + k];
  for (; i < n; ++i) sum[0] += x[i] * y[i];
  return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

/// y −= a x.
void take_off(Real a, const Real* x, Real* y, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) y[i] -= a * x[i];
}

}  // namespace

template <int Columns>
void SparseCholesky::eliminate(std::size_t node, Real* const* x) const {
  const Index from = first_[node], to = first_[node + 1];
  const std::size_t most = below_.size() / 3, low = start_[to] - start_[to - 1];
  const Index* rows = row_.data() + start_[to - 1];
  Real* const below = below_.data();
  for (int c = 0; c < Columns; ++c) std::fill_n(below + c * most, low, 0.0);
  for (Index k = from; k < to; ++k) {
    const Real* entry = entry_.data() + start_[k];
    const std::size_t beside = to - 1 - k;
    for (int c = 0; c < Columns; ++c) {
      const Real y = x[c][k] *= inverse_[k];
      take_off(y, entry, x[c] + k + 1, beside);
      take_off(y, entry + beside, below + c * most, low);
    }
  }
  for (std::size_t i = 0; i < low; ++i)
    for (int c = 0; c < Columns; ++c) x[c][rows[i]] += below[c * most + i];
}

template <int Columns>
void SparseCholesky::substitute(std::size_t node, Real* const* x) const {
  const Index from = first_[node], to = first_[node + 1];
  const std::size_t most = below_.size() / 3, low = start_[to] - start_[to - 1];
  const Index* rows = row_.data() + start_[to - 1];
  Real* const below = below_.data();
  for (std::size_t i = 0; i < low; ++i)
    for (int c = 0; c < Columns; ++c) below[c * most + i] = x[c][rows[i]];
  for (Index k = to; k-- > from;) {
    const Real* entry = entry_.data() + start_[k];
    const std::size_t beside = to - 1 - k;
    for (int c = 0; c < Columns; ++c)
      x[c][k] = inverse_[k] * (x[c][k] - dot(entry, x[c] + k + 1, beside) -
                               dot(entry + beside, below + c * most, low));
  }
}

template <int Columns>
void SparseCholesky::solve_columns(Real* const* r) const {
  const std::size_t rows = order_.size(), nodes = first_.size() - 1;
  Real* x[Columns];
  for (int c = 0; c < Columns; ++c) {
    x[c] = work_.data() + c * rows;
    for (std::size_t k = 0; k < rows; ++k) x[c][k] = r[c][order_[k]];
  }
  for (std::size_t node = 0; node < nodes; ++node) eliminate<Columns>(node, x);
  for (std::size_t node = nodes; node-- > 0;) substitute<Columns>(node, x);
  for (int c = 0; c < Columns; ++c)
    for (std::size_t k = 0; k < rows; ++k) r[c][order_[k]] = std::exchange(x[c][k], 0);
}

void SparseCholesky::solve(Real* const* r, int columns) const {
  if (columns == 1) return solve_columns<1>(r);
  if (columns == 2) return solve_columns<2>(r);
  solve_columns<3>(r);
}

}  // namespace rockfold::solve
