#include "host/cover/triangle_rule.hpp"

#include <cmath>
#include <numbers>

namespace rockfold {

namespace {

struct LinePoint {
  Real x, weight;  // on [0, 1]
};

/// Gauss & Legendre's n points, exact to degree 2n − 1: roots of the Legendre polynomial by Newton's method.
std::vector<LinePoint> gauss(int n) {
  std::vector<LinePoint> points;
  for (int i = 0; i < n; ++i) {
    Real x = std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5)), slope = 1;
    for (int round = 0; round < 50; ++round) {
      Real before = 1, value = x;
      for (int k = 2; k <= n; ++k) {
        const Real next = ((2 * k - 1) * x * value - (k - 1) * before) / k;
        before = value;
        value = next;
      }
      slope = n * (x * value - before) / (x * x - 1);
      const Real step = value / slope;
      x -= step;
      if (std::abs(step) < 1e-16) break;
    }
    points.push_back({0.5 * (1 - x), 1 / ((1 - x * x) * slope * slope)});
  }
  return points;
}

}  // namespace

std::vector<RulePoint> triangle_rule(int degree) {
  if (degree <= 1) return {{{1.0 / 3, 1.0 / 3, 1.0 / 3}, 1}};
  // ∫ f over the triangle / area = ∫∫ f(u, v(1 − u)) 2 (1 − u) du dv: one degree more along u.
  std::vector<RulePoint> points;
  for (const auto& [u, along] : gauss((degree + 3) / 2))
    for (const auto& [v, across] : gauss((degree + 2) / 2))
      points.push_back({{u, v * (1 - u), (1 - v) * (1 - u)}, 2 * (1 - u) * along * across});
  return points;
}

}  // namespace rockfold
