// Where a motion begins: the first acceleration; and where it ends: equilibrium.
#include <algorithm>

#include "kernels/update/motion_kernel.hpp"

namespace rockfold::update {
namespace {

/// A support that starts with a velocity takes the rock along: the velocity nearest to that given, measured by mass, that
/// goes with the augmented points. Else theirs would swing about their tables' slope for ever.
SolveReport catch_up_with_supports(Motion::Data& m) {
  if (!m.supports.tables.any() || !m.supports.tables.moving_after(m.now.time)) return {};
  const Real before = kinetic_energy(m);
  m.rock->apply({0, 1}, m.now.velocity, m.right);
  aim_velocity(m);
  const SolveReport report =
      solve::solve_held(m.held, m.right, m.goal, m.now.velocity, Field(), solve_options(m, 0));
  Kokkos::deep_copy(m.now.multiplier, 0.0);  // of a blow, not of a force
  m.now.work.supports += kinetic_energy(m) - before;
  return report;
}

}  // namespace

SolveReport solve_initial_acceleration(Motion::Data& m, Real dt) {
  set_time(m, m.now.time);
  const Real hold = m.beta * dt * dt;
  set_matrix(m, {1, 1 / hold}, 0, 1, true);  // chooses the springs' stiffness
  set_matrix(m, {0, 1}, 0, hold, false);
  const SolveReport caught = catch_up_with_supports(m);
  if (!caught.converged) return caught;
  Kokkos::deep_copy(m.now.acceleration, 0.0);
  const Real reference = find_residual(m, m.damped());
  aim_acceleration(m);
  const std::vector<Vec3> guess = uniform_field(m.unknowns, m.covers, m.gravity);
  device::copy_to_device(guess, m.now.acceleration);
  SolveReport report = solve::solve_held(m.held, m.right, m.goal, m.now.acceleration, Field(),
                                         solve_options(m, reference));
  report.iterations += caught.iterations;
  if (m.held.springs.any())
    solve::spring_reactions(m.held.springs, m.held.spring_factor, m.now.acceleration, m.goal,
                            m.now.reaction);
  return report;
}

SolveReport solve_equilibrium(Motion::Data& m) {
  m.now.time = 1;
  set_time(m, m.now.time);
  set_matrix(m, {1, 0}, 0, 1, true);
  const Real reference = find_residual(m, false);
  aim(m);
  Kokkos::deep_copy(m.correction, 0.0);
  // There is no next step in which the multipliers could go on.
  solve::HeldOptions how = solve_options(m, reference);
  how.patience = 40;
  how.plain_at_last = true;
  how.max_outer = std::max<Index>(how.max_outer, 400);
  const SolveReport report =
      solve::solve_held(m.held, m.right, m.goal, m.correction, m.now.displacement, how);
  Kokkos::deep_copy(m.increment, m.correction);
  const auto d = m.now.displacement, x = m.correction;
  device::for_each(
      "rockfold::update::displace", m.unknowns, KOKKOS_LAMBDA(const Index p) {
        for (int i = 0; i < 3; ++i) d(p, i) += x(p, i);
      });
  update_reactions(m);
  return report;
}

}  // namespace rockfold::update
