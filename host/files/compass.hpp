// Directions as geologists write them: "N60E", "S 30° W", "SE".
#pragma once

#include <optional>
#include <string_view>

#include "src/base/types.hpp"

namespace rockfold {

/// deg clockwise from north, of a quadrant bearing (from N or S by 0 to 90 deg towards E or W); none of other texts.
std::optional<Real> quadrant_bearing(std::string_view text);

/// deg clockwise from north, of one of the 16 points of the compass: 135 of "SE"; none of other texts.
std::optional<Real> compass_point(std::string_view text);

/// deg, 0 to 180: between two directions.
Real turn_between(Real a, Real b);

/// A dip with the side that the plane dips to: "35SE", "60 NW".
struct SidedDip {
  Real dip = 0;   ///< deg
  Real side = 0;  ///< deg clockwise from north
};
std::optional<SidedDip> sided_dip(std::string_view text);

/// A side is named by the compass: planes dip within three sixteenths of a circle of it, or the letters mean another side.
constexpr Real widest_side = 67.5;  // deg

}  // namespace rockfold
