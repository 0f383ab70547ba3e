// What a piece of steel bears.
//
// Along the bolt: elastic, then plastic with linear hardening to its strength. Across it, at a joint: a dowel in the rock (dowel_stiffness of
// host/bolting/bolt_law.hpp). Both together yield on the ellipse (N/T)² + (Q/S)² = 1 with the flow that belongs to it, so that once a
// joint has moved far enough the force is that which does the most work: the capacity that block theory counts with (docs/support_design.md; of
// such ellipses Pellet & Egger, Rock Mech. Rock Engng 29, 1996, 73).
#pragma once

#include "kernels/device/device_kernel.hpp"
#include "src/arrays/bolt_arrays.hpp"

namespace rockfold::bolts {

namespace math = device::math;

/// A piece of steel as a law in terms of its elongation.
struct Steel {
  Real along = 0;      ///< N/m
  Real across = 0;     ///< N/m; 0: it has no dowel
  Real yield = 0;      ///< N, as used so far
  Real strength = 0;   ///< N
  Real hardening = 0;  ///< N for each metre of plastic elongation
  Real shear = 0;      ///< N, strength across
  Real pushed = 0;     ///< BoltLaw::pushed
};

/// Forces and their derivatives by elongation and shear.
struct SteelForce {
  Real axial = 0, shear = 0;  ///< N
  Real aa = 0, as = 0,
       ss = 0;    ///< N/m: of axial by elongation, of either by the other, of shear by itself
  Real used = 0;  ///< m, of plastic flow
};

/// Of what is left elastic of a plastic tangent, so that no chain of them is loose.
constexpr Real least_tangent = 1e-9;

/// Without shear; `e` m beyond the plastic elongation.
KOKKOS_INLINE_FUNCTION SteelForce axial_force(const Steel& steel, Real e) {
  SteelForce f;
  const Real k = e < 0 ? steel.pushed * steel.along : steel.along;
  f.axial = k * e;
  f.aa = k;
  const Real over = math::fabs(f.axial) - steel.yield;
  if (!(over > 0)) return f;
  const bool hardens = steel.yield < steel.strength;
  const Real h = hardens ? steel.hardening : 0;
  f.used = over / (k + h);
  Real bears = steel.yield + h * f.used;
  f.aa = k * h / (k + h);
  if (bears > steel.strength) {
    f.used = (math::fabs(f.axial) - steel.strength) / k;
    bears = steel.strength;
    f.aa = 0;
  }
  f.axial = e < 0 ? -bears : bears;
  f.aa = math::fmax(f.aa, least_tangent * k);
  return f;
}

/// Elongation e and shear g ≥ 0 beyond the plastic ones.
KOKKOS_INLINE_FUNCTION SteelForce steel_force(const Steel& steel, Real e, Real g) {
  if (!(steel.across > 0 && steel.shear > 0)) return axial_force(steel, e);
  if (e < 0) {  // pushed: the dowel alone, on the axis of the ellipse
    SteelForce f = axial_force(steel, e);
    f.shear = steel.across * g;
    f.ss = steel.across;
    const Real most = steel.shear * steel.yield / steel.strength;
    if (f.shear > most) {
      f.used += (f.shear - most) / steel.across;
      f.shear = most;
      f.ss = least_tangent * steel.across;
    }
    return f;
  }
  const Real n = steel.along * e, q = steel.across * g;
  const Real t2 = steel.strength * steel.strength, s2 = steel.shear * steel.shear;
  const Real start = steel.yield / steel.strength;
  const Real a = steel.along / t2, b = steel.across / s2;
  // The flow λ: N = n/(1 + λa), Q = q/(1 + λb) lie on the ellipse of size r(λ).
  const auto size_at = [&](Real used) {
    return math::fmin(Real{1}, start + steel.hardening * used / steel.strength);
  };
  SteelForce f{n, q, steel.along, 0, steel.across, 0};
  if (n * n / t2 + q * q / s2 <= start * start) return f;
  Real flow = 0, size = start, slope = 0;
  constexpr int most = 60;
  for (int k = 0; k < most; ++k) {
    f.axial = n / (1 + flow * a);
    f.shear = q / (1 + flow * b);
    const Real by_axial = f.axial / t2, by_shear = f.shear / s2;
    const Real rate = math::sqrt(by_axial * by_axial + by_shear * by_shear);
    f.used = flow * rate;
    size = size_at(f.used);
    slope = size < 1 ? steel.hardening * rate / steel.strength : 0;
    const Real off = f.axial * by_axial + f.shear * by_shear - size * size;
    const Real of_axial = by_axial * by_axial * steel.along / (1 + flow * a),
               of_shear = by_shear * by_shear * steel.across / (1 + flow * b);
    const Real step = off / (2 * (of_axial + of_shear + size * slope));
    flow += step;
    if (math::fabs(step) <= 1e-14 * flow) break;
  }
  const Real along = steel.along / (1 + flow * a), across = steel.across / (1 + flow * b);
  const Real by_axial = f.axial / t2, by_shear = f.shear / s2;
  const Real whole = by_axial * by_axial * along + by_shear * by_shear * across + size * slope;
  f.aa = along - along * along * by_axial * by_axial / whole;
  f.as = -along * across * by_axial * by_shear / whole;
  f.ss = across - across * across * by_shear * by_shear / whole;
  f.aa += least_tangent * steel.along;
  f.ss += least_tangent * steel.across;
  return f;
}

}  // namespace rockfold::bolts
