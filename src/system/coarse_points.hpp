// Points as coarse levels see them: the rows N P of terms, which stand beside the matrices of all levels. Written into them they
// would couple covers that share no element, for which block rows have no place.
#pragma once

#include <vector>

#include "src/system/coarse_covers.hpp"

namespace rockfold::solve {

/// N P, in the unknowns of the coarse level. `step` (of covers of order 2, else empty): [entries of `coarse`][3] finer place −
/// coarser place in cells of the lattice; ξξ of a coarse cover there has slopes, which are the finer cover's ξ.
MaterialPoints coarsen_points(const MaterialPoints& points, const CoarseCovers& coarse,
                              const std::vector<Real>& step = {});

}  // namespace rockfold::solve
