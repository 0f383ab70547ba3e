// What a plane table should answer, by exact rational arithmetic alone.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "host/exact/plane_exact.hpp"
#include "host/exact/plane_table.hpp"

namespace rockfold::test {

/// A plane table beside the exact planes that were put into it.
struct Planes {
  Planes(const Vec3& centre, Real size) : table(centre, size), centre_exact(exact(centre)) {}

  Index add(const ExactPlane& plane) {
    exact_planes.push_back({plane.n, plane.d - dot(plane.n, centre_exact)});
    return table.add(plane);
  }
  Index add(const Vec3& normal, const Vec3& point) { return add(plane_through(normal, point)); }

  /// The meeting point of three planes relative to the centre, by Cramer's rule.
  ExactVec3 meeting_point(const std::array<Index, 3>& p) const {
    const ExactPlane &a = exact_planes[p[0]], &b = exact_planes[p[1]], &c = exact_planes[p[2]];
    const ExactVec3 bc = cross(b.n, c.n), ca = cross(c.n, a.n), ab = cross(a.n, b.n);
    const Exact det = dot(a.n, bc);
    ExactVec3 x;
    for (int d = 0; d < 3; ++d) x[d] = (a.d * bc[d] + b.d * ca[d] + c.d * ab[d]) / det;
    return x;
  }

  /// n·x − d of the plane as given (not of unit normal).
  Exact value(const ExactVec3& x, Index plane) const {
    return dot(exact_planes[plane].n, x) - exact_planes[plane].d;
  }

  /// Signed distance in m, relative error some 1e-15: rounded only after the exact value.
  Real distance(const ExactVec3& x, Index plane) const {
    const Exact squared = dot(exact_planes[plane].n, exact_planes[plane].n);
    return CGAL::to_double(value(x, plane)) / std::sqrt(CGAL::to_double(squared));
  }

  /// Sine of the angle between two planes.
  Real sine(Index p, Index q) const {
    const ExactVec3 &a = exact_planes[p].n, &b = exact_planes[q].n;
    const ExactVec3 c = cross(a, b);
    return std::sqrt(CGAL::to_double(Exact(dot(c, c) / (dot(a, a) * dot(b, b)))));
  }

  PlaneTable table;
  ExactVec3 centre_exact;
  std::vector<ExactPlane> exact_planes;  ///< d relative to the centre
};

inline int sign(const Exact& x) {
  return x > 0 ? 1 : x < 0 ? -1 : 0;
}

/// DESIGN.md, rule 5, on exact numbers: on the plane if the least of the four distances by which the planes miss a common
/// point is within 1e-10 of the size (less in proportion where two of them make an angle of sine under 1e-3), and the
/// vertex is not moved by more than 1e-7 of the size; the exact sign otherwise. `decided` is false so near a threshold that
/// doubles may differ.
struct Answer {
  int side = 0;
  bool decided = true;
};
inline Answer rule_five(const Planes& planes, const std::array<Index, 3>& vertex, Index s,
                        Real size) {
  const ExactVec3 x = planes.meeting_point(vertex);
  const Real distance = std::abs(planes.distance(x, s));
  Real least = distance;
  for (int i = 0; i < 3; ++i) {
    std::array<Index, 3> other = vertex;
    std::swap(other[i], s);
    const auto& n = planes.exact_planes;
    if (dot(n[other[0]].n, cross(n[other[1]].n, n[other[2]].n)) != 0)
      least = std::min(least, std::abs(planes.distance(planes.meeting_point(other), s)));
    std::swap(other[i], s);
  }
  const Index all[4] = {vertex[0], vertex[1], vertex[2], s};
  Real smallest = 1e-3;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < i; ++j) smallest = std::min(smallest, planes.sine(all[i], all[j]));
  const Real allowed = 1e-10 * size * (smallest / 1e-3);
  const int exact_sign = sign(planes.value(x, s));
  const bool on = least <= allowed && distance <= 1e-7 * size;
  // Rounding of the unit normals counts where the tolerance is as small as they are.
  const bool near_distance = std::abs(least - allowed) < 0.02 * allowed + 4e-15 * size ||
                             std::abs(distance / (1e-7 * size) - 1) < 1e-3;
  return {on ? 0 : exact_sign, !near_distance};
}

}  // namespace rockfold::test
