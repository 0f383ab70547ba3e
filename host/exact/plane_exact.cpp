#include "host/exact/plane_exact.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "src/base/vector.hpp"

namespace rockfold {

namespace {

Exact power_of_ten(int exponent) {
  Exact power = 1, square = 10;
  for (; exponent > 0; exponent /= 2) {
    if (exponent % 2 != 0) power *= square;
    if (exponent > 1) square *= square;
  }
  return power;
}

// At most 17 digits: two halves that doubles hold exactly.
Exact whole_number(std::int64_t digits) {
  constexpr std::int64_t half = 1'000'000'000;
  const auto part = [](std::int64_t n) { return Exact(static_cast<double>(n)); };
  return digits / half == 0 ? part(digits) : part(digits / half) * part(half) + part(digits % half);
}

}  // namespace

Exact exact(Real x) {
  constexpr Real whole_below = 9007199254740992.0;  // 2^53
  if (std::abs(x) < whole_below && x == std::trunc(x)) return {x};
  char text[32];
  const char* const end =
      std::to_chars(text, text + sizeof text, x, std::chars_format::scientific).ptr;
  std::int64_t digits = 0;
  int exponent = 0;
  const char* at = text + (x < 0 ? 1 : 0);
  for (bool fraction = false; *at != 'e'; ++at) {
    if (*at == '.') {
      fraction = true;
      continue;
    }
    digits = 10 * digits + (*at - '0');
    if (fraction) --exponent;
  }
  exponent += std::atoi(std::string(at + 1, end).c_str());
  const Exact size = exponent < 0 ? Exact(whole_number(digits) / power_of_ten(-exponent))
                                  : Exact(whole_number(digits) * power_of_ten(exponent));
  return x < 0 ? Exact(-size) : size;
}

ExactVec3 exact(const Vec3& a) {
  return {exact(a[0]), exact(a[1]), exact(a[2])};
}

Exact dot(const ExactVec3& a, const ExactVec3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

ExactVec3 cross(const ExactVec3& a, const ExactVec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

ExactPlane plane_through(const Vec3& normal, const Vec3& point, const Exact& offset) {
  const ExactVec3 n = exact(normal);
  return {n, dot(n, exact(point)) + offset};
}

ExactPlane plane_along(const ExactVec3& point, const ExactVec3& u, const ExactVec3& v) {
  const ExactVec3 n = cross(u, v);
  return {n, dot(n, point)};
}

ExactPlane plane_through_points(const ExactVec3& a, const ExactVec3& b, const ExactVec3& c) {
  return plane_along(a, {b[0] - a[0], b[1] - a[1], b[2] - a[2]},
                     {c[0] - a[0], c[1] - a[1], c[2] - a[2]});
}

ExactPlane opposite(const ExactPlane& plane) {
  return {{-plane.n[0], -plane.n[1], -plane.n[2]}, -plane.d};
}

UnitPlane rounded(const ExactVec3& n, const Exact& centred_d) {
  // Scaled by the largest component first, so that normals of any length neither overflow nor vanish.
  const Exact largest = std::max({Exact(abs(n[0])), Exact(abs(n[1])), Exact(abs(n[2]))});
  Vec3 m;
  for (int d = 0; d < 3; ++d) m[d] = CGAL::to_double(Exact(n[d] / largest));
  const Real length = norm(m);
  return {(1.0 / length) * m, CGAL::to_double(Exact(centred_d / largest)) / length};
}

UnitPlane rounded(const ExactPlane& plane, const Vec3& centre) {
  return rounded(plane.n, plane.d - dot(plane.n, exact(centre)));
}

}  // namespace rockfold
