#include "src/report/drawings/net.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "src/base/vector.hpp"
#include "src/report/drawings/joint_pyramids.hpp"
#include "src/report/drawings/net_density.hpp"
#include "src/report/drawings/projection.hpp"

namespace rockfold {

namespace {

constexpr Real degree = std::numbers::pi / 180;
constexpr Real net_radius = 250, margin = 60, legend_x = 2 * (net_radius + margin) + 20;
constexpr Real pyramid_reach = 2.4;  // of the radius: how far out whole circles are drawn
constexpr Real flat = 1e-3;  // cos dip: steeper planes are straight lines on whole-circle nets

class Net {
 public:
  explicit Net(const NetContent& content)
      : content_(content),
        planes_(content.planes),
        scale_(content.joint_pyramids ? 1 / pyramid_reach * 1.12 : 1) {
    if (planes_.size() > most_net_planes) planes_.resize(most_net_planes);
    net_ = {{net_radius + margin, net_radius + margin + 40},
            net_radius * scale_,
            content.upper,
            content.equal_area};
  }

  std::string draw();

 private:
  void draw_frame();
  void draw_circles();
  void draw_poles();
  void draw_friction();
  void draw_pyramids();
  void draw_legend();
  void draw_pyramid_legend(Real y);
  void draw_wall();
  bool has_axis() const { return norm(content_.axis) > 0; }
  Real distance(const NetPlane& plane, const Point2& p) const;
  std::optional<Point2> place_for(const std::string& code) const;

