// Convex polygons on a plane of the table: faces of cells, shared fragments, and what is left when some are taken
// away. All questions are signs of four planes, as for cells.
#pragma once

#include <span>
#include <vector>

#include "host/cut/cells/convex_cell.hpp"

namespace rockfold {

/// A convex polygon on `plane`, counter-clockwise seen from above it. Edge i runs from corner i to corner i + 1 and the
/// polygon lies inside the half-space edge[i].
struct Polygon {
  Index plane = none;
  std::vector<Vertex> corner;
  std::vector<HalfSpaceId> edge;  ///< same length

  bool empty() const { return corner.size() < 3; }
};

/// A face of a cell as a polygon (reversed where the cell lies above its plane).
Polygon face_polygon(const CellView& cell, const ConvexCell::Face& face);

/// Area of a cell's face, m².
Real face_area(const CellView& cell, const ConvexCell::Face& face);

/// Area in m², and the centroid about the table's centre.
struct PolygonMoments {
  Real area = 0;
  Vec3 centroid{};
};
PolygonMoments polygon_moments(const Polygon& polygon);

/// m: the least width of a convex polygon in its plane, corners in a row; 0 for fewer than three.
Real width_in_plane(std::span<const Vec3> corner, const Vec3& normal);

/// Clips polygons; keeps its workspace.
class PolygonClipper {
 public:
  explicit PolygonClipper(const PlaneTable& planes) : planes_(planes) {}

  /// The parts of `polygon` inside and outside a half-space whose plane is not the polygon's own; either may come out
  /// empty (no area). `outside` may be null.
  void split(const Polygon& polygon, HalfSpaceId h, Polygon& inside, Polygon* outside);

  /// How much of a polygon lies inside half-spaces none of whose planes is the polygon's own.
  enum class Share { nothing, some, all };  ///< `some` may turn out to be nothing
  Share share(const Polygon& polygon, std::span<const HalfSpaceId> inside);

  /// The part of `a` inside all of the half-spaces; empty if they share no area.
  Polygon intersection(const Polygon& a, std::span<const HalfSpaceId> inside);

  /// What is left of `a` without that part, as convex polygons appended to `rest`: `a` itself if they share no area.
  void subtract(const Polygon& a, std::span<const HalfSpaceId> inside, std::vector<Polygon>& rest);

 private:
  struct Extent {
    bool inside, outside;  // whether any corner lies strictly there
  };
  Extent classify(const Polygon& polygon, HalfSpaceId h);
  void write_part(const Polygon& polygon, HalfSpaceId h, Polygon& part) const;

  const PlaneTable& planes_;
  std::vector<std::int8_t> side_;
};

}  // namespace rockfold
