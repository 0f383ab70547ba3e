// What the factors of a sparse symmetric matrix look like, before any number is computed: an order that keeps them sparse, and the
// fronts (supernodes) of the multifrontal method (Duff & Reid 1983; Liu 1992).
#pragma once

#include <cstdint>
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
  double entries = 0;                     ///< of the factors
  double operations = 0;    ///< multiplications, each with an addition, of the factorisation
  double most_at_once = 0;  ///< entries of fronts and of what is handed on, at their worst

  Index fronts() const { return static_cast<Index>(parent.size()); }
};

FrontTree make_front_tree(const BlockMatrix& a);

}  // namespace rockfold::host
