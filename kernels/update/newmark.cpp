#include <algorithm>
#include <cmath>

#include "kernels/update/motion_kernel.hpp"

namespace rockfold::update {
namespace {

using device::Sums;
using solve::Combination;

constexpr Combination stiffness_only{1, 0};
constexpr Combination mass_only{0, 1};

Index covers_of(const Motion::Data& m) {
  return m.held.op.unknowns;
}
Index fixed_of(const Motion::Data& m) {
  return m.held.springs.points.count;
}

void prepare(Motion::Data& m, Real dt) {
  if (m.step_length == dt) return;
  solve::set_combination(m.held, {1, 1 / (m.beta * dt * dt)}, 1, true);
  m.step_length = dt;
}

/// right = F + inertia − K d, inertia in `right` before. Returns the largest norm of F and K d: what the right-hand side is made of,
/// and what residuals are measured against where it vanishes (near equilibrium).
Real balance_forces(const Motion::Data& m, bool inertia) {
  solve::apply(m.held.op, stiffness_only, m.now.displacement, m.work);
  const auto load = m.load, right = m.right, internal = m.work;
  const auto out = m.sums;
  device::sum_then<2>(
      "rockfold::update::balance_forces", m.held.op.unknowns, m.partial,
      KOKKOS_LAMBDA(const Index p, Sums<2>& sum) {
        for (int d = 0; d < 3; ++d) {
          sum.value[0] += load(p, d) * load(p, d);
          sum.value[1] += internal(p, d) * internal(p, d);
          right(p, d) = load(p, d) - internal(p, d) + (inertia ? right(p, d) : 0);
        }
      },
      KOKKOS_LAMBDA(const Sums<2>& sum) {
        for (int k = 0; k < 2; ++k) out(k) = sum.value[k];
      });
  const std::vector<Real> squares = device::to_host(m.sums);
  return std::sqrt(std::max(squares[0], squares[1]));
}

/// right = M (v / (βΔt) + (1/(2β) − 1) a).
void inertia_forces(const Motion::Data& m, Real dt) {
  const auto v = m.now.velocity, a = m.now.acceleration, w = m.work;
  const Real of_velocity = 1 / (m.beta * dt), of_acceleration = 1 / (2 * m.beta) - 1;
  device::for_each(
      "rockfold::update::inertia", covers_of(m), KOKKOS_LAMBDA(const Index p) {
        for (int d = 0; d < 3; ++d) w(p, d) = of_velocity * v(p, d) + of_acceleration * a(p, d);
      });
  solve::apply(m.held.op, mass_only, w, m.right);
}

/// Δd = Δt v + Δt²/2 a: exact for free flight, and the start of the solution otherwise.
void predict(const Motion::Data& m, Real dt) {
  const auto v = m.now.velocity, a = m.now.acceleration, x = m.increment;
  device::for_each(
      "rockfold::update::predict", covers_of(m), KOKKOS_LAMBDA(const Index p) {
        for (int d = 0; d < 3; ++d) x(p, d) = dt * v(p, d) + 0.5 * dt * dt * a(p, d);
      });
}

/// goal = ū − N d: how far the fixed points still have to go.
void aim(const Motion::Data& m) {
  const solve::Springs s = m.held.springs;
  const auto d = m.now.displacement, goal = m.goal;
  device::for_each(
      "rockfold::update::aim", fixed_of(m), KOKKOS_LAMBDA(const Index n) {
        for (int i = 0; i < 3; ++i)
          goal(n, i) = s.target(n, i) - solve::interpolate_one(s.points, n, i, d);
      });
}

/// a' = a + (Δd − predicted) / (βΔt²): equal to Eq. 4-21 for β = 1/4, but exact in free flight.
void move_covers(const Motion::Data& m, Real dt) {
  const auto d = m.now.displacement, v = m.now.velocity, a = m.now.acceleration, x = m.increment;
  const Real beta = m.beta, gamma = m.gamma;
  device::for_each(
      "rockfold::update::move", covers_of(m), KOKKOS_LAMBDA(const Index p) {
        for (int i = 0; i < 3; ++i) {
          const Real before = a(p, i), predicted = dt * v(p, i) + 0.5 * dt * dt * before;
          const Real after = before + (x(p, i) - predicted) / (beta * dt * dt);
          d(p, i) += x(p, i);
          v(p, i) += dt * ((1 - gamma) * before + gamma * after);
          a(p, i) = after;
        }
      });
}

/// Reactions to the new positions, and the work of the supports: mean force times way.
void update_reactions(Motion::Data& m) {
  const solve::Springs s = m.held.springs;
  if (!s.any()) return;
  const auto x = m.increment, before = m.now.reaction, goal = m.goal;
  const auto out = m.sums;
  solve::spring_reactions(s, m.held.spring_factor, x, goal, s.force);
  device::sum_then<1>(
      "rockfold::update::support_work", s.points.count, m.partial,
      KOKKOS_LAMBDA(const Index n, Sums<1>& sum) {
        for (int d = 0; d < 3; ++d) {
          sum.value[0] +=
              0.5 * (before(n, d) + s.force(n, d)) * solve::interpolate_one(s.points, n, d, x);
          before(n, d) = s.force(n, d);
        }
      },
      KOKKOS_LAMBDA(const Sums<1>& sum) { out(0) = sum.value[0]; });
  m.now.support_work += device::to_host(m.sums)[0];
}

solve::HeldOptions options(const Motion::Data& m, Real reference) {
  solve::HeldOptions how;
  how.pcg.tolerance = m.solver.tolerance;
  how.pcg.max_iterations = m.solver.max_iterations;
  how.pcg.reference = reference;
  how.gap_tolerance = m.solver.gap_tolerance;
  how.max_outer = m.solver.max_outer;
  return how;
}

}  // namespace

void make_load(Motion::Data& m, const MotionSetup& setup) {
  // Weights sum to one, so ∫ρ N dV b is the mass matrix times the uniform field b.
  std::vector<Vec3> field(m.held.op.unknowns);
  std::fill_n(field.begin(), m.held.op.covers, setup.gravity);  // the functions 0 are one
  device::copy_to_device(field, m.work);
  solve::apply(m.held.op, mass_only, m.work, m.load);
  if (setup.forces.empty()) return;
  field = device::copy_to_host(m.load);
  for (std::size_t n = 0; n < setup.forces.size(); ++n)
    for (Index i = setup.loaded.begin[n]; i < setup.loaded.begin[n + 1]; ++i)
      for (int d = 0; d < 3; ++d)
        field[setup.loaded.unknown[i]][d] += setup.loaded.weight[i] * setup.forces[n][d];
  device::copy_to_device(field, m.load);
}

SolveReport solve_initial_acceleration(Motion::Data& m, Real dt) {
  prepare(m, dt);  // chooses the springs' stiffness
  solve::set_combination(m.held, mass_only, m.beta * dt * dt, false);
  m.step_length = 0;
  const Real reference = balance_forces(m, false);
  Kokkos::deep_copy(m.goal, 0.0);
  std::vector<Vec3> guess(m.held.op.unknowns);
  std::fill_n(guess.begin(), m.held.op.covers, m.gravity);
  device::copy_to_device(guess, m.now.acceleration);
  const SolveReport report = solve::solve_held(m.held, m.right, m.goal, m.now.acceleration, Field(),
                                               options(m, reference));
  if (m.held.springs.any())
    solve::spring_reactions(m.held.springs, m.held.spring_factor, m.now.acceleration, m.goal,
                            m.now.reaction);
  return report;
}

SolveReport solve_equilibrium(Motion::Data& m) {
  solve::set_combination(m.held, stiffness_only, 1, true);
  m.step_length = 0;
  const Real reference = balance_forces(m, false);
  aim(m);
  Kokkos::deep_copy(m.increment, 0.0);
  // There is no next step in which the multipliers could go on.
  solve::HeldOptions how = options(m, reference);
  how.patience = 40;
  how.max_outer = std::max<Index>(how.max_outer, 400);
  const SolveReport report =
      solve::solve_held(m.held, m.right, m.goal, m.increment, m.now.displacement, how);
  update_reactions(m);
  const auto d = m.now.displacement, x = m.increment;
  device::for_each(
      "rockfold::update::displace", covers_of(m), KOKKOS_LAMBDA(const Index p) {
        for (int i = 0; i < 3; ++i) d(p, i) += x(p, i);
      });
  m.now.time = 1;
  return report;
}

SolveReport advance(Motion::Data& m, Real dt) {
  prepare(m, dt);
  const bool inertia = m.dynamic_ratio > 0;
  if (inertia) inertia_forces(m, dt);
  const Real reference = balance_forces(m, inertia);
  predict(m, dt);
  aim(m);
  const SolveReport report = solve::solve_held(m.held, m.right, m.goal, m.increment,
                                               m.now.displacement, options(m, reference));
  update_reactions(m);
  move_covers(m, dt);
  m.now.time += dt;
  ++m.now.steps;
  return report;
}

void hand_on(Motion::Data& m) {
  if (m.dynamic_ratio == 1 || m.now.steps == 0) return;
  const Real share = m.dynamic_ratio;
  const bool keep_acceleration = share > 0;
  const auto v = m.now.velocity, a = m.now.acceleration;
  device::for_each(
      "rockfold::update::hand_on", covers_of(m), KOKKOS_LAMBDA(const Index p) {
        for (int d = 0; d < 3; ++d) {
          v(p, d) *= share;
          if (!keep_acceleration) a(p, d) = 0;
        }
      });
}

}  // namespace rockfold::update
