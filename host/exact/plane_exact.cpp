#include "host/exact/plane_exact.hpp"

namespace rockfold {

ExactVec3 exact(const Vec3& a) {
  return {Exact(a[0]), Exact(a[1]), Exact(a[2])};
}

Exact dot(const ExactVec3& a, const ExactVec3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

ExactVec3 cross(const ExactVec3& a, const ExactVec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

ExactPlane plane_through(const Vec3& normal, const Vec3& point, Real offset) {
  const ExactVec3 n = exact(normal);
  return {n, dot(n, exact(point)) + Exact(offset)};
}

ExactPlane plane_along(const ExactVec3& point, const ExactVec3& u, const ExactVec3& v) {
  const ExactVec3 n = cross(u, v);
  return {n, dot(n, point)};
}

ExactPlane plane_through_points(const Vec3& a, const Vec3& b, const Vec3& c) {
  const ExactVec3 o = exact(a), p = exact(b), q = exact(c);
  return plane_along(o, {p[0] - o[0], p[1] - o[1], p[2] - o[2]},
                     {q[0] - o[0], q[1] - o[1], q[2] - o[2]});
}

ExactPlane opposite(const ExactPlane& plane) {
  return {{-plane.n[0], -plane.n[1], -plane.n[2]}, -plane.d};
}

}  // namespace rockfold
