// Cholesky's method for matrices that may be singular.
#pragma once

#include <vector>

#include "src/base/types.hpp"

namespace rockfold::host {

/// P A Pᵀ = L Lᵀ for the lower half of a symmetric, positive semi-definite n × n matrix, the largest pivot first, until none is larger than
/// `least_pivot` (Hammarling, Higham & Lucas 2007). Columns of `a` are `stride` apart. Returns the rank r; the first r columns become L, and
/// `order` tells where its rows stood.
Index pivoted_cholesky(Real* a, Index n, Index stride, Real least_pivot, std::vector<Index>& order);

}  // namespace rockfold::host
