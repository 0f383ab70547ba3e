// How far supports are off their places.
#pragma once

#include <vector>

#include "src/arrays/cover_arrays.hpp"
#include "src/model/model.hpp"

namespace rockfold {

/// Where a fixed point has come to lie.
struct OffPlace {
  Real distance = 0;       ///< m, from its place
  Real prescribed = 0;     ///< m, the largest displacement that any condition prescribes
  Index condition = none;  ///< into Model::fixed
  Index other = none;      ///< one that holds the same covers, if there is any
};

/// The point farthest off its place at time t (s), of those not on springs of given stiffness. `displacement`: [unknowns] m.
OffPlace find_farthest_off_place(const FixedPoints& fixed, const std::vector<Fixed>& conditions,
                                 const std::vector<Vec3>& displacement, Real t);

}  // namespace rockfold
