// Where a motion begins: the first velocity and acceleration.
#include "kernels/time/step_kernel.hpp"

namespace rockfold::motion {
namespace {

/// The velocity that goes with the points held, nearest to the one given: one that contradicts its supports would oscillate about their tables'
/// slope in every later step.
SolveReport catch_up_with_supports(Motion::Data& m, Real dt) {
  const Real before = kinetic_energy(m);
  const bool moving = m.supports.tables.any() && m.supports.tables.moving_after(m.now.time);
  if (!moving && !(before > 0 && m.system.springs.any() && m.system.constraints.any_held))
    return {};
  const Real hold = m.beta * dt * dt;
  set_matrix(m, {hold, 1}, 0, hold);
  solve::apply_rock(m.system, m.now.velocity, m.right);
  prescribe_velocity(m);
  const SolveReport report = solve::solve_constrained(m.system, m.right, m.prescribed,
                                                      m.now.velocity, Field(), solve_options(m, 0));
  m.now.work.supports += kinetic_energy(m) - before;
  return report;
}

/// From (M + γΔt C + βΔt² K) a = F − C v − f(d). The matrix is that of the steps: what follows from it leaves functions at rest that steps
/// leave, those that move no rock, and those of slivers, which have stiffness and next to no mass. Slow modes are changed by β(ωΔt)², as the
/// scheme changes them.
SolveReport find_acceleration(Motion::Data& m, Real dt) {
  const Real hold = m.beta * dt * dt, damp = m.gamma * dt;
  set_matrix(m, {hold + damp * m.damping.stiffness, 1 + damp * m.damping.mass}, damp, hold);
  Kokkos::deep_copy(m.now.acceleration, 0.0);
  Step step;
  step.inertia = step.rate = m.damped();
  const Real reference = find_residual(m, step).reference;
  prescribe_acceleration(m);
  const SolveReport report = solve::solve_constrained(
      m.system, m.right, m.prescribed, m.now.acceleration, Field(), solve_options(m, reference));
  if (m.system.springs.any())
    solve::spring_reactions(m.system.springs, m.now.acceleration, m.prescribed, m.now.reaction);
  find_pull_of_springs(m);
  return report;
}

SolveReport set_in_motion(Motion::Data& m, Real dt) {
  SolveReport report = catch_up_with_supports(m, dt);
  if (!report.converged) return report;
  // An analysis that goes on from another one's motion has its acceleration, in balance.
  if (!m.average() && solve::largest_entry(m.now.acceleration) == 0)
    report.add(find_acceleration(m, dt));
  else if (m.average() && !m.system.springs.any())
    device::copy_to_device(uniform_field(m.unknowns, m.covers, free_fall(m, 0)),
                           m.now.acceleration);
  return report;
}

}  // namespace

SolveReport solve_initial_acceleration(Motion::Data& m, Real dt) {
  if (m.contact) {
    begin_contact(m);
    find_contacts(m, {});
    m.system.symmetric = contact::clear_tangents(m.system.contacts);
  }
  set_time(m, m.now.time);
  bolts::clear_tangents(m.bolts, m.system.terms, m.first_link);
  m.rock->begin_step(m.now.displacement, {});
  m.rock->drop_geometric_stiffness();  // the stiffness, without the part of the stress
  return set_in_motion(m, dt);
}

}  // namespace rockfold::motion
