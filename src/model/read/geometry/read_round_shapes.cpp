// Cylinder, sphere and tunnel.
#include <algorithm>
#include <cmath>

#include "src/base/vector.hpp"
#include "src/model/planar_polygon.hpp"
#include "src/model/read/draft.hpp"
#include "src/model/read/geometry/read_shapes.hpp"
#include "src/model/read/read_value.hpp"
#include "src/model/tunnel_section.hpp"

namespace rockfold {

namespace {

constexpr Real tolerance = 1e-9;  // of the shape's size: far over what coordinates are rounded by
constexpr Index default_round_points = 24;  // of a tunnel: 1 % less area than the circle

/// "radius", or "width" and "height" with the radius as their default: half the width, and the height
/// of a circle.
struct Opening {
  Real width = 0, height = 0;
};

std::optional<Opening> read_opening(TableReader& in, bool by_radius) {
  Opening opening;
  Real radius = 0;
  if (by_radius && in.has("radius")) {
    if (in.has("width")) {
      in.wrong("width", "give either radius (half the width) or width, not both");
      return {};
    }
    if (!in.read("radius", radius, length())) return {};
    opening = {2 * radius, 2 * radius};
    return in.read("height", opening.height, length(), Need::optional) || !in.has("height")
               ? std::optional(opening)
               : std::nullopt;
  }
  if (by_radius && !in.has("width") && !in.has("height")) {
    in.missing({"width", "height", "radius"}, "is missing: give width and height, or radius (m)");
    return {};
  }
  const bool width = in.read("width", opening.width, length());
  const bool height = in.read("height", opening.height, length());
  return width && height ? std::optional(opening) : std::nullopt;
}

Section read_circle(TableReader& in, Index sides) {
  Real radius = 0;
  if (!in.read("radius", radius, length())) return {};
  return circle_section(radius, sides);
}

Section read_rectangle(TableReader& in) {
  const auto opening = read_opening(in, false);
  return opening ? rectangle_section(opening->width, opening->height) : Section{};
}

Section read_arched(TableReader& in, bool horseshoe, Index sides) {
  const auto opening = read_opening(in, true);
  if (!opening) return {};
  const auto [width, height] = *opening;
  const Real most = horseshoe_height_limit(width);
  if (height < width / 2) {
    in.wrong("height", "found " + number_text(height) + ", must be at least half the width (" +
                           number_text(width / 2) + " m): the roof is half a circle");
    return {};
  }
  if (horseshoe && !(height < (1 - tolerance) * most)) {
    in.wrong("height", "found " + number_text(height) + ", must be < " + number_text(most) +
                           " m, where the walls of this horseshoe meet");
    return {};
  }
  return horseshoe ? horseshoe_section(width, height, sides)
                   : d_shape_section(width, height, sides);
}

Section read_polygon_section(TableReader& in, const Array& list) {
  Section section;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::string path = item_path(in.path_of("section"), i);
    const auto* pair = std::get_if<Array>(&list[i].data);
    if (!pair || pair->size() != 2) {
      in.out().add(list[i].spot, path,
                   "found " + described(list[i]) + ", must be 2 numbers [u, v] (m)");
      continue;
    }
    const auto u = real_from((*pair)[0], item_path(path, 0), coordinate(), in.out());
    const auto v = real_from((*pair)[1], item_path(path, 1), coordinate(), in.out());
    if (u && v) section.push_back({*u, *v});
  }
  if (section.size() < list.size()) return {};
  return section;
}

std::vector<Vec3> in_space(const Section& section) {
  std::vector<Vec3> points;
  for (const auto& [x, y] : section) points.push_back({x, y, 0});
  return points;
}

/// Empty if anything is wrong.
Section read_section_points(TableReader& in) {
  const auto* value =
      in.find("section", "must be \"circle\", \"horseshoe\", \"d_shape\", \"rectangle\" or points");
  if (!value) {
    in.give_up();
    return {};
  }
  Section section;
  if (const auto* list = std::get_if<Array>(&value->data)) {
    if (!array_from(*value, in.path_of("section"), 3, "3 or more points [u, v] (m)", in.out()))
      return {};
    section = read_polygon_section(in, *list);
  } else {
    const auto kind = in.choose("section", {{"circle", "horseshoe", "d_shape", "rectangle"}, {}});
    if (!kind) in.give_up();
    if (!kind) return {};
    Index sides = default_round_points;
    if (*kind != 3) read_sides(in, sides);
    section = *kind == 0   ? read_circle(in, sides)
              : *kind == 3 ? read_rectangle(in)
                           : read_arched(in, *kind == 1, sides);
  }
  if (section.empty()) return {};
  const auto points = in_space(section);
  if (const auto problem = polygon_problem(points); !problem.empty()) {
    in.wrong("section", problem);
    return {};
  }
  if (doubled_area(points)[2] < 0) std::reverse(section.begin(), section.end());
  return section;
}

std::string path_problem(const std::vector<Vec3>& path) {
  Real size = 0;
  for (const auto& p : path) size = std::max(size, norm(p - path[0]));
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const std::string point = "point " + std::to_string(i + 1);
    if (!(norm(path[i + 1] - path[i]) > tolerance * size))
      return "points " + std::to_string(i + 1) + " and " + std::to_string(i + 2) + " are equal";
    if (i == 0) continue;
    const Vec3 in = normalized(path[i] - path[i - 1]), out = normalized(path[i + 1] - path[i]);
    if (dot(in, out) < 0 && norm(cross(in, out)) <= tolerance)
      return "turns straight back at " + point;
  }
  return "";
}

}  // namespace

void read_sides(TableReader& in, Index& target) {
  in.read("sides", target, IntegerRange{.low = 3, .high = 1000}, Need::optional);
}

std::optional<Shape> read_cylinder(TableReader& in) {
  CylinderShape cylinder;
  const auto* value = in.find("axis", "must be 2 points [[x, y, z], [x, y, z]] (m)");
  const auto axis =
      value ? two_points_from(*value, in.path_of("axis"), "points", in.out()) : std::nullopt;
  const bool radius = in.read("radius", cylinder.radius, length());
  read_sides(in, cylinder.sides);
  if (!axis || !radius) return {};
  cylinder.axis = *axis;
  const Real long_side = norm((*axis)[1] - (*axis)[0]);
  if (long_side > tolerance * cylinder.radius) return cylinder;
  in.wrong("axis", "its two points are equal, must be the ends of the cylinder");
  return {};
}

std::optional<Shape> read_sphere(TableReader& in) {
  SphereShape sphere;
  const bool center = in.read("center", sphere.center, coordinate());
  const bool radius = in.read("radius", sphere.radius, length());
  in.read("subdivisions", sphere.subdivisions, IntegerRange{.low = 0, .high = 7}, Need::optional);
  return center && radius ? std::optional<Shape>(sphere) : std::nullopt;
}

Section read_tunnel_section(TableReader& in) {
  return read_section_points(in);
}

std::optional<Shape> read_tunnel(TableReader& in) {
  const auto* value = in.find("path", "must be 2 or more points [x, y, z] (m)");
  const auto path = value ? points_from(*value, in.path_of("path"), 2, in.out()) : std::nullopt;
  const auto problem = path ? path_problem(*path) : "";
  if (!problem.empty()) in.wrong("path", problem);
  auto section = read_section_points(in);
  if (!path || !problem.empty() || section.empty()) return {};
  return TunnelShape{*path, std::move(section)};
}

}  // namespace rockfold
