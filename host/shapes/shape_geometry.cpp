#include <algorithm>

#include "host/shapes/exact_vector_exact.hpp"
#include "host/shapes/families_exact.hpp"
#include "host/shapes/shape_geometry_exact.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {

struct Builder {
  bool bounded;
  const Place& place;

  ShapeGeometry operator()(const BoxShape& s) const { return box_geometry(s); }
  ShapeGeometry operator()(const HalfspacesShape& s) const {
    return halfspaces_geometry(s, bounded, place);
  }
  ShapeGeometry operator()(const PrismShape& s) const { return prism_geometry(s, place); }
  ShapeGeometry operator()(const PyramidShape& s) const { return pyramid_geometry(s, place); }
  ShapeGeometry operator()(const FrustumShape& s) const { return frustum_geometry(s, place); }
  ShapeGeometry operator()(const CylinderShape& s) const { return cylinder_geometry(s, place); }
  ShapeGeometry operator()(const SphereShape& s) const { return sphere_geometry(s); }
  ShapeGeometry operator()(const TunnelShape& s) const { return tunnel_geometry(s, place); }
  ShapeGeometry operator()(const MeshShape& s) const { return mesh_geometry(s, place); }
  ShapeGeometry operator()(const TerrainShape& s) const { return terrain_geometry(s, place); }
};

}  // namespace

ShapeGeometry shape_geometry(const Shape& shape, bool bounded, const Place& place) {
  return std::visit(Builder{bounded, place}, shape);
}

std::vector<Vec3> box_corners(const Vec3& min, const Vec3& max) {
  std::vector<Vec3> corners;
  for (int c = 0; c < 8; ++c)
    corners.push_back({(c & 1 ? max : min)[0], (c & 2 ? max : min)[1], (c & 4 ? max : min)[2]});
  return corners;
}

std::vector<Vec3> bounding_corners(const std::vector<Vec3>& points) {
  Vec3 min = points.front(), max = min;
  for (const Vec3& p : points)
    for (int d = 0; d < 3; ++d) {
      min[d] = std::min(min[d], p[d]);
      max[d] = std::max(max[d], p[d]);
    }
  return box_corners(min, max);
}

ExactPlane plane_of_polygon(const std::vector<Vec3>& polygon) {
  std::size_t widest = 1;
  Real largest = 0;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    const Real area = norm(cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]));
    if (area > largest) largest = area, widest = i;
  }
  const ExactVec3 o = exact(polygon[0]);
  return plane_along(o, exact(polygon[widest]) - o, exact(polygon[widest + 1]) - o);
}

}  // namespace rockfold
