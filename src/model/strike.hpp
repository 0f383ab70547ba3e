// Strikes, as many tables and models give orientations.
#pragma once

#include "src/base/types.hpp"

namespace rockfold {

/// Into a full circle, deg.
inline Real turned(Real angle) {
  return angle < 0 ? angle + 360 : angle >= 360 ? angle - 360 : angle;
}

/// Dip direction (deg) of a plane that dips to the right of its strike, or to the left.
inline Real dip_direction_of(Real strike, bool left_hand) {
  return turned(left_hand ? strike - 90 : strike + 90);
}

}  // namespace rockfold
