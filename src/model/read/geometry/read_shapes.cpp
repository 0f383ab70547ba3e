#include "src/model/read/geometry/read_shapes.hpp"

#include <algorithm>
#include <cmath>

#include "src/base/vector.hpp"
#include "src/model/read/draft.hpp"
#include "src/model/read/read_value.hpp"

namespace rockfold {

namespace {

constexpr const char* axes = "xyz";

std::optional<Shape> read_box(TableReader& in) {
  BoxShape box;
  const bool low = in.read("min", box.min, coordinate());
  const bool high = in.read("max", box.max, coordinate());
  if (!low || !high) return {};
  bool good = true;
  for (int d = 0; d < 3; ++d) {
    if (box.min[d] < box.max[d]) continue;
    in.wrong("max", std::string("found ") + axes[d] + " = " + number_text(box.max[d]) +
                        ", must be > min's " + number_text(box.min[d]) + " (m)");
    good = false;
  }
  return good ? std::optional<Shape>(box) : std::nullopt;
}

std::optional<HalfSpace> read_half_space(const Value& value, const std::string& path,
                                         Diagnostics& out) {
  TableReader in(value, path, out);
  HalfSpace half;
  const bool plane = read_plane(in, half.plane);
  const auto keep = in.choose("keep", {{"below", "above"}, {}});
  half.keep_above = keep == 1;
  return plane && keep ? std::optional(half) : std::nullopt;
}

std::optional<Shape> read_halfspaces(TableReader& in, bool bounded) {
  const std::size_t least = bounded ? 4 : 1;
  const std::string what =
      bounded ? "4 or more planes {…}: fewer bound no solid" : "one or more planes {…}";
  const auto* value = in.find("planes", "must be " + what);
  const auto* planes =
      value ? array_from(*value, in.path_of("planes"), least, what, in.out()) : nullptr;
  if (!planes) return {};
  HalfspacesShape shape;
  for (std::size_t i = 0; i < planes->size(); ++i)
    if (const auto half =
            read_half_space((*planes)[i], item_path(in.path_of("planes"), i), in.out()))
      shape.planes.push_back(*half);
  return shape.planes.size() == planes->size() ? std::optional<Shape>(shape) : std::nullopt;
}

/// The corners of a box about a point.
std::vector<Vec3> around(const Vec3& point, Real reach) {
  const Vec3 diagonal{reach, reach, reach};
  return {point - diagonal, point + diagonal};
}

struct GivenPoints {
  std::vector<Vec3> operator()(const BoxShape& box) const { return {box.min, box.max}; }
  std::vector<Vec3> operator()(const HalfspacesShape& shape) const {
    std::vector<Vec3> points;
    for (const auto& half : shape.planes) points.push_back(half.plane.point);
    return points;
  }
  std::vector<Vec3> operator()(const PrismShape& prism) const {
    auto points = prism.base;
    for (const auto& p : prism.base) points.push_back(p + prism.extrude);
    return points;
  }
  std::vector<Vec3> operator()(const PyramidShape& pyramid) const {
    auto points = pyramid.base;
    points.push_back(pyramid.apex);
    return points;
  }
  std::vector<Vec3> operator()(const FrustumShape& frustum) const {
    auto points = frustum.base;
    points.insert(points.end(), frustum.top.begin(), frustum.top.end());
    return points;
  }
  std::vector<Vec3> operator()(const CylinderShape& cylinder) const {
    auto points = around(cylinder.axis[0], cylinder.radius);
    for (const auto& p : around(cylinder.axis[1], cylinder.radius)) points.push_back(p);
    return points;
  }
  std::vector<Vec3> operator()(const SphereShape& sphere) const {
    return around(sphere.center, sphere.radius);
  }
  std::vector<Vec3> operator()(const TunnelShape& tunnel) const {
    Real reach = 0;
    for (const auto& [x, y] : tunnel.section) reach = std::max(reach, std::hypot(x, y));
    std::vector<Vec3> points;
    for (const auto& corner : tunnel.path)
      for (const auto& p : around(corner, reach)) points.push_back(p);
    return points;
  }
  std::vector<Vec3> operator()(const MeshShape&) const { return {}; }
  std::vector<Vec3> operator()(const TerrainShape&) const { return {}; }
};

}  // namespace

std::optional<Shape> read_shape(TableReader& in, bool bounded, const std::string& model_path) {
  const auto shape = in.choose("shape", {{"box", "halfspaces", "prism", "pyramid", "frustum",
                                          "cylinder", "sphere", "tunnel", "mesh", "terrain"},
                                         {}});
  if (!shape) {
    in.give_up();
    return {};
  }
  switch (*shape) {
    case 0:
      return read_box(in);
    case 1:
      return read_halfspaces(in, bounded);
    case 2:
      return read_prism(in);
    case 3:
      return read_pyramid(in);
    case 4:
      return read_frustum(in);
    case 5:
      return read_cylinder(in);
    case 6:
      return read_sphere(in);
    case 7:
      return read_tunnel(in);
    case 8:
      return read_mesh(in, model_path);
    default:
      return read_terrain(in, model_path);
  }
}

std::vector<Vec3> given_points(const Shape& shape) {
  return std::visit(GivenPoints{}, shape);
}

}  // namespace rockfold
