// What a plane table should answer, by exact rational arithmetic alone.
#pragma once

#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "host/exact/plane_exact.hpp"
#include "host/exact/plane_table.hpp"
#include "src/base/vector.hpp"

namespace rockfold::test {

inline int sign(const Exact& x) {
  return x > 0 ? 1 : x < 0 ? -1 : 0;
}

/// 10^exponent
inline Exact ten_to(int exponent) {
  Exact power = 1;
  for (int i = 0; i < std::abs(exponent); ++i) power *= 10;
  return exponent < 0 ? Exact(1 / power) : power;
}

/// The number that a text of the form -12.34e-5 stands for.
inline Exact decimal(const std::string& text) {
  const std::size_t e = text.find_first_of("eE");
  int exponent = e == std::string::npos ? 0 : std::stoi(text.substr(e + 1));
  Exact digits = 0;
  bool fraction = false;
  for (const char c : text.substr(0, e)) {
    if (c == '.') fraction = true;
    if (c < '0' || c > '9') continue;
    digits = 10 * digits + Exact(c - '0');
    exponent -= fraction ? 1 : 0;
  }
  return (text.front() == '-' ? Exact(-1) : Exact(1)) * digits * ten_to(exponent);
}

/// A plane table beside the exact planes that were put into it.
struct Planes {
  Planes(const Vec3& centre, Real size) : table(centre, size), centre_exact(exact(centre)) {}

  Index add(const ExactPlane& plane) {
    exact_planes.push_back({plane.n, plane.d - dot(plane.n, centre_exact)});
    return table.add(plane);
  }
  Index add(const Vec3& normal, const Vec3& point, const Exact& offset = 0) {
    return add(plane_through(normal, point, offset));
  }

  Exact determinant(const std::array<Index, 3>& p) const {
    const auto& e = exact_planes;
    return dot(e[p[0]].n, cross(e[p[1]].n, e[p[2]].n));
  }

  /// The meeting point of three planes relative to the centre, by Cramer's rule.
  ExactVec3 meeting_point(const std::array<Index, 3>& p) const {
    const ExactPlane &a = exact_planes[p[0]], &b = exact_planes[p[1]], &c = exact_planes[p[2]];
    const ExactVec3 bc = cross(b.n, c.n), ca = cross(c.n, a.n), ab = cross(a.n, b.n);
    const Exact det = dot(a.n, bc);
    ExactVec3 x;
    for (int d = 0; d < 3; ++d) x[d] = (a.d * bc[d] + b.d * ca[d] + c.d * ab[d]) / det;
    return x;
  }

  /// −1, 0, +1: the side of plane s on which the meeting point of three others lies.
  int side(const std::array<Index, 3>& p, Index s) const {
    return sign(dot(exact_planes[s].n, meeting_point(p)) - exact_planes[s].d);
  }

  PlaneTable table;
  ExactVec3 centre_exact;
  std::vector<ExactPlane> exact_planes;  ///< d relative to the centre
};

/// Vectors and points at random, the same in each run.
struct Random {
  std::mt19937 engine{20261121};
  std::normal_distribution<Real> gauss;
  std::uniform_real_distribution<Real> unit{-1, 1};

  Vec3 vector() { return {gauss(engine), gauss(engine), gauss(engine)}; }
  Vec3 point(Real size) {
    return {size / 2 * unit(engine), size / 2 * unit(engine), size / 2 * unit(engine)};
  }
};

}  // namespace rockfold::test
