// What a stress does on a plane.
#pragma once

#include "src/arrays/load_arrays.hpp"

namespace rockfold {

/// σ n at x, Pa.
inline Vec3 traction_on(const InitialStress& stress, const Vec3& x, const Vec3& n) {
  std::array<Real, 6> s{};
  for (std::size_t k = 0; k < 6; ++k)
    s[k] = stress.at[k] + (stress.reference_z - x[2]) * stress.gradient[k];
  return {s[0] * n[0] + s[3] * n[1] + s[5] * n[2], s[3] * n[0] + s[1] * n[1] + s[4] * n[2],
          s[5] * n[0] + s[4] * n[1] + s[2] * n[2]};
}

}  // namespace rockfold
