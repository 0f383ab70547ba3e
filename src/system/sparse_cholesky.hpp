// Cholesky's method for small sparse symmetric matrices, those of the points of surfaces.
#pragma once

#include <vector>

#include "src/base/types.hpp"

namespace rockfold::solve {

class SparseCholesky {
 public:
  SparseCholesky() = default;
  /// Where entries stand: the columns of row i are column[begin[i]] … column[begin[i + 1] − 1], both halves and the diagonal.
  SparseCholesky(const std::vector<Index>& begin, const std::vector<Index>& column);

  /// `value`: those of `column`, of a matrix that is positive, or all but positive: unknowns whose pivot is no more than `negligible` of
  /// their diagonal depend on others, and get no answer.
  void factorise(const std::vector<Index>& begin, const std::vector<Index>& column,
                 const std::vector<Real>& value, Real negligible = 0);
  /// Each right-hand side r, of `sides` ≤ 3, becomes its answer; [rows]. The factors are read once for all.
  void solve(Real* const* r, int sides) const;

  /// Columns of L that are read at a time, for all right-hand sides: what they are applied to is then read a quarter as often.
  static constexpr int at_once = 4;
  using Columns = const Real* [at_once];

 private:
  void find_entries(const std::vector<Index>& begin, const std::vector<Index>& column);
  void find_supernodes();
  void locate_rows(std::size_t node);
  void factorise_columns(std::size_t node, Real negligible);
  void take_off_others(std::size_t node);
  int columns_from(Index k, Index to, Columns& column) const;
  void eliminate(std::size_t node, int sides, Real* const* x) const;
  void substitute(std::size_t node, int sides, Real* const* x) const;

  std::vector<Index> order_, place_;  ///< [rows] the row at a place, and the place of a row
  std::vector<Index> parent_;         ///< [rows] in the elimination tree (Liu 1990), by place
  std::vector<std::size_t> start_;    ///< [rows + 1] of each column of L below its diagonal
  std::vector<Index> row_;            ///< of the entries of L, ascending in a column
  std::vector<Real> entry_;           ///< likewise
  std::vector<Real> inverse_;         ///< [rows] 1 / diagonal of L, 0 of unknowns without answer
  std::vector<Real> diagonal_;        ///< [rows] of the matrix
  /// [+1] Columns from first_[s] to first_[s + 1] − 1 have the same rows below them (Liu, Ng & Peyton 1993): as dense ones, without indices.
  std::vector<Index> first_;
  std::vector<Index> at_;            ///< [rows] work space
  mutable std::vector<Real> work_;   ///< [3][rows]
  mutable std::vector<Real> below_;  ///< [3][rows below a supernode, at most]
};

}  // namespace rockfold::solve
