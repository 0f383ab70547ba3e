// Steps and equilibrium under large kinematics, by Newton's method.
//
// With β = 1/4, γ = 1/2 and a velocity that is handed on, forces are taken as Simo & Tarnow (1992) take them: the mean of both ends
// of the momentum balance, with the internal force F(middle) · mean S. Momentum, angular momentum and energy are then kept
// to the accuracy of the solution, whatever the step. Other β, γ balance forces at the step's end, as under small strain.
//
// In each step M (a + a')/2 + f = (F + F')/2 is solved twice over: M (a + a') + 2 f = F + F', whose matrix is Newmark's.
#include <algorithm>
#include <cmath>
#include <limits>

#include "kernels/update/motion_kernel.hpp"
#include "src/base/interrupt.hpp"

namespace rockfold::update {
namespace {

using device::Sums;

constexpr int most_iterations = 60;
/// Share of the unbalanced forces that the solve of an iteration leaves (inexact Newton: Dembo, Eisenstat & Steihaug 1982) …
constexpr Real forcing = 1e-3;
/// … or, where conjugate gradients get no further, may leave.
constexpr Real good_progress = 0.1;

/// What a step of large kinematics balances.
struct Balance {
  Real dt = 0;           ///< s; 0: equilibrium, without inertia
  bool middle = false;   ///< twice the mean of both ends
  bool steered = false;  ///< augmented points go as supports.cpp says, not straight to their places
  Real load = 1;         ///< share of the loads and of the supports' way, in equilibrium
};

/// w = a + α v, of both ends where `middle`.
void inertia_motion(const Motion::Data& m, const Balance& balance, const Field& w) {
  const auto v = m.now.velocity, a = m.now.acceleration;
  const auto v0 = m.velocity_before, a0 = m.acceleration_before;
  const Real of_velocity = m.damping.mass, of_start = balance.middle ? 1 : 0,
             whole = balance.middle ? 1 / m.handed : 0;
  device::for_each(
      "rockfold::update::large_inertia", m.unknowns, KOKKOS_LAMBDA(const Index p) {
        for (int i = 0; i < 3; ++i)
          w(p, i) = a(p, i) + of_start * a0(p, i) + of_velocity * (v(p, i) + whole * v0(p, i));
      });
}

/// v' (+ v, as it was when forces were balanced with it)
void damped_velocity(const Motion::Data& m, const Balance& balance, const Field& w) {
  const auto v = m.now.velocity, v0 = m.velocity_before;
  const Real of_start = balance.middle ? 1 / m.handed : 0;
  device::for_each(
      "rockfold::update::damped_velocity", m.unknowns, KOKKOS_LAMBDA(const Index p) {
        for (int i = 0; i < 3; ++i) w(p, i) = v(p, i) + of_start * v0(p, i);
      });
}

/// Takes the pressures that follow off the internal force in `work`, so that both change together.
void follow(Motion::Data& m, const Balance& balance) {
  // Internal forces are doubled later in the middle rule: of both ends half each.
  const Real share = balance.load * (balance.middle ? 0.5 : 1);
  add_following_pressures(m.following, m.now.time, m.now.displacement, -share, m.work);
  if (!balance.middle) return;
  const Field before = m.following_before, work = m.work;
  device::for_each(
      "rockfold::update::following_before", m.unknowns, KOKKOS_LAMBDA(const Index p) {
        for (int i = 0; i < 3; ++i) work(p, i) -= 0.5 * before(p, i);
      });
}

/// right = what is not balanced, the supports left out. Returns the largest norm of loads, inertia and internal forces, each by
/// itself.
Real find_residual(Motion::Data& m, const Balance& balance) {
  Kokkos::deep_copy(m.right, 0.0);
  if (balance.dt > 0) {
    inertia_motion(m, balance, m.work);
    m.rock->apply({0, 1}, m.work, m.right);
    if (m.dashpots.any()) {
      damped_velocity(m, balance, m.work);
      add_dashpots(m.dashpots, 1, m.work, m.right);
    }
  }
  m.rock->force(m.now.displacement, m.work);
  Real reference = m.initial_force;
  if (m.following.any()) {
    reference = std::max(reference, std::sqrt(solve::dot(m.held.work, m.work, m.work)));
    follow(m, balance);
  }
  const auto load = m.load, varying = m.varying, before = m.varying_before, right = m.right,
             internal = m.work;
  const bool varies = m.varying_loads.any(), middle = balance.middle;
  const Real times = middle ? 2 : 1, share = balance.load;
  const auto out = m.sums;
  device::sum_then<3>(
      "rockfold::update::large_residual", m.unknowns, m.partial,
      KOKKOS_LAMBDA(const Index p, Sums<3>& sum) {
        for (int d = 0; d < 3; ++d) {
          const Real constant = share * times * load(p, d);
          const Real changing = varies ? share * (varying(p, d) + (middle ? before(p, d) : 0)) : 0;
          const Real f = constant + changing, inner = times * internal(p, d);
          sum.value[0] += constant * constant + changing * changing;
          sum.value[1] += right(p, d) * right(p, d);
          sum.value[2] += inner * inner;
          right(p, d) = f - right(p, d) - inner;
        }
      },
      KOKKOS_LAMBDA(const Sums<3>& sum) {
        for (int k = 0; k < 3; ++k) out(k) = sum.value[k];
      });
  const std::vector<Real> squares = device::to_host(m.sums);
  return std::max(reference, std::sqrt(std::max({squares[0], squares[1], squares[2]})));
}

/// goal = what supports still have to go; in the middle, springs pull with the mean of both ends.
void aim(const Motion::Data& m, const Balance& balance) {
  const solve::Springs s = m.held.springs;
  const auto d = m.now.displacement, goal = m.goal, before = m.goal_before;
  const auto increment = m.increment, way = m.support_way;
  const bool middle = balance.middle, steered = balance.steered;
  const Real share = balance.load;
  device::for_each(
      "rockfold::update::large_aim", s.points.count, KOKKOS_LAMBDA(const Index n) {
        for (int i = 0; i < 3; ++i) {
          if (steered && s.augmented(n, i) > 0)
            goal(n, i) = way(n, i) - solve::interpolate_one(s.points, n, i, increment);
          else
            goal(n, i) = share * s.target(n, i) - solve::interpolate_one(s.points, n, i, d);
          if (middle && !(s.augmented(n, i) > 0)) goal(n, i) += before(n, i);
        }
      });
}

/// goal_before = what springs are stretched by at the step's start; at that of the first they pull as the first acceleration has it, not
/// as rock does that has not given way to them yet.
void aim_at_start(Motion::Data& m) {
  update::aim(m);
  const solve::Springs s = m.held.springs;
  const auto goal = m.goal, before = m.goal_before, reaction = m.now.reaction;
  const bool first = m.now.steps == 0;
  device::for_each(
      "rockfold::update::aim_at_start", s.points.count, KOKKOS_LAMBDA(const Index n) {
        for (int i = 0; i < 3; ++i) {
          const Real k = s.given_stiffness(n, i);
          before(n, i) = first && k > 0 ? reaction(n, i) / k : goal(n, i);
        }
      });
}

/// ‖right + forces of the supports‖, N. `reference` becomes the norm of the latter, if that is larger.
Real unbalanced(Motion::Data& m, Real& reference) {
  const Field work = m.work, right = m.right;
  Kokkos::deep_copy(work, 0.0);
  solve::add_spring_load(m.held.springs, m.held.spring_factor, m.goal, work);
  const auto out = m.sums;
  device::sum_then<2>(
      "rockfold::update::unbalanced", m.unknowns, m.partial,
      KOKKOS_LAMBDA(const Index p, Sums<2>& sum) {
        for (int d = 0; d < 3; ++d) {
          const Real left = right(p, d) + work(p, d);
          sum.value[0] += work(p, d) * work(p, d);
          sum.value[1] += left * left;
        }
      },
      KOKKOS_LAMBDA(const Sums<2>& sum) {
        for (int k = 0; k < 2; ++k) out(k) = sum.value[k];
      });
  const std::vector<Real> squares = device::to_host(m.sums);
  reference = std::max(reference, std::sqrt(squares[0]));
  return std::sqrt(squares[1]);
}

/// Supports' largest distance from their places over the largest displacement, or over what forces of the size `reference` would
/// move the stiffest cover by: where forces cancel nothing moves.
Real gap_of_supports(Motion::Data& m, Real reference) {
  const solve::Springs s = m.held.springs;
  if (!s.any()) return 0;
  const auto goal = m.goal;
  const Real gap = device::largest(
      "rockfold::update::large_gap", s.points.count, KOKKOS_LAMBDA(const Index n) {
        Real worst = 0;
        for (int d = 0; d < 3; ++d)
          if (s.augmented(n, d) > 0)
            worst = device::math::fmax(worst, s.reach(n) * device::math::fabs(goal(n, d)));
        return worst;
      });
  if (!(gap > 0)) return 0;
  const Real diagonal = m.held.largest_diagonal;
  const Real least = diagonal > 0 ? reference / diagonal : 0;
  return gap / std::max({solve::largest_motion(m.held, m.now.displacement, Field()), gap, least});
}

/// d' += x, and what follows from it.
void correct(const Motion::Data& m, const Balance& balance) {
  const auto d = m.now.displacement, v = m.now.velocity, a = m.now.acceleration, way = m.increment;
  const auto x = m.correction;
  const Real of_velocity = balance.dt > 0 ? m.gamma / (m.beta * balance.dt) : 0,
             of_acceleration = balance.dt > 0 ? 1 / (m.beta * balance.dt * balance.dt) : 0;
  device::for_each(
      "rockfold::update::large_correct", m.unknowns, KOKKOS_LAMBDA(const Index p) {
        for (int i = 0; i < 3; ++i) {
          way(p, i) += x(p, i);
          d(p, i) += x(p, i);
          v(p, i) += of_velocity * x(p, i);
          a(p, i) += of_acceleration * x(p, i);
        }
      });
}

void set_tangent(Motion::Data& m, const Balance& balance, bool first) {
  m.rock->linearise(m.now.displacement);
  const Real of_mass = balance.dt > 0 ? 1 / (m.beta * balance.dt * balance.dt) : 0,
             of_damping = balance.dt > 0 ? m.gamma / (m.beta * balance.dt) : 0;
  set_matrix(m, {1, of_mass + of_damping * m.damping.mass}, of_damping, 1, first);
}

/// Newton's iteration from the state as it is. Steps of a tangent that is not positive are taken with the part of it that is.
/// `wanted`: the force, N, below which nothing is balanced.
SolveReport iterate(Motion::Data& m, const Balance& balance, Real& wanted) {
  SolveReport total;
  total.converged = false;
  const auto count = [&](const SolveReport& solve) {
    total.iterations += solve.iterations;
    total.outer += solve.outer;
    total.fallbacks += solve.fallbacks;
    total.preconditioner = solve.preconditioner;
  };
  Real before = std::numeric_limits<Real>::infinity(), gap_before = before;
  for (int i = 0; i < most_iterations; ++i) {
    Real reference = find_residual(m, balance);
    aim(m, balance);
    const Real left = unbalanced(m, reference);
    reference = std::max(reference, 1e-30);
    total.residual = left / reference;
    total.gap = gap_of_supports(m, reference);
    const Real rounding = m.rock->rounding(m.now.displacement);
    wanted = std::max(m.solver.tolerance * reference, 16 * rounding);
    // Rounding alone: what is left is small, and another iteration would not take it away.
    const Real cancelled = std::max<Real>(1, m.large->largest_terms(m.now.displacement));
    const bool stalled = left <= 256 * cancelled * rounding && left > 0.5 * before;
    const bool inexact = balance.dt > 0;
    before = left;
    // A gap that whole solves do not halve stays: the report says how large it is, as under small strain.
    const bool closed = total.gap <= m.solver.gap_tolerance || total.gap > 0.5 * gap_before;
    gap_before = total.gap;
    if (i > 0 && (left <= wanted || stalled) && closed) {
      total.converged = true;
      return total;
    }
    if (!std::isfinite(left)) return total;
    solve::HeldOptions how = solve_options(m, reference);
    // Statics is solved closely: of smooth motions little shows in the forces.
    how.pcg.tolerance =
        std::max({0.1 * wanted, inexact ? forcing * left : 0, 4 * rounding}) / reference;
    const Real good = inexact ? good_progress * left : 0;
    if (balance.dt == 0 || !balance.steered) {
      close_gaps(how);
      how.plain_at_last = false;  // the next iteration goes on
    }
    how.gap_tolerance *= 0.5;  // measured against another reference there
    set_tangent(m, balance, i == 0);
    Kokkos::deep_copy(m.correction, 0.0);
    SolveReport report =
        solve::solve_held(m.held, m.right, m.goal, m.correction, m.now.displacement, how);
    count(report);
    if (!report.converged && interrupt_signal) return total;
    if (!report.converged && !(report.residual * reference < good)) {
      m.large->soften();
      set_matrix(m, m.held.combination, m.dashpot_factor, 1, false);
      Kokkos::deep_copy(m.correction, 0.0);
      report = solve::solve_held(m.held, m.right, m.goal, m.correction, m.now.displacement, how);
      count(report);
      if (!report.converged && !(report.residual * reference < good)) {
        total.residual = report.residual;  // of the solve that failed
        return total;
      }
    }
    m.large->turn(m.correction);
    correct(m, balance);
  }
  return total;
}

/// Balanced forces that turn no rock inside out: elastic forces of St. Venant and Kirchhoff vanish where nothing is left of it, and
/// have an equilibrium beyond.
SolveReport balance_forces(Motion::Data& m, const Balance& balance) {
  Real wanted = 0;
  SolveReport report = iterate(m, balance, wanted);
  if (report.converged) report.inverted = m.large->inverted(m.now.displacement, wanted);
  report.converged = report.converged && report.inverted == none;
  return report;
}

/// Forces of the supports over the step, mean where `middle`, and their work.
void count_support_work(Motion::Data& m, const Balance& balance) {
  const solve::Springs s = m.held.springs;
  if (!s.any()) return;
  Kokkos::deep_copy(m.correction, 0.0);
  const auto way = m.increment, before = m.now.reaction;
  const auto out = m.sums;
  const bool middle = balance.middle;
  solve::spring_reactions(s, m.held.spring_factor, m.correction, m.goal, s.force);
  device::sum_then<1>(
      "rockfold::update::large_support_work", s.points.count, m.partial,
      KOKKOS_LAMBDA(const Index n, Sums<1>& sum) {
        for (int d = 0; d < 3; ++d) {
          const Real now = middle ? 0.5 * s.force(n, d) : s.force(n, d);
          const Real mean = middle ? now : 0.5 * (before(n, d) + now);
          sum.value[0] += mean * solve::interpolate_one(s.points, n, d, way);
          before(n, d) = now;
        }
      },
      KOKKOS_LAMBDA(const Sums<1>& sum) { out(0) = sum.value[0]; });
  m.now.work.supports += device::to_host(m.sums)[0];
}

/// Work of pressures that follow their faces.
void count_following_work(Motion::Data& m) {
  if (!m.following.any()) return;
  Kokkos::deep_copy(m.work, m.following_before);
  add_following_pressures(m.following, m.now.time, m.now.displacement, 1, m.work);
  m.now.work.loads += 0.5 * solve::dot(m.held.work, m.work, m.increment);
}

/// Work of changing loads and of pressures that follow, put on at once where nothing has moved yet: `increment` is the way.
void count_loads_at_once(Motion::Data& m) {
  Real& work = m.now.work.loads;
  if (m.varying_loads.any()) work += solve::dot(m.held.work, m.varying, m.increment);
  if (!m.following.any()) return;
  const Field in_place = m.correction;
  Kokkos::deep_copy(in_place, 0.0);
  Kokkos::deep_copy(m.work, 0.0);
  add_following_pressures(m.following, m.now.time, in_place, 0.5, m.work);
  add_following_pressures(m.following, m.now.time, m.now.displacement, 0.5, m.work);
  work += solve::dot(m.held.work, m.work, m.increment);
}

}  // namespace

SolveReport advance_large(Motion::Data& m, Real dt) {
  Balance balance;
  balance.dt = dt;
  balance.steered = m.dynamic_ratio > 0;
  balance.middle = m.beta == 0.25 && m.gamma == 0.5 && balance.steered;
  finite::ForceRule rule;
  rule.middle = balance.middle;
  const Real at_end = m.gamma / m.beta, damping = m.damping.stiffness;
  rule.viscosity = damping / dt * (rule.middle ? 1 : at_end);

  if (m.now.steps > 0) leave_out_idle_motion(m);  // with the matrix of the step before
  if (m.varying_loads.any()) varying_load(m.varying_loads, m.now.time, m.varying_before);
  Kokkos::deep_copy(m.velocity_before, m.now.velocity);
  Kokkos::deep_copy(m.acceleration_before, m.now.acceleration);
  aim_at_start(m);
  if (m.following.any()) {
    Kokkos::deep_copy(m.following_before, 0.0);
    add_following_pressures(m.following, m.now.time, m.now.displacement, 1, m.following_before);
  }
  m.large->begin_step(m.now.displacement, rule);
  // Half of the rate that was not handed on is missing in the mean over the step.
  const Real of_rate = rule.middle ? 0.5 * (1 / m.handed - 1) : 1 - at_end;
  if (damping > 0 && of_rate != 0)
    m.large->carry_rate(m.now.velocity, damping * of_rate, m.now.acceleration,
                        rule.middle ? 0 : damping * dt * (1 - 0.5 * at_end));
  if (balance.steered) steer(m, dt);
  m.now.time += dt;
  set_time(m, m.now.time);
  predict(m, dt);
  const SolveReport report = balance_forces(m, balance);
  count_support_work(m, balance);
  count_following_work(m);
  count_work(m, dt);
  ++m.now.steps;
  return report;
}

SolveReport solve_equilibrium_large(Motion::Data& m) {
  m.now.time = 1;
  set_time(m, m.now.time);
  m.large->begin_step(m.now.displacement, {});
  Kokkos::deep_copy(m.increment, 0.0);
  // All of the load at once; where that does not converge, in ever smaller parts.
  constexpr Real smallest = 1.0 / 4096;
  MovingState good = make_moving_state(m.unknowns, m.held.springs.points.count);
  copy_state(m.now, good);
  SolveReport total;
  Real done = 0, part = 1;
  while (done < 1) {
    Balance balance;
    balance.load = std::min<Real>(1, done + part);
    const SolveReport report = balance_forces(m, balance);
    const Index inverted = total.inverted;
    total.add(report);
    if (report.inverted == none && !report.converged)
      total.inverted = inverted;  // smaller parts may just not converge
    if (report.converged) {
      done = balance.load;
      part *= 2;
      copy_state(m.now, good);
      continue;
    }
    part /= 2;
    if (part < smallest || interrupt_signal) return total;
    copy_state(good, m.now);
  }
  Balance balance;
  aim(m, balance);
  const auto way = m.increment, d = m.now.displacement;
  Kokkos::deep_copy(way, d);
  count_support_work(m, balance);
  count_loads_at_once(m);
  return total;
}

}  // namespace rockfold::update
