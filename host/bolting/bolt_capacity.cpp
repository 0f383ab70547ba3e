#include "host/bolting/bolt_capacity.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "src/base/vector.hpp"

namespace rockfold {

Real axial_capacity(const BoltType& type, const Embedment& embedment) {
  if (!(embedment.anchored > 0)) return 0;
  const Real plate = embedment.plate ? type.plate_capacity : 0;
  const Real bond = type.bond_strength.value_or(std::numeric_limits<Real>::infinity());
  if (type.coupling == Coupling::dmfc) {
    if (!(embedment.anchor > 0)) return 0;
    return std::min({type.force_capacity, plate, bond * embedment.anchor});
  }
  const Real in_block = embedment.within > 0 ? plate + bond * embedment.within : plate;
  return std::min({type.force_capacity, in_block, bond * embedment.anchored});
}

BoltForce bolt_force(const BoltType& type, const Vec3& axis, Real axial, const Vec3& motion) {
  constexpr Real rounding = 1e-12;
  const Real along = -dot(axis, motion);  // cos θ
  const Vec3 across = motion + along * axis;
  const Real sine = norm(across);
  BoltForce result;
  result.angle = std::atan2(sine, along);
  const bool pulled = along > rounding, sheared = sine > rounding;
  const Real tension = type.efficiency == BoltEfficiency::cosine ? axial * along : axial;
  // No bond, no plate: nothing that would hold the bolt against being sheared out either.
  const Real shear = axial > 0 ? type.shear_capacity : 0;
  if (pulled && sheared && shear > 0) {
    const Real work = std::hypot(tension * along, shear * sine);
    result.axial = tension * tension * along / work;
    result.shear = shear * shear * sine / work;
  } else {
    result.axial = pulled ? tension : 0;
    result.shear = sheared ? shear : 0;
  }
  result.force = result.axial * axis;
  if (result.shear > 0) result.force -= (result.shear / sine) * across;
  return result;
}

Index bolts_needed(Real force, Real capacity) {
  constexpr Real rounding = 1e-9;
  const Real count = std::ceil(force / capacity - rounding);
  return static_cast<Index>(std::min(count, Real{std::numeric_limits<Index>::max()}));
}

Real square_spacing(Real capacity, Real pressure) {
  return std::sqrt(capacity / pressure);
}

BoltCategory bolt_category(const BoltType& type, Real length) {
  constexpr Real longest_rock_bolt = 3, shortest_anchor = 10, longest_cable = 15;  // m
  const auto over = [&](Real limit) { return length > (1 + 1e-9) * limit; };  // beyond rounding
  if (!over(longest_rock_bolt)) return BoltCategory::rock_bolt;
  if (over(longest_cable)) return BoltCategory::ground_anchor;
  const bool anchor = over(shortest_anchor) && type.coupling == Coupling::dmfc;
  return anchor ? BoltCategory::ground_anchor : BoltCategory::cable_bolt;
}

}  // namespace rockfold
