// A solid's shape as what the cutter takes: convex parts by half-spaces, or one closed surface of convex polygons.
// CGAL's numbers: include in .cpp only.
#pragma once

#include <vector>

#include "host/exact/plane_exact.hpp"
#include "src/model/model.hpp"

namespace rockfold {

/// One half-space of a convex part.
struct FacePlane {
  ExactPlane plane;
  bool inside_above = true;  ///< the part lies above the plane
  Index face =
      none;  ///< into face_names(shape); none = between two parts of one shape, never on its boundary
};

struct ConvexPart {
  std::vector<FacePlane>
      faces;  ///< their intersection; may be unbounded for a solid that is subtracted
};

/// A closed, outward oriented surface without self-intersections.
/// Example: a tetrahedron has 4 vertices, 4 polygons, polygon_begin = {0, 3, 6, 9, 12}.
struct ClosedSurface {
  std::vector<Vec3> vertices;           ///< m, taken exactly
  std::vector<Index> polygon_begin{0};  ///< [polygons + 1]
  std::vector<Index>
      corner;               ///< vertices of convex planar polygons, counter-clockwise from outside
  std::vector<Index> face;  ///< [polygons] into face_names(shape)
};

/// Either `parts` (the shape is their union) or `surface` is filled.
struct ShapeGeometry {
  std::vector<ConvexPart> parts;
  ClosedSurface surface;
  /// m; the shape lies in their convex hull. Empty for a shape without bounds (halfspaces that are subtracted).
  std::vector<Vec3> corners;
};

/// Throws Error(model) at `place` for a shape without volume, for half-spaces without bounds where `bounded` is asked for,
/// and for bends of a tunnel sharper than its width allows. Files have been read before (host/files).
ShapeGeometry shape_geometry(const Shape& shape, bool bounded, const Place& place);

}  // namespace rockfold
