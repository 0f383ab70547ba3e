// Explicit steps of block covers: central differences (leapfrog), for masses in motion.
//
//   block_inertia.cpp   the mass matrix of each block, inverted once, and the stiffness of its rock
//   held_rows.cpp       points that are held: the parts of a block's motion that they take
//   critical_step.cpp   how long a substep may be
//   substeps.cpp        the step that the user asks for, in substeps
//
// A substep from v at its middle:  v += h M⁻¹ f,  d += h v, points that are held put exactly in their places by the impulse that this takes
// (SHAKE: Ryckaert, Ciccotti & Berendsen, J. Comput. Phys. 23, 1977, 327), then forces anew, with the memories of contact points that are
// there. Steps begin and end with half a kick, so that between them places and velocities are those of one time.
//
// The mass matrix of a block cover is one small matrix, since blocks share no function. Slivers vibrate in themselves far faster than they move
// in their joints (c/h of 1 mm: 2e6 rad/s), so that strain alone is given more inertia, M + θh²K with the block's own K (selective mass scaling:
// Olovsson, Simonsson & Unosson, Int. J. Numer. Meth. Engng 63, 2005, 1436): no motion as a rigid body strains, and none is changed. Of blocks that have
// turned by R that is R (M + θh²K) Rᵀ.
#pragma once

#include <string>

#include "kernels/time/motion_kernel.hpp"

namespace rockfold::motion {

/// Why explicit steps cannot be had of this motion; empty: they can.
std::string why_not_explicit(const Motion::Data& m);

/// What does not change with the motion.
void find_inertia(Motion::Data& m);
HeldRows find_held_rows(const Motion::Data& m);
/// Of the rock in place.
void find_stiffness(Motion::Data& m);

/// s: the longest substep that is stable with the contact points of now, whatever their states (critical_step.cpp).
Real critical_substep(Motion::Data& m);
/// The inverses that go with substeps of h at most: ExplicitScheme::slowed.
void slow_strain(const Motion::Data& m, Real h);

/// y = R x or Rᵀ x, function by function; index 3k + d.
KOKKOS_INLINE_FUNCTION void turn_vector(const Real* r, bool back, int n, const Real* x, Real* y) {
  for (int k = 0; k < n; ++k)
    for (int i = 0; i < 3; ++i) {
      Real sum = 0;
      for (int j = 0; j < 3; ++j) sum += (back ? r[3 * j + i] : r[3 * i + j]) * x[3 * k + j];
      y[3 * k + i] = sum;
    }
}

}  // namespace rockfold::motion
