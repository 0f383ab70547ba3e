#include "src/base/gauss.hpp"

#include <cmath>
#include <numbers>

namespace rockfold {

std::vector<LinePoint> gauss_points(int n) {
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

}  // namespace rockfold
