// Where a motion begins: the first velocity and acceleration.
#include <algorithm>

#include "kernels/time/step_kernel.hpp"
#include "src/base/interrupt.hpp"
#include "src/base/vector.hpp"

namespace rockfold::motion {
namespace {

/// Iteration limit of a solve with the mass matrix alone, for covers of several functions.
constexpr Index limit_with_mass = 1000;
/// A mode of frequency ω with βΔt² ω² above the inverse of this share decays within one step.
constexpr Real fast_mode_share = 1e-3;
/// α of the regularised mass M + αK, over the weight βΔt² that a step gives to K. Slow modes change by a tenth of β(ωΔt)².
constexpr Real smoothing_share = 0.1;

/// Second tolerance of the solve with the mass matrix alone.
constexpr Real attainable = 1e-8;

/// How steps of length dt will hold the rock that begins to move.
struct Beginning {
  Real hold = 0;       ///< β Δt²: factor of the springs
  Real stiffness = 0;  ///< βΔt² + γΔt · β of Rayleigh: weight of the stiffness beside the mass
};

/// Whether modes that decay within one step dominate the motion x. Slivers have such modes: they have stiffness and next to no mass.
bool is_fast(Motion::Data& m, const Beginning& begin, const Field& x) {
  auto energy = [&](const solve::Combination& c) {
    m.rock->apply(c, x, m.work);
    return solve::dot(m.system.work, x, m.work);
  };
  return energy({fast_mode_share * begin.stiffness, 0}) > energy({0, 1});
}

/// The velocity nearest to the present one, measured by M + αK, that goes with the points held. `stiffness`: α.
SolveReport project_velocity(Motion::Data& m, const Beginning& begin, Real stiffness) {
  const solve::Combination c{stiffness, 1};
  set_matrix(m, c, 0, begin.hold);
  m.rock->apply(c, m.now.velocity, m.right);
  prescribe_velocity(m);
  const SolveReport report = solve::solve_constrained(m.system, m.right, m.prescribed,
                                                      m.now.velocity, Field(), solve_options(m, 0));
  return report;
}

/// Projects the initial velocity on what points held prescribe, in the norm of the mass matrix. A velocity that contradicts its
/// supports would oscillate about their tables' slope in every later step.
SolveReport catch_up_with_supports(Motion::Data& m, const Beginning& begin) {
  const Real before = kinetic_energy(m);
  const bool moving = m.supports.tables.any() && m.supports.tables.moving_after(m.now.time);
  if (!moving && !(before > 0 && m.system.springs.any() && m.system.constraints.any_held))
    return {};
  const Field v = m.now.velocity, given = m.increment, change = m.correction;
  Kokkos::deep_copy(given, v);
  SolveReport report = project_velocity(m, begin, 0);
  device::for_each(
      "rockfold::motion::change_of_velocity", m.unknowns, KOKKOS_LAMBDA(const Index p) {
        for (int i = 0; i < 3; ++i) change(p, i) = v(p, i) - given(p, i);
      });
  if (report.converged && is_fast(m, begin, change)) {
    Kokkos::deep_copy(v, given);
    report.add(project_velocity(m, begin, smoothing_share * begin.stiffness));
  }
  m.now.work.supports += kinetic_energy(m) - before;
  return report;
}

/// The acceleration at the start, from (M + αK) a = F − C v − f(d), `stiffness` = α; the iterations of `total` are counted on.
SolveReport find_acceleration(Motion::Data& m, const Beginning& begin, Real stiffness,
                              Real tolerance, Index most_iterations, const SolveReport& total) {
  set_matrix(m, {stiffness, 1}, 0, begin.hold);
  Kokkos::deep_copy(m.now.acceleration, 0.0);
  Step step;
  step.inertia = step.rate = m.damped();
  const Real reference = find_residual(m, step).reference;
  prescribe_acceleration(m);
  const std::vector<Vec3> guess = uniform_field(m.unknowns, m.covers, m.gravity);
  device::copy_to_device(guess, m.now.acceleration);
  solve::ConstraintOptions how = solve_options(m, reference);
  how.pcg.tolerance = tolerance;
  how.pcg.max_iterations = std::min(how.pcg.max_iterations, most_iterations);
  // The mass resists whatever rounding leaves of the forces of strain, where these are not all there is.
  if (how.pcg.rounding < how.pcg.tolerance * reference) how.pcg.rounding = 0;
  SolveReport report = total;
  report.add(
      solve::solve_constrained(m.system, m.right, m.prescribed, m.now.acceleration, Field(), how));
  return report;
}

/// a = g, less what the base has.
void fall_freely(const Motion::Data& m) {
  const TimeTable& base = m.varying_loads.base;
  const Vec3 fall = base.empty() ? m.gravity : m.gravity - base.at(m.now.time);
  device::copy_to_device(uniform_field(m.unknowns, m.covers, fall), m.now.acceleration);
}

/// The velocity and the acceleration at the start, from M a = f. Where that does not converge, or gives fast modes to a scheme that turns
/// them into displacement, from (M + αK) a = f: functions of slivers have stiffness and next to no mass.
SolveReport set_in_motion(Motion::Data& m, const Beginning& begin) {
  const SolveReport caught = catch_up_with_supports(m, begin);
  if (!caught.converged) return caught;
  if (m.average()) {
    if (!m.system.springs.any()) fall_freely(m);
    return caught;
  }
  const bool several = m.system.op.functions > 1;
  const Index most = m.solver.max_iterations, few = several ? limit_with_mass : most;
  const Real tolerance = m.solver.tolerance;
  SolveReport report = find_acceleration(m, begin, 0, tolerance, few, caught);
  if (!report.converged && tolerance < attainable && !interrupt_signal)
    report = find_acceleration(m, begin, 0, attainable, few, report);
  const bool stuck = several || report.iterations < most;
  if (report.converged ? is_fast(m, begin, m.now.acceleration) : stuck && !interrupt_signal)
    report =
        find_acceleration(m, begin, smoothing_share * begin.stiffness, tolerance, most, report);
  if (m.system.springs.any())
    solve::spring_reactions(m.system.springs, m.now.acceleration, m.prescribed, m.now.reaction);
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
  const Real hold = m.beta * dt * dt;
  m.rock->begin_step(m.now.displacement, {});
  m.rock->drop_geometric_stiffness();  // the stiffness, without the part of the stress
  const SolveReport report = set_in_motion(m, {hold, hold + m.gamma * dt * m.damping.stiffness});
  return report;
}

}  // namespace rockfold::motion
