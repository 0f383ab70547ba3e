// The planes of the edges of finite joints (decision 5, rule 3).
#pragma once

#include <vector>

#include "host/cut/cells/patch.hpp"
#include "host/exact/plane_table.hpp"

namespace rockfold {

/// A convex polygon on a plane of the table.
struct FlatPolygon {
  Index plane = none;
  std::vector<Vec3> corner;  ///< m, as given; counter-clockwise seen from above the plane
};

/// A plane that the user gave, where it is: everywhere, or in a box (m, model coordinates).
struct GivenFace {
  Index plane = none;
  Box box = Box::everything();
};

struct EdgePlanes {
  /// [polygons] the half-spaces that bound each on its plane, edge i (from corner i to i + 1) first.
  std::vector<std::vector<HalfSpaceId>> edges;
  Index identified = 0;  ///< edges that took a plane which they miss by rounding or noise
};

/// An edge that lies on a given plane (of another polygon near it, or one of `given`) takes that plane: to 1e-10 of the
/// model's size where the sine of their angle is over 1e-3, whatever the angle where it lies there exactly. Another one takes
/// the edge plane of a longer edge that it lies on; else a plane of its own, perpendicular to the polygon's.
/// Does not depend on the order of the polygons but for the numbers of planes. O(n log³ n) and what meets.
EdgePlanes edge_planes(PlaneTable& planes, const std::vector<FlatPolygon>& polygons,
                       const std::vector<GivenFace>& given);

/// The plane through an edge from a to b, perpendicular to another one: exactly through both ends.
Index plane_across(PlaneTable& planes, const Vec3& a, const Vec3& b, Index perpendicular_to);

/// The side of an edge's plane that holds the corners, by the farthest of them, exactly where that is within the identity tolerance; none where all
/// lie on it.
HalfSpaceId side_of_corners(const PlaneTable& planes, Index edge_plane,
                            const std::vector<Vec3>& corners);

}  // namespace rockfold
