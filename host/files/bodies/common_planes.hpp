// Corners and planes such that each corner lies on all of its planes.
#pragma once

#include <utility>
#include <vector>

#include "host/files/bodies/plane_fit.hpp"
#include "src/base/types.hpp"

namespace rockfold {

struct CommonPlanes {
  std::vector<Vec3> corner;        ///< [corners] m
  std::vector<FittedPlane> plane;  ///< [planes]
  Real off = 0;                    ///< m: how far a corner lies off one of its planes, at most
};

/// Moves corners, and planes fitted to them, about as little as brings each corner on its planes, `on` = (corner, plane): Newton's method with
/// the least change of all (sum of squares, m²) that solves each linear step. Planes on fewer than 3 corners are not asked for.
CommonPlanes common_planes(std::vector<Vec3> corner, Index plane_count,
                           const std::vector<std::pair<Index, Index>>& on);

}  // namespace rockfold
