// Points and weights that integrate polynomials over a triangle exactly.
#pragma once

#include <array>
#include <vector>

#include "src/base/types.hpp"

namespace rockfold {

struct RulePoint {
  std::array<Real, 3> at{};  ///< barycentric
  Real weight = 0;           ///< share of the area; they sum to 1
};

/// A rule that is exact for polynomials up to `degree` ≥ 0, with all points inside: the centroid for 1, else Gauss's points on the
/// square, collapsed to the triangle (Stroud 1971, 2.4).
std::vector<RulePoint> triangle_rule(int degree);

}  // namespace rockfold
