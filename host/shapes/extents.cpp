#include "host/shapes/extents.hpp"

#include <algorithm>

#include "host/shapes/shape_geometry_exact.hpp"

namespace rockfold {

namespace {

/// Points whose box is the shape's; none of a shape without bounds.
std::vector<Vec3> extreme_points(const Shape& shape, bool bounded, const Place& place) {
  if (const auto* mesh = std::get_if<MeshShape>(&shape)) return mesh->surface->vertices;
  if (const auto* terrain = std::get_if<TerrainShape>(&shape)) {
    std::vector<Vec3> points = terrain->ground->vertices;
    points.push_back({points[0][0], points[0][1], terrain->base});
    return points;
  }
  return shape_geometry(shape, bounded, place).corners;
}

NamedExtent extent_of(std::string kind, std::string name, const std::vector<Vec3>& points) {
  NamedExtent extent{std::move(kind), std::move(name), !points.empty()};
  if (extent.bounded) extent.box = bounding_box(points);
  return extent;
}

}  // namespace

std::vector<NamedExtent> named_extents(const Model& model) {
  std::vector<NamedExtent> extents;
  for (const Solid& solid : model.solids)
    extents.push_back(
        extent_of("solid", solid.name, extreme_points(solid.shape, solid.add, solid.place)));
  for (const Excavation& excavation : model.excavations)
    extents.push_back(extent_of("excavation", excavation.name,
                                extreme_points(excavation.shape, false, excavation.place)));
  for (const JointMesh& mesh : model.joint_meshes)
    extents.push_back(extent_of("joint_mesh", mesh.name, mesh.surface->vertices));
  return extents;
}

}  // namespace rockfold
