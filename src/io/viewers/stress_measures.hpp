// What a stress means for the rock: principal stresses, von Mises' stress, and how near it is to the rock's strength.
#pragma once

#include <array>

#include "src/model/model.hpp"

namespace rockfold {

/// Pa, tension positive, descending: σ1 ≥ σ2 ≥ σ3. `stress`: xx yy zz xy yz zx.
Vec3 principal_stresses(const std::array<Real, 6>& stress);

/// Pa: √(3 J2).
Real von_mises(const std::array<Real, 6>& stress);

bool has_strength(const Material& material);

/// No stress is farther than this from failure: above it numbers say nothing.
inline constexpr Real largest_strength_ratio = 1000;

/// Strength over stress, below 1 where the rock would fail; NaN for a material without strength. With compression positive
/// (σ1 ≥ σ3) it is the smaller of
///   in shear    (σ1f − σ3) / (σ1 − σ3), σ1f the largest σ1 that the rock bears at this σ3: Mohr–Coulomb's
///               σ3 N + 2 c √N, N = (1 + sin φ) / (1 − sin φ), or Hoek & Brown's;
///   in tension  tensile strength / −σ3, where σ3 < 0.
/// At most largest_strength_ratio.
Real strength_ratio(const std::array<Real, 6>& stress, const Material& material);

}  // namespace rockfold
