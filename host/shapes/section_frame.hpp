// How sections of tunnels and cylinders stand on their axis.
#pragma once

#include "src/base/types.hpp"

namespace rockfold {

/// Unit vectors (to rounding) across a direction, as seen along it: right × up points back at the viewer. `right` is
/// horizontal; for a vertical direction (to 1e-10) it is east, and up is then south of a rising and north of a falling one.
struct SectionFrame {
  Vec3 right{}, up{};
};

/// `direction` of any length but zero.
SectionFrame section_frame(const Vec3& direction);

}  // namespace rockfold
