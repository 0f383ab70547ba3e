// What the points of a pair inherit from those that it had before: each its own memory by its key; new ones the mean shear of all; and the
// sum of their shear forces stays what it was, whatever corners were born or died and however areas changed. Of an overlap that all but
// vanishes it does not: what little is left would be stretched without bound.
#pragma once

#include "kernels/contact/detection/point_set_kernel.hpp"

namespace rockfold::contact {

/// Times its mean, to which a step's change of area may stretch what is left.
inline constexpr Real most_stretch = 2;

/// The points of one pair.
struct Span {
  const Array<ContactPoint>& point;
  std::size_t begin;
  Index count;
  KOKKOS_INLINE_FUNCTION ContactPoint& operator[](Index i) const { return point(begin + i); }
};

/// k_s · area of a point that carries load.
KOKKOS_INLINE_FUNCTION Real shear_share(const ContactPoint& p, const Array<JointLaw>& laws) {
  return p.memory.state == Contact::open ? 0 : laws(p.law).shear_stiffness * p.area;
}

/// Σ k_s · area · stretch, N, and Σ k_s · area, N/m.
struct ShearSum {
  Vector force;
  Real stiffness = 0;
};

/// `frame(p, n, a)` gives a point's normal and first tangential direction at the time that the sum is taken of.
template <class Frame>
KOKKOS_INLINE_FUNCTION ShearSum sum_shear(const Span& points, const Array<JointLaw>& laws,
                                          const Frame& frame) {
  ShearSum sum;
  for (Index i = 0; i < points.count; ++i) {
    const ContactPoint& p = points[i];
    const Real share = shear_share(p, laws);
    if (share == 0) continue;
    Vector n, a;
    frame(p, n, a);
    sum.force =
        sum.force + (share * p.memory.shear[0]) * a + (share * p.memory.shear[1]) * cross(n, a);
    sum.stiffness += share;
  }
  return sum;
}

/// Adds the stretch s (m, in space) to a point.
KOKKOS_INLINE_FUNCTION void add_stretch(const Vector& s, const Vector& n, const Vector& a,
                                        ContactPoint& p) {
  p.memory.shear[0] += dot(s, a);
  p.memory.shear[1] += dot(s, cross(n, a));
}

/// Whether a point is lifted by dilation with the others of its pair: those of joints, and what faces meet by a law that dilates. A block
/// that slides off its joint rides on the rough faces as it did.
KOKKOS_INLINE_FUNCTION bool rides(const ContactPoint& p, const Array<JointLaw>& laws) {
  return p.joint != none || laws(p.law).dilation > 0;
}

/// What a point born into a pair remembers: it is as whole as all were that the pair had; those that ride have slipped and are opened by
/// dilation as it is in the mean; and the mean closing speed of those that touched is the one that its rebound is measured by, and what they store
/// in the mean what it has stored: an impact goes on where corners change their names in it.
KOKKOS_INLINE_FUNCTION ContactMemory memory_of_newborn(const Span& old,
                                                       const Array<JointLaw>& laws) {
  ContactMemory newborn;
  Real dilation = 0, slip = 0, riding = 0, approach = 0, pressed = 0, touching = 0;
  newborn.met = newborn.loose = newborn.parting = 1;
  for (Index j = 0; j < old.count; ++j) {
    const ContactMemory& memory = old[j].memory;
    newborn.broken = newborn.broken || memory.broken;
    newborn.met = newborn.met && memory.met;
    newborn.loose = newborn.loose && memory.loose;
    if (memory.state != Contact::open) {
      approach += old[j].area * memory.approach;
      pressed += old[j].area * memory.pressed * memory.pressed;
      touching += old[j].area;
      newborn.parting = newborn.parting && memory.parting;
    }
    if (!rides(old[j], laws)) continue;
    dilation += old[j].area * memory.dilation;
    slip += old[j].area * memory.slip;
    riding += old[j].area;
  }
  if (riding > 0) {
    newborn.dilation = dilation / riding;
    newborn.slip = slip / riding;
  }
  if (touching > 0) {
    newborn.approach = approach / touching;
    newborn.pressed = math::sqrt(pressed / touching);
  } else {
    newborn.parting = 0;
  }
  return newborn;
}

/// Copies the memories of points that live on. Returns how many were born.
KOKKOS_INLINE_FUNCTION Index keep_memories(const Span& old, const Span& now,
                                           const Array<JointLaw>& laws) {
  const ContactMemory newborn = memory_of_newborn(old, laws);
  Index born = 0;
  for (Index i = 0; i < now.count; ++i) {
    ContactPoint& p = now[i];
    bool lives = false;
    for (Index j = 0; j < old.count && !lives; ++j) {
      if (old[j].key != p.key) continue;
      lives = true;
      p.memory = old[j].memory;
      p.offset = old[j].offset;
      p.law = old[j].law;
    }
    if (lives) continue;
    ++born;
    if (old.count == 0) continue;
    p.memory = newborn;
    if (p.joint == none) p.memory.broken = p.memory.loose = 1;  // nothing grows where no joint was
    if (!rides(p, laws)) p.memory.dilation = p.memory.slip = 0;
  }
  return born;
}

/// Shear of the points born, then what is missing for the same sum, spread evenly. `old_frame` is of the time of the old points; `frame`
/// of the new ones at the same time.
template <class OldFrame, class Frame>
KOKKOS_INLINE_FUNCTION void hand_over_shear(const Span& old, const Span& now,
                                            const Array<JointLaw>& laws, const OldFrame& old_frame,
                                            const Frame& frame) {
  const ShearSum before = sum_shear(old, laws, old_frame);
  if (!(before.stiffness > 0)) return;
  const Vector mean = (1 / before.stiffness) * before.force;
  for (Index i = 0; i < now.count; ++i) {
    ContactPoint& p = now[i];
    bool lives = false;
    for (Index j = 0; j < old.count && !lives; ++j) lives = old[j].key == p.key;
    if (lives) continue;
    p.memory.pressed =
        math::fmin(p.memory.pressed, math::fmax(0.0, p.memory.dilation - p.gap_before));
    if (!(p.gap_before < p.memory.dilation)) continue;
    Vector n, a;
    frame(p, n, a);
    p.memory.state = Contact::stick;
    add_stretch(mean, n, a, p);
  }
  const ShearSum after = sum_shear(now, laws, frame);
  if (!(after.stiffness > 0)) return;
  const Vector carried = math::fmin(before.stiffness, most_stretch * after.stiffness) * mean;
  const Vector missing = (1 / after.stiffness) * (carried - after.force);
  for (Index i = 0; i < now.count; ++i) {
    if (shear_share(now[i], laws) == 0) continue;
    Vector n, a;
    frame(now[i], n, a);
    add_stretch(missing, n, a, now[i]);
  }
}

}  // namespace rockfold::contact
