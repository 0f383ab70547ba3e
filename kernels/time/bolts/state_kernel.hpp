// What becomes of a bolt by a step.
#pragma once

#include "kernels/time/bolts/link_kernel.hpp"

namespace rockfold::bolts {

/// What has become of a bolt's links at the end of a step.
KOKKOS_INLINE_FUNCTION void accept_link(const DeviceBolts& all, const Chain& chain, Index l) {
  const Index link = chain.link + l, begin = all.steel_begin(link), end = all.steel_begin(link + 1);
  const LinkMotion m = motion_of(all, chain, l);
  const bool crossing = all.crossing(link) != 0;
  for (Index p = begin; p < end; ++p) {
    const Index near = p + chain.bolt;
    const Real total =
        m.stretch / static_cast<Real>(end - begin) + all.next.slip(near + 1) - all.next.slip(near);
    const Steel steel = steel_of(all, chain, link, p);
    const SteelForce f = steel_force(steel, total - all.now.plastic(p), m.shear);
    all.next.plastic(p) = all.now.plastic(p);
    all.next.used(p) = all.now.used(p) + f.used;
    all.next.broken(p) = all.now.broken(p);
    const Real k = f.axial < 0 ? steel.pushed * steel.along : steel.along;
    if (f.used > 0 && k > 0) all.next.plastic(p) = total - f.axial / k;
    all.next.cut(link) = all.now.cut(link);
    if (!crossing) continue;
    const Vector was = contact::at(all.now.axis, link);
    Vector sheared = turn_along(contact::at(all.now.sheared, link), was, m.along);
    if (m.shear > 0) {
      const bool doweled = steel.across > 0 && steel.shear > 0;
      const Real elastic = doweled ? f.shear / steel.across : 0;
      sheared = sheared + ((m.shear - elastic) / m.shear) * m.across;
      if (!doweled) all.next.cut(link) += m.shear;
    }
    put(all.next.sheared, link, sheared);
    put(all.next.axis, link, m.along);
  }
}

/// The state of one bolt.
KOKKOS_INLINE_FUNCTION void copy_chain(const BoltState& from, const BoltState& to,
                                       const Chain& chain) {
  to.plate(chain.bolt) = from.plate(chain.bolt);
  to.peak(chain.bolt) = from.peak(chain.bolt);
  for (Index n = chain.node; n < chain.node + chain.nodes; ++n) {
    to.slip(n) = from.slip(n);
    to.slid(n) = from.slid(n);
  }
  for (Index p = chain.steel; p + 1 < chain.steel + chain.nodes; ++p) {
    to.plastic(p) = from.plastic(p);
    to.used(p) = from.used(p);
    to.broken(p) = from.broken(p);
  }
  for (Index l = chain.link; l < chain.link + chain.links; ++l) {
    to.cut(l) = from.cut(l);
    for (int i = 0; i < 3; ++i) {
      to.sheared(l, i) = from.sheared(l, i);
      to.axis(l, i) = from.axis(l, i);
    }
  }
}

/// Steel between places that hold it, which pulls with one force and yields anywhere: breaks where it has flowed most.
KOKKOS_INLINE_FUNCTION void break_steel(const DeviceBolts& all, const Chain& chain) {
  const BoltLaw& law = all.law(chain.bolt);
  const Index end = chain.steel + chain.nodes - 1;
  Index link = chain.link;  // of the piece looked at
  for (Index first = chain.steel; first < end;) {
    Index last = first, most = first;
    Real flow = 0, before = 0, length = 0, cut = 0;
    for (;; ++last) {
      while (all.steel_begin(link + 1) <= last) ++link;
      cut = math::fmax(cut, all.next.cut(link));
      flow += all.next.used(last);
      before += all.now.used(last);
      if (all.next.used(last) > all.next.used(most)) most = last;
      length += all.steel_length(last);
      const Index far = last + chain.bolt + 1;
      if (last + 1 == end || all.bond_to(far) > all.bond_from(far)) break;
    }
    if (flow > before && all.next.broken(most) == 0) {
      const Real moved = flow + math::fabs(all.work.axial(most)) / law.stiffness + cut;
      const bool breaks =
          law.rupture > 0 ? flow > law.rupture * length : moved >= (1 - 1e-9) * law.reach;
      if (breaks) all.next.broken(most) = 1;
    }
    first = last + 1;
  }
}

/// The next state of a bolt that acts, whose trial motion is that of the step's end.
KOKKOS_INLINE_FUNCTION void accept_chain(const DeviceBolts& all, const Chain& chain) {
  const Index b = chain.bolt;
  all.next.plate(b) = all.now.plate(b);
  for (Index i = 0; i < chain.nodes; ++i) {
    const Hold hold = hold_of(all, chain, i, all.next.slip(chain.node + i));
    all.next.slid(chain.node + i) = hold.lost;
    if (i == 0) all.next.plate(b) = hold.plate_lost;
  }
  for (Index l = 0; l < chain.links; ++l) accept_link(all, chain, l);
  Real peak = all.now.peak(b);
  for (Index p = chain.steel; p + 1 < chain.steel + chain.nodes; ++p)
    peak = math::fmax(peak, all.work.axial(p));
  all.next.peak(b) = peak;
  break_steel(all, chain);
}

}  // namespace rockfold::bolts
