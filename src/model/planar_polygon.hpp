// What makes points a simple polygon of one plane: bases of prisms, sections of tunnels, joints.
#pragma once

#include <string>
#include <vector>

#include "src/base/types.hpp"

namespace rockfold {

/// What is wrong with a polygon, "" if nothing: 3 to 10,000 points, coplanar to 1e-9 of its size, no
/// two equal, no three neighbours collinear, no edges that cross or touch. It may be concave and go
/// round either way. The points at fault are named, counting from 1. O(n log n) for edges of about
/// one length, O(n²) at worst.
std::string polygon_problem(const std::vector<Vec3>& points);

/// The same for the polygon's projection along `normal` (unit) on a plane.
std::string projected_polygon_problem(const std::vector<Vec3>& points, const Vec3& normal);

// Of a polygon without problem:

/// Twice its vector area, by Newell's method: counter-clockwise seen from its tip. Exactly along an
/// axis for a polygon whose points agree exactly in that coordinate.
Vec3 doubled_area(const std::vector<Vec3>& points);

bool is_convex(const std::vector<Vec3>& points);

/// Whether `direction` leaves its plane.
bool leaves_plane(const std::vector<Vec3>& points, const Vec3& direction);

}  // namespace rockfold
