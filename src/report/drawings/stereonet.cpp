#include "src/report/drawings/stereonet.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "host/bolting/wall.hpp"
#include "src/base/vector.hpp"
#include "src/report/drawings/joint_pyramids.hpp"
#include "src/report/drawings/projection.hpp"

namespace rockfold {

namespace {

constexpr Real degree = std::numbers::pi / 180;
constexpr Real net_radius = 250, margin = 60, legend_x = 2 * (net_radius + margin) + 20;
constexpr Real pyramid_reach = 2.4;  // of the radius: how far out whole circles are drawn
constexpr std::size_t most_planes = 8;
constexpr Real flat = 1e-3;  // cos dip: steeper planes are straight lines on whole-circle nets

/// A plane that has a great circle of its own.
struct NamedPlane {
  std::string name;
  Vec3 normal{};  ///< unit, upward
  Real dip = 0, dip_direction = 0;
};

NamedPlane named_plane(const std::string& name, const Orientation& orientation) {
  Vec3 n;
  if (const auto* given = std::get_if<Vec3>(&orientation)) {
    n = normalized(*given);
  } else {
    const auto& d = std::get<DipOrientation>(orientation);
    n = {std::sin(d.dip * degree) * std::sin(d.dip_direction * degree),
         std::sin(d.dip * degree) * std::cos(d.dip_direction * degree), std::cos(d.dip * degree)};
  }
  if (n[2] < 0) n = -n;
  Real direction = std::atan2(n[0], n[1]) / degree;
  if (direction < 0) direction += 360;
  return {name, n, std::acos(std::clamp(n[2], -1.0, 1.0)) / degree, direction};
}

/// Joint sets, then single joints.
std::vector<NamedPlane> planes_of(const Model& model) {
  std::vector<NamedPlane> planes;
  for (const JointSet& set : model.joint_sets)
    planes.push_back(named_plane(set.name, set.orientation));
  for (const Joint& joint : model.joints)
    planes.push_back(named_plane(joint.name, joint.plane.orientation));
  if (planes.size() > most_planes) planes.resize(most_planes);
  return planes;
}

class Stereonet {
 public:
  Stereonet(const BlockArrays& blocks, const Model& model, const Drawing& drawing)
      : blocks_(blocks),
        model_(model),
        drawing_(drawing),
        planes_(planes_of(model)),
        scale_(drawing.joint_pyramids ? 1 / pyramid_reach * 1.12 : 1),
        svg_(legend_x + 250, 2 * (net_radius + margin) + 40) {
    net_ = {{net_radius + margin, net_radius + margin + 40},
            net_radius * scale_,
            drawing.upper,
            drawing.equal_area};
  }

  std::string draw();

 private:
  void draw_frame();
  void draw_circles();
  void draw_poles();
  void draw_friction();
  void draw_pyramids();
  void draw_legend();
  std::vector<Vec3> free_normals(Vec3& axis) const;
  std::size_t colour_of(const std::string& name) const;
  Real distance(const NamedPlane& plane, const Point2& p) const;
  std::optional<Point2> place_for(const std::string& code) const;

