// The force that brings a moving block to a target factor of safety. docs/block_theory.md,
// "Support".
#pragma once

#include <span>
#include <vector>

#include "host/keyblock/motions/rotation.hpp"
#include "host/keyblock/motions/sliding.hpp"

namespace rockfold {

/// A force on the block.
struct SupportForce {
  Real force = 0;    ///< N, ≥ 0
  Vec3 direction{};  ///< unit
};

/// What a motion asks of the support P, N: gain·P ≥ deficit.
struct SupportCondition {
  Vec3 gain{};       ///< 1 for a motion of the whole block, m for a rotation
  Real deficit = 0;  ///< N, or N m; ≤ 0 where no support is needed
};

/// Of a translation with the target factor of safety F > 0. The first one brings it to F:
///   sliding: F (T + P·s) = Σ ((N + ΔN) tan φ + c A), the support as part of the resultant
///   ("active"); lifting: −P·s = F T, which the support must carry alone;
/// the others keep the planes slid on in contact, N + ΔN ≥ 0.
std::vector<SupportCondition> support_conditions(std::span<const ContactPlane> planes,
                                                 const Movement& movement,
                                                 Real target_factor_of_safety);

/// Of a rotation, for a support that acts at a point: F (M_d + axis·((at − point) × P)) = M_r.
SupportCondition support_condition(const Rotation& rotation, const Vec3& at,
                                   Real target_factor_of_safety);

/// The least force, over all directions, that meets all conditions (one or more); +inf where none does. Without any need of support the
/// direction is that of the first condition.
SupportForce least_support(std::span<const SupportCondition> conditions);

/// The least force along a unit direction that meets all conditions; +inf where none does.
Real support_force_along(std::span<const SupportCondition> conditions, const Vec3& direction);

/// Of a translation alone.
SupportForce least_support(std::span<const ContactPlane> planes, const Movement& movement,
                           Real target_factor_of_safety);
Real support_force_along(std::span<const ContactPlane> planes, const Movement& movement,
                         const Vec3& direction, Real target_factor_of_safety);

}  // namespace rockfold
