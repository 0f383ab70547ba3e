// Places as people write them.
#pragma once

#include <string>

#include "src/base/types.hpp"

namespace rockfold {

/// "(412345.12, 5802117.4, -20)": metres, whole, to the millimetre; where all are below 1 m, to four digits of the largest.
std::string place_text(const Vec3& place);

/// The same of a place that the user gave: whole, with all digits that it was given with.
std::string given_place_text(const Vec3& place);

}  // namespace rockfold
