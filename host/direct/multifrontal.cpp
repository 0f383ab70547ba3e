#include "host/direct/multifrontal.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

#include "host/direct/dense.hpp"
#include "host/direct/front_tree.hpp"
#include "host/direct/pivoted_cholesky.hpp"
#include "host/parallel.hpp"
#include "src/base/interrupt.hpp"

namespace rockfold::host {
namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

/// Entries that take longer to go through than other threads take to start.
constexpr double worthwhile = 1e5;

/// Of a front's own unknowns those that get an answer, in the order of their pivots; L of them, and of the rows below.
struct Factor {
  std::vector<Index> column;
  Matrix own, below;
};

/// The columns that a front eliminates, of all its rows, and the lower half of what it leaves to its parent.
struct Front {
  Matrix columns, left;
};

class Multifrontal : public DirectSolver {
 public:
  explicit Multifrontal(const DirectLimits& limits) : limits_(limits) {}

  bool analyse(const BlockMatrix& a) override;
  double operations() const override { return tree_.operations; }
  double entries() const override { return tree_.entries; }
  bool factorise(const BlockMatrix& a, Real least_pivot) override;
  void solve(std::vector<Real>& r) override;

 private:
  void find_scale(const BlockMatrix& a);
  Front assemble(const BlockMatrix& a, Index f, std::vector<Matrix>& left);
  void add_what_child_left(Index child, const Matrix& left, Front& front) const;
  void eliminate(Front& front, Index f, Real least_pivot);
  template <class F>
  void for_each_front(const F& f) const;
  void forward(Index f);
  void backward(Index f);
  Index own(Index f) const { return width_ * (tree_.first[f + 1] - tree_.first[f]); }
  Index rows(Index f) const { return width_ * (tree_.begin[f + 1] - tree_.begin[f]); }

