// A step: predict → residual → tangent → solve → correct → accept or cut. Statics, quasi-statics and dynamics, small and large kinematics
// go through it; where the rock's force is linear in the displacement, Newton's first iteration is the last.
//
// With β = 1/4, γ = 1/2 and a velocity that is handed on, forces are the mean of both ends of the momentum balance; under large kinematics
// the internal force is F(middle) · mean S (Simo & Tarnow 1992). Momentum, angular momentum and energy are then kept
// to the accuracy of the solution, whatever the step. M (a + a')/2 + f = (F + F')/2 is solved twice over: M (a + a') + 2 f = F + F',
// whose matrix is Newmark's. Otherwise forces are balanced at the step's end.
#pragma once

#include "kernels/time/motion_kernel.hpp"

namespace rockfold::motion {

/// What a step balances.
struct Step {
  Real dt = 0;           ///< s; 0: equilibrium
  bool inertia = false;  ///< and damping: whether they count
  bool rate =
      false;  ///< damping by stiffness stands beside the internal force, of the velocity at the end
  bool middle = false;      ///< twice the mean of both ends
  bool stabilised = false;  ///< points held go as supports.cpp says, not straight to their places
  Real speed_by_gap = 0;    ///< 1/s, dv'/dd': of contacts that feel speeds; 0: they do not
  Real load = 1;            ///< share of the loads and of the supports' way, in equilibrium
  Real walls = 0;  ///< share of the forces on walls: at the end; in the middle of both ends
};

/// Norms of what acts, each by itself, N.
struct Forces {
  Real loads = 0, inertia = 0, internal = 0;
  Real reference =
      0;  ///< the largest of them: what residuals are measured against where they cancel
};

/// d' += share · x, and what follows from it.
void correct(const Motion::Data& m, const Step& step, Real share);

// contact_step.cpp

/// Before the first step: the points of step 0.
void begin_contact(Motion::Data& m);
/// The points at the predicted places.
void find_contacts(Motion::Data& m, const Step& step);
/// right += the forces of the points as blocks are now. Returns their norm, N.
Real add_contact_forces(Motion::Data& m, const Step& step);
/// held = right, with points that turned round since the last correction as if they stuck. Their tangents are those of that.
void hold_reversed(Motion::Data& m, const Step& step);
/// As far along the correction as forces let blocks go. Returns those there: find_residual and find_prescribed are done.
Forces correct_along_line(Motion::Data& m, const Step& step);
/// Finds the points at the places that balance forces; whether some are new and closed. Normals that turn too far: not converged.
bool misses_contacts(Motion::Data& m, const Step& step, SolveReport& report);
/// Accepts them, and counts what they have taken.
void end_contact(Motion::Data& m, const Step& step);

// predict.cpp

/// d', v', a' of rock that goes on as it moves, or falls.
void predict(Motion::Data& m, Real dt);

// residual.cpp

/// right = F − M a − C v − f(d) of `now`, the supports left out; twice the mean where `middle`.
Forces find_residual(Motion::Data& m, const Step& step);
/// prescribed = what supports still have to go; in the middle, springs pull with the mean of both ends.
void find_prescribed(const Motion::Data& m, const Step& step);
/// What the start of a step gives to the mean: velocity, acceleration, stretched springs, pressures that follow.
void keep_start(Motion::Data& m);
/// bolts_before = those of the step's start.
void keep_bolts(Motion::Data& m);
/// ‖right + forces of the supports‖, N. `reference` becomes the norm of the latter, if that is larger.
Real find_imbalance(Motion::Data& m, Real& reference);
/// Supports' largest distance from their places over the largest displacement, or over what forces of the size `reference` would
/// move the stiffest cover by: where forces cancel nothing moves.
Real gap_of_supports(Motion::Data& m, Real reference);

}  // namespace rockfold::motion
