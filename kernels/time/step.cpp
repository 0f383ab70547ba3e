#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "kernels/constraints/policy_kernel.hpp"
#include "kernels/time/step_kernel.hpp"
#include "src/base/interrupt.hpp"

namespace rockfold::motion {
namespace {

/// Share of the unbalanced forces that the solve of an iteration leaves (inexact Newton: Dembo, Eisenstat & Steihaug 1982) …
constexpr Real forcing = 1e-3;
/// … with factors, an iteration of which costs little beside their making, …
constexpr Real forcing_with_factors = 1e-6;
/// … or, where conjugate gradients get no further, may leave.
constexpr Real good_progress = 0.1;

/// Corrections that are taken whole where contacts feel no speeds: between states their law is linear, so that each correction solves for the states
/// that the one before came to, and mostly ten and less find them all. (A share of it, cut for a single loose block, leaves all others between
/// two guesses.) Those beyond may be going round in a ring. Impact is not linear: there each correction is cut.
constexpr int whole_corrections = 30;

/// Detections after which the contact points of a step are all there.
constexpr int most_detections = 6;

/// Share of the reference that may be unbalanced while bonds still break: what the last one leaves is balanced to the solver's tolerance.
constexpr Real rough_balance = 1e-3;

/// Of what acts on a block, what may be unbalanced: the tolerance's share of all forces may be more than a small block weighs beside large ones.
constexpr Real balance_of_a_block = 1e-4;

/// What Newton's iterations have come to.
struct Newton {
  Real enough = 0;         ///< of the reference that may be left; 0: the solver's tolerance
  bool corrected = false;  ///< in earlier iterations
  int iterations = 0;
  Real reference = 0;                                 ///< N
  Real left = std::numeric_limits<Real>::infinity();  ///< N, unbalanced
  Real gap = left;
  Real wanted = 0;  ///< N, below which nothing is balanced
  Real worst = 0;   ///< of what is unbalanced on a block over what may be
  Real least = 0;   ///< N, that a solve may leave
};

Step make_step(const Motion::Data& m, Real dt, const StepCourse& course) {
  const bool linear = m.rock->linear();
  Step step;
  step.dt = dt;
  step.stabilised = m.now.dynamic_ratio > 0;
  step.middle = m.average() && step.stabilised;
  step.walls = course.walls + (step.middle ? m.now.walls : 0);
  step.inertia =
      !linear || step.stabilised || m.now.steps == 0;  // else nothing moves before the solve
  step.rate = linear;
  if (m.contact && step.stabilised) step.speed_by_gap = m.gamma / (m.beta * dt);
  return step;
}

void set_tangent(Motion::Data& m, const Step& step) {
  const bool linear = m.rock->linear();
  if (linear && step.dt > 0 && m.step_length == step.dt) return;
  m.rock->linearise(m.now.displacement);
  if (m.contact)
    m.system.symmetric =
        contact::write_tangents(*m.contact, step.middle ? 2 : 1, m.system.contacts);
  bolts::write_tangents(m.bolts, m.system.terms, m.first_link);
  const Real of_mass = step.dt > 0 ? 1 / (m.beta * step.dt * step.dt) : 0,
             of_damping = step.dt > 0 ? m.gamma / (m.beta * step.dt) : 0;
  set_matrix(m,
             {1 + (step.rate ? of_damping * m.damping.stiffness : 0),
              of_mass + of_damping * m.damping.mass},
             of_damping, 1);
  m.step_length = step.dt;
}

finite::ForceRule force_rule(const Motion::Data& m, const Step& step) {
  finite::ForceRule rule;
  rule.middle = step.middle;
  rule.viscosity = m.damping.stiffness / step.dt * (step.middle ? 1 : m.gamma / m.beta);
  return rule;
}

/// Viscous stress of the step's start: with the middle rule the part of the strain rate that the dynamic ratio took away, else Newmark's
/// share of velocity and acceleration.
void carry_rate(Motion::Data& m, const Step& step) {
  const Real at_end = m.gamma / m.beta, damping = m.damping.stiffness;
  const Real of_rate = step.middle ? 0.5 * (1 / m.handed - 1) : 1 - at_end;
  if (damping > 0 && of_rate != 0)
    m.rock->carry_rate(m.now.velocity, damping * of_rate, m.now.acceleration,
                       step.middle ? 0 : damping * step.dt * (1 - 0.5 * at_end));
}

void begin(Motion::Data& m, const Step& step, bool time_stands) {
  const bool linear = m.rock->linear();
  m.system.begins_with_factors = m.now.begins_with_factors != 0;
  m.system.steady = linear;
  m.rock->begin_step(m.now.displacement, force_rule(m, step));
  Kokkos::deep_copy(m.system.springs.multiplier, 0.0);
  if (m.contact) {
    begin_contact(m);
    m.system.symmetric = contact::clear_tangents(m.system.contacts);
    m.system.factors.of_this_step = false;  // what a step does follows from the state at its start
  }
  if (!linear) carry_rate(m, step);
  if (!linear || step.middle) keep_start(m);
  keep_bolts(m);
  m.following.water = m.following.water_at_end;
  if (m.varying_loads.any()) varying_load(m.varying_loads, m.now.time, m.varying_before);
  if (step.stabilised) stabilise_supports(m, step.dt, step.middle);
  if (!time_stands) m.now.time += step.dt;
  set_time(m, m.now.time);
}

/// Whether rock on which nothing acts goes on as predicted: its own forces alone are left, by rounding.
bool flies_freely(const Motion::Data& m, const Forces& forces) {
  return !m.system.springs.any() && forces.loads == 0 && forces.inertia == 0 &&
         forces.internal <= m.rock->rounding(m.now.displacement);
}

/// Whether the forces are in balance, or cannot be brought there; `total` says which. Balanced forces must not turn rock inside out: elastic
/// forces of St. Venant and Kirchhoff vanish where nothing is left of it, and have an equilibrium beyond.
bool is_settled(Motion::Data& m, const Step& step, const Forces& forces, Newton& newton,
                SolveReport& total) {
  newton.reference = forces.reference;
  if (m.rock->linear()) return total.converged = step.dt > 0 && flies_freely(m, forces);
  const Real before = newton.left, gap_before = newton.gap;
  newton.left = find_imbalance(m, newton.reference);
  newton.reference = std::max(newton.reference, 1e-30);
  newton.gap = gap_of_supports(m, newton.reference);
  const Real rounding = m.rock->rounding(m.now.displacement) +
                        (m.contact ? contact::rounding(*m.contact) : 0) + bolts::rounding(m.bolts);
  newton.wanted = std::max(newton.enough, m.solver.tolerance) * newton.reference;
  newton.wanted = std::max(newton.wanted, 2 * rounding);
  newton.least = newton.wanted;
  if (m.contact) {
    const BlockBalance balance = find_balance(
        m.of_blocks, m.right, m.work, std::max(newton.enough, balance_of_a_block), 2 * rounding);
    newton.worst = balance.worst;
    newton.least = std::min(newton.wanted, balance.wanted);
  }
  total.residual = newton.left / newton.reference;
  total.gap = newton.gap;
  // Rounding alone: what is left is small, and another iteration would not take it away.
  const bool stalled = newton.left <= 32 * rounding && newton.left > 0.5 * before;
  // A gap that a solve does not halve stays: points contradict each other, and the report says by how much.
  const bool closed = newton.gap <= solve::closed_gap || newton.gap > 0.5 * gap_before;
  if ((newton.corrected || newton.iterations > 0) &&
      ((newton.left <= newton.wanted && newton.worst <= 1) || stalled) && closed) {
    total.inverted = m.rock->inverted(m.now.displacement, newton.wanted);
    total.converged = total.inverted == none;
    return true;
  }
  return !std::isfinite(newton.left);
}

/// How closely the correction is solved for: wholly where it is the only one; of smooth motions in statics little shows in the forces.
solve::ConstraintOptions correction_options(Motion::Data& m, const Step& step,
                                            const Newton& newton) {
  solve::ConstraintOptions how = solve_options(m, newton.reference);
  how.go_on = true;
  if (m.rock->linear()) {
    how.rounding = [&m](const Field& x) { return m.rock->rounding(x); };
    how.stop_at_rounding = step.dt == 0 || !step.stabilised;
    return how;
  }
  const bool factors = !m.contact && solve::policy_of(m.system).first == Preconditioner::direct;
  const Real inexact = step.dt > 0 ? (factors ? forcing_with_factors : forcing) * newton.left : 0;
  Real enough = std::max(0.1 * newton.least, inexact);
  // Where all forces together are in balance and those of a block are not, a correction must gain a digit.
  if (newton.worst > 1) enough = std::min(enough, 0.1 * newton.left);
  how.pcg.tolerance =
      std::max(enough, 0.5 * m.rock->rounding(m.now.displacement)) / newton.reference;
  return how;
}

/// The correction of the displacement, by the tangent, or by the part of it that is positive where the whole is not.
bool solve_correction(Motion::Data& m, const Step& step, const Newton& newton, SolveReport& total) {
  const solve::ConstraintOptions how = correction_options(m, step, newton);
  const Real good = m.rock->linear() || step.dt == 0 ? 0 : good_progress * newton.left;
  for (const bool material_only : {false, true}) {
    if (material_only) {
      m.rock->drop_geometric_stiffness();
      set_matrix(m, m.system.combination, m.dashpot_factor, 1);
    }
    Kokkos::deep_copy(m.correction, 0.0);
    total.add(solve::solve_constrained(m.system, m.right, m.prescribed, m.correction,
                                       m.now.displacement, how));
    leave_out_gone(m, m.correction);
    if (total.converged || total.residual * newton.reference < good) return true;
    if (m.rock->linear() || interrupt_signal) return false;
  }
  return false;
}

}  // namespace

void correct(const Motion::Data& m, const Step& step, Real share) {
  const auto d = m.now.displacement, v = m.now.velocity, a = m.now.acceleration, way = m.increment;
  const auto x = m.correction;
  const Real of_velocity = step.dt > 0 ? m.gamma / (m.beta * step.dt) : 0,
             of_acceleration = step.dt > 0 ? 1 / (m.beta * step.dt * step.dt) : 0;
  device::for_each(
      "rockfold::motion::correct", m.unknowns, KOKKOS_LAMBDA(const Index p) {
        for (int i = 0; i < 3; ++i) {
          const Real by = share * x(p, i);
          way(p, i) += by;
          d(p, i) += by;
          v(p, i) += of_velocity * by;
          a(p, i) += of_acceleration * by;
        }
      });
}

namespace {

/// Newton's iteration from the state as it is.
SolveReport balance_forces(Motion::Data& m, const Step& step, Newton newton = {}) {
  SolveReport total;
  Kokkos::deep_copy(m.correction, 0.0);
  const bool linear_states = m.contact && step.speed_by_gap == 0;
  if (linear_states) contact::forget_headings(*m.contact);
  Forces forces = find_residual(m, step);
  if (linear_states) hold_reversed(m, step);
  set_tangent(m, step);
  find_prescribed(m, step);
  for (;; ++newton.iterations) {
    total.converged = false;
    if (is_settled(m, step, forces, newton, total)) return total;
    if (newton.iterations == m.most_iterations) return total;
    if (newton.iterations > 0) {
      if (linear_states) hold_reversed(m, step);
      set_tangent(m, step);
    }
    if (linear_states) std::swap(m.right, m.held);
    const bool solved = solve_correction(m, step, newton, total);
    if (linear_states) std::swap(m.right, m.held);
    if (!solved && !m.rock->linear()) return total;
    ++total.newton;
    m.rock->turn(m.correction);
    if (m.contact && (!linear_states || newton.iterations >= whole_corrections)) {
      forces = correct_along_line(m, step);
      continue;
    }
    correct(m, step, 1);
    if (m.rock->linear()) return total;
    forces = find_residual(m, step);
    find_prescribed(m, step);
  }
}

/// Balanced forces break bonds, and bring blocks to where contact had not been looked for: then balance is sought again.
SolveReport balance_with_contact(Motion::Data& m, const Step& step) {
  Newton newton;
  newton.enough = rough_balance;
  SolveReport report = balance_forces(m, step, newton);
  newton.corrected = true;
  for (int detections = 0; report.converged;) {
    const bool broke = contact::break_bonds(m.contact->contacts, m.contact->motion) > 0;
    if (!broke && newton.enough == 0) {
      if (!misses_contacts(m, step, report)) break;
      report.converged = ++detections < most_detections;
      if (!report.converged) break;
    }
    newton.enough = broke ? rough_balance : 0;
    report.add(balance_forces(m, step, newton));
  }
  return report;
}

/// What is left to go is where the correction ended, or, after iterations, what they are now.
void count_supports(Motion::Data& m, bool middle) {
  if (!m.rock->linear()) Kokkos::deep_copy(m.correction, 0.0);
  update_reactions(m, middle);
}

}  // namespace

namespace {

/// The middle rule takes no notice of how velocity is gained within a step: the mean says more than what alternates about it.
void take_mean_acceleration(const Motion::Data& m, const Step& step) {
  const auto v = m.now.velocity, before = m.velocity_before, a = m.now.acceleration;
  const Real rate = 1 / step.dt;
  device::for_each(
      "rockfold::motion::mean_acceleration", m.unknowns, KOKKOS_LAMBDA(const Index p) {
        for (int i = 0; i < 3; ++i) a(p, i) = rate * (v(p, i) - before(p, i));
      });
}

/// Elements of blocks that something hits, for this step.
void stiffen_rebounding(Motion::Data& m, const Step& step) {
  if (step.speed_by_gap == 0) {
    Kokkos::deep_copy(m.rebounds.viscosity, 0.0);
    return;
  }
  find_viscosity(m.rebounds, m.of_blocks, *m.contact, m.system.contacts, step.dt);
  m.rock->stiffen(m.rebounds.viscosity, step.middle ? 1 : m.gamma / m.beta);
}

}  // namespace

SolveReport take_step(Motion::Data& m, Real dt, const StepCourse& course) {
  const Step step = make_step(m, dt, course);
  m.now.substep_energy = 0;
  begin(m, step, course.time_stands);
  predict(m, dt);
  if (m.contact) find_contacts(m, step);
  if (m.rebounds.any()) stiffen_rebounding(m, step);
  SolveReport report = m.contact ? balance_with_contact(m, step) : balance_forces(m, step);
  count_supports(m, step.middle);
  count_following_work(m);
  count_bolt_work(m);
  count_work(m, dt);
  count_wall_work(m, m.now.walls, course.walls);
  m.now.walls = course.walls;
  if (m.contact && report.converged) end_contact(m, step);
  if (report.converged) bolts::accept(m.bolts);
  if (step.middle) take_mean_acceleration(m, step);
  m.mean_over = step.middle ? dt : 0;
  m.now.begins_with_factors = m.system.begins_with_factors ? 1 : 0;
  ++m.now.steps;
  return report;
}

SolveReport solve_equilibrium(Motion::Data& m) {
  constexpr Real smallest = 1.0 / 4096;  // of the load
  m.now.time += 1;
  set_time(m, m.now.time);
  m.system.begins_with_factors = m.system.steady = false;
  m.rock->begin_step(m.now.displacement, {});
  keep_bolts(m);
  Kokkos::deep_copy(m.system.springs.multiplier, 0.0);
  Kokkos::deep_copy(m.increment, 0.0);
  const Field start = device::make_field("motion::start", m.unknowns);
  Kokkos::deep_copy(start, m.now.displacement);
  // All of the load at once; where that does not converge, in ever smaller parts.
  MovingState good;
  if (!m.rock->linear()) {
    good = make_moving_state(m.unknowns, m.system.springs.points.count, m.contact != nullptr);
    copy_state(m.now, good);
  }
  SolveReport total;
  Real done = 0, part = 1;
  Step step;  // rock is excavated only where blocks touch: walls are none
  while (done < 1) {
    step.load = std::min<Real>(1, done + part);
    const Index inverted = total.inverted;
    total.add(balance_forces(m, step));
    if (m.rock->linear()) break;
    if (total.converged) {
      done = step.load;
      part *= 2;
      copy_state(m.now, good);
      continue;
    }
    if (total.inverted == none) total.inverted = inverted;  // smaller parts may just not converge
    part /= 2;
    if (part < smallest || interrupt_signal) return total;
    copy_state(good, m.now);
  }
  const auto way = m.increment, d = m.now.displacement;
  device::for_each(
      "rockfold::motion::way", m.unknowns, KOKKOS_LAMBDA(const Index p) {
        for (int i = 0; i < 3; ++i) way(p, i) = d(p, i) - start(p, i);
      });
  count_supports(m, false);
  count_bolt_work(m);
  bolts::accept(m.bolts);
  count_loads_at_once(m);
  return total;
}

void hand_on(Motion::Data& m) {
  if (m.now.dynamic_ratio == 1 || m.now.steps == 0) return;
  const Real share = m.handed = m.now.dynamic_ratio;
  m.now.work.ratio += (1 - share * share) * kinetic_energy(m);
  if (m.contact) contact::scale_speeds(m.contact->contacts, share);
  const bool keep_acceleration = share > 0;
  const auto v = m.now.velocity, a = m.now.acceleration;
  device::for_each(
      "rockfold::motion::hand_on", m.unknowns, KOKKOS_LAMBDA(const Index p) {
        for (int d = 0; d < 3; ++d) {
          v(p, d) *= share;
          if (!keep_acceleration) a(p, d) = 0;
        }
      });
}

void begin_stage(Motion::Data& m, Real dynamic_ratio) {
  if (dynamic_ratio == 0 || m.now.dynamic_ratio == 0) {
    m.now.work.ratio += kinetic_energy(m);
    Kokkos::deep_copy(m.now.velocity, 0.0);
    Kokkos::deep_copy(m.now.acceleration, 0.0);
    m.now.substep_energy = 0;
  }
  find_pull_of_springs(m);  // the last step left its mean
  m.now.dynamic_ratio = dynamic_ratio;
  m.now.steps = 0;
  m.now.begins_with_factors = 0;
  m.step_length = 0;
  m.mean_over = 0;
  m.explicit_scheme.ready = false;
}

void set_matrix(Motion::Data& m, const solve::Combination& c, Real dashpots, Real springs) {
  m.dashpot_factor = dashpots;
  set_tangents(m.dashpots, dashpots, m.system.terms, m.system.springs.points.count);
  solve::set_combination(m.system, c, springs);
  m.step_length = 0;
}

void set_time(Motion::Data& m, Real t) {
  if (m.varying_loads.any()) varying_load(m.varying_loads, t, m.varying);
  move_supports(m.supports, t, m.system.springs);
}

solve::ConstraintOptions solve_options(Motion::Data& m, Real reference) {
  solve::ConstraintOptions how;
  how.pcg.tolerance = m.solver.tolerance;
  how.pcg.max_iterations = m.solver.max_iterations;
  how.pcg.reference = reference;
  how.pcg.rounding = m.rock->rounding(m.now.displacement);
  return how;
}

}  // namespace rockfold::motion
