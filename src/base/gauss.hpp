// Gauss & Legendre's points: what rules for triangles and tetrahedra are made of.
#pragma once

#include <vector>

#include "src/base/types.hpp"

namespace rockfold {

struct LinePoint {
  Real x, weight;  ///< on [0, 1]; the weights sum to 1
};

/// n points, exact for polynomials up to degree 2n − 1: roots of the Legendre polynomial by Newton's method.
std::vector<LinePoint> gauss_points(int n);

}  // namespace rockfold
