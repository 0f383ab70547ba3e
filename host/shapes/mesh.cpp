#include <utility>

#include "host/refuse.hpp"
#include "host/shapes/families_exact.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {

// Bodies that share a plane have it from the same numbers.
ConvexPart convex_part(const std::vector<SurfacePlane>& planes) {
  ConvexPart part;
  for (const SurfacePlane& plane : planes)
    part.faces.push_back(
        {plane_through(plane.normal, plane.point, Exact(0)), plane.inside_above, 0});
  return part;
}

}  // namespace

ShapeGeometry mesh_geometry(const MeshShape& mesh, const Place& place) {
  if (!mesh.surface || mesh.surface->triangles.empty())
    refuse(place, place.key, "the mesh of " + mesh.file + " has no triangles");
  ShapeGeometry geometry;
  if (!mesh.surface->planes.empty()) {
    geometry.parts.push_back(convex_part(mesh.surface->planes));
    geometry.corners = bounding_corners(mesh.surface->vertices);
    return geometry;
  }
  ClosedSurface& surface = geometry.surface;
  surface.vertices = mesh.surface->vertices;
  surface.corner.reserve(3 * mesh.surface->triangles.size());
  for (const auto& t : mesh.surface->triangles) {
    surface.corner.insert(surface.corner.end(), t.begin(), t.end());
    surface.polygon_begin.push_back(static_cast<Index>(surface.corner.size()));
  }
  surface.face.assign(mesh.surface->triangles.size(), 0);
  geometry.corners = bounding_corners(surface.vertices);
  return geometry;
}

}  // namespace rockfold
