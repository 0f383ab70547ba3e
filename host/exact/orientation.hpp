// Orientations in degrees as plane normals, exact where they can be.
#pragma once

#include "src/base/types.hpp"
#include "src/model/model.hpp"

namespace rockfold {

/// Sine and cosine of an angle in degrees. The angle is reduced to one octant first (exactly), so that mirror-image
/// angles have mirror-image values: sin 45° = cos 45°, sin 30° = cos 60°, cos 90° = 0.
struct SineCosine {
  Real sine, cosine;
};
SineCosine sine_cosine_degrees(Real angle);

/// Upward unit normal (to rounding) of a plane: (sin dip · sin dd, sin dip · cos dd, cos dip).
Vec3 upward_normal(const DipOrientation& orientation);

/// The normal of an orientation: upward for dip and dip direction, as given (any length) for a normal.
Vec3 normal_of(const Orientation& orientation);

}  // namespace rockfold
