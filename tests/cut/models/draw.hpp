// Random numbers for models drawn from a seed: the same on every machine and with every standard library.
#pragma once

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <random>
#include <vector>

#include "src/base/vector.hpp"

namespace rockfold::test {

class Draw {
 public:
  explicit Draw(unsigned seed) : random_(seed) {}

  Real uniform(Real low, Real high) {
    return low + (high - low) * (static_cast<Real>(random_() >> 11) * 0x1p-53);
  }
  int integer(int low, int high) {
    return low + static_cast<int>(random_() % static_cast<std::uint64_t>(high - low + 1));
  }
  bool chance(Real share) { return uniform(0, 1) < share; }
  Real sign() { return chance(0.5) ? 1 : -1; }
  /// 10^x with x uniform in [low, high]
  Real power(Real low, Real high) { return std::pow(10.0, uniform(low, high)); }
  Vec3 within(Real low, Real high) {
    return {uniform(low, high), uniform(low, high), uniform(low, high)};
  }
  /// A unit vector, uniform on the sphere.
  Vec3 direction() {
    for (;;) {
      const Vec3 v = within(-1, 1);
      if (const Real length = norm(v); length > 0.1 && length < 1) return (1 / length) * v;
    }
  }
  Vec3 normal_to(const Vec3& axis) { return normalized(cross(axis, away_from(axis))); }
  template <class T>
  T pick(std::initializer_list<T> list) {
    return list.begin()[integer(0, static_cast<int>(list.size()) - 1)];
  }
  template <class T>
  void shuffle(std::vector<T>& list) {
    for (std::size_t i = list.size(); i > 1; --i) std::swap(list[i - 1], list[random_() % i]);
  }

 private:
  Vec3 away_from(const Vec3& axis) {
    for (;;) {
      const Vec3 v = direction();
      if (norm(cross(v, axis)) > 0.2 * norm(axis)) return v;
    }
  }
  std::mt19937_64 random_;
};

inline Real to_decimals(Real x, int decimals) {
  const Real scale = std::pow(10.0, decimals);
  return std::round(x * scale) / scale;
}

/// To a multiple of 0.001, 0.01, 0.1 or 1 (as 3, 2, 1, 0 decimals).
inline Vec3 to_decimals(const Vec3& x, int decimals) {
  return {to_decimals(x[0], decimals), to_decimals(x[1], decimals), to_decimals(x[2], decimals)};
}

}  // namespace rockfold::test
