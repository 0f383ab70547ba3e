#include "host/direct/multifrontal.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

#include "host/direct/front_tree.hpp"
#include "host/direct/pivoted_cholesky.hpp"
#include "src/base/interrupt.hpp"

namespace rockfold::host {
namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

/// Of a front's own unknowns those that get an answer, in the order of their pivots; L of them, and of the rows below.
struct Factor {
  std::vector<Index> column;
  Matrix own, below;
};

class Multifrontal : public DirectSolver {
 public:
  explicit Multifrontal(const DirectLimits& limits) : limits_(limits) {}

  bool analyse(const BlockMatrix& a) override;
  double operations() const override { return tree_.operations; }
  double entries() const override { return tree_.entries; }
  bool factorise(const BlockMatrix& a, Real least_pivot) override;
  void solve(std::vector<Real>& r) const override;

 private:
  void find_scale(const BlockMatrix& a);
  Matrix assemble(const BlockMatrix& a, Index f, std::vector<Matrix>& left);
  Matrix eliminate(Matrix& front, Index f, Real least_pivot);
  Index own(Index f) const { return width_ * (tree_.first[f + 1] - tree_.first[f]); }
  Index rows(Index f) const { return width_ * (tree_.begin[f + 1] - tree_.begin[f]); }

  DirectLimits limits_;
  int width_ = 0;
  FrontTree tree_;
  std::vector<Index> row_at_;   // [P] the row of the matrix at each place
  std::vector<Real> scale_;     // [P · width] in the order: 1 / √diagonal, 0: no answer
  std::vector<Factor> factor_;  // [F]
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
Matrix Multifrontal::assemble(const BlockMatrix& a, Index f, std::vector<Matrix>& left) {
  const int w = width_;
  const Index begin = tree_.begin[f], end = tree_.begin[f + 1];
  const auto* row = tree_.row.data();
  const auto local = [&](Index place) {
    return w * static_cast<Index>(std::lower_bound(row + begin, row + end, place) - (row + begin));
  };
  Matrix front = Matrix::Zero(rows(f), rows(f));
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
          front(at_i + e, at_j + d) = v[e * w + d] * scale_[static_cast<std::size_t>(i) * w + e] *
                                      scale_[static_cast<std::size_t>(j) * w + d];
    }
  }
  for (Index c = tree_.child_begin[f]; c < tree_.child_begin[f + 1]; ++c) {
    const Index child = tree_.child[c];
    const Index from = tree_.begin[child] + tree_.first[child + 1] - tree_.first[child];
    const Index blocks = tree_.begin[child + 1] - from;
    std::vector<Index> to(blocks);
    for (Index i = 0; i < blocks; ++i) to[i] = local(row[from + i]);
    Matrix& s = left[child];
    for (Index j = 0; j < blocks; ++j)
      for (Index i = j; i < blocks; ++i)
        front.block(to[i], to[j], w, w) += s.block(w * i, w * j, w, w);
    s.resize(0, 0);
  }
  return front;
}

/// Eliminates the front's own columns. Pivots that are rounding alone stand for functions that depend on the others: they get no
/// answer. Returns what is left to the parent.
Matrix Multifrontal::eliminate(Matrix& front, Index f, Real least_pivot) {
  const Index columns = own(f), below = rows(f) - columns;
  Factor& factor = factor_[f];
  std::vector<Index> order;
  const Index rank = pivoted_cholesky(front.data(), columns, rows(f), least_pivot, order);
  order.resize(rank);
  factor.own = front.topLeftCorner(rank, rank);
  factor.below.resize(below, rank);
  for (Index j = 0; j < rank; ++j) factor.below.col(j) = front.col(order[j]).tail(below);
  factor.column = std::move(order);
  if (below == 0) return {};
  Matrix left = front.bottomRightCorner(below, below);
  if (rank == 0) return left;  // Eigen divides by the depth of a product
  factor.own.triangularView<Eigen::Lower>().transpose().solveInPlace<Eigen::OnTheRight>(
      factor.below);
  left.selfadjointView<Eigen::Lower>().rankUpdate(factor.below, -1);
  return left;
}

bool Multifrontal::analyse(const BlockMatrix& a) {
  tree_ = make_front_tree(a);
  width_ = a.width;
  row_at_.resize(a.rows());
  for (Index i = 0; i < a.rows(); ++i) row_at_[tree_.place[i]] = i;
  return tree_.operations <= limits_.operations &&
         sizeof(Real) * (tree_.entries + tree_.most_at_once) <= limits_.bytes;
}

bool Multifrontal::factorise(const BlockMatrix& a, Real least_pivot) {
  find_scale(a);
  factor_.assign(tree_.fronts(), {});
  std::vector<Matrix> left(tree_.fronts());
  for (Index f = 0; f < tree_.fronts(); ++f) {
    if (interrupt_signal) return false;
    Matrix front = assemble(a, f, left);
    left[f] = eliminate(front, f, least_pivot);
  }
  return true;
}

void Multifrontal::solve(std::vector<Real>& r) const {
  const int w = width_;
  const Index n = static_cast<Index>(tree_.place.size());
  Vector x(static_cast<Eigen::Index>(n) * w);
  for (Index i = 0; i < n; ++i)
    for (int e = 0; e < w; ++e)
      x(tree_.place[i] * w + e) = r[static_cast<std::size_t>(i) * w + e] *
                                  scale_[static_cast<std::size_t>(tree_.place[i]) * w + e];
  // Rows of a front beyond its own.
  const auto for_each_below = [&](Index f, const auto& visit) {
    Index at = 0;
    for (Index m = tree_.begin[f] + tree_.first[f + 1] - tree_.first[f]; m < tree_.begin[f + 1];
         ++m, at += w)
      visit(at, tree_.row[m] * w);
  };
  std::vector<Vector> answer(tree_.fronts());
  Vector below;
  for (Index f = 0; f < tree_.fronts(); ++f) {
    const Factor& factor = factor_[f];
    auto own_part = x.segment(tree_.first[f] * w, own(f));
    Vector& y = answer[f] = own_part(factor.column);
    factor.own.triangularView<Eigen::Lower>().solveInPlace(y);
    own_part.setZero();
    below.noalias() = factor.below * y;
    for_each_below(f, [&](Index at, Index to) { x.segment(to, w) -= below.segment(at, w); });
  }
  for (Index f = tree_.fronts(); f-- > 0;) {
    const Factor& factor = factor_[f];
    below.resize(rows(f) - own(f));
    for_each_below(f, [&](Index at, Index from) { below.segment(at, w) = x.segment(from, w); });
    Vector& y = answer[f];
    y.noalias() -= factor.below.transpose() * below;
    factor.own.triangularView<Eigen::Lower>().transpose().solveInPlace(y);
    for (std::size_t j = 0; j < factor.column.size(); ++j)
      x(tree_.first[f] * w + factor.column[j]) = y(j);
  }
  for (Index i = 0; i < n; ++i)
    for (int e = 0; e < w; ++e)
      r[static_cast<std::size_t>(i) * w + e] =
          x(tree_.place[i] * w + e) * scale_[static_cast<std::size_t>(tree_.place[i]) * w + e];
}

}  // namespace

std::unique_ptr<DirectSolver> make_direct_solver(const DirectLimits& limits) {
  return std::make_unique<Multifrontal>(limits);
}

}  // namespace rockfold::host
