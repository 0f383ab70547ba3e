// A bolt in balance with the rock about it, for given motions of its links.
//
// With s the slips of its nodes, e the stretch of a piece of steel (its share of the link's, plus s of its far node less s of its near one), N its pull and b
// what bond and plate take,  g_i = N_before − N_after + b_i(s_i) = 0: the derivative of a convex potential, with a tridiagonal matrix of
// second derivatives. Newton's method with a search along its steps finds the least.
#pragma once

#include "kernels/contact/vector_kernel.hpp"
#include "kernels/time/bolts/bolts_kernel.hpp"
#include "kernels/time/bolts/steel_law_kernel.hpp"

namespace rockfold::bolts {

using contact::Vector;

/// Nodes, pieces of steel and links of one bolt: places in the arrays of all.
struct Chain {
  Index bolt, node, nodes, steel, link, links;
};

KOKKOS_INLINE_FUNCTION Chain chain_of(const DeviceBolts& all, Index b) {
  const Index node = all.node_begin(b), point = all.point_begin(b);
  return {b,
          node,
          all.node_begin(b + 1) - node,
          node - b,  // one piece less than nodes in each bolt
          point - b,
          all.point_begin(b + 1) - point - 1};
}

/// What the rock does to a link.
struct LinkMotion {
  Real stretch = 0;  ///< m along the bolt
  Vector along;      ///< unit
  Vector across;     ///< m, beyond the plastic shear; crossings
  Real shear = 0;    ///< m, its length
};

/// A vector across `from` as it is where that has become `to`.
KOKKOS_INLINE_FUNCTION Vector turn_along(const Vector& v, const Vector& from, const Vector& to) {
  const Real both = 1 + dot(from, to);
  if (!(both > 1e-6)) return v;
  return v - (dot(to, v) / both) * (from + to);
}

KOKKOS_INLINE_FUNCTION LinkMotion motion_of(const DeviceBolts& all, const Chain& chain, Index l) {
  const Index link = chain.link + l, near = link + chain.bolt;
  const Vector way = contact::at(all.motion, link), home = contact::at(all.apart, link);
  LinkMotion m;
  if (all.crossing(link) == 0) {
    const Real length = contact::length(way);
    m.along = length > 0 ? (1 / length) * way : contact::at(all.axis, near);
    m.stretch = length - contact::length(home);
    return m;
  }
  m.along = contact::unit(contact::at(all.axis, near) + contact::at(all.axis, near + 1));
  const Real along = dot(way, m.along);
  m.stretch = along - contact::length(home);
  const Vector was = contact::at(all.now.axis, link);
  m.across = way - along * m.along - turn_along(contact::at(all.now.sheared, link), was, m.along);
  m.across = m.across - dot(m.across, m.along) * m.along;
  m.shear = contact::length(m.across);
  return m;
}

KOKKOS_INLINE_FUNCTION Steel steel_of(const DeviceBolts& all, const Chain& chain, Index link,
                                      Index piece) {
  const BoltLaw& law = all.law(chain.bolt);
  const Real share = 1 / static_cast<Real>(all.steel_begin(link + 1) - all.steel_begin(link));
  const Real length = all.length(link) * share;
  Steel steel;
  steel.along = law.section / (all.elastic_length(link) * share);
  steel.strength = law.strength;
  steel.pushed = law.pushed;
  steel.hardening = law.rupture > 0 ? (law.strength - law.yield) / (law.rupture * length) : 0;
  steel.yield = math::fmin(law.strength, law.yield + steel.hardening * all.now.used(piece));
  if (all.crossing(link) != 0) {
    steel.across = all.dowel(link);
    steel.shear = law.shear_strength;
  }
  if (all.now.broken(piece) >
      0) {  // a thread that no load notices, so that what it leaves loose has a place
    const Real thread = least_tangent * law.strength;
    steel = {least_tangent * steel.along, 0, thread, thread, 0, 0, 1};
  }
  return steel;
}

/// m of bond that is left about a node: steel that has slipped there by s is what lay s nearer to the collar, and ends where that did.
KOKKOS_INLINE_FUNCTION Real bond_left(const DeviceBolts& all, const Chain& chain, Index i) {
  const Index n = chain.node + i;
  const Real slip = all.now.slip(n), near = all.node_place(chain.node) + slip,
             far = all.toe(chain.bolt) + slip;
  return math::fmax(Real{0}, math::fmin(all.bond_to(n), far) - math::fmax(all.bond_from(n), near));
}

/// Of the bolt's stiffness, what a bond that slides keeps in Newton's steps: without it a length that slides as a whole would be taken metres along.
/// It is little beside the steel's, so that where one length slides among others iterations hardly notice.
constexpr Real sliding_tangent = 1e-4;

/// What holds a node of the steel back.
struct Hold {
  Real force = 0, tangent = 0;
  Real lost = 0;  ///< m of slip that the bond has lost
  Real plate = 0, plate_lost = 0;
  bool slides = false;
};

KOKKOS_INLINE_FUNCTION Hold hold_of(const DeviceBolts& all, const Chain& chain, Index i,
                                    Real slip) {
  const BoltLaw& law = all.law(chain.bolt);
  const Index n = chain.node + i;
  Hold hold;
  hold.lost = all.now.slid(n);
  hold.tangent = least_tangent * law.section / all.toe(chain.bolt);  // of steel that nothing holds
  const Real bonded = bond_left(all, chain, i), k = law.bond_stiffness * bonded;
  if (k > 0) {
    hold.force = k * (slip - hold.lost);
    hold.tangent += k;
    const Real most = law.bond_strength * bonded;
    if (math::fabs(hold.force) > most) {
      hold.force = hold.force > 0 ? most : -most;
      hold.lost = slip - hold.force / k;
      hold.tangent = math::fmin(k, sliding_tangent * law.section / all.toe(chain.bolt));
      hold.slides = true;
    }
  }
  if (i > 0 || !(law.plate_strength > 0)) return hold;
  hold.plate_lost = all.now.plate(chain.bolt);
  const Real pull = law.plate_stiffness * (slip - hold.plate_lost);
  if (pull > law.plate_strength) {
    hold.plate = law.plate_strength;
    hold.plate_lost = slip - hold.plate / law.plate_stiffness;
    hold.tangent += least_tangent * law.plate_stiffness;
  } else if (pull > 0) {
    hold.plate = pull;
    hold.tangent += law.plate_stiffness;
  }
  hold.force += hold.plate;
  return hold;
}

/// Fills axial, tangent and residual at the slips of `next`; ‖residual‖ at most, and the largest force.
struct ChainBalance {
  Real left = 0, largest = 0;
};
KOKKOS_INLINE_FUNCTION ChainBalance find_residual(const DeviceBolts& all, const Chain& chain) {
  const ChainWork& w = all.work;
  ChainBalance balance;
  for (Index i = 0; i < chain.nodes; ++i) {
    const Hold hold = hold_of(all, chain, i, all.next.slip(chain.node + i));
    w.residual(chain.node + i) = hold.force;
    w.diagonal(chain.node + i) = hold.tangent;
    balance.largest = math::fmax(balance.largest, math::fabs(hold.force));
  }
  for (Index l = 0; l < chain.links; ++l) {
    const Index link = chain.link + l;
    const LinkMotion m = motion_of(all, chain, l);
    const Index begin = all.steel_begin(link), end = all.steel_begin(link + 1);
    for (Index p = begin; p < end; ++p) {
      const Index near = p + chain.bolt;  // the node before it
      const Real e = m.stretch / static_cast<Real>(end - begin) + all.next.slip(near + 1) -
                     all.next.slip(near) - all.now.plastic(p);
      const SteelForce f = steel_force(steel_of(all, chain, link, p), e, m.shear);
      w.axial(p) = f.axial;
      w.tangent(p) = f.aa;
      w.residual(near) -= f.axial;
      w.residual(near + 1) += f.axial;
      w.diagonal(near) += f.aa;
      w.diagonal(near + 1) += f.aa;
      w.off(near) = -f.aa;
      balance.largest = math::fmax(balance.largest, math::fabs(f.axial));
    }
  }
  for (Index i = 0; i < chain.nodes; ++i)
    balance.left = math::fmax(balance.left, math::fabs(w.residual(chain.node + i)));
  return balance;
}

/// solution ← H⁻¹ right; H as find_residual left it. Neither is changed.
KOKKOS_INLINE_FUNCTION void solve_chain(const DeviceBolts& all, const Chain& chain,
                                        const Array<Real>& right, const Array<Real>& solution,
                                        const Array<Real>& scratch) {
  const ChainWork& w = all.work;
  const Index first = chain.node, end = chain.node + chain.nodes;
  Real pivot = w.diagonal(first);
  solution(first) = right(first) / pivot;
  for (Index n = first + 1; n < end; ++n) {
    scratch(n) = w.off(n - 1) / pivot;
    pivot = w.diagonal(n) - w.off(n - 1) * scratch(n);
    solution(n) = (right(n) - w.off(n - 1) * solution(n - 1)) / pivot;
  }
  for (Index n = end - 1; n > first; --n) solution(n - 1) -= scratch(n) * solution(n);
}

/// The slips that bring the chain into balance, from those of the last step on.
KOKKOS_INLINE_FUNCTION void balance_chain(const DeviceBolts& all, const Chain& chain) {
  constexpr int most = 200, trials = 100;
  constexpr Real enough = 1e-12, rounding = 1e-16, within = 0.5, beyond = 1e-3, lost = 0.5;
  const ChainWork& w = all.work;
  const Index first = chain.node, end = chain.node + chain.nodes;
  const Real least = enough * all.law(chain.bolt).strength;
  for (Index n = first; n < end; ++n) all.next.slip(n) = all.now.slip(n);
  ChainBalance balance = find_residual(all, chain);
  for (int k = 0; k < most && balance.left > math::fmax(least, enough * balance.largest); ++k) {
    solve_chain(all, chain, w.residual, w.step, w.solution);
    const auto slope = [&]() {
      Real sum = 0;
      for (Index n = first; n < end; ++n) sum -= w.residual(n) * w.step(n);
      return sum;
    };
    const auto go = [&](Real by) {
      for (Index n = first; n < end; ++n) all.next.slip(n) -= by * w.step(n);
      balance = find_residual(all, chain);
    };
    const Real start = slope();  // < 0
    Real longest = 0;
    for (Index n = first; n < end; ++n) longest = math::fmax(longest, math::fabs(w.step(n)));
    if (longest <= rounding * all.toe(chain.bolt)) break;
    if (!(start < 0)) break;
    go(1);
    // Beyond the least by much: back to it. Where a stiff part lets go the slope has a sharp bend, so every second trial halves. The end of the
    // interval that lies beyond has the tangent that leads there; it serves once less has been lost on the way to it than had been won.
    Real at = 1, here = slope(), low = 0, of_low = start, high = 1, of_high = here;
    for (int t = 0; t < trials && (here > -beyond * start || (t > 0 && here < within * start));
         ++t) {
      if (of_high * (high - low) <= -lost * of_low * low) {
        go(high - at);
        break;
      }
      const Real to =
          t % 2 == 1 ? 0.5 * (low + high) : low + (high - low) * of_low / (of_low - of_high);
      go(to - at);
      at = to;
      here = slope();
      (here > 0 ? high : low) = at;
      (here > 0 ? of_high : of_low) = here;
    }
  }
}

}  // namespace rockfold::bolts
