// Links of a bolt: their motions with the rock, and what they do to it.
#pragma once

#include "kernels/time/bolts/chain_kernel.hpp"
#include "kernels/time/forces/stress_kernel.hpp"

namespace rockfold::bolts {

/// Where a bolt's directions are at its points in rock that d has displaced, and what its links have become.
KOKKOS_INLINE_FUNCTION void move_chain(const DeviceBolts& all, const Chain& chain, const Field& d) {
  const Vector from = contact::at(all.direction, chain.bolt);
  for (Index n = chain.link + chain.bolt; n <= chain.link + chain.bolt + chain.links; ++n) {
    const Real x[3] = {all.local(n, 0), all.local(n, 1), all.local(n, 2)};
    Real deformed[3][3];
    motion::gradient_at(all.elements, d, all.element(n), x, all.slopes.at(n), deformed);
    const Vector axis = contact::unit(from + Vector{dot(contact::to_vector(deformed[0]), from),
                                                    dot(contact::to_vector(deformed[1]), from),
                                                    dot(contact::to_vector(deformed[2]), from)});
    all.axis(n, 0) = axis.x;
    all.axis(n, 1) = axis.y;
    all.axis(n, 2) = axis.z;
  }
  for (Index l = chain.link; l < chain.link + chain.links; ++l) {
    Real u[3];
    solve::interpolate_all(all.rows.points, l, d, u);
    for (int i = 0; i < 3; ++i) all.motion(l, i) = all.apart(l, i) + u[i];
  }
}

KOKKOS_INLINE_FUNCTION void put(const Field& to, Index n, const Vector& v) {
  to(n, 0) = v.x;
  to(n, 1) = v.y;
  to(n, 2) = v.z;
}

/// b += s · (v wᵀ + w vᵀ)/2, symmetric.
KOKKOS_INLINE_FUNCTION void add_product(const solve::Blocks& b, Index n, Real s, const Vector& v,
                                        const Vector& w) {
  const Real a[3] = {v.x, v.y, v.z}, c[3] = {w.x, w.y, w.z};
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j)
      b(n, solve::symmetric_entry(i, j)) += 0.5 * s * (a[i] * c[j] + a[j] * c[i]);
}

/// What the rock gets from a link, and A_k and a_k of it.
KOKKOS_INLINE_FUNCTION void find_link(const DeviceBolts& all, const Chain& chain, Index l) {
  const Index link = chain.link + l, begin = all.steel_begin(link), end = all.steel_begin(link + 1);
  const LinkMotion m = motion_of(all, chain, l);
  const Real share = 1 / static_cast<Real>(end - begin);
  for (int i = 0; i < 6; ++i) all.tangent(link, i) = 0;
  if (all.crossing(link) == 0) {
    Real force = 0, stiffness = 0;
    for (Index p = begin; p < end; ++p) {
      force += share * all.work.axial(p);
      stiffness += share * share * all.work.tangent(p);
    }
    put(all.force, link, force * m.along);
    put(all.lead, link, m.along);
    add_product(all.tangent, link, stiffness, m.along, m.along);
    return;
  }
  const Index near = begin + chain.bolt;
  const Real e = m.stretch + all.next.slip(near + 1) - all.next.slip(near) - all.now.plastic(begin);
  const SteelForce f = steel_force(steel_of(all, chain, link, begin), e, m.shear);
  const Vector across = m.shear > 0 ? (1 / m.shear) * m.across : contact::any_across(m.along);
  const Vector third = contact::cross(m.along, across);
  put(all.force, link, f.axial * m.along + f.shear * across);
  put(all.lead, link, f.aa * m.along + f.as * across);
  add_product(all.tangent, link, f.aa, m.along, m.along);
  add_product(all.tangent, link, 2 * f.as, m.along, across);
  add_product(all.tangent, link, f.ss, across, across);
  const Real turning = m.shear > 0 ? f.shear / m.shear : f.ss;
  add_product(all.tangent, link, turning, third, third);
}

/// Row l of B into `right`: by how much the slips change what the link pulls with (over lead).
KOKKOS_INLINE_FUNCTION void find_row(const DeviceBolts& all, const Chain& chain, Index l,
                                     const Array<Real>& right) {
  for (Index n = chain.node; n < chain.node + chain.nodes; ++n) right(n) = 0;
  const Index link = chain.link + l, begin = all.steel_begin(link), end = all.steel_begin(link + 1);
  const Real share = 1 / static_cast<Real>(end - begin);
  for (Index p = begin; p < end; ++p) {
    const Real k = all.crossing(link) != 0 ? 1 : share * all.work.tangent(p);
    right(p + chain.bolt) -= k;
    right(p + chain.bolt + 1) += k;
  }
}

/// W of one bolt.
KOKKOS_INLINE_FUNCTION void find_couplings(const DeviceBolts& all, const Chain& chain) {
  const ChainWork& w = all.work;
  Real* const coupling = &all.coupling(all.coupling_begin(chain.bolt));
  for (Index l = 0; l < chain.links; ++l) {
    find_row(all, chain, l, w.residual);
    solve_chain(all, chain, w.residual, w.step, w.solution);
    for (Index k = 0; k < chain.links; ++k) {
      const Index link = chain.link + k, begin = all.steel_begin(link),
                  end = all.steel_begin(link + 1);
      const Real share = 1 / static_cast<Real>(end - begin);
      Real sum = 0;
      for (Index p = begin; p < end; ++p) {
        const Real stiffness = all.crossing(link) != 0 ? 1 : share * w.tangent(p);
        sum += stiffness * (w.step(p + chain.bolt + 1) - w.step(p + chain.bolt));
      }
      coupling[l * chain.links + k] = sum;
    }
  }
}

KOKKOS_INLINE_FUNCTION void hold_nothing(const DeviceBolts& all, const Chain& chain) {
  for (Index l = chain.link; l < chain.link + chain.links; ++l) {
    put(all.force, l, {});
    put(all.lead, l, {});
    for (int i = 0; i < 6; ++i) all.tangent(l, i) = 0;
  }
  Real* const coupling = &all.coupling(all.coupling_begin(chain.bolt));
  for (Index k = 0; k < chain.links * chain.links; ++k) coupling[k] = 0;
}

/// What the links pull with where d has the rock.
KOKKOS_INLINE_FUNCTION void pull_chain(const DeviceBolts& all, const Chain& chain, const Field& d) {
  move_chain(all, chain, d);
  balance_chain(all, chain);
  for (Index l = 0; l < chain.links; ++l) find_link(all, chain, l);
}

}  // namespace rockfold::bolts
