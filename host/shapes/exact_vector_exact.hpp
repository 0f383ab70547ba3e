// The few operations on exact vectors that shapes need beyond plane_exact.hpp. Include in .cpp only.
#pragma once

#include "host/exact/plane_exact.hpp"

namespace rockfold {

inline ExactVec3 operator+(const ExactVec3& a, const ExactVec3& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline ExactVec3 operator-(const ExactVec3& a, const ExactVec3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline ExactVec3 operator*(const Exact& s, const ExactVec3& a) {
  return {s * a[0], s * a[1], s * a[2]};
}

inline bool is_zero(const ExactVec3& a) {
  return a[0] == 0 && a[1] == 0 && a[2] == 0;
}

/// −1 below the plane, 0 on it, +1 above.
inline int side_of(const ExactPlane& plane, const ExactVec3& x) {
  return CGAL::sign(Exact(dot(plane.n, x) - plane.d));
}

}  // namespace rockfold
