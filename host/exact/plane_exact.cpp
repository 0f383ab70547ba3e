#include "host/exact/plane_exact.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <numeric>
#include <string>

#include "src/base/vector.hpp"

namespace rockfold {

namespace {

constexpr int at_once = 18;  // powers of ten that a machine word holds

std::int64_t small_power_of_ten(int exponent) {
  std::int64_t power = 1;
  for (; exponent > 0; --exponent) power *= 10;
  return power;
}

Integer power_of_ten(int exponent) {
  Integer power = small_power_of_ten(exponent % at_once);
  for (; exponent >= at_once; exponent -= at_once) power *= small_power_of_ten(at_once);
  return power;
}

// digits · 10^exponent, the shortest that reads back as a double: at most 17 digits.
struct Decimal {
  std::int64_t digits = 0;
  int exponent = 0;
};

Decimal decimal(Real x) {
  constexpr Real whole_below = 9007199254740992.0;  // 2^53
  if (std::abs(x) < whole_below && x == std::trunc(x)) return {static_cast<std::int64_t>(x), 0};
  char text[32];
  const char* const end =
      std::to_chars(text, text + sizeof text, x, std::chars_format::scientific).ptr;
  Decimal result;
  const char* at = text + (x < 0 ? 1 : 0);
  for (bool fraction = false; *at != 'e'; ++at) {
    if (*at == '.') {
      fraction = true;
      continue;
    }
    result.digits = 10 * result.digits + (*at - '0');
    if (fraction) --result.exponent;
  }
  result.exponent += std::atoi(std::string(at + 1, end).c_str());
  if (x < 0) result.digits = -result.digits;
  return result;
}

using DecimalVec3 = std::array<Decimal, 3>;

DecimalVec3 decimals(const Vec3& a) {
  return {decimal(a[0]), decimal(a[1]), decimal(a[2])};
}

int least_exponent(const DecimalVec3& a) {
  return std::min({a[0].exponent, a[1].exponent, a[2].exponent});
}

// In units of 10^exponent, which is not over any of theirs.
IntegerVec3 in_units(const DecimalVec3& a, int exponent) {
  IntegerVec3 result;
  for (int d = 0; d < 3; ++d) result[d] = a[d].digits * power_of_ten(a[d].exponent - exponent);
  return result;
}

Integer dot(const IntegerVec3& a, const IntegerVec3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

void divide(IntegerVec3& a, const Integer& by) {
  if (by > 1)
    for (Integer& x : a) mpz_divexact(x.get_mpz_t(), x.get_mpz_t(), by.get_mpz_t());
}

IntegerVec3 cross(const IntegerVec3& a, const IntegerVec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

}  // namespace

Exact exact(Real x) {
  const auto [digits, exponent] = decimal(x);
  if (exponent >= 0) return Integer(digits * power_of_ten(exponent));
  if (exponent < -at_once) {
    Exact result(digits, power_of_ten(-exponent));
    result.canonicalize();
    return result;
  }
  // Reduced in machine words, a tenth of the time that GMP takes.
  const std::int64_t below = small_power_of_ten(-exponent), shared = std::gcd(digits, below);
  return {digits / shared, below / shared};
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

IntegerPlane integers(const ExactVec3& n, const Exact& d) {
  const std::array<const Exact*, 4> given{&n[0], &n[1], &n[2], &d};
  Integer common = 1;
  for (const Exact* x : given) common = lcm(common, x->get_den());
  std::array<Integer, 4> whole;
  Integer shared = 0;
  for (int i = 0; i < 4; ++i) {
    whole[i] = given[i]->get_num() * (common / given[i]->get_den());
    shared = gcd(shared, whole[i]);
  }
  for (Integer& i : whole) mpz_divexact(i.get_mpz_t(), i.get_mpz_t(), shared.get_mpz_t());
  return {{whole[0], whole[1], whole[2]}, whole[3]};
}

// All in integers: (b − a) × normal has 40 digits, and its greatest common divisor with the offset is one with a power of ten.
IntegerPlane plane_through_edge(const Vec3& a, const Vec3& b, const Vec3& normal,
                                const Vec3& centre) {
  const DecimalVec3 from = decimals(a), to = decimals(b), across = decimals(normal),
                    origin = decimals(centre);
  const int unit = std::min({least_exponent(from), least_exponent(to), least_exponent(origin), 0});
  const IntegerVec3 p = in_units(from, unit), q = in_units(to, unit), o = in_units(origin, unit);
  IntegerVec3 n =
      cross({q[0] - p[0], q[1] - p[1], q[2] - p[2]}, in_units(across, least_exponent(across)));
  divide(n, gcd(gcd(n[0], n[1]), n[2]));
  Integer d = dot(n, {p[0] - o[0], p[1] - o[1], p[2] - o[2]});
  // In metres: n·x = d·10^unit.
  Integer scale = power_of_ten(-unit);
  const Integer shared = gcd(d, scale);
  mpz_divexact(d.get_mpz_t(), d.get_mpz_t(), shared.get_mpz_t());
  mpz_divexact(scale.get_mpz_t(), scale.get_mpz_t(), shared.get_mpz_t());
  for (Integer& x : n) x *= scale;
  return {std::move(n), std::move(d)};
}

namespace {

// value·2^exponent, from the two highest machine words of an integer: to 2^-63 of it.
struct Scaled {
  long double value = 0;
  long exponent = 0;
};
Scaled scaled(const Integer& x) {
  const std::size_t words = mpz_size(x.get_mpz_t());
  if (words == 0) return {};
  constexpr int bits = GMP_NUMB_BITS;
  auto value =
      static_cast<long double>(mpz_getlimbn(x.get_mpz_t(), static_cast<mp_size_t>(words) - 1));
  if (words > 1)
    value += std::ldexp(
        static_cast<long double>(mpz_getlimbn(x.get_mpz_t(), static_cast<mp_size_t>(words) - 2)),
        -bits);
  return {sgn(x) < 0 ? -value : value, bits * (static_cast<long>(words) - 1)};
}

}  // namespace

Real ratio(const Integer& a, const Integer& b) {
  const Scaled above = scaled(a), below = scaled(b);
  return static_cast<Real>(
      std::ldexp(above.value / below.value, static_cast<int>(above.exponent - below.exponent)));
}

UnitPlane rounded(const IntegerPlane& plane) {
  // In units of the longest component's highest word, so that normals of any length neither overflow nor vanish.
  std::array<Scaled, 4> part{scaled(plane.n[0]), scaled(plane.n[1]), scaled(plane.n[2]),
                             scaled(plane.d)};
  const long unit = std::max({part[0].exponent, part[1].exponent, part[2].exponent});
  for (Scaled& p : part) p.value = std::ldexp(p.value, static_cast<int>(p.exponent - unit));
  long double length = 0;
  for (int d = 0; d < 3; ++d) length += part[d].value * part[d].value;
  length = std::sqrt(length);
  UnitPlane unit_plane;
  for (int d = 0; d < 3; ++d) unit_plane.normal[d] = static_cast<Real>(part[d].value / length);
  unit_plane.offset = static_cast<Real>(part[3].value / length);
  return unit_plane;
}

UnitPlane rounded(const ExactPlane& plane, const Vec3& centre) {
  return rounded(integers(plane.n, plane.d - dot(plane.n, exact(centre))));
}

}  // namespace rockfold
