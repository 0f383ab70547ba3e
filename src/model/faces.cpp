// Names of the faces of shapes.
#include <algorithm>
#include <numeric>

#include "src/model/model.hpp"

namespace rockfold {

namespace {

struct FaceCount {
  std::size_t operator()(const BoxShape&) const { return 6; }
  std::size_t operator()(const HalfspacesShape& shape) const { return shape.planes.size(); }
  std::size_t operator()(const PrismShape& shape) const { return shape.base.size() + 2; }
  std::size_t operator()(const PyramidShape& shape) const { return shape.base.size() + 1; }
  std::size_t operator()(const FrustumShape& shape) const { return shape.base.size() + 2; }
  std::size_t operator()(const CylinderShape& shape) const { return shape.sides + 2; }
  std::size_t operator()(const SphereShape&) const { return 1; }
  std::size_t operator()(const TunnelShape& shape) const { return shape.section.size() + 2; }
  std::size_t operator()(const MeshShape&) const { return 1; }
  std::size_t operator()(const TerrainShape&) const { return 6; }
};

/// The prism's faces with ids from `begin` to before `end`.
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
  std::vector<std::string> names(std::visit(FaceCount{}, shape));
  for (std::size_t i = 0; i < names.size(); ++i) names[i] = std::to_string(i);
  return names;
}

std::vector<Index> faces_named(const Shape& shape, const std::string& name) {
  if (const auto* prism = std::get_if<PrismShape>(&shape)) {
    const std::size_t sides = prism->base.size();
    if (name == "side") return face_range(0, sides);
    if (name == "cap0") return face_range(sides, sides + 1);
    if (name == "cap1") return face_range(sides + 1, sides + 2);
  }
  const auto names = face_names(shape);
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) return {};
  return {static_cast<Index>(found - names.begin())};
}

}  // namespace rockfold
