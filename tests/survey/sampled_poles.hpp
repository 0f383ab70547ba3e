// Poles drawn from Fisher's and from the uniform distribution, for tests: one draw of cos θ by inverting its distribution, one of the turn.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include "src/base/vector.hpp"

namespace rockfold {

constexpr Real degree = std::numbers::pi / 180;

/// The upward normal of a plane, angles in degrees.
inline Vec3 normal_of(Real dip, Real dip_direction) {
  return {std::sin(dip * degree) * std::sin(dip_direction * degree),
          std::sin(dip * degree) * std::cos(dip_direction * degree), std::cos(dip * degree)};
}

/// At an angle `theta` (rad) from `mean`, turned about it by `turn` (rad).
inline Vec3 direction_beside(const Vec3& mean, Real theta, Real turn) {
  const Vec3 a = normalized(cross(mean, std::abs(mean[2]) < 0.9 ? Vec3{0, 0, 1} : Vec3{1, 0, 0}));
  const Vec3 b = cross(mean, a);
  return std::cos(theta) * mean + std::sin(theta) * (std::cos(turn) * a + std::sin(turn) * b);
}

class PoleSampler {
 public:
  explicit PoleSampler(std::uint64_t seed) : random_(seed) {}

  Vec3 fisher(const Vec3& mean, Real kappa) {
    const Real cosine = 1 + std::log1p(uniform() * std::expm1(-2 * kappa)) / kappa;
    return direction_beside(mean, std::acos(cosine), 2 * std::numbers::pi * uniform());
  }
  Vec3 any() {
    return direction_beside({0, 0, 1}, std::acos(2 * uniform() - 1),
                            2 * std::numbers::pi * uniform());
  }
  /// Points the other way with even chances, as a pole may.
  Vec3 either_way(const Vec3& pole) { return uniform() < 0.5 ? -pole : pole; }

 private:
  Real uniform() { return std::uniform_real_distribution<Real>(0, 1)(random_); }

  std::mt19937_64 random_;
};

inline Real angle_between_axes(const Vec3& a, const Vec3& b) {
  return std::acos(std::min(std::abs(dot(a, b)), Real{1})) / degree;
}

}  // namespace rockfold
