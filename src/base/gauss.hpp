// Gauss' quadrature on the unit interval.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "src/base/types.hpp"

namespace rockfold {

struct GaussPoint {
  Real x, weight;
};

/// ∫_0^1 f(x) (1 − x)^power dx ≈ Σ weight f(x), exact to degree 2n − 1: Gauss & Jacobi's points, for power 0 those of Gauss &
/// Legendre. Roots of the Jacobi polynomial P_n^(power,0) by Newton's method (Abramowitz & Stegun 22.7, 22.8, 25.4.33).
/// Example: n = 1, power = 0 is the midpoint with weight 1.
inline std::vector<GaussPoint> gauss_points(int n, int power = 0) {
  std::vector<GaussPoint> points;
  const Real a = power;
  for (int i = 0; i < n; ++i) {
    Real x = std::cos(std::numbers::pi * (i + 0.75 + a / 2) / (n + 0.5 + a / 2)), slope = 1;
    for (int round = 0; round < 50; ++round) {
      Real before = 1, value = ((2 + a) * x + a) / 2;
      for (int k = 2; k <= n; ++k) {
        const Real m = 2 * k + a;
        const Real next =
            ((m - 1) * (m * (m - 2) * x + a * a) * value - 2 * (k + a - 1) * (k - 1) * m * before) /
            (2 * k * (k + a) * (m - 2));
        before = value;
        value = next;
      }
      const Real m = 2 * n + a;
      slope = (n * (a - m * x) * value + 2 * n * (n + a) * before) / (m * (1 - x * x));
      const Real step = value / slope;
      x -= step;
      if (std::abs(step) < 1e-16) break;
    }
    points.push_back({0.5 * (1 + x), 1 / ((1 - x * x) * slope * slope)});
  }
  return points;
}

}  // namespace rockfold