  const NetContent& content_;
  std::vector<NetPlane> planes_;
  Real scale_;
  Svg svg_{2 * (net_radius + margin) + 40, 2 * (net_radius + margin) + 40};
  Projection net_;
  std::string hidden_;  ///< codes for which the paper has no room
};

void Net::draw_frame() {
  const Point2 c = net_.centre;
  const Real r = net_.radius;
  if (!content_.title.empty())
    svg_.text({c[0], 28}, content_.title, {.size = 16, .anchor = "middle", .bold = true});
  svg_.circle(c, r, {.stroke = "#111111", .width = content_.joint_pyramids ? 1.2 : 1.6});
  for (int azimuth = 0; azimuth < 360; azimuth += 10) {
    const Real s = std::sin(azimuth * degree), k = std::cos(azimuth * degree);
    const Real tick = azimuth % 90 == 0 ? 9 : azimuth % 30 == 0 ? 6 : 3;
    svg_.line({c[0] + r * s, c[1] - r * k}, {c[0] + (r + tick) * s, c[1] - (r + tick) * k},
              {.stroke = "#111111", .width = 1});
    const bool main = azimuth % 90 == 0;
    if (azimuth % 30 != 0 || (content_.joint_pyramids && !main)) continue;
    const std::string words = azimuth == 0     ? "N"
                              : azimuth == 90  ? "E"
                              : azimuth == 180 ? "S"
                              : azimuth == 270 ? "W"
                                               : fmt::format("{:03}", azimuth);
    const Real out = r + (content_.joint_pyramids ? 18 : 24);
    svg_.text({c[0] + out * s, c[1] - out * k + 5}, words,
              {.size = main ? 15.0 : 11.0, .anchor = "middle", .bold = main, .halo = main});
  }
  svg_.line({c[0] - 4, c[1]}, {c[0] + 4, c[1]}, {.stroke = "#111111"});
  svg_.line({c[0], c[1] - 4}, {c[0], c[1] + 4}, {.stroke = "#111111"});
}

void Net::draw_circles() {
  for (std::size_t i = 0; i < planes_.size(); ++i) {
    const Pen pen{.stroke = series_colour(i), .width = 2};
    if (!content_.joint_pyramids) {
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

void Net::draw_poles() {
  for (const NetContent::Pole& pole : content_.poles)
    svg_.circle(net_.of(net_.shown(pole.normal)), 3.2,
                {.stroke = "white",
                 .width = 0.7,
                 .fill = series_colour(pole.plane < planes_.size() ? pole.plane : 7)});
}

/// The free faces as great circles, the axis of what runs round one as a star.
void Net::draw_wall() {
  for (const Vec3& normal : content_.free)
    svg_.polyline(net_.great_circle(normal[2] < 0 ? -normal : normal),
                  {.stroke = "#111111", .width = 2.4, .dash = "9 5"});
  if (!has_axis()) return;
  const Point2 at = net_.of(net_.shown(content_.axis));
  for (const Real turn : {0.0, 60.0, 120.0}) {
    const Real x = 8 * std::cos(turn * degree), y = 8 * std::sin(turn * degree);
    svg_.line({at[0] - x, at[1] - y}, {at[0] + x, at[1] + y}, {.stroke = "#111111", .width = 2.2});
  }
}

/// About the vertical, one for each friction angle: dashed, with the angle on it.
void Net::draw_friction() {
  const std::set<Real> angles(content_.friction_angles.begin(), content_.friction_angles.end());
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

void Net::draw_pyramids() {
  std::vector<Vec3> upward;
  for (const NetPlane& plane : planes_) upward.push_back(plane.normal);
  const auto regions = joint_pyramid_regions(upward, content_.free, content_.axis);
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
Real Net::distance(const NetPlane& plane, const Point2& p) const {
  const Vec3& n = plane.normal;
  const Real x = p[0] - net_.centre[0], y = net_.centre[1] - p[1];
  if (n[2] < flat) return std::abs(n[0] * x + n[1] * y) / std::hypot(n[0], n[1]);
  const Real side = net_.upper ? net_.radius : -net_.radius;
  return std::abs(std::hypot(x - side * n[0] / n[2], y - side * n[1] / n[2]) - net_.radius / n[2]);
}

/// Where a region's code has most room on the paper; nothing where the paper does not show it.
std::optional<Point2> Net::place_for(const std::string& code) const {
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

void Net::draw_legend() {
  Real y = 70;
  const auto row = [&](const std::string& words, bool bold = false) {
    svg_.text({legend_x + 34, y}, words, {.size = 12.5, .bold = bold});
    y += 22;
  };
  svg_.text({legend_x, y},
            fmt::format("{} hemisphere, {}", content_.upper ? "Upper" : "Lower",
                        content_.equal_area ? "equal area" : "equal angle"),
            {.size = 12.5, .bold = true});
  y += 26;
  for (std::size_t i = 0; i < planes_.size(); ++i) {
    svg_.line({legend_x, y - 4}, {legend_x + 26, y - 4},
              {.stroke = series_colour(i), .width = 2.4});
    if (content_.with_poles)
      svg_.circle({legend_x + 13, y - 4}, 3.6,
                  {.stroke = "white", .width = 0.7, .fill = series_colour(i)});
    row(fmt::format("{}  {:02.0f}/{:03.0f}{}", planes_[i].name, planes_[i].dip,
                    planes_[i].dip_direction, planes_[i].note));
  }
  const auto is_other = [&](const auto& pole) { return pole.plane >= planes_.size(); };
  if (content_.with_poles && std::any_of(content_.poles.begin(), content_.poles.end(), is_other)) {
    svg_.circle({legend_x + 13, y - 4}, 3.6, {.stroke = "none", .fill = series_colour(7)});
    row(content_.words_of_others);
  }
  if (content_.with_poles) row(content_.words_of_poles);
  if (!content_.means.empty()) {
    svg_.circle({legend_x + 13, y - 4}, 5, {.stroke = "#333333", .width = 2});
    row("ring: mean pole, dashed: its 95 % cone");
  }
  if (!content_.joint_pyramids && !content_.friction_angles.empty()) {
    svg_.line({legend_x, y - 4}, {legend_x + 26, y - 4},
              {.stroke = "#666666", .width = 1.2, .dash = "5 4"});
    row("friction angle, for poles");
  }
  if (!content_.free.empty()) {
    svg_.line({legend_x, y - 4}, {legend_x + 26, y - 4},
              {.stroke = "#111111", .width = 2.4, .dash = "9 5"});
    row("free faces of " + content_.wall);
  }
  if (has_axis()) {
    svg_.text({legend_x + 13, y}, "✶", {.size = 14, .anchor = "middle"});
    row("axis of " + content_.wall);
  }
  y = draw_shade_legend(svg_, content_, legend_x, y);
  if (content_.joint_pyramids) draw_pyramid_legend(y);
}

void Net::draw_pyramid_legend(Real y) {
  svg_.square({legend_x + 13, y - 4}, 7, {.stroke = "#b2182b", .width = 0.8, .fill = "#fddbc7"});
  const std::string codes = "0 above, 1 below the joint, in the order of the list";
  for (const std::string& words :
       {content_.wall.empty() ? "removable: name a wall with `on`"
                              : "removable from " + content_.wall,
        codes, hidden_.empty() ? hidden_ : "off this paper:" + hidden_}) {
    if (!words.empty()) svg_.text({legend_x + 34, y}, words, {.size = 12.5});
    y += 22;
  }
}

std::string Net::draw() {
  svg_.clip_circle("net", net_.centre, content_.joint_pyramids ? net_radius : net_.radius);
  if (content_.joint_pyramids) {
    draw_pyramids();
    svg_.circle(net_.centre, net_radius, {.stroke = "#bbbbbb", .width = 1});
  } else {
    draw_shades(svg_, net_, content_);
    draw_circles();
  }
  draw_frame();
  if (!content_.joint_pyramids) draw_friction();
  draw_wall();
  if (content_.with_poles) draw_poles();
  draw_means(svg_, net_, content_);
  if (content_.label_planes) draw_plane_labels(svg_, net_, planes_);
  draw_legend();
  return svg_.document(content_.title_of_document);
}

}  // namespace

std::string draw_net(const NetContent& content) {
  return Net(content).draw();
}

}  // namespace rockfold