  const BlockArrays& blocks_;
  const Model& model_;
  const Drawing& drawing_;
  std::vector<NamedPlane> planes_;
  Real scale_;
  Svg svg_;
  Projection net_;
  std::string hidden_;  ///< codes for which the paper has no room
};

void Stereonet::draw_frame() {
  const Point2 c = net_.centre;
  const Real r = net_.radius;
  svg_.text({c[0], 28}, model_.title.empty() ? "Joints" : model_.title,
            {.size = 16, .anchor = "middle", .bold = true});
  svg_.circle(c, r, {.stroke = "#111111", .width = drawing_.joint_pyramids ? 1.2 : 1.6});
  for (int azimuth = 0; azimuth < 360; azimuth += 10) {
    const Real s = std::sin(azimuth * degree), k = std::cos(azimuth * degree);
    const Real tick = azimuth % 90 == 0 ? 9 : azimuth % 30 == 0 ? 6 : 3;
    svg_.line({c[0] + r * s, c[1] - r * k}, {c[0] + (r + tick) * s, c[1] - (r + tick) * k},
              {.stroke = "#111111", .width = 1});
    if (azimuth % 30 != 0 || drawing_.joint_pyramids) continue;
    const std::string words = azimuth == 0     ? "N"
                              : azimuth == 90  ? "E"
                              : azimuth == 180 ? "S"
                              : azimuth == 270 ? "W"
                                               : fmt::format("{:03}", azimuth);
    const bool main = azimuth % 90 == 0;
    svg_.text({c[0] + (r + 24) * s, c[1] - (r + 24) * k + 5}, words,
              {.size = main ? 15.0 : 11.0, .anchor = "middle", .bold = main});
  }
  svg_.line({c[0] - 4, c[1]}, {c[0] + 4, c[1]}, {.stroke = "#111111"});
  svg_.line({c[0], c[1] - 4}, {c[0], c[1] + 4}, {.stroke = "#111111"});
}

void Stereonet::draw_circles() {
  for (std::size_t i = 0; i < planes_.size(); ++i) {
    const Pen pen{.stroke = series_colour(i), .width = 2};
    if (!drawing_.joint_pyramids) {
      svg_.polyline(net_.great_circle(planes_[i].normal), pen);
      continue;
    }
    // In equal angle a great circle is a circle: radius R / cos dip about the point at R tan dip down (upper) or up the dip.
    const Vec3& n = planes_[i].normal;
    if (n[2] < flat) {
      const Point2 along = {n[1] * 3 * net_radius, n[0] * 3 * net_radius};
      svg_.polygon({{{net_.centre[0] - along[0], net_.centre[1] - along[1]},
                     {net_.centre[0] + along[0], net_.centre[1] + along[1]}}},
                   pen, "net");
      continue;
    }
    const Real side = net_.upper ? 1 : -1;
    svg_.circle({net_.centre[0] + side * net_.radius * n[0] / n[2],
                 net_.centre[1] - side * net_.radius * n[1] / n[2]},
                net_.radius / n[2], pen, "net");
  }
}

std::size_t Stereonet::colour_of(const std::string& name) const {
  const auto found = std::find_if(planes_.begin(), planes_.end(),
                                  [&](const NamedPlane& p) { return p.name == name; });
  return found == planes_.end() ? 7 : static_cast<std::size_t>(found - planes_.begin());
}

/// One for each joint plane that bounds blocks.
void Stereonet::draw_poles() {
  std::set<std::pair<Index, Index>> seen;
  for (std::size_t f = 0; f < blocks_.face_origin.size(); ++f) {
    const FaceOrigin& origin = blocks_.origins[blocks_.face_origin[f]];
    if (origin.kind != FaceOrigin::Kind::joint ||
        !seen.insert({blocks_.face_origin[f], blocks_.face_plane[f]}).second)
      continue;
    svg_.circle(net_.of(net_.shown(blocks_.face_normal[f])), 3.2,
                {.stroke = "white", .width = 0.7, .fill = series_colour(colour_of(origin.name))});
  }
}

/// About the vertical, one for each friction angle: dashed, with the angle on it.
void Stereonet::draw_friction() {
  std::set<Real> angles;
  for (const JointMaterial& material : model_.joint_materials)
    angles.insert(material.friction_angle);
  const Vec3 middle{0, 0, net_.upper ? 1.0 : -1.0};
  for (const Real angle : angles) {
    if (!(angle > 0)) continue;
    for (const auto& run : net_.small_circle(middle, angle * degree))
      svg_.polyline(run, {.stroke = "#666666", .width = 1.2, .dash = "5 4"});
    const Point2 top = net_.of({0, std::sin(angle * degree), middle[2] * std::cos(angle * degree)});
    svg_.text({top[0], top[1] - 4}, fmt::format("φ = {:g}°", angle),
              {.size = 11, .anchor = "middle", .colour = "#444444", .halo = true});
  }
}

/// Outward normals of the free planes of the drawing's wall; of what runs round an axis, that axis.
std::vector<Vec3> Stereonet::free_normals(Vec3& axis) const {
  std::vector<Vec3> normals;
  if (drawing_.on.owner == none) return normals;
  const Wall wall(blocks_, model_, drawing_.on, drawing_.place);
  for (const WallPanel& panel : wall.panels())
    if (panel.around) axis = wall.strip(panel.strips.front()).along_v;
  for (const WallPanel& panel : wall.panels())
    if (!panel.around) normals.push_back(wall.strip(panel.strips.front()).across);
  return normals;
}

void Stereonet::draw_pyramids() {
  std::vector<Vec3> upward;
  for (const NamedPlane& plane : planes_) upward.push_back(plane.normal);
  Vec3 axis{};
  const auto free = free_normals(axis);
  const auto regions = joint_pyramid_regions(upward, free, axis);
  const Vec3 opposite{0, 0, net_.upper ? -1.0 : 1.0};  // not on the paper
  const Point2 c = net_.centre;
  const Real out = net_radius;
  for (const PyramidRegion& region : regions) {
    if (!region.removable) continue;
    std::vector<Point2> outline;
    for (const Vec3& u : region.boundary) outline.push_back(net_.of(u));
    std::vector<std::vector<Point2>> loops;
    if (!outline.empty()) loops.push_back(outline);
    const bool holds_opposite = [&] {
      for (std::size_t i = 0; i < upward.size(); ++i)
        if ((dot(upward[i], opposite) >= 0) != (region.code[i] == '0')) return false;
      return true;
    }();
    if (holds_opposite)
      loops.push_back({{c[0] - 20 * out, c[1] - 20 * out},
                       {c[0] + 20 * out, c[1] - 20 * out},
                       {c[0] + 20 * out, c[1] + 20 * out},
                       {c[0] - 20 * out, c[1] + 20 * out}});
    svg_.polygon(loops, {.stroke = "none", .fill = "#fddbc7"}, "net");
  }
  draw_circles();
  for (const PyramidRegion& region : regions) {
    const auto at = place_for(region.code);
    if (!at) hidden_ += " " + region.code + (region.removable ? " (removable)" : "");
    if (at)
      svg_.text({(*at)[0], (*at)[1] + 4}, region.code,
                {.size = 13,
                 .anchor = "middle",
                 .colour = region.removable ? "#b2182b" : "#333333",
                 .bold = region.removable,
                 .halo = true});
  }
}

/// px: how far a point of the paper is from a plane's circle.
Real Stereonet::distance(const NamedPlane& plane, const Point2& p) const {
  const Vec3& n = plane.normal;
  const Real x = p[0] - net_.centre[0], y = net_.centre[1] - p[1];
  if (n[2] < flat) return std::abs(n[0] * x + n[1] * y) / std::hypot(n[0], n[1]);
  const Real side = net_.upper ? net_.radius : -net_.radius;
  return std::abs(std::hypot(x - side * n[0] / n[2], y - side * n[1] / n[2]) - net_.radius / n[2]);
}

/// Where a region's code has most room on the paper; nothing where the paper does not show it.
std::optional<Point2> Stereonet::place_for(const std::string& code) const {
  constexpr Real step = 4;  // px
  std::optional<Point2> best;
  Real most = 8;  // px
  for (Real dy = -net_radius; dy <= net_radius; dy += step)
    for (Real dx = -net_radius; dx <= net_radius; dx += step) {
      const Real far = std::hypot(dx, dy), rho = far / net_.radius;
      // Back from the paper: θ = 2 atan ρ.
      const Real height = (1 - rho * rho) / (1 + rho * rho);
      const Vec3 u{2 * dx / net_.radius / (1 + rho * rho), -2 * dy / net_.radius / (1 + rho * rho),
                   net_.upper ? height : -height};
      const Point2 p{net_.centre[0] + dx, net_.centre[1] + dy};
      Real room = net_radius - far;
      for (std::size_t i = 0; i < planes_.size(); ++i)
        room = (dot(planes_[i].normal, u) > 0) == (code[i] == '0')
                   ? std::min(room, distance(planes_[i], p))
                   : 0;
      if (room > most) most = room, best = p;
    }
  return best;
}

void Stereonet::draw_legend() {
  Real y = 70;
  const auto row = [&](const std::string& words, bool bold = false) {
    svg_.text({legend_x + 34, y}, words, {.size = 12.5, .bold = bold});
    y += 22;
  };
  svg_.text({legend_x, y},
            fmt::format("{} hemisphere, {}", drawing_.upper ? "Upper" : "Lower",
                        drawing_.equal_area ? "equal area" : "equal angle"),
            {.size = 12.5, .bold = true});
  y += 26;
  for (std::size_t i = 0; i < planes_.size(); ++i) {
    svg_.line({legend_x, y - 4}, {legend_x + 26, y - 4},
              {.stroke = series_colour(i), .width = 2.4});
    row(fmt::format("{}  {:02.0f}/{:03.0f}", planes_[i].name, planes_[i].dip,
                    planes_[i].dip_direction));
  }
  if (drawing_.poles) {
    svg_.circle({legend_x + 13, y - 4}, 3.6, {.stroke = "none", .fill = series_colour(7)});
    row("pole of a joint between blocks");
  }
  if (!drawing_.joint_pyramids) {
    svg_.line({legend_x, y - 4}, {legend_x + 26, y - 4},
              {.stroke = "#666666", .width = 1.2, .dash = "5 4"});
    row("friction angle, for poles");
    return;
  }
  svg_.square({legend_x + 13, y - 4}, 7, {.stroke = "#b2182b", .width = 0.8, .fill = "#fddbc7"});
  row(drawing_.on.owner == none ? "removable: name a wall with `on`"
                                : "removable from " + drawing_.on.name);
  row("0 above, 1 below the joint, in the");
  y -= 5;
  row("order of the list");
  if (!hidden_.empty()) row("off this paper:" + hidden_);
}

std::string Stereonet::draw() {
  svg_.clip_circle("net", net_.centre, drawing_.joint_pyramids ? net_radius : net_.radius);
  if (drawing_.joint_pyramids) {
    draw_pyramids();
    svg_.circle(net_.centre, net_radius, {.stroke = "#bbbbbb", .width = 1});
  } else {
    draw_circles();
  }
  draw_frame();
  if (!drawing_.joint_pyramids) draw_friction();
  if (drawing_.poles) draw_poles();
  draw_legend();
  return svg_.document("Stereonet of " + (model_.title.empty() ? model_.path : model_.title));
}

}  // namespace

std::string stereonet(const BlockArrays& blocks, const Model& model, const Drawing& drawing) {
  return Stereonet(blocks, model, drawing).draw();
}

}  // namespace rockfold
