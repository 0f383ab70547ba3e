#include <utility>

#include "host/refuse.hpp"
#include "host/shapes/families_exact.hpp"

namespace rockfold {

ShapeGeometry mesh_geometry(const MeshShape& mesh, const Place& place) {
  if (!mesh.surface || mesh.surface->triangles.empty())
    refuse(place, place.key, "the mesh of " + mesh.file + " has no triangles");
  ShapeGeometry geometry;
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