  DirectLimits limits_;
  int width_ = 0;
  FrontTree tree_;
  std::vector<Index> row_at_;   // [P] the row of the matrix at each place
  std::vector<Real> scale_;     // [P · width] in the order: 1 / √diagonal, 0: no answer
  std::vector<Factor> factor_;  // [F]
  Vector x_;                    // [P · width] in the order
  Vector
      part_;  // [row · width] of each front: its answers in the order of pivots, and what it hands on
};

void Multifrontal::find_scale(const BlockMatrix& a) {
  const int w = width_;
  scale_.assign(static_cast<std::size_t>(a.rows()) * w, 0);
  for (Index i = 0; i < a.rows(); ++i)
    for (Index m = a.begin[i]; m < a.begin[i + 1]; ++m)
      if (a.column[m] == i)
        for (int e = 0; e < w; ++e) {
          const Real d = a.value[(static_cast<std::size_t>(m) * w + e) * w + e];
          scale_[static_cast<std::size_t>(tree_.place[i]) * w + e] = d > 0 ? 1 / std::sqrt(d) : 0;
        }
}

/// A front: the matrix's own entries and what children have left.
Front Multifrontal::assemble(const BlockMatrix& a, Index f, std::vector<Matrix>& left) {
  const int w = width_;
  const Index begin = tree_.begin[f], end = tree_.begin[f + 1];
  const auto* row = tree_.row.data();
  const auto local = [&](Index place) {
    return w * static_cast<Index>(std::lower_bound(row + begin, row + end, place) - (row + begin));
  };
  const Index below = rows(f) - own(f);
  Front front{Matrix::Zero(rows(f), own(f)), Matrix::Zero(below, below)};
  for (Index j = tree_.first[f]; j < tree_.first[f + 1]; ++j) {
    const Index of = row_at_[j];
    const Index at_j = w * (j - tree_.first[f]);
    for (Index m = a.begin[of]; m < a.begin[of + 1]; ++m) {
      const Index i = tree_.place[a.column[m]];
      if (i < j) continue;
      // Row `of` of the matrix is column j here: [column][row] is then (i, j) by rows.
      const Real* v = &a.value[static_cast<std::size_t>(m) * w * w];
      const Index at_i = local(i);
      for (int e = 0; e < w; ++e)
        for (int d = 0; d < w; ++d)
          front.columns(at_i + e, at_j + d) = v[e * w + d] *
                                              scale_[static_cast<std::size_t>(i) * w + e] *
                                              scale_[static_cast<std::size_t>(j) * w + d];
    }
  }
  for (Index c = tree_.child_begin[f]; c < tree_.child_begin[f + 1]; ++c) {
    add_what_child_left(tree_.child[c], left[tree_.child[c]], front);
    left[tree_.child[c]].resize(0, 0);
  }
  return front;
}

void Multifrontal::add_what_child_left(Index child, const Matrix& left, Front& front) const {
  const int w = width_;
  const Index* to = tree_.in_parent.data() + tree_.handed_on(child);
  const Index blocks = tree_.begin[child + 1] - tree_.handed_on(child);
  const Index own = static_cast<Index>(front.columns.cols());
  const auto add_columns = [&](std::int64_t j) {
    const bool eliminated = w * to[j] < own;
    const Index first = eliminated ? 0 : own;  // row and column of the part in which it stands
    for (int e = 0; e < w; ++e) {
      Real* into = (eliminated ? front.columns : front.left).col(w * to[j] + e - first).data();
      const Real* from = left.col(w * j + e).data();
      for (Index i = static_cast<Index>(j); i < blocks; ++i)
        for (int d = 0; d < w; ++d) into[w * to[i] + d - first] += from[w * i + d];
    }
  };
  parallel_for(blocks, 16, add_columns, static_cast<double>(left.size()) > worthwhile);
}

/// Eliminates the front's own columns, and takes them off what is left. Pivots that are rounding alone stand for functions that depend
/// on the others: they get no answer.
void Multifrontal::eliminate(Front& front, Index f, Real least_pivot) {
  const Index columns = own(f), below = rows(f) - columns;
  Factor& factor = factor_[f];
  std::vector<Index> order;
  const Index rank = pivoted_cholesky(front.columns.data(), columns, rows(f), least_pivot, order);
  order.resize(rank);
  factor.own = front.columns.topLeftCorner(rank, rank);
  factor.below.resize(below, rank);
  for (Index j = 0; j < rank; ++j) factor.below.col(j) = front.columns.col(order[j]).tail(below);
  factor.column = std::move(order);
  divide_by_transpose(below, rank, factor.own.data(), rank, factor.below.data(), below);
  take_off_square(below, rank, factor.below.data(), below, front.left.data(), below);
}

bool Multifrontal::analyse(const BlockMatrix& a) {
  tree_ = make_front_tree(a);
  width_ = a.width;
  row_at_.resize(a.rows());
  for (Index i = 0; i < a.rows(); ++i) row_at_[tree_.place[i]] = i;
  return tree_.operations <= limits_.operations &&
         sizeof(Real) * (tree_.entries + tree_.most_at_once) <= limits_.bytes;
}

/// Subtrees side by side, then one front after the other, which threads share.
template <class F>
void Multifrontal::for_each_front(const F& f) const {
  const auto in_subtree = [&](std::int64_t s) {
    for (Index i = tree_.subtree[s][0]; i < tree_.subtree[s][1]; ++i) f(i);
  };
  parallel_for(static_cast<std::int64_t>(tree_.subtree.size()), 1, in_subtree,
               tree_.entries > worthwhile);
  for (const Index i : tree_.top) f(i);
}

bool Multifrontal::factorise(const BlockMatrix& a, Real least_pivot) {
  find_scale(a);
  x_.resize(static_cast<Eigen::Index>(width_) * a.rows());
  part_.resize(static_cast<Eigen::Index>(width_) * static_cast<Eigen::Index>(tree_.row.size()));
  factor_.assign(tree_.fronts(), {});
  std::vector<Matrix> left(tree_.fronts());
  for_each_front([&](Index f) {
    if (interrupt_signal) return;
    Front front = assemble(a, f, left);
    eliminate(front, f, least_pivot);
    left[f] = std::move(front.left);
  });
  return !interrupt_signal;
}

/// L y = x of a front's own, with what its children hand on; then what it hands on itself.
void Multifrontal::forward(Index f) {
  const Factor& factor = factor_[f];
  auto own_part = x_.segment(width_ * tree_.first[f], own(f));
  auto below = part_.segment(width_ * tree_.handed_on(f), rows(f) - own(f));
  below.setZero();
  for (Index c = tree_.child_begin[f]; c < tree_.child_begin[f + 1]; ++c) {
    const Index child = tree_.child[c];
    for (Index m = tree_.handed_on(child); m < tree_.begin[child + 1]; ++m) {
      const Index to = width_ * tree_.in_parent[m];
      if (to < own(f))
        own_part.segment(to, width_) += part_.segment(width_ * m, width_);
      else
        below.segment(to - own(f), width_) += part_.segment(width_ * m, width_);
    }
  }
  auto y = part_.segment(width_ * tree_.begin[f], static_cast<Index>(factor.column.size()));
  for (std::size_t j = 0; j < factor.column.size(); ++j) y(j) = own_part(factor.column[j]);
  factor.own.triangularView<Eigen::Lower>().solveInPlace(y);
  below.noalias() -= factor.below * y;
}

/// Lᵀ x = y, with the answers of the fronts above.
void Multifrontal::backward(Index f) {
  const Factor& factor = factor_[f];
  auto own_part = x_.segment(width_ * tree_.first[f], own(f));
  auto below = part_.segment(width_ * tree_.handed_on(f), rows(f) - own(f));
  for (Index m = tree_.handed_on(f); m < tree_.begin[f + 1]; ++m)
    part_.segment(width_ * m, width_) = x_.segment(width_ * tree_.row[m], width_);
  auto y = part_.segment(width_ * tree_.begin[f], static_cast<Index>(factor.column.size()));
  y.noalias() -= factor.below.transpose() * below;
  factor.own.triangularView<Eigen::Lower>().transpose().solveInPlace(y);
  own_part.setZero();
  for (std::size_t j = 0; j < factor.column.size(); ++j) own_part(factor.column[j]) = y(j);
}

void Multifrontal::solve(std::vector<Real>& r) {
  const int w = width_;
  const Index n = static_cast<Index>(tree_.place.size());
  const auto scale = Eigen::Map<const Vector>(scale_.data(), x_.size());
  auto given = Eigen::Map<Vector>(r.data(), x_.size());
  for (Index i = 0; i < n; ++i)
    x_.segment(w * tree_.place[i], w) =
        given.segment(w * i, w).cwiseProduct(scale.segment(w * tree_.place[i], w));
  for_each_front([&](Index f) { forward(f); });
  for (Index t = static_cast<Index>(tree_.top.size()); t-- > 0;) backward(tree_.top[t]);
  const auto in_subtree = [&](std::int64_t s) {
    for (Index f = tree_.subtree[s][1]; f-- > tree_.subtree[s][0];) backward(f);
  };
  parallel_for(static_cast<std::int64_t>(tree_.subtree.size()), 1, in_subtree,
               tree_.entries > worthwhile);
  for (Index i = 0; i < n; ++i)
    given.segment(w * i, w) =
        x_.segment(w * tree_.place[i], w).cwiseProduct(scale.segment(w * tree_.place[i], w));
}

}  // namespace

std::unique_ptr<DirectSolver> make_direct_solver(const DirectLimits& limits) {
  return std::make_unique<Multifrontal>(limits);
}

}  // namespace rockfold::host
