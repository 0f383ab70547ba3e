// Polygons to make shapes of, and where they lie.
#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "src/base/vector.hpp"

namespace rockfold::test {

using Polygon2 = std::vector<std::array<Real, 2>>;

inline Real shoelace(const Polygon2& p) {
  Real area = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const auto &a = p[i], &b = p[(i + 1) % p.size()];
    area += (a[0] * b[1] - a[1] * b[0]) / 2;
  }
  return area;
}

inline Real edge_length(const Polygon2& p, std::size_t i) {
  const auto &a = p[i], &b = p[(i + 1) % p.size()];
  return std::hypot(b[0] - a[0], b[1] - a[1]);
}

/// Numbers that every standard library draws alike.
class Random {
 public:
  explicit Random(std::uint32_t seed) : engine_(seed) {}
  Real uniform(Real low, Real high) { return low + (high - low) * (engine_() / 4294967296.0); }
  Vec3 direction() {
    for (;;) {
      const Vec3 v{uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)};
      if (norm(v) > 0.2 && norm(v) < 1) return normalized(v);
    }
  }

 private:
  std::mt19937 engine_;
};

/// Corners around the origin at random radii; deep dents, no two edges on one line.
inline Polygon2 random_star(int corners, Random& random) {
  Polygon2 p;
  for (int i = 0; i < corners; ++i) {
    const Real angle = 2 * std::numbers::pi * (i + random.uniform(0, 0.7)) / corners;
    const Real radius = random.uniform(0.2, 1);
    p.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  return p;
}

/// A wall with teeth: all their tips are on one line, all gaps on another.
inline Polygon2 comb(int teeth) {
  Polygon2 p{{0, 0}, {2.0 * teeth + 1, 0}, {2.0 * teeth + 1, 1}};
  for (int i = teeth - 1; i >= 0; --i)
    for (const auto& [x, y] :
         Polygon2{{2.0 * i + 2, 1}, {2.0 * i + 2, 3}, {2.0 * i + 1, 3}, {2.0 * i + 1, 1}})
      p.push_back({x, y});
  p.push_back({0, 1});
  return p;
}

/// A band that winds `turns` times about the origin: no point sees all of it.
inline Polygon2 spiral(int turns) {
  Polygon2 p;
  const int n = 8 * turns;
  const auto at = [](int i, Real radius) {
    return std::array<Real, 2>{radius * std::cos(0.25 * std::numbers::pi * i),
                               radius * std::sin(0.25 * std::numbers::pi * i)};
  };
  for (int i = 0; i <= n; ++i) p.push_back(at(i, 1.6 + 0.125 * i));
  for (int i = n; i >= 0; --i) p.push_back(at(i, 1.0 + 0.125 * i));
  return p;
}

/// A plane in space: where (x, y) comes to lie, rounded to double.
struct Placement {
  Vec3 origin{}, u{1, 0, 0}, v{0, 1, 0};

  Vec3 normal() const { return cross(u, v); }
  std::vector<Vec3> operator()(const Polygon2& polygon) const {
    std::vector<Vec3> points;
    for (const auto& [x, y] : polygon) points.push_back(origin + x * u + y * v);
    return points;
  }
};

inline Placement random_placement(Real reach, Random& random) {
  Placement placement;
  placement.origin = reach * random.direction();
  placement.u = random.direction();
  Vec3 other = random.direction();
  while (norm(cross(placement.u, other)) < 0.3) other = random.direction();
  placement.v = normalized(cross(placement.u, other));
  return placement;
}

}  // namespace rockfold::test
