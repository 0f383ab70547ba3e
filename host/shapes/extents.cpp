#include "host/shapes/extents.hpp"

#include <algorithm>
#include <variant>

#include <fmt/format.h>

#include "host/shapes/shape_geometry_exact.hpp"
#include "src/base/vector.hpp"

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

std::vector<Diagnostic> files_out_of_scale(const Model& model) {
  struct Given {
    const Place* place;
    bool from_file;
  };
  std::vector<Given> given;
  const auto from_file = [](const Shape& shape) {
    return std::holds_alternative<MeshShape>(shape) || std::holds_alternative<TerrainShape>(shape);
  };
  for (const Solid& solid : model.solids) given.push_back({&solid.place, from_file(solid.shape)});
  for (const Excavation& excavation : model.excavations)
    given.push_back({&excavation.place, from_file(excavation.shape)});
  for (const JointMesh& mesh : model.joint_meshes) given.push_back({&mesh.place, true});

  const auto extents = named_extents(model);
  const auto size = [](const NamedExtent& e) { return norm(e.box.max - e.box.min); };
  Real by_numbers = 0;
  for (std::size_t i = 0; i < extents.size(); ++i)
    if (extents[i].bounded && !given[i].from_file)
      by_numbers = std::max(by_numbers, size(extents[i]));
  std::vector<Diagnostic> found;
  if (!(by_numbers > 0)) return found;
  constexpr Real off = 300;  // a surface in mm that fits the rock to a third
  for (std::size_t i = 0; i < extents.size(); ++i) {
    if (!extents[i].bounded || !given[i].from_file) continue;
    const Real ratio = size(extents[i]) / by_numbers;
    if (ratio <= off && ratio >= 1 / off) continue;
    Place place = *given[i].place;
    place.key += ".file";
    found.push_back(
        {place, fmt::format("is {:.3g} m large, the solids given by numbers {:.3g} m: did you mean "
                            "{}? Lengths of files are in m",
                            size(extents[i]), by_numbers, ratio > 1 ? "mm" : "km")});
  }
  return found;
}

}  // namespace rockfold
