// The force that brings a moving block to a target factor of safety. docs/block_theory.md,
// "Support".
#pragma once

#include <span>

#include "host/keyblock/sliding.hpp"

namespace rockfold {

/// A force on the block.
struct SupportForce {
  Real force = 0;    ///< N, ≥ 0
  Vec3 direction{};  ///< unit
};

/// The least force, over all directions, with which the movement has the target factor of safety F
/// > 0:
///   sliding: F (T + P·s) = Σ ((N + ΔN) tan φ + c A), the support as part of the resultant
///   ("active"); lifting: P = −F r, which the support must carry alone.
SupportForce least_support(std::span<const ContactPlane> planes, const Movement& movement,
                           Real target_factor_of_safety);

/// The same along a given unit direction; +inf where no force along it suffices.
Real support_force_along(std::span<const ContactPlane> planes, const Movement& movement,
                         const Vec3& direction, Real target_factor_of_safety);

}  // namespace rockfold
