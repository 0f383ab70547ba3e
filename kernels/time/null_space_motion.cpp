// Covers with several functions can move without moving rock: with linear weights Σ N_a (c + ω × x_a)·(x − x_a) = 0. Nothing resists
// such null-space motion. Conjugate gradients that start from nothing with a preconditioner B find none of it: B⁻¹ x is orthogonal to it. But the first
// acceleration of schemes that need one is found with another B than the corrections of the steps, and what is idle in it goes on as in free flight: it grows with t², until
// forces and energies, differences of ever larger numbers, drown in rounding.
#include <algorithm>
#include <cmath>

#include "kernels/time/motion_kernel.hpp"

namespace rockfold::motion {
namespace {

/// Steps after which what has come of other preconditioners and of rounding is taken out again; under large kinematics the preconditioner
/// turns with the rock.
constexpr Index null_space_steps = 25, null_space_large_steps = 10;
/// What is moved by leaving it out should be far below what the steps leave open, and must not be above; rounding sets a limit.
constexpr Real share_of_tolerance = 1e-3, least_tolerance = 1e-11;
constexpr Index most_iterations = 500;

/// Replaces x, or leaves it where that cannot be done.
void leave_out(Motion::Data& m, const Field& x) {
  solve::PcgOptions pcg;
  pcg.tolerance = std::max(share_of_tolerance * m.solver.tolerance, least_tolerance);
  if (pcg.tolerance > m.solver.tolerance) return;  // closer steps do without
  pcg.max_iterations = std::min(m.solver.max_iterations, most_iterations);
  // Against inertia alone: where x strains rock with far larger forces no step flies along x (see predict), and it may be left as it is.
  m.rock->apply({0, m.system.combination.mass}, x, m.work);
  pcg.reference = std::sqrt(solve::dot(m.system.work, m.work, m.work));
  pcg.measure_load = false;
  if (!(pcg.reference > 0)) return;
  const SolveReport done =
      solve::find_same_motion(m.system, x, m.correction, pcg, m.solver.tolerance);
  if (done.converged) Kokkos::deep_copy(x, m.correction);
}

}  // namespace

bool null_space_motion_is_due(const Motion::Data& m) {
  return !m.average() && m.system.op.functions > 1 && m.now.dynamic_ratio > 0 &&
         m.now.steps % (m.rock->linear() ? null_space_steps : null_space_large_steps) == 0;
}

void remove_null_space_motion(Motion::Data& m) {
  leave_out(m, m.now.acceleration);
  if (m.now.steps > 0) leave_out(m, m.now.velocity);
}

}  // namespace rockfold::motion
