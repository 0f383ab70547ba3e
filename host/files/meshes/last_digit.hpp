// How finely the coordinates of a file are written.
#pragma once

#include <vector>

#include "src/base/types.hpp"

namespace rockfold {

/// m: what 1 in the last decimal means of the coordinate that needs most of them: 0.25 and 3 give 0.01. Of numbers that were stored in
/// single precision their shortest decimals count. 0 without points.
Real last_digit(const std::vector<Vec3>& points, bool single_precision);

}  // namespace rockfold
