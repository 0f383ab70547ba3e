#include "host/exact/orientation.hpp"

#include <cmath>
#include <numbers>
#include <utility>

#include "host/exact/correctly_rounded.hpp"

namespace rockfold {

SineCosine sine_cosine_degrees(Real angle) {
  Real a = std::fmod(angle, 360.0);  // exact
  if (a < 0) a += 360.0;
  const int quadrant = static_cast<int>(a / 90.0) % 4;
  a -= 90.0 * static_cast<int>(
                  a / 90.0);  // exact: multiples of 90 are, and a is within a factor 2 or small
  const bool upper = a > 45.0;
  if (upper) a = 90.0 - a;
  Real s, c;
  if (a == 45.0) {
    s = c = std::sqrt(0.5);
  } else if (a == 30.0) {
    s = 0.5, c = std::sqrt(0.75);
  } else {
    const Real radians = a * (std::numbers::pi / 180.0);
    s = correctly_rounded::sin(radians), c = correctly_rounded::cos(radians);
  }
  if (upper) std::swap(s, c);
  switch (quadrant) {
    case 0:
      return {s, c};
    case 1:
      return {c, -s};
    case 2:
      return {-s, -c};
    default:
      return {-c, s};
  }
}

Vec3 upward_normal(const DipOrientation& orientation) {
  const auto [sin_dip, cos_dip] = sine_cosine_degrees(orientation.dip);
  const auto [sin_dd, cos_dd] = sine_cosine_degrees(orientation.dip_direction);
  return {sin_dip * sin_dd, sin_dip * cos_dd, cos_dip};
}

Vec3 normal_of(const Orientation& orientation) {
  if (const auto* dip = std::get_if<DipOrientation>(&orientation)) return upward_normal(*dip);
  return std::get<Vec3>(orientation);
}

}  // namespace rockfold
