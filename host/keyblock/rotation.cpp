#include "host/keyblock/rotation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/keyblock/pyramid.hpp"
#include "src/base/vector.hpp"

namespace rockfold {
namespace {

using Patches = std::span<const ContactPatch>;

/// Rounding of coordinates, over their size.
constexpr Real coordinate_rounding = 1e-14;

/// Whether turning about the axis through `point` moves no corner of a contact into the rock.
bool is_admissible(Patches patches, const Vec3& point, const Vec3& axis) {
  for (const ContactPatch& patch : patches)
    for (const Vec3& x : patch.corners) {
      const Vec3 arm = x - point;
      const Real limit = direction_tolerance * norm(arm) + coordinate_rounding * norm(x);
      if (dot(cross(axis, arm), patch.normal) > limit) return false;
    }
  return true;
}

/// m⁻¹ v of a symmetric, positive definite matrix.
Vec3 solution(const Mat3& m, const Vec3& v) {
  const Vec3 a = cross(m[1], m[2]), b = cross(m[2], m[0]), c = cross(m[0], m[1]);
  return (1 / dot(m[0], a)) * (v[0] * a + v[1] * b + v[2] * c);
}

/// About a point at `arm` from it to the centroid (Steiner).
Mat3 inertia_about(const RigidBody& body, const Vec3& arm) {
  Mat3 j = body.inertia;
  for (std::size_t i = 0; i < 3; ++i) {
    j[i][i] += body.mass * dot(arm, arm);
    for (std::size_t k = 0; k < 3; ++k) j[i][k] -= body.mass * arm[i] * arm[k];
  }
  return j;
}

/// The moments about an axis: r as its parts along and across the normal of the plane that the
/// block lifts off, and the loads' own moment.
Rotation with_moments(const ContactPatch& patch, const RigidBody& body, Rotation rotation) {
  const Vec3 arm = body.centroid - rotation.point;
  rotation.velocity = cross(rotation.axis, arm);
  const Vec3 pressing = dot(body.force, patch.normal) * patch.normal;
  for (const Real moment :
       {dot(pressing, rotation.velocity), dot(body.force - pressing, rotation.velocity),
        dot(body.moment, rotation.axis)})
    (moment > 0 ? rotation.driving : rotation.resisting) += std::abs(moment);
  return rotation;
}

/// Below this share of |r| times the arm a moment is rounding.
bool is_driven(const Rotation& rotation, const RigidBody& body) {
  const Real size = norm(body.force) * norm(body.centroid - rotation.point) + norm(body.moment);
  return rotation.driving > 1e-9 * size && norm(rotation.velocity) > 0;
}

Real safety(const Rotation& rotation) {
  return rotation.resisting / rotation.driving;
}

/// (net moment)² over the moment of inertia about the axis: of motions that start together, the one
/// that departs least from the free motion has the most (Gauss' principle of least constraint).
Real vigour(const Rotation& rotation, const RigidBody& body) {
  const Mat3 inertia = inertia_about(body, body.centroid - rotation.point);
  const Real net = rotation.driving - rotation.resisting;
  const Vec3& a = rotation.axis;
  return net * net / dot(a, {dot(inertia[0], a), dot(inertia[1], a), dot(inertia[2], a)});
}

/// The less safe one; of equals (to rounding) the more vigorous, then the first.
void keep_worse(std::optional<Rotation>& worst, const Rotation& rotation, const RigidBody& body) {
  if (!worst) {
    worst = rotation;
    return;
  }
  const Real difference = safety(rotation) - safety(*worst);
  const bool same = std::abs(difference) <= 1e-12;
  if (same ? vigour(rotation, body) > (1 + 1e-12) * vigour(*worst, body) : difference < 0)
    worst = rotation;
}

/// The free rotation about a corner; only where it turns the block at all.
std::optional<Rotation> about_corner(const ContactPatch& patch, const Vec3& corner,
                                     const RigidBody& body) {
  const Vec3 arm = body.centroid - corner;
  const Vec3 moment = cross(arm, body.force) + body.moment;
  const Vec3 acceleration = solution(inertia_about(body, arm), moment);
  if (!(norm(acceleration) > 0)) return {};
  Rotation rotation;
  rotation.about = Rotation::About::corner;
  rotation.point = corner;
  rotation.axis = normalized(acceleration);
  rotation = with_moments(patch, body, rotation);
  if (rotation.driving <= rotation.resisting) return {};
  return rotation;
}

}  // namespace

Rotation about_edge(const ContactPatch& patch, std::size_t k) {
  const Vec3 &from = patch.corners[k], &to = patch.corners[(k + 1) % patch.corners.size()];
  Rotation rotation;
  rotation.point = from;
  rotation.axis = normalized(to - from);
  Vec3 middle{};
  for (const Vec3& x : patch.corners)
    middle += (1.0 / static_cast<Real>(patch.corners.size())) * (x - from);
  if (dot(cross(rotation.axis, middle), patch.normal) > 0) rotation.axis = -rotation.axis;
  return rotation;
}

Real Rotation::factor_of_safety() const {
  return resisting > 0 ? resisting / driving : std::numeric_limits<Real>::quiet_NaN();
}

Real Rotation::sliding_force() const {
  return (driving - resisting) / norm(velocity);
}

std::optional<Rotation> find_rotation(Patches patches, const RigidBody& body) {
  std::optional<Rotation> worst;
  const auto consider = [&](Rotation rotation, const ContactPatch& patch) {
    if (!is_driven(rotation, body)) return;
    if (!is_admissible(patches, rotation.point, rotation.axis)) return;
    rotation.face = patch.face;
    keep_worse(worst, rotation, body);
  };
  for (const ContactPatch& patch : patches) {
    if (dot(body.force, patch.normal) <= direction_tolerance * norm(body.force)) continue;
    for (std::size_t k = 0; k < patch.corners.size(); ++k) {
      consider(with_moments(patch, body, about_edge(patch, k)), patch);
      if (const auto rotation = about_corner(patch, patch.corners[k], body))
        consider(*rotation, patch);
    }
  }
  return worst;
}

}  // namespace rockfold
