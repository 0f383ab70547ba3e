// One block in one motion with the forces of its support: factor of safety, what is missing, how far the support is
// mobilised.
// docs/support_design.md, "A block with its support".
#pragma once

#include <span>
#include <vector>

#include "host/keyblock/motions/sliding.hpp"
#include "src/base/types.hpp"

namespace rockfold {

/// What one bolt, or the shotcrete, can put on the block.
struct SupportElement {
  Vec3 force{};  ///< N, on the block, at its capacity
  /// Its force is part of the resultant that the motion was found for: here it only moves with the block. Else it adds to the
  /// resistance as the block moves.
  bool active = false;
  Real stiffness = 0;  ///< N/m; 0 = loaded in step with the one that reaches its capacity last
  Vec3 point{};        ///< m, where the force acts; for rotations
};

/// A block that turns about an axis.
struct Turning {
  Vec3 point{};        ///< m, on the axis
  Vec3 axis{};         ///< unit; the block turns counter-clockwise seen against it
  Real driving = 0;    ///< N m, > 0
  Real resisting = 0;  ///< N m
  Real arm = 1;        ///< m, of the point whose displacement is told

  /// m at one radian: how a point of the block moves.
  Vec3 motion(const Vec3& at) const;
};

struct HeldBlock {
  /// With all elements at their capacity. NaN where nothing resists; infinite where nothing drives.
  Real factor_of_safety = 0;
  bool adequate = false;  ///< it reaches the target
  Real missing_force =
      0;  ///< N, the least further force for the target, in the direction that is best without support
  bool in_balance = false;  ///< the elements hold the block (F ≥ 1)
  /// m: how far the block moves until they do; infinite if they never do.
  Real displacement = 0;
  std::vector<Real>
      mobilised;  ///< [elements] service load over capacity, 0 … 1; 1 where they do not hold it
  std::vector<Real> moved;  ///< m, [elements] how far the block moves at each
};

/// In a movement that active elements take part in, with the forces P of the passive ones:
///   F = (Σ (N_k + P·b_k) tan φ_k + Σ c A − P·s) / T,
/// a plane that the support lifts open (N_k + P·b_k < 0) resisting by its cohesion alone; where the block falls there are no
/// planes. Active elements are at their capacity from the start. Each passive one carries stiffness × displacement up to its
/// capacity; the displacement is that at which F = 1.
HeldBlock hold(std::span<const ContactPlane> planes, const Movement& movement,
               std::span<const SupportElement> elements, Real target_factor_of_safety);

/// A block that nothing drives.
HeldBlock at_rest(std::span<const SupportElement> elements);

/// The same for a block that turns, with the moments of the passive forces about its axis:
///   F = (M_resisting − Σ m) / M_driving,  m = axis · ((x − point) × P).
/// `missing_force` acts at the arm; displacements are those at the arm, and each element's follows its own.
HeldBlock hold(const Turning& turning, std::span<const SupportElement> elements,
               Real target_factor_of_safety);

}  // namespace rockfold
