// How much of a polygon lies in a box.
#pragma once

#include <vector>

#include "host/joints/disc.hpp"
#include "src/base/types.hpp"

namespace rockfold {

/// m², of the part of a planar polygon (simple, may be concave) that lies in the box.
Real area_in_box(const std::vector<Vec3>& polygon, const Extent& box);

}  // namespace rockfold
