#include "host/files/bodies/body_planes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <tuple>

#include "host/files/bodies/plane_fit.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {

class PlaneFinder {
 public:
  PlaneFinder(const TriangleSurface& surface, Real reach) : surface_(surface), reach_(reach) {
    for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
      const auto [a, b, c] = corners(t);
      area_.push_back(0.5 * cross(b - a, c - a));
    }
    pair_sides();
    found_.of_triangle.assign(surface.triangles.size(), none);
    seen_.assign(surface.vertices.size(), none);
  }

  BodyPlanes run() {
    std::vector<std::size_t> order(area_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::vector<Real> size;
    for (const Vec3& area : area_) size.push_back(norm(area));
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return size[a] > size[b]; });
    for (const std::size_t t : order)
      if (found_.of_triangle[t] == none) grow(t);
    found_.convex = is_convex();
    return std::move(found_);
  }

 private:
  std::array<Vec3, 3> corners(std::size_t t) const {
    const auto& [a, b, c] = surface_.triangles[t];
    return {surface_.vertices[a], surface_.vertices[b], surface_.vertices[c]};
  }

  void pair_sides() {
    std::vector<std::tuple<Index, Index, std::size_t>> sides;
    for (std::size_t t = 0; t < surface_.triangles.size(); ++t)
      for (std::size_t i = 0; i < 3; ++i) {
        const Index a = surface_.triangles[t][i], b = surface_.triangles[t][(i + 1) % 3];
        sides.emplace_back(std::min(a, b), std::max(a, b), 3 * t + i);
      }
    std::sort(sides.begin(), sides.end());
    neighbour_.assign(sides.size(), 0);
    for (std::size_t s = 0; s + 1 < sides.size(); s += 2) {
      neighbour_[std::get<2>(sides[s])] = std::get<2>(sides[s + 1]) / 3;
      neighbour_[std::get<2>(sides[s + 1])] = std::get<2>(sides[s]) / 3;
    }
  }

  // A triangle so thin that rounding may turn it over says nothing by its sense.
  bool is_thin(std::size_t t) const {
    const auto [a, b, c] = corners(t);
    const Real longest = std::max({norm(b - a), norm(c - b), norm(a - c)});
    return 2 * norm(area_[t]) < 4 * reach_ * longest;
  }

  // Grown by what lies within reach of the plane fitted so far; where its first triangles then lie off the last one, by what lies within
  // reach of the first triangle's plane.
  void grow(std::size_t seed) {
    if (const auto plane = spread(seed, false); max_distance(plane) <= 2 * reach_)
      accept(seed, plane);
    else
      accept(seed, spread(seed, true));
  }

  FittedPlane spread(std::size_t seed, bool keep_first) {
    for (const std::size_t t : region_)
      if (found_.of_triangle[t] == tried) found_.of_triangle[t] = none;
    const auto stamp = static_cast<Index>(stamp_++);
    region_ = {seed}, vertices_.clear();
    const Vec3 sense = area_[seed];
    PlaneFit fit(corners(seed)[0]);
    for (const Index v : surface_.triangles[seed]) take(v, stamp, fit);
    FittedPlane plane{corners(seed)[0], normalized(sense)};
    found_.of_triangle[seed] = tried;
    for (std::size_t at = 0; at < region_.size(); ++at)
      for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t next = neighbour_[3 * region_[at] + i];
        if (found_.of_triangle[next] != none) continue;
        if (dot(sense, area_[next]) <= 0 && !is_thin(next)) continue;
        PlaneFit wider = fit;
        bool near = true;
        for (const Index v : surface_.triangles[next])
          if (seen_[v] != stamp) wider.add(surface_.vertices[v]);
        const FittedPlane moved = keep_first ? plane : wider.plane();
        for (const Index v : surface_.triangles[next])
          near = near && std::abs(moved.above(surface_.vertices[v])) <= reach_;
        if (!near) continue;
        for (const Index v : surface_.triangles[next])
          if (seen_[v] != stamp) take(v, stamp, fit);
        plane = moved;
        found_.of_triangle[next] = tried;
        region_.push_back(next);
      }
    if (!keep_first && region_.size() > 1) plane = fit.plane();
    return plane;
  }

  void take(Index v, Index stamp, PlaneFit& fit) {
    seen_[v] = stamp;
    vertices_.push_back(v);
    fit.add(surface_.vertices[v]);
  }

  Real max_distance(const FittedPlane& plane) const {
    Real most = 0;
    for (const Index v : vertices_)
      most = std::max(most, std::abs(plane.above(surface_.vertices[v])));
    return most;
  }

  void accept(std::size_t seed, const FittedPlane& plane) {
    const auto id = static_cast<Index>(found_.outward.size());
    found_.outward.push_back(dot(plane.normal, area_[seed]) < 0 ? -plane.normal : plane.normal);
    for (const std::size_t t : region_) found_.of_triangle[t] = id;
    region_.clear();
  }

  bool is_convex() const {
    for (std::size_t t = 0; t < surface_.triangles.size(); ++t)
      for (std::size_t i = 0; i < 3; ++i) {
        const Index own = found_.of_triangle[t], other = found_.of_triangle[neighbour_[3 * t + i]];
        if (own == other) continue;
        const auto x = corners(t);
        if (dot(cross(found_.outward[own], found_.outward[other]), x[(i + 1) % 3] - x[i]) <= 0)
          return false;
      }
    return true;
  }

  static constexpr Index tried = none - 1;

  const TriangleSurface& surface_;
  Real reach_;
  std::vector<Vec3> area_;              // [triangles] vector area
  std::vector<std::size_t> neighbour_;  // [3 triangles] across each side
  std::vector<Index> seen_;             // [vertices] by which region last
  std::vector<std::size_t> region_;     // triangles of the plane that grows
  std::vector<Index> vertices_;         // theirs
  std::size_t stamp_ = 0;
  BodyPlanes found_;
};

}  // namespace

BodyPlanes find_planes(const TriangleSurface& surface, Real reach) {
  return PlaneFinder(surface, reach).run();
}

}  // namespace rockfold
