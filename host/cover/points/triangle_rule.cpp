#include "host/cover/points/triangle_rule.hpp"

#include "src/base/gauss.hpp"

namespace rockfold {

std::vector<RulePoint> triangle_rule(int degree) {
  if (degree <= 1) return {{{1.0 / 3, 1.0 / 3, 1.0 / 3}, 1}};
  // ∫ f over the triangle / area = ∫∫ f(u, v(1 − u)) 2 (1 − u) du dv.
  std::vector<RulePoint> points;
  for (const auto& [u, along] : gauss_points((degree + 2) / 2, 1))
    for (const auto& [v, across] : gauss_points((degree + 2) / 2))
      points.push_back({{u, v * (1 - u), (1 - v) * (1 - u)}, 2 * along * across});
  return points;
}

}  // namespace rockfold
