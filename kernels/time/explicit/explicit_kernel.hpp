// Explicit steps of block covers: central differences (leapfrog), for masses in motion.
//
//   block_inertia.cpp   the mass matrix of each block and the stiffness of its rock
//   held_rows.cpp       points that are held: the parts of a block's motion that they take
//   critical_step.cpp   how long a block's substeps may be
//   schedule.cpp        who is looked at how often
//   ticks.cpp           one tick of the blocks: kick, drift, points held, vertices
//   substeps.cpp        the step that the user asks for
//
// Asynchronous variational integration (Lew, Marsden, Ortiz & West, Arch. Rat. Mech. Anal. 167, 2003, 85): each contact point and each block's own
// forces have a clock, in powers of two. When a clock of interval h ticks, its force gives both blocks the impulse h f; between ticks blocks drift. Momentum
// is kept to rounding whatever the clocks, and one sliver sets the pace of its own points alone. Steps begin and end with half an impulse of all, so that
// places and velocities are then those of one time. Points that are held are put exactly in their places by the impulse that this takes (SHAKE:
// Ryckaert, Ciccotti & Berendsen, J. Comput. Phys. 23, 1977, 327).
//
// The mass matrix of a block cover is one small matrix, since blocks share no function. Slivers vibrate in themselves far faster than they move
// in their joints (c/h of 1 mm: 2e6 rad/s), so that strain alone is given more inertia, M + θh²K with the block's own K (selective mass scaling:
// Olovsson, Simonsson & Unosson, Int. J. Numer. Meth. Engng 63, 2005, 1436), and damped: no motion as a rigid body strains, and none is changed. Of
// blocks that have turned by R that is R (M + θh²K) Rᵀ.
//
// A quasi-static step relaxes: each generalised force f of a block is damped by 0.8 |f| against the velocity that goes with it (local damping: Cundall,
// in: Numerical Methods in Geomechanics, Innsbruck 1988, as FLAC and 3DEC have it). It takes nothing where forces are in balance, so that the rest
// it comes to is that of the forces alone, and what slips on the way follows the law.
#pragma once

#include "kernels/time/motion_kernel.hpp"

namespace rockfold::motion {

/// What does not change with the motion: masses, stiffness, the surface vertices of blocks.
void find_inertia(Motion::Data& m);
/// For the inertia of now: slow_strain.
HeldRows find_held_rows(const Motion::Data& m);

/// ExplicitScheme::rigid, of masses without factor.
void find_rigid(const Motion::Data& m);
/// ExplicitScheme::step and turning: what is stable with the contact points of now, whatever their states.
void find_block_steps(Motion::Data& m);
/// ExplicitScheme::slowed and damped, for the intervals of the schedule.
void slow_strain(const Motion::Data& m);
/// J: ½ vᵀ((factor − 1) M + θh²K)v, kinetic energy of the inertia that blocks and their strain have been given.
Real added_inertia(const Motion::Data& m);

/// For the contact points of now; dt s are left to go, in periods of at most `longest` s. Where steps relax all blocks go by one clock, each with the mass that is stable with it: local damping
/// is of whole forces, and masses do not matter to rest.
void make_schedule(Motion::Data& m, Real dt, Real longest, const StepCourse& course);

/// A tick of all blocks that level `from` and faster ones touch. Where they do not go on, points held stop with their supports (prescribed, m/s).
struct Tick {
  int from = 0;
  Real share = 1;        ///< of the impulses: ½ where steps begin and end
  bool drifts = true;    ///< to where each is touched next
  Index count = 0;       ///< of the period's shortest intervals, that have gone
  bool relaxes = false;  ///< forces are damped locally
};
void tick_blocks(const Motion::Data& m, const Tick& tick);

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
