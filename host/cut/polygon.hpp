// Convex polygons on a plane of the table: faces of cells, shared fragments, and what is left when some are taken
// away. All questions are signs of four planes, as for cells.
#pragma once

#include <vector>

#include "host/cut/convex_cell.hpp"

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

/// Area in m², and the centroid about the table's centre.
struct PolygonMoments {
  Real area = 0;
  Vec3 centroid{};
};
PolygonMoments polygon_moments(const Polygon& polygon);

/// Clips polygons; keeps its workspace.
class PolygonClipper {
 public:
  explicit PolygonClipper(const PlaneTable& planes) : planes_(planes) {}

  /// The parts of `polygon` inside and outside a half-space whose plane is not the polygon's own; either may come out
  /// empty (no area). `outside` may be null.
  void split(const Polygon& polygon, HalfSpaceId h, Polygon& inside, Polygon* outside);

  /// The common part of two polygons of one plane; empty if they share no area.
  Polygon intersection(const Polygon& a, const Polygon& b);

  /// What is left of `a` without `b`, as convex polygons appended to `rest`.
  void subtract(const Polygon& a, const Polygon& b, std::vector<Polygon>& rest);

  IntentCount intent;

 private:
  void write_part(const Polygon& polygon, HalfSpaceId h, Polygon& part) const;

  const PlaneTable& planes_;
  std::vector<std::int8_t> side_;
};

}  // namespace rockfold
