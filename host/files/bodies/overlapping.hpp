// Bodies of mesh files that lie in each other by more than rounding.
#pragma once

#include <vector>

#include "src/model/model.hpp"

namespace rockfold {

struct Overlap {
  Index body = none, other = none;  ///< a corner of `body` lies in `other`, …
  Real depth = 0;                   ///< m, … so deep, the deepest of all
  Index count = 0;                  ///< pairs of bodies that overlap
};

/// Corners that lie inside another body by more than `reach` (m); edges that cross without one are not seen. O(n log n) and what is near.
Overlap find_overlap(const std::vector<const TriangleSurface*>& bodies, Real reach);

}  // namespace rockfold
