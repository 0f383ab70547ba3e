#include "src/io/viewers/stress_measures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace rockfold {

namespace {

/// The largest principal stress that the rock bears, and its tensile strength; compression positive.
struct Strength {
  Real sigma1 = 0, tensile = 0;
};

struct FindStrength {
  Real sigma3;

  Strength operator()(const MohrCoulombStrength& rock) const {
    const Real sine = std::sin(rock.friction_angle * std::numbers::pi / 180);
    const Real n = (1 + sine) / (1 - sine);
    return {sigma3 * n + 2 * rock.cohesion * std::sqrt(n), rock.tensile_strength};
  }
  Strength operator()(const HoekBrownStrength& rock) const {
    const Real inside = std::max(0.0, rock.m_b * sigma3 / rock.sigma_ci + rock.s);
    return {sigma3 + rock.sigma_ci * std::pow(inside, rock.a), rock.s * rock.sigma_ci / rock.m_b};
  }
  Strength operator()(std::monostate) const {
    return {std::numeric_limits<Real>::quiet_NaN(), std::numeric_limits<Real>::quiet_NaN()};
  }
};

/// A quotient of what the rock bears and what it has to, within [0, largest_strength_ratio].
Real quotient(Real strength, Real stress) {
  if (!(stress * largest_strength_ratio > strength)) return largest_strength_ratio;
  return std::max(0.0, strength / stress);
}

}  // namespace

Vec3 principal_stresses(const std::array<Real, 6>& s) {
  // Roots of the characteristic polynomial of the deviator by its Lode angle (Smith 1961): the matrix divided by its size, so that
  // nothing leaves the range of numbers.
  const Real mean = (s[0] + s[1] + s[2]) / 3;
  const Real a = s[0] - mean, b = s[1] - mean, c = s[2] - mean;
  const Real shear = s[3] * s[3] + s[4] * s[4] + s[5] * s[5];
  const Real p = std::sqrt((a * a + b * b + c * c + 2 * shear) / 6);
  if (!(p > 0)) return {mean, mean, mean};
  const Real det = (a / p) * ((b / p) * (c / p) - (s[4] / p) * (s[4] / p)) -
                   (s[3] / p) * ((s[3] / p) * (c / p) - (s[4] / p) * (s[5] / p)) +
                   (s[5] / p) * ((s[3] / p) * (s[4] / p) - (b / p) * (s[5] / p));
  const Real lode = std::acos(std::clamp(det / 2, -1.0, 1.0)) / 3;
  const Real first = mean + 2 * p * std::cos(lode);
  const Real third = mean + 2 * p * std::cos(lode + 2 * std::numbers::pi / 3);
  return {first, 3 * mean - first - third, third};
}

Real von_mises(const std::array<Real, 6>& s) {
  const Real xy = s[0] - s[1], yz = s[1] - s[2], zx = s[2] - s[0];
  return std::sqrt(0.5 * (xy * xy + yz * yz + zx * zx) +
                   3 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]));
}

bool has_strength(const Material& material) {
  return !std::holds_alternative<std::monostate>(material.strength);
}

Real strength_ratio(const std::array<Real, 6>& stress, const Material& material) {
  if (!has_strength(material)) return std::numeric_limits<Real>::quiet_NaN();
  const Vec3 tension = principal_stresses(stress);
  const Real sigma1 = -tension[2], sigma3 = -tension[0];
  const Strength strength = std::visit(FindStrength{sigma3}, material.strength);
  const Real in_shear = quotient(strength.sigma1 - sigma3, sigma1 - sigma3);
  return sigma3 < 0 ? std::min(in_shear, quotient(strength.tensile, -sigma3)) : in_shear;
}

}  // namespace rockfold
