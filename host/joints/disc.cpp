#include "host/joints/disc.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "host/exact/orientation.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {

PlaneFrame frame_of(const DipOrientation& orientation) {
  const auto [sin_dip, cos_dip] = sine_cosine_degrees(orientation.dip);
  const auto [sin_dd, cos_dd] = sine_cosine_degrees(orientation.dip_direction);
  return {{sin_dip * sin_dd, sin_dip * cos_dd, cos_dip},
          {cos_dip * sin_dd, cos_dip * cos_dd, -sin_dip},
          {-cos_dd, sin_dd, 0}};
}

PlaneFrame frame_of(const Vec3& given) {
  // Scaled first: a normal of any length has a square that neither overflows nor vanishes.
  const Real largest = std::max({std::abs(given[0]), std::abs(given[1]), std::abs(given[2])});
  Vec3 n = {given[0] / largest, given[1] / largest, given[2] / largest};
  const Real length = norm(n);
  n = {n[0] / length, n[1] / length, n[2] / length};
  if (n[2] < 0) n = -n;
  const Real level = std::sqrt(n[0] * n[0] + n[1] * n[1]);
  if (level == 0) return {n, {0, 1, 0}, {-1, 0, 0}};
  const Real sin_dd = n[0] / level, cos_dd = n[1] / level;
  return {n, {n[2] * sin_dd, n[2] * cos_dd, -level}, {-cos_dd, sin_dd, 0}};
}

// Of k/n of a full turn; reduced to one octant in whole numbers, so that mirror-image corners have mirror-image values.
SineCosine sine_cosine_of_turn(std::int64_t k, std::int64_t n) {
  const std::int64_t quadrant = 4 * k / n;
  std::int64_t rest = 4 * k - quadrant * n;  // of n: a quarter turn
  const bool upper = 2 * rest > n;
  if (upper) rest = n - rest;
  auto [s, c] = sine_cosine_degrees(90.0 * static_cast<Real>(rest) / static_cast<Real>(n));
  if (upper) std::swap(s, c);
  switch (quadrant % 4) {
    case 0:
      return {s, c};
    case 1:
      return {c, -s};
    case 2:
      return {-s, -c};
    default:
      return {-c, s};
  }
}

}  // namespace

PlaneFrame plane_frame(const Orientation& orientation) {
  return std::visit([](const auto& given) { return frame_of(given); }, orientation);
}

DiscOutline disc_outline(Index sides) {
  DiscOutline outline;
  outline.reserve(sides);
  for (Index k = 0; k < sides; ++k) outline.push_back(sine_cosine_of_turn(k, sides));
  return outline;
}

std::vector<Vec3> disc_corners(const PlaneFrame& frame, const Vec3& centre, const Vec3& shift,
                               Real radius, const DiscOutline& outline) {
  std::vector<Vec3> corners;
  corners.reserve(outline.size());
  for (const auto& [s, c] : outline)
    corners.push_back(centre + (shift + radius * (c * frame.down + s * frame.strike)));
  return corners;
}

Extent bounding_box(const std::vector<Vec3>& points) {
  Extent box{points.front(), points.front()};
  for (const Vec3& p : points)
    for (int d = 0; d < 3; ++d) {
      box.min[d] = std::min(box.min[d], p[d]);
      box.max[d] = std::max(box.max[d], p[d]);
    }
  return box;
}

Real diagonal(const Extent& box) {
  return norm(box.max - box.min);
}

bool boxes_meet(const Extent& a, const Extent& b, Real margin) {
  for (int d = 0; d < 3; ++d)
    if (a.min[d] > b.max[d] + margin || b.min[d] > a.max[d] + margin) return false;
  return true;
}

}  // namespace rockfold
