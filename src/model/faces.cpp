// Names of the faces of shapes.
#include <algorithm>
#include <numeric>

#include "src/model/model.hpp"

namespace rockfold {

namespace {

/// How many sides a shape has before its caps, and how many caps.
struct Groups {
  std::size_t sides = 0;
  std::size_t caps = 0;
};

struct FindGroups {
  Groups operator()(const PrismShape& shape) const { return {shape.base.size(), 2}; }
  Groups operator()(const PyramidShape& shape) const { return {shape.base.size(), 1}; }
  Groups operator()(const FrustumShape& shape) const { return {shape.base.size(), 2}; }
  Groups operator()(const CylinderShape& shape) const {
    return {static_cast<std::size_t>(shape.sides), 2};
  }
  Groups operator()(const TunnelShape& shape) const { return {shape.section.size(), 2}; }
  Groups operator()(const SphereShape&) const { return {1, 0}; }
  Groups operator()(const MeshShape&) const { return {1, 0}; }
  template <class Other>
  Groups operator()(const Other&) const {
    return {};
  }
};

/// Faces with ids from `begin` to before `end`.
std::vector<Index> face_range(std::size_t begin, std::size_t end) {
  std::vector<Index> faces(end - begin);
  std::iota(faces.begin(), faces.end(), static_cast<Index>(begin));
  return faces;
}

}  // namespace

std::vector<std::string> face_names(const Shape& shape) {
  if (std::holds_alternative<BoxShape>(shape))
    return {"xmin", "xmax", "ymin", "ymax", "zmin", "zmax"};
  if (std::holds_alternative<TerrainShape>(shape))
    return {"xmin", "xmax", "ymin", "ymax", "zmin", "top"};
  const auto* halfspaces = std::get_if<HalfspacesShape>(&shape);
  const auto [sides, caps] = std::visit(FindGroups{}, shape);
  std::vector<std::string> names(halfspaces ? halfspaces->planes.size() : sides + caps);
  for (std::size_t i = 0; i < names.size(); ++i) names[i] = std::to_string(i);
  return names;
}

std::vector<Index> faces_named(const Shape& shape, const std::string& name) {
  const auto [sides, caps] = std::visit(FindGroups{}, shape);
  if (name == "side") return face_range(0, sides);
  for (std::size_t cap = 0; cap < caps; ++cap)
    if (name == "cap" + std::to_string(cap)) return face_range(sides + cap, sides + cap + 1);
  const auto names = face_names(shape);
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) return {};
  return {static_cast<Index>(found - names.begin())};
}

}  // namespace rockfold
