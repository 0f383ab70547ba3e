#include "host/direct/pivoted_cholesky.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <Eigen/Core>

#include "host/direct/dense.hpp"

namespace rockfold::host {
namespace {

using Block = Eigen::Map<Eigen::MatrixXd, 0, Eigen::OuterStride<>>;

/// Columns that are found before the rest of the matrix follows.
constexpr Index panel = 32;

/// Exchanges rows and columns i < j of the lower half.
void exchange(Block& a, Index i, Index j) {
  const Index n = static_cast<Index>(a.rows());
  a.row(i).head(i).swap(a.row(j).head(i));
  for (Index k = i + 1; k < j; ++k) std::swap(a(k, i), a(j, k));
  a.col(i).tail(n - j - 1).swap(a.col(j).tail(n - j - 1));
  std::swap(a(i, i), a(j, j));
}

}  // namespace

Index pivoted_cholesky(Real* values, Index n, Index stride, Real least_pivot,
                       std::vector<Index>& order) {
  Block a(values, n, n, Eigen::OuterStride<>(stride));
  order.resize(n);
  std::iota(order.begin(), order.end(), 0);
  Eigen::VectorXd diagonal = a.diagonal();  // with the panel's columns taken off
  for (Index begin = 0; begin < n; begin += panel) {
    const Index end = std::min(begin + panel, n);
    for (Index j = begin; j < end; ++j) {
      Eigen::Index largest = 0;
      const Real pivot = diagonal.tail(n - j).maxCoeff(&largest);
      if (!(pivot > least_pivot)) return j;
      const Index from = j + static_cast<Index>(largest), under = n - j - 1;
      if (from != j) {
        exchange(a, j, from);
        std::swap(diagonal(j), diagonal(from));
        std::swap(order[j], order[from]);
      }
      auto column = a.col(j).tail(under);
      column.noalias() -=
          a.block(j + 1, begin, under, j - begin) * a.row(j).segment(begin, j - begin).transpose();
      const Real root = std::sqrt(pivot);
      a(j, j) = root;
      column /= root;
      diagonal.tail(under) -= column.cwiseAbs2();
    }
    if (end < n)
      take_off_square(n - end, end - begin, &a(end, begin), stride, &a(end, end), stride);
  }
  return n;
}

}  // namespace rockfold::host
