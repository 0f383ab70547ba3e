// Boxes and intersections of half-spaces.
#include <algorithm>

#include "host/cut/cells/convex_cell.hpp"
#include "host/exact/orientation.hpp"
#include "host/refuse.hpp"
#include "host/shapes/families_exact.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {

constexpr Real unbounded_reach = 1e12;  // m: coordinates are limited to 1e9 when the model is read

// The corners of an intersection of half-spaces; none if it is unbounded and need not be bounded.
std::vector<Vec3> corners_of(const HalfspacesShape& shape, const ConvexPart& part, bool bounded,
                             const Place& place) {
  const auto& planes = shape.planes;
  Vec3 centre{};
  for (const HalfSpace& h : planes)
    centre += (1.0 / static_cast<Real>(planes.size())) * h.plane.point;
  Real size = 0;
  for (const HalfSpace& h : planes) size = std::max(size, norm(h.plane.point - centre));
  PlaneTable table(centre, size > 0 ? size : 1);
  std::vector<HalfSpaceId> inside;
  for (const FacePlane& f : part.faces)
    inside.push_back(half_space(table.add(f.plane), f.inside_above));
  const ConvexCell cell = clip_cube(table, unbounded_reach, inside);
  if (cell.faces.empty()) {
    if (!bounded) return {};
    refuse(place, place.key, "the half-spaces have no point in common; found nothing to add");
  }
  std::vector<Vec3> corners;
  for (const Vertex& v : cell.vertices) {
    if (norm(v.x) > unbounded_reach / 10) {
      if (!bounded) return {};
      refuse(place, place.key,
             "the half-spaces enclose no bounded volume; a solid that is added needs planes on all "
             "sides");
    }
    corners.push_back(v.x + centre);
  }
  return corners;
}

}  // namespace

ShapeGeometry box_geometry(const BoxShape& box) {
  ShapeGeometry geometry;
  auto& faces = geometry.parts.emplace_back().faces;
  for (int d = 0; d < 3; ++d) {
    Vec3 n{};
    n[d] = 1;
    faces.push_back({plane_through(n, box.min), true, 2 * d});
    faces.push_back({plane_through(n, box.max), false, 2 * d + 1});
  }
  geometry.corners = box_corners(box.min, box.max);
  return geometry;
}

ShapeGeometry halfspaces_geometry(const HalfspacesShape& shape, bool bounded, const Place& place) {
  ShapeGeometry geometry;
  ConvexPart& part = geometry.parts.emplace_back();
  for (const HalfSpace& h : shape.planes)
    part.faces.push_back({plane_through(normal_of(h.plane.orientation), h.plane.point),
                          h.keep_above, static_cast<Index>(part.faces.size())});
  geometry.corners = corners_of(shape, part, bounded, place);
  return geometry;
}

}  // namespace rockfold
