// Contact in explicit substeps: points go on in place, and what a substep ends with is what the next starts from.
#include <utility>

#include "kernels/contact/point_kernel.hpp"
#include "kernels/device/sums_kernel.hpp"

namespace rockfold::contact {
namespace {

/// Its traction, bonds that do not bear it broken at once: within a substep nothing goes far.
KOKKOS_INLINE_FUNCTION PointTraction advance_memory(ContactPoint& p, const LocalMotion& l,
                                                    const JointLaw& law, const ImpactRule& rule) {
  PointTraction t = traction(law, rule, p.memory, l.motion);
  if (overloads_bonds(law, p.memory, t)) {
    p.memory.broken = 1;
    t = traction(law, rule, p.memory, l.motion);
  }
  p.memory = t.memory;
  return t;
}

/// An open point that stays open: it only keeps account of how fast it closes. False: it may touch, or hold.
KOKKOS_INLINE_FUNCTION bool stays_open(ContactPoint& p, const LocalMotion& l, const JointLaw& law,
                                       const ImpactRule& rule) {
  ContactMemory& memory = p.memory;
  if (memory.state != Contact::open || !memory.met || law.dilation > 0 ||
      !(l.motion.gap > memory.dilation))
    return false;
  watch_approach(rule, l.motion, true, memory);
  return true;
}

/// Of its force, what an impact explains.
KOKKOS_INLINE_FUNCTION Real impact_share(const ContactPoint& p, const LocalMotion& l,
                                         const ImpactRule& rule) {
  const ContactMemory& memory = p.memory;
  if (memory.state == Contact::open || !memory.met) return 0;
  return rigid_share(rule.period, memory.approach, l.motion.gap - memory.dilation);
}

/// m: how far the first side has gone from the second in the substep.
KOKKOS_INLINE_FUNCTION Vector way_of(const LocalMotion& l) {
  return (l.motion.gap - l.motion.gap_before) * l.n + l.motion.shear[0] * l.a +
         l.motion.shear[1] * l.b;
}

}  // namespace

void advance(DeviceContacts& c, const Motion& m, const PointClocks& clocks, const Field& force,
             const Array<Real>& impact, const Array<Real>& account) {
  device::grow(c.partial, "contact::partial",
               2 * static_cast<std::size_t>(device::chunk_count(clocks.count)));
  const auto point = c.current.point;
  const auto laws = c.laws;
  const auto met = c.met;
  const Real restitution = clocks.restitution;
  const bool shares = impact.extent(0) > 0;
  device::sum_then<2>(
      "rockfold::contact::advance", clocks.count, c.partial,
      KOKKOS_LAMBDA(const Index k, device::Sums<2>& sum) {
        const Index i = clocks.order(k);
        ContactPoint& p = point(i);
        const LocalMotion l = local_motion(p, m);
        const JointLaw& law = laws(p.law);
        const Real dt = clocks.period / (Index{1} << clocks.level(i));
        PointTraction t;
        const ImpactRule rule = explicit_rule(restitution, p.period, dt);
        if (!stays_open(p, l, law, rule)) {
          t = advance_memory(p, l, law, rule);
          note_surfaces(p, met);
        }
        if (shares) impact(i) = impact_share(p, l, rule);
        const Vector f = force_of(t, l, p.area), before = at(force, i);
        for (int d = 0; d < 3; ++d) force(i, d) = component(f, d);
        p.gap_before = l.motion.gap;
        p.speed_before = l.motion.speed;
        for (int d = 0; d < 2; ++d) p.shear_before[d] += l.motion.shear[d];
        sum.value[0] += p.area * t.friction;
        sum.value[1] += 0.5 * dot(before + f, way_of(l));
      },
      KOKKOS_LAMBDA(const device::Sums<2>& sum) {
        for (int k = 0; k < 2; ++k) account(k) += sum.value[k];
      });
}

Real settle_in_place(DeviceContacts& c, const Field& x, const Field& v) {
  set_pose(c.surfaces, x, c.before);
  Kokkos::deep_copy(c.speed_before, v);
  std::swap(c.accepted, c.current);
  c.detected = false;
  return stored_energy(c);
}

void write_stiffest(const DeviceContacts& c, Real factor, const solve::Blocks& tangent) {
  const auto point = c.current.point;
  const auto laws = c.laws;
  device::for_each(
      "rockfold::contact::stiffest", c.current.count, KOKKOS_LAMBDA(const Index i) {
        const ContactPoint& p = point(i);
        const JointLaw& law = laws(p.law);
        const Real kn = factor * p.area * law.normal_stiffness,
                   ks = factor * p.area * law.shear_stiffness;
        for (int d = 0; d < 3; ++d)
          for (int e = d; e < 3; ++e)
            tangent(i, solve::symmetric_entry(d, e)) =
                (kn - ks) * p.normal[d] * p.normal[e] + (d == e ? ks : 0);
      });
}

}  // namespace rockfold::contact
