// What makes points the base of a prism.
#pragma once

#include <string>
#include <vector>

#include "src/base/types.hpp"

namespace rockfold {

/// What is wrong with the base, "" if nothing: its points must be coplanar to 1e-9 of its size, no
/// two neighbours equal, no three collinear, and go once around a convex polygon.
std::string base_problem(const std::vector<Vec3>& base);

/// Whether `extrude` leaves the plane of a base without problem.
bool leaves_plane(const std::vector<Vec3>& base, const Vec3& extrude);

}  // namespace rockfold
