#include "host/keyblock/motions/in_situ.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "host/keyblock/motions/pyramid.hpp"
#include "src/base/vector.hpp"

namespace rockfold {
namespace {

/// A clamped joint that the block does not slide on.
struct ClampedJoint {
  const ContactPlane* plane;
  Real opening;     ///< a = −s·n, ≥ 0; exactly 0 where the block shears along the joint
  Real tangential;  ///< t
  Real
      shear;  ///< S₀, N: what it held against the motion before that began; negative: it pushed the block on

  /// m: the way after which it has opened; infinite where it does not open.
  Real opens_at() const {
    return opening > 0 ? plane->clamping / (plane->normal_stiffness * opening)
                       : std::numeric_limits<Real>::infinity();
  }
  /// Whether it has opened before a way d: at the way where it opens it still holds, whatever the last digit says.
  bool is_open(Real d) const {
    constexpr Real rounding = 1e-9;
    return d > (1 + rounding) * opens_at();
  }
  /// N after a way d; infinite d: all that opens has opened.
  Real normal_force(Real d) const {
    if (opening == 0) return plane->clamping;
    if (is_open(d)) return 0;
    return std::max(0.0, plane->clamping - plane->normal_stiffness * opening * d);
  }
  Real shear_force(Real d) const {
    if (is_open(d) || tangential == 0) return 0;
    const Real strength = normal_force(d) * plane->friction + plane->cohesion;
    if (std::isinf(d)) return strength;
    return std::clamp(shear + plane->shear_stiffness * tangential * d, -strength, strength);
  }
  /// Where it yields and where it has opened.
  void add_events(std::vector<Real>& ways) const {
    const Real opening_stiffness = plane->normal_stiffness * opening;
    const Real strength = plane->clamping * plane->friction + plane->cohesion;
    const Real stiffness = plane->shear_stiffness * tangential;
    const Real softening = opening_stiffness * plane->friction;
    ways.push_back(std::max(0.0, (strength - shear) / (stiffness + softening)));
    const Real pushing =
        (strength + shear) / (softening - stiffness);  // it begins or ceases to slide the other way
    if (std::isfinite(pushing) && pushing > 0) ways.push_back(pushing);
    if (opening > 0) ways.push_back(opens_at());
  }
};

std::vector<ClampedJoint> clamped_joints(std::span<const ContactPlane> planes,
                                         const Movement& movement) {
  std::vector<ClampedJoint> clamped;
  for (std::size_t p = 0; p < planes.size(); ++p) {
    const bool slides = std::find(movement.planes.begin(), movement.planes.end(),
                                  static_cast<Index>(p)) != movement.planes.end();
    if (slides || planes[p].clamping <= 0 || planes[p].normal_stiffness <= 0 ||
        planes[p].shear_stiffness <= 0)
      continue;
    Real opening = -dot(movement.direction, planes[p].normal);
    if (opening <= direction_tolerance) opening = 0;
    const Real tangential = std::sqrt(std::max(0.0, 1 - opening * opening));
    // In the plane the block moves along s + a n; `in_situ_shear` lies in it, so that its part along n is none.
    const Real shear =
        tangential > 0 ? -dot(planes[p].in_situ_shear, movement.direction) / tangential : 0;
    clamped.push_back({&planes[p], opening, tangential, shear});
  }
  return clamped;
}

/// The movement after a way d.
Movement after(std::span<const ContactPlane> planes, const Movement& movement, const Vec3& r,
               std::span<const ClampedJoint> clamped, Real d) {
  Movement m = movement;
  Vec3 pushed = r;
  Real resisting = 0;
  for (const ClampedJoint& joint : clamped) {
    pushed -= joint.normal_force(d) * joint.plane->normal;
    resisting += joint.shear_force(d) * joint.tangential;
  }
  // What the clamping pushes along s is no load of the block's own: it counts against the resistance.
  resisting -= dot(pushed - r, movement.direction);
  const auto plane = [&](std::size_t k) -> const ContactPlane& {
    return planes[static_cast<std::size_t>(movement.planes[k])];
  };
  if (movement.mode == SlidingMode::single_plane) {
    m.normal_force[0] = std::max(0.0, dot(pushed, plane(0).normal));
  } else if (movement.mode == SlidingMode::two_planes) {
    m.normal_force = {
        std::max(0.0, dot(pushed, reciprocal_normal(plane(0).normal, plane(1).normal))),
        std::max(0.0, dot(pushed, reciprocal_normal(plane(1).normal, plane(0).normal)))};
  }
  for (std::size_t k = 0; k < 2; ++k)
    if (movement.planes[k] != none)
      resisting += m.normal_force[k] * plane(k).friction + plane(k).cohesion;
  m.resisting = resisting;
  return m;
}

}  // namespace

Movement with_in_situ_stress(std::span<const ContactPlane> planes, const Movement& movement,
                             const Vec3& r) {
  const auto clamped = clamped_joints(planes, movement);
  if (clamped.empty()) return movement;
  // Between events the sliding force is linear in d (where a plane that is slid on opens, concave), so that its least
  // value is at an event or at the end. It rises by a step where a joint with cohesion opens: what counts is the
  // limit from before (ClampedJoint::is_open).
  std::vector<Real> ways{0, std::numeric_limits<Real>::infinity()};
  for (const ClampedJoint& joint : clamped) joint.add_events(ways);
  Movement best = after(planes, movement, r, clamped, ways[1]);
  for (const Real d : ways) {
    const Movement m = after(planes, movement, r, clamped, d);
    if (m.sliding_force() < best.sliding_force()) best = m;
  }
  return best;
}

}  // namespace rockfold
