// Triangles of a plane polygon with holes, for viewers that draw convex polygons only.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "src/base/types.hpp"

namespace rockfold {

/// A loop of points by number: counter-clockwise for an outer boundary seen from the tip of the
/// normal, clockwise for a hole.
using Loop = std::span<const Index>;

/// Whether a polygon turns left or goes straight at each corner (to 1e-9 of the sine).
bool is_convex(Loop loop, const std::vector<Vec3>& points, const Vec3& normal);

/// Ear clipping after each hole was joined to the boundary by a bridge (Held 2001; Eberly 2008).
/// loops[0] is the outer boundary. Triangles turn as the boundary does, cover the polygon once, and
/// use no other points; corners on a straight edge are kept as corners. Takes n² operations for n
/// corners, n³ at worst.
/// Example: a square with a square hole: 8 triangles.
std::vector<std::array<Index, 3>> triangulate(std::span<const Loop> loops,
                                              const std::vector<Vec3>& points, const Vec3& normal);

}  // namespace rockfold
