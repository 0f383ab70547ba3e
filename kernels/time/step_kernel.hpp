// A step: predict → residual → tangent → solve → correct → accept or cut. Statics, quasi-statics and dynamics, small and large kinematics
// go through it; where the rock's force is linear in the displacement, Newton's first iteration is the last.
//
// With β = 1/4, γ = 1/2 and a velocity that is handed on, large kinematics take forces as Simo & Tarnow (1992) do: the mean of
// both ends of the momentum balance, with the internal force F(middle) · mean S. Momentum, angular momentum and energy are then kept
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
  bool middle = false;  ///< twice the mean of both ends
  bool stabilised =
      false;      ///< augmented points go as supports.cpp says, not straight to their places
  Real load = 1;  ///< share of the loads and of the supports' way, in equilibrium
};

/// Norms of what acts, each by itself, N.
struct Forces {
  Real loads = 0, inertia = 0, internal = 0;
  Real reference =
      0;  ///< the largest of them: what residuals are measured against where they cancel
};

// predict.cpp

/// d', v', a' in free flight, or where the step is too long for it with d' = d.
void predict(Motion::Data& m, Real dt);

// residual.cpp

/// right = F − M a − C v − f(d) of `now`, the supports left out; twice the mean where `middle`.
Forces find_residual(Motion::Data& m, const Step& step);
/// goal = what supports still have to go; in the middle, springs pull with the mean of both ends.
void find_goals(const Motion::Data& m, const Step& step);
/// What the start of a step gives to the mean: velocity, acceleration, stretched springs, pressures that follow.
void keep_start(Motion::Data& m);
/// ‖right + forces of the supports‖, N. `reference` becomes the norm of the latter, if that is larger.
Real find_imbalance(Motion::Data& m, Real& reference);
/// Supports' largest distance from their places over the largest displacement, or over what forces of the size `reference` would
/// move the stiffest cover by: where forces cancel nothing moves.
Real gap_of_supports(Motion::Data& m, Real reference);

}  // namespace rockfold::motion
