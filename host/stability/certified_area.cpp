#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "host/stability/certificate_form.hpp"
#include "host/stability/certified_area_exact.hpp"

namespace rockfold {

namespace {

constexpr Real unit_tolerance = 1e-9;  ///< of a normal's length
/// Of an area's size, for its plane; of the square of that, for convexity.
constexpr Real flat_tolerance = 1e-6;
/// Of a force: by so much it may exceed what strength allows. What doubles cannot say; the balance is looked at less closely.
constexpr Real force_rounding = 1e-12;
constexpr long root_bits = 106;  ///< of a root: 2^-105 < 1e-31 of it

/// x·2^bits
Exact scaled(const Exact& x, long bits) {
  Exact result;
  if (bits >= 0)
    mpq_mul_2exp(result.get_mpq_t(), x.get_mpq_t(), static_cast<mp_bitcnt_t>(bits));
  else
    mpq_div_2exp(result.get_mpq_t(), x.get_mpq_t(), static_cast<mp_bitcnt_t>(-bits));
  return result;
}

long bits_of(const Integer& x) {
  return static_cast<long>(mpz_sizeinbase(x.get_mpz_t(), 2));
}

/// Between the middle and each edge.
void add_triangles(CertifiedArea& area) {
  const std::size_t count = area.corner.size();
  for (std::size_t i = 0; i < count; ++i) {
    const ExactVec3 &a = area.corner[i], &b = area.corner[(i + 1) % count];
    const Exact twice_square = square(cross(a - area.middle, b - area.middle));
    area.triangle.push_back({{area.middle, a, b}, root_of(twice_square / 4)});
  }
}

/// How often the corners go round the middle of an area that is convex otherwise.
int turns(const CertifiedArea& area) {
  Real angle = 0;
  for (std::size_t i = 0; i < area.corner.size(); ++i) {
    const ExactVec3 a = area.corner[i] - area.middle;
    const ExactVec3 b = area.corner[(i + 1) % area.corner.size()] - area.middle;
    angle += std::atan2(Exact(dot(area.normal, cross(a, b))).get_d(), Exact(dot(a, b)).get_d());
  }
  return static_cast<int>(std::lround(std::abs(angle) / (2 * std::numbers::pi)));
}

void require_convex(const CertifiedArea& area, const Exact& size_square) {
  const std::size_t count = area.corner.size();
  Exact twice_area = 0;
  for (std::size_t i = 0; i < count; ++i)
    twice_area += dot(area.normal, cross(area.corner[i], area.corner[(i + 1) % count]));
  if (twice_area == 0) throw WrongCertificate{area.name + ": its corners span no area"};
  const int sense = twice_area > 0 ? 1 : -1;
  for (std::size_t i = 0; i < count; ++i) {
    const ExactVec3 edge = area.corner[(i + 1) % count] - area.corner[i];
    for (std::size_t j = 0; j < count; ++j) {
      const Exact inside = sense * dot(area.normal, cross(edge, area.corner[j] - area.corner[i]));
      if (inside < -rational(flat_tolerance) * size_square)
        throw WrongCertificate{fmt::format(
            "{}: not convex, or its corners not in order: corner {} lies {} m outside of the edge "
            "from corner {}",
            area.name, j + 1, short_text(-inside / root_of(square(edge)).above), i + 1)};
    }
  }
  if (turns(area) != 1)
    throw WrongCertificate{
        fmt::format("{}: its corners go round it {} times", area.name, turns(area))};
}

/// "by 2.1e-3 of it"; `excess` is in units of the normal's length.
std::string share(const Exact& excess, const ExactVec3& force, const CertifiedArea& area) {
  const SafeRoot whole = root_of(square(force) * area.normal_square);
  return fmt::format("by {} of it", short_text(excess / whole.above));
}

}  // namespace

std::string short_text(const Exact& x) {
  return fmt::format("{:.2g}", x.get_d());
}

SafeRoot root_of(const Exact& square) {
  if (square <= 0) return {0, 0};
  const long shift = root_bits - (bits_of(square.get_num()) - bits_of(square.get_den())) / 2;
  const Exact wide = scaled(square, 2 * shift);
  const Integer whole = sqrt(Integer(wide.get_num() / wide.get_den()));
  return {scaled(Exact(whole), -shift), scaled(Exact(whole + 1), -shift)};
}

CertifiedArea area_of(const RigidMass& mass, Index contact) {
  const ContactArea& given = mass.contacts[contact];
  CertifiedArea area;
  area.name = contact_text(mass, contact);
  area.body = given.body;
  area.normal = rational(given.normal);
  area.normal_square = square(area.normal);
  area.normal_length = root_of(area.normal_square);
  for (const Vec3& x : given.corner) area.corner.push_back(rational(x));
  for (const ExactVec3& x : area.corner) area.middle = area.middle + x;
  area.middle = Exact(1, area.corner.size()) * area.middle;
  if (is_strong(given)) add_triangles(area);
  area.friction = rational(given.friction);
  area.cohesion = rational(given.cohesion);
  area.tension = rational(given.tension);
  return area;
}

void require_shape(const CertifiedArea& area) {
  if (abs(area.normal_square - 1) > 2 * rational(unit_tolerance))
    throw WrongCertificate{fmt::format("{}: its normal has not the length 1 but {:.10g}", area.name,
                                       area.normal_length.below.get_d())};
  Exact size_square = 0;
  for (const ExactVec3& x : area.corner)
    size_square = std::max(size_square, square(x - area.middle));
  const Exact flat = rational(flat_tolerance);
  for (std::size_t i = 0; i < area.corner.size(); ++i) {
    const Exact off = dot(area.normal, area.corner[i] - area.middle);
    if (off * off > flat * flat * size_square)
      throw WrongCertificate{fmt::format("{}, corner {}: {} m off the plane across the normal",
                                         area.name, i + 1, short_text(abs(off)))};
  }
  require_convex(area, size_square);
}

ReducedStrength strength_of(const CertifiedArea& area, const Exact& factor) {
  ReducedStrength s{area.friction / factor, area.cohesion / factor, area.tension / factor};
  if (s.friction > 0) s.tension = std::min(s.tension, Exact(s.cohesion / s.friction));
  return s;
}

void require_borne(const ExactVec3& force, const CertifiedArea& area,
                   const ReducedStrength& strength, const Exact& point_area,
                   const std::string& place) {
  // All of it times the normal's length, so that roots are needed for the area alone.
  const Exact pressure = dot(force, area.normal);
  const Exact shear_square = square(force) * area.normal_square - pressure * pressure;
  const Exact slack = rational(force_rounding) * root_of(square(force) * area.normal_square).above;
  const Exact held = point_area * area.normal_length.below;
  const Exact pull = -pressure - strength.tension * held;
  if (pull > slack)
    throw WrongCertificate{fmt::format("{}: the force pulls more than the tensile strength, {}",
                                       place, share(pull, force, area))};
  const Exact most = strength.friction * pressure + strength.cohesion * held + slack;
  if (shear_square > most * most)
    throw WrongCertificate{fmt::format("{}: the force lies outside the friction cone, {}", place,
                                       share(root_of(shear_square).above - most, force, area))};
}

}  // namespace rockfold
