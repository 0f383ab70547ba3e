#include "src/report/drawings/projection.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "src/base/vector.hpp"

namespace rockfold {

namespace {

constexpr int steps = 180;  // of a whole circle

/// Two unit vectors across a third.
std::pair<Vec3, Vec3> across(const Vec3& n) {
  const Vec3 level =
      std::hypot(n[0], n[1]) < 1e-12 ? Vec3{1, 0, 0} : normalized(cross({0, 0, 1}, n));
  return {level, cross(n, level)};
}

}  // namespace

Point2 Projection::of(const Vec3& direction) const {
  const Real height = upper ? direction[2] : -direction[2];  // cos θ
  // tan(θ/2)/sin θ = 1/(1 + cos θ); √2 sin(θ/2)/sin θ = 1/√(1 + cos θ).
  const Real below = std::max(1 + height, 1e-6);
  const Real scale = radius / (equal_area ? std::sqrt(below) : below);
  return {centre[0] + scale * direction[0], centre[1] - scale * direction[1]};
}

bool Projection::shows(const Vec3& direction) const {
  return (upper ? direction[2] : -direction[2]) >= -1e-9;
}

std::vector<Point2> Projection::great_circle(const Vec3& normal) const {
  const auto [level, dip] = across(normal);
  const Vec3 middle = shown(dip);
  std::vector<Point2> points;
  for (int i = 0; i <= steps / 2; ++i) {
    const Real a = std::numbers::pi * i / (steps / 2);
    points.push_back(of(std::cos(a) * level + std::sin(a) * middle));
  }
  return points;
}

std::vector<std::vector<Point2>> Projection::small_circle(const Vec3& axis, Real angle) const {
  const auto [a, b] = across(axis);
  std::vector<std::vector<Point2>> runs(1);
  for (int i = 0; i <= steps; ++i) {
    const Real t = 2 * std::numbers::pi * i / steps;
    const Vec3 d = std::cos(angle) * axis + std::sin(angle) * (std::cos(t) * a + std::sin(t) * b);
    if (shows(d))
      runs.back().push_back(of(d));
    else if (!runs.back().empty())
      runs.emplace_back();
  }
  std::erase_if(runs, [](const auto& run) { return run.size() < 2; });
  return runs;
}

}  // namespace rockfold
