#include "src/report/drawings/net_density.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

namespace rockfold {

namespace {

constexpr Real degree = std::numbers::pi / 180;
constexpr Real label_size = 12;  // px

/// From a pale to a deep sand, whose greys differ in print too; the colours of sets are seen on all of them.
std::string shade_colour(std::size_t number, std::size_t count) {
  const Real part = count < 2 ? 1 : static_cast<Real>(number) / static_cast<Real>(count - 1);
  const auto between = [part](int pale, int deep) {
    return static_cast<int>(std::lround(pale + part * (deep - pale)));
  };
  return fmt::format("#{:02x}{:02x}{:02x}", between(0xfb, 0xc4), between(0xf3, 0x9a),
                     between(0xe0, 0x52));
}

Real nearest_distance(const Point2& p, const std::vector<Point2>& others) {
  Real nearest = std::numeric_limits<Real>::infinity();
  for (const Point2& q : others)
    nearest = std::min(nearest, std::hypot((p[0] - q[0]) / 3, p[1] - q[1]));  // words are wide
  return nearest;
}

}  // namespace

void draw_shades(Svg& svg, const Projection& net, const NetContent& content) {
  const std::size_t count = content.shades.size();
  for (std::size_t k = 0; k < count; ++k) {
    std::vector<std::vector<Point2>> loops = content.shades[k].loops;
    for (auto& loop : loops)
      for (Point2& p : loop)
        p = {net.centre[0] + net.radius * p[0], net.centre[1] - net.radius * p[1]};
    svg.polygon(loops, {.stroke = "#a9854a", .width = 0.6, .fill = shade_colour(k, count)}, "net");
  }
}

void draw_means(Svg& svg, const Projection& net, const NetContent& content) {
  for (const NetContent::Mean& mean : content.means) {
    const std::string colour = series_colour(mean.plane);
    const Vec3 shown = net.shown(mean.pole), other{-shown[0], -shown[1], -shown[2]};
    for (const Vec3& end : {shown, other})
      for (const auto& run : net.small_circle(end, mean.cone * degree))
        svg.polyline(run, {.stroke = colour, .width = 1.4, .dash = "4 3"});
    svg.circle(net.of(shown), 6.5, {.stroke = "white", .width = 4});
    svg.circle(net.of(shown), 6.5, {.stroke = colour, .width = 2.4});
  }
}

void draw_plane_labels(Svg& svg, const Projection& net, const std::vector<NetPlane>& planes) {
  std::vector<Point2> taken;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    const std::vector<Point2> arc = net.great_circle(planes[i].normal);
    std::vector<Point2> others = taken;
    for (std::size_t k = 0; k < planes.size(); ++k)
      if (k != i) {
        const std::vector<Point2> other = net.great_circle(planes[k].normal);
        others.insert(others.end(), other.begin(), other.end());
      }
    // Not at the rim, where azimuths stand.
    Point2 best = arc[arc.size() / 2];
    for (std::size_t k = arc.size() / 8; k < arc.size() - arc.size() / 8; ++k)
      if (nearest_distance(arc[k], others) > nearest_distance(best, others)) best = arc[k];
    taken.push_back(best);
    svg.text({best[0], best[1] + 4},
             fmt::format("{:02.0f}/{:03.0f}", planes[i].dip, planes[i].dip_direction),
             {.size = label_size,
              .anchor = "middle",
              .colour = series_colour(i),
              .bold = true,
              .halo = true});
  }
}

Real draw_shade_legend(Svg& svg, const NetContent& content, Real x, Real y) {
  if (content.shades.empty()) return y;
  constexpr Real row = 17;
  y += 8;
  svg.text({x, y}, content.title_of_shades, {.size = 12.5, .bold = true});
  const std::size_t count = content.shades.size();
  for (std::size_t k = 0; k < count; ++k) {
    y += row;
    svg.square({x + 13, y - 4}, 7,
               {.stroke = "#a9854a", .width = 0.6, .fill = shade_colour(k, count)});
    svg.text({x + 34, y}, content.shades[k].words, {.size = 12});
  }
  return y + row;
}

}  // namespace rockfold
