// Plane polygons with holes for the tests of triangulation, and what their triangles must be.
#pragma once

#include <array>
#include <vector>

#include <gtest/gtest.h>

#include "host/flatten/triangulate.hpp"
#include "src/base/vector.hpp"

namespace rockfold::test {

using Point2 = std::array<Real, 2>;
using Outlines = std::vector<std::vector<Point2>>;  ///< the boundary and its holes, (x, y)

struct PlanePolygon {
  std::vector<Vec3> points;
  std::vector<std::vector<Index>> loops;
};

constexpr Vec3 u_axis{0.6, 0, 0.8}, v_axis{0.64, 0.6, -0.48};  // orthonormal
const Vec3 plane_normal = cross(u_axis, v_axis);

/// Each corner as a point of its own.
inline PlanePolygon polygon_in(const Vec3& origin, const Vec3& u, const Vec3& v,
                               const Outlines& outlines) {
  PlanePolygon polygon;
  for (const auto& loop : outlines) {
    polygon.loops.emplace_back();
    for (const auto& [x, y] : loop) {
      polygon.loops.back().push_back(static_cast<Index>(polygon.points.size()));
      polygon.points.push_back(origin + x * u + y * v);
    }
  }
  return polygon;
}

/// In an inclined plane off the origin, so that coordinates are rounded.
inline PlanePolygon in_plane(const Outlines& outlines) {
  return polygon_in({100, -20, 7}, u_axis, v_axis, outlines);
}

/// In z = 0, so that they are not.
inline PlanePolygon flat(const Outlines& outlines) {
  return polygon_in({}, {1, 0, 0}, {0, 1, 0}, outlines);
}

inline std::vector<std::array<Index, 3>> triangles_of(const PlanePolygon& polygon,
                                                      const Vec3& normal) {
  const std::vector<Loop> loops(polygon.loops.begin(), polygon.loops.end());
  return triangulate(loops, polygon.points, normal);
}

inline Real signed_area(const std::vector<Index>& loop, const std::vector<Vec3>& points,
                        const Vec3& normal) {
  Vec3 sum{};
  for (std::size_t i = 0; i < loop.size(); ++i)
    sum += cross(points[loop[i]] - points[loop[0]],
                 points[loop[(i + 1) % loop.size()]] - points[loop[0]]);
  return dot(sum, normal) / 2;
}

inline Real area_of_triangles(const PlanePolygon& polygon, const Vec3& normal) {
  Real area = 0;
  for (const auto& t : triangles_of(polygon, normal))
    area += signed_area({t[0], t[1], t[2]}, polygon.points, normal);
  return area;
}

}  // namespace rockfold::test
