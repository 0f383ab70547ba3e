#include "host/bolting/bolt_capacity.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/keyblock/motions/pyramid.hpp"
#include "src/base/vector.hpp"

namespace rockfold {
namespace {

/// θ between the bolt and −s, without loss of digits near 0° and 180°; NaN where nothing moves.
Real angle_against(const Vec3& axis, const Vec3& motion) {
  if (motion == Vec3{}) return std::numeric_limits<Real>::quiet_NaN();
  return std::atan2(norm(cross(axis, motion)), -dot(axis, motion));
}

}  // namespace

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
  const Vec3 across = motion - dot(axis, motion) * axis;
  const Real cosine = -dot(axis, motion), sine = norm(across);
  const Real along = std::max(cosine, Real{0});
  BoltForce result;
  result.angle = angle_against(axis, motion);
  const bool pulled = cosine >= -direction_tolerance, sheared = sine > rounding;
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

BoltForce anchor_force(const Vec3& axis, Real axial, const Vec3& motion) {
  return {axial * axis, axial, 0, angle_against(axis, motion)};
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
