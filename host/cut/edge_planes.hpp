// The planes of the edges of polygons (DESIGN.md, "Intent is kept at the door", rules 3 and 4).
#pragma once

#include <vector>

#include "host/exact/plane_table.hpp"

namespace rockfold {

/// A convex polygon on a plane of the table.
struct FlatPolygon {
  Index plane = none;
  std::vector<Vec3> corner;  ///< m, as given; counter-clockwise seen from above the plane
};

/// The half-spaces that bound each polygon on its plane, edge i (from corner i to i + 1) first. An edge that lies on a
/// given plane (of another polygon near it, or one of `unbounded`) takes that plane, if their angle allows it; another one
/// takes the edge plane of a longer edge that it lies on; else a plane of its own, perpendicular to the polygon's.
/// Does not depend on the order of the polygons but for the numbers of planes. O(n log³ n) and what meets.
std::vector<std::vector<HalfSpaceId>> edge_planes(PlaneTable& planes,
                                                  const std::vector<FlatPolygon>& polygons,
                                                  const std::vector<Index>& unbounded);

}  // namespace rockfold
