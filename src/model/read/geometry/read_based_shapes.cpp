// Shapes over a base polygon: prism, pyramid and frustum.
#include <algorithm>
#include <cmath>

#include "src/base/vector.hpp"
#include "src/model/planar_polygon.hpp"
#include "src/model/read/geometry/read_shapes.hpp"
#include "src/model/read/read_value.hpp"

namespace rockfold {

namespace {

constexpr Real tolerance = 1e-9;  // of the shape's size, as for the polygons themselves

std::optional<std::vector<Vec3>> read_polygon(TableReader& in, const std::string& key) {
  const auto* value = in.find(key, "must be 3 or more points [x, y, z] (m)");
  const auto points = value ? points_from(*value, in.path_of(key), 3, in.out()) : std::nullopt;
  if (!points) return {};
  const auto problem = polygon_problem(*points);
  if (!problem.empty()) in.wrong(key, problem);
  return problem.empty() ? points : std::nullopt;
}

bool require_convex(TableReader& in, const std::string& key, const std::vector<Vec3>& points) {
  if (is_convex(points)) return true;
  in.wrong(key, "is concave, must be convex in a frustum; use several");
  return false;
}

std::string side_name(std::size_t i, std::size_t n) {
  return "side " + std::to_string(i) + " (points " + std::to_string(i + 1) + " and " +
         std::to_string((i + 1) % n + 1) + " of base and top)";
}

/// Whether the points lie on one side of the polygon's plane, off it.
bool all_apart(const std::vector<Vec3>& polygon, const std::vector<Vec3>& points, Real off) {
  const Vec3 normal = normalized(doubled_area(polygon));
  const auto height = [&](const Vec3& p) { return dot(normal, p - polygon[0]); };
  return std::all_of(points.begin(), points.end(),
                     [&](const auto& p) { return height(p) > off; }) ||
         std::all_of(points.begin(), points.end(), [&](const auto& p) { return height(p) < -off; });
}

/// Its sides must be planar and hold all other corners on one side: then it is the convex hull of
/// base and top, and the sides join neighbouring edges.
std::string frustum_problem(const std::vector<Vec3>& base, const std::vector<Vec3>& top) {
  const std::size_t n = base.size();
  auto corners = base;
  corners.insert(corners.end(), top.begin(), top.end());
  Real size = 0;
  for (const auto& p : corners) size = std::max(size, norm(p - base[0]));
  const auto straddled = [&](const Vec3& normal, const Vec3& point) {
    Real low = 0, high = 0;
    for (const auto& p : corners) {
      low = std::min(low, dot(normal, p - point));
      high = std::max(high, dot(normal, p - point));
    }
    return low < -tolerance * size && high > tolerance * size;
  };
  if (!all_apart(base, top, tolerance * size) || !all_apart(top, base, tolerance * size))
    return "meets the plane of the base, or the base that of the top; each must lie apart from the "
           "other's plane";
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t j = (i + 1) % n;
    const Vec3 area =
        cross(base[j] - base[i], top[j] - base[i]) + cross(top[j] - base[i], top[i] - base[i]);
    if (!(norm(area) > tolerance * size * size)) return side_name(i, n) + " has no area";
    const Vec3 normal = normalized(area);
    if (std::abs(dot(normal, base[j] - base[i])) > tolerance * size ||
        std::abs(dot(normal, top[i] - base[i])) > tolerance * size ||
        std::abs(dot(normal, top[j] - base[i])) > tolerance * size)
      return side_name(i, n) + " is not planar";
    if (straddled(normal, base[i]))
      return side_name(i, n) + " has corners on both sides of it: list the top's points in the " +
             "order of the base's";
  }
  return "";
}

}  // namespace

std::optional<Shape> read_prism(TableReader& in) {
  PrismShape prism;
  const auto base = read_polygon(in, "base");
  const bool extruded = in.read("extrude", prism.extrude, coordinate());
  const bool moves = extruded && norm(prism.extrude) > 0;
  if (extruded && !moves) in.wrong("extrude", "found [0, 0, 0], must not be zero");
  if (!base || !moves) return {};
  if (!leaves_plane(*base, prism.extrude)) {
    in.wrong("extrude", "lies in the plane of the base, must leave it");
    return {};
  }
  prism.base = *base;
  return prism;
}

std::optional<Shape> read_pyramid(TableReader& in) {
  PyramidShape pyramid;
  const auto base = read_polygon(in, "base");
  const bool apex = in.read("apex", pyramid.apex, coordinate());
  if (!base || !apex) return {};
  pyramid.base = *base;
  if (leaves_plane(*base, pyramid.apex - base->front())) return pyramid;
  in.wrong("apex", "lies in the plane of the base, must be off it");
  return {};
}

std::optional<Shape> read_frustum(TableReader& in) {
  auto base = read_polygon(in, "base");
  auto top = read_polygon(in, "top");
  if (base && !require_convex(in, "base", *base)) base.reset();
  if (top && !require_convex(in, "top", *top)) top.reset();
  if (!base || !top) return {};
  if (top->size() != base->size()) {
    in.wrong("top", "has " + std::to_string(top->size()) +
                        " points, must have as many as base: " + std::to_string(base->size()));
    return {};
  }
  const auto problem = frustum_problem(*base, *top);
  if (problem.empty()) return FrustumShape{std::move(*base), std::move(*top)};
  in.wrong("top", problem);
  return {};
}

}  // namespace rockfold
