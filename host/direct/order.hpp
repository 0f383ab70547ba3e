// Orders in which the rows of a sparse symmetric matrix are eliminated so that its factors stay sparse.
#pragma once

#include <vector>

#include "src/arrays/direct_solver.hpp"

namespace rockfold::host {

/// [P] The place of each row: those with the fewest neighbours left come first (approximate minimum degree; Amestoy, Davis & Duff 1996).
std::vector<Index> order_by_degree(const BlockMatrix& a);

/// [P] Likewise: what divides the rock into halves comes last (nested dissection by multilevel partitions; Karypis & Kumar 1998). Empty
/// where METIS does not know how.
std::vector<Index> order_by_dissection(const BlockMatrix& a);

}  // namespace rockfold::host
