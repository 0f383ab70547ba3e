// Cholesky's method for matrices that may be singular.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "src/base/types.hpp"

namespace rockfold::host {

/// P A Pᵀ = L Lᵀ for the lower half of a symmetric, positive semi-definite A of unit diagonal or less, the largest pivot first, until none is
/// larger than `least_pivot` (Hammarling, Higham & Lucas 2007). Returns the rank r; the first r columns of `a` become L, and `order` tells
/// where its rows stood.
Index pivoted_cholesky(Eigen::Ref<Eigen::MatrixXd> a, Real least_pivot, std::vector<Index>& order);

}  // namespace rockfold::host
