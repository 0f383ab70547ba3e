// Simple polygons as convex ones.
#pragma once

#include <array>
#include <vector>

#include "src/base/types.hpp"

namespace rockfold {

/// Convex pieces of a simple counter-clockwise polygon: corners of each, counter-clockwise, as indices of the polygon's
/// points. The polygon itself if it is convex. Decided exactly on the coordinates given. O(n log n).
std::vector<std::vector<Index>> convex_pieces(const std::vector<std::array<Real, 2>>& polygon);

}  // namespace rockfold
