// Triangles of a plane polygon with holes, for viewers that draw convex polygons only.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "src/arrays/polygon_mesh.hpp"

namespace rockfold {

/// Constrained Delaunay triangles of the region that the loops wind around once or more, exact in
/// the coordinate plane nearest to the polygon's. loops[0] is the outer boundary, the others are
/// holes; corners on a straight edge are kept as corners. Triangles turn as the boundary does, cover
/// the region once and use no other points; where several points lie in one place, that of the loop
/// at whose side the triangle lies.
///
/// Takes any loops. They may touch, share edges and run back on themselves; what has no area has no
/// triangle. Of two edges that cross, as rounded ones may in their last bits, one is bent to the
/// nearest of their ends. Where a point is infinite or not a number there are no triangles.
/// About n log n operations for n corners.
/// Example: a square with a square hole: 8 triangles.
std::vector<std::array<Index, 3>> triangulate(std::span<const Loop> loops,
                                              const std::vector<Vec3>& points, const Vec3& normal);

}  // namespace rockfold
