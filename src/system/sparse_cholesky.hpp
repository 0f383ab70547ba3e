// Cholesky's method for small sparse symmetric matrices, those of the points of surfaces, in the order of nested dissection (George 1973): what
// stands on both sides of a row of neighbours comes before it.
#pragma once

#include <vector>

#include "src/base/types.hpp"

namespace rockfold::solve {

class SparseCholesky {
 public:
  SparseCholesky() = default;
  /// Where entries stand: the columns of row i are column[begin[i]] … column[begin[i + 1] − 1], both halves and the diagonal.
  SparseCholesky(const std::vector<Index>& begin, const std::vector<Index>& column);

  /// `value`: those of `column`, of a matrix that is positive.
  void factorise(const std::vector<Index>& begin, const std::vector<Index>& column,
                 const std::vector<Real>& value);
  /// Each of the r, of `columns` ≤ 3, becomes its answer; [rows]. The factors are read once for all.
  void solve(Real* const* r, int columns) const;

 private:
  /// The columns of L in row k, as they have to be taken, into `reached`; how many.
  Index reach(Index k, const std::vector<Index>& begin, const std::vector<Index>& column);
  void find_supernodes();
  template <int Columns>
  void solve_columns(Real* const* r) const;
  template <int Columns>
  void eliminate(std::size_t node, Real* const* x) const;
  template <int Columns>
  void substitute(std::size_t node, Real* const* x) const;

  std::vector<Index> order_, place_;  ///< [rows] the row at a place, and the place of a row
  std::vector<Index> parent_;         ///< [rows] in the elimination tree (Liu 1990), by place
  std::vector<std::size_t> start_;    ///< [rows + 1] of each column of L below its diagonal
  std::vector<Index> row_;            ///< of the entries of L, ascending in a column
  std::vector<Real> entry_;           ///< likewise
  std::vector<Real> inverse_;         ///< [rows] 1 / diagonal of L
  /// [+1] Columns from first_[s] to first_[s + 1] − 1 have the same rows below them (Liu, Ng & Peyton 1993): as dense ones, without indices.
  std::vector<Index> first_;
  std::vector<Index> mark_, reached_;  ///< [rows] work space
  mutable std::vector<Real> work_;     ///< [3][rows]
  mutable std::vector<Real> below_;    ///< [3][rows below a supernode, at most]
};

}  // namespace rockfold::solve
