// The order of nested dissection (George 1973) for matrices of surfaces: what stands on both sides of a row of neighbours comes before it.
#pragma once

#include <vector>

#include "src/base/types.hpp"

namespace rockfold::solve {

/// [rows] The row at each place. The columns of row i are column[begin[i]] … column[begin[i + 1] − 1], those of a symmetric matrix.
std::vector<Index> dissect(const std::vector<Index>& begin, const std::vector<Index>& column);

}  // namespace rockfold::solve
