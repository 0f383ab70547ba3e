// Faces that turn in their plane while they slide. What their friction brakes that by is μ ∫ p r dA, which neither the points of a joint
// (0.6 to 0.75 of it) nor corners alone (1.5 to 1.85 times it) give: their moments are right up to the second. Where faces turn, there is a point half-way
// between the centre and each corner too, and the shares of both are such that a uniform pressure has its true torque about the centre.
// It takes twice the points, so that faces have them only while they turn.
#pragma once

#include "kernels/contact/detection/handover_kernel.hpp"

namespace rockfold::contact {

/// Turning over all other motion of the faces, as speeds in the mean square over the area: from the first on faces turn, below the other they no
/// longer do. The torque depends on the second moment alone in the limit of none, and to 1 % up to there.
inline constexpr Real turns_from = 0.1, turns_until = 0.05;

/// Of the points' radius of gyration: nearer to the centre than that, points may stick while faces turn.
inline constexpr Real outer_radius = 0.5;

/// Where the first side of a point is.
KOKKOS_INLINE_FUNCTION Vector place_of(const ContactPoint& p, const Field& x) {
  Vector sum;
  for (int k = 0; k < 3; ++k) sum = sum + p.weight[k] * at(x, p.vertex[k]);
  return sum;
}

/// Whether the faces of a pair turn: all its points are closed, those farther out slide, and with what speed they do. `did`: whether they
/// did before. Faces that part or rock carry at their corners again, as an impact on them has to.
KOKKOS_INLINE_FUNCTION bool turns_in_plane(const Span& points, const Field& x, const Field& v,
                                           bool did) {
  Real area = 0;
  Vector centre;
  for (Index i = 0; i < points.count; ++i) {
    const ContactPoint& p = points[i];
    if (p.memory.state == Contact::open) return false;
    area += p.area;
    centre = centre + p.area * place_of(p, x);
  }
  if (!(area > 0)) return false;
  centre = (1 / area) * centre;
  const Vector n = to_vector(points[0].normal);
  Real second = 0, momentum = 0, motion = 0;
  for (Index i = 0; i < points.count; ++i) {
    const Vector r = place_of(points[i], x) - centre;
    second += points[i].area * dot(r, r);
    const Vector speed = between(points[i], v);
    momentum += points[i].area * dot(n, cross(r, speed));
    motion += points[i].area * dot(speed, speed);
  }
  for (Index i = 0; i < points.count; ++i) {
    const Vector r = place_of(points[i], x) - centre;
    if (points[i].memory.state != Contact::slide &&
        dot(r, r) * area > outer_radius * outer_radius * second)
      return did;
  }
  const Real turning = momentum * momentum / second, least = did ? turns_until : turns_from;
  return turning > least * least * (motion - turning);
}

}  // namespace rockfold::contact
