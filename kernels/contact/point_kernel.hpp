// One contact point in a step: how its sides have moved in its frame, and what follows.
#pragma once

#include "kernels/contact/contact_kernel.hpp"
#include "kernels/contact/law_kernel.hpp"

namespace rockfold::contact {

/// A point's frame and how its sides have moved in it.
struct LocalMotion {
  Vector n, a, b;
  PointMotionInStep motion;
};

KOKKOS_INLINE_FUNCTION LocalMotion local_motion(const ContactPoint& p, const Motion& m) {
  LocalMotion l;
  l.n = to_vector(p.normal);
  l.a = to_vector(p.along);
  l.b = cross(l.n, l.a);
  const Vector d = between(p, m.x);
  l.motion.gap = dot(l.n, d) + p.offset;
  l.motion.gap_before = p.gap_before;
  l.motion.shear[0] = dot(l.a, d) - p.shear_before[0];
  l.motion.shear[1] = dot(l.b, d) - p.shear_before[1];
  l.motion.speed_by_gap = m.speed_by_gap;
  if (m.speed_by_gap > 0) {
    l.motion.speed = dot(l.n, between(p, m.v));
    l.motion.speed_before = p.speed_before;
  }
  return l;
}

KOKKOS_INLINE_FUNCTION PointTraction traction_at(const ContactPoint& p, const LocalMotion& l,
                                                 const Array<JointLaw>& laws, Real restitution,
                                                 Real dt, bool held = false) {
  return traction(laws(p.law), impact_rule(restitution, p.period, dt), p.memory, l.motion, held);
}

/// N, on the first side.
KOKKOS_INLINE_FUNCTION Vector force_of(const PointTraction& t, const LocalMotion& l, Real area) {
  return area * (t.traction[0] * l.n + t.traction[1] * l.a + t.traction[2] * l.b);
}

KOKKOS_INLINE_FUNCTION Real component(const Vector& v, int d) {
  return d == 0 ? v.x : d == 1 ? v.y : v.z;
}

/// area · E D Eᵀ, E = (n, a, b) as columns.
KOKKOS_INLINE_FUNCTION void store_tangent(const PointTraction& t, const LocalMotion& l, Real area,
                                          const Tangents& tangent, Index c) {
  const Vector e[3] = {l.n, l.a, l.b};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      Real sum = 0;
      for (int k = 0; k < 3; ++k)
        for (int m = 0; m < 3; ++m)
          sum += component(e[k], i) * t.tangent[3 * k + m] * component(e[m], j);
      tangent(c, 3 * i + j) = area * sum;
    }
}

/// J/m² that is stored in the state that a point remembers.
KOKKOS_INLINE_FUNCTION Real elastic_energy(const ContactPoint& p, const JointLaw& law) {
  const ContactMemory& m = p.memory;
  if (m.state == Contact::open) return 0;
  return 0.5 * law.normal_stiffness * m.pressed * m.pressed +
         0.5 * law.shear_stiffness * (m.shear[0] * m.shear[0] + m.shear[1] * m.shear[1]);
}

/// Notes the surfaces of a point that touches.
KOKKOS_INLINE_FUNCTION void note_surfaces(const ContactPoint& p, const Array<std::uint8_t>& met) {
  if (p.joint == none && p.memory.state != Contact::open && met(p.surfaces) == 0)
    met(p.surfaces) = 1;
}

}  // namespace rockfold::contact
