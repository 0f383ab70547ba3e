// What the factors of a sparse symmetric matrix look like, before any number is computed: an order that keeps them sparse, and the
// fronts (supernodes) of the multifrontal method (Duff & Reid 1983; Liu 1992).
#pragma once

#include <array>
#include <vector>

#include "src/arrays/direct_solver.hpp"

namespace rockfold::host {

/// Fronts in postorder: each comes after all those that hand it what they leave. Columns are numbered by their place in the order.
struct FrontTree {
  std::vector<Index> place;  ///< [P] of each row of the matrix in the order
  std::vector<Index> first;  ///< [F+1] front f eliminates columns first[f] … first[f + 1] − 1
  std::vector<Index> begin;  ///< [F+1] into `row`
  std::vector<Index>
      row;  ///< all rows of a front, ascending: its own columns, then those that it hands on
  std::vector<Index> parent;              ///< [F] or none
  std::vector<Index> child_begin, child;  ///< [F+1]; ascending
  std::vector<Index> in_parent;  ///< [row] of what is handed on: its place among the parent's rows
  /// Subtrees that need nothing of each other: their fronts, one after the other, from … to − 1; and those above, in their order.
  std::vector<std::array<Index, 2>> subtree;
  std::vector<Index> top;
  double entries = 0;       ///< of the factors
  double operations = 0;    ///< multiplications, each with an addition, of the factorisation
  double most_at_once = 0;  ///< entries of fronts and of what is handed on, at their worst

  Index fronts() const { return static_cast<Index>(parent.size()); }
  /// Where the rows that front f hands on begin.
  Index handed_on(Index f) const { return begin[f] + first[f + 1] - first[f]; }
};

FrontTree make_front_tree(const BlockMatrix& a);

}  // namespace rockfold::host
