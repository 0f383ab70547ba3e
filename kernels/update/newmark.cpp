// Newmark's method as predictor and corrector (Hughes 1987, ch. 9):
//   d' = d + Δt v + Δt²/2 a,  v' = v + Δt a,  a' = a                      prediction: exact in free flight
//   d' = d,  v' and a' as Newmark's formulas then ask                     where that would strain rock more than inertia resists
//   (M/(βΔt²) + γ/(βΔt) C + K) x = F − M a' − C v' − f(d')
//   d' += x,  v' += γ/(βΔt) x,  a' += x/(βΔt²)
#include <algorithm>
#include <cmath>

#include "kernels/update/motion_kernel.hpp"

namespace rockfold::update {
namespace {

using device::Sums;

void prepare(Motion::Data& m, Real dt) {
  if (m.step_length == dt) return;
  const Real of_mass = 1 / (m.beta * dt * dt), of_damping = m.gamma / (m.beta * dt);
  set_matrix(m, {1 + of_damping * m.damping.stiffness, of_mass + of_damping * m.damping.mass},
             of_damping, 1, true);
  m.step_length = dt;
}

void correct(const Motion::Data& m, Real dt) {
  const auto d = m.now.displacement, v = m.now.velocity, a = m.now.acceleration, way = m.increment;
  const auto x = m.correction;
  const Real of_velocity = m.gamma / (m.beta * dt), of_acceleration = 1 / (m.beta * dt * dt);
  device::for_each(
      "rockfold::update::correct", m.unknowns, KOKKOS_LAMBDA(const Index p) {
        for (int i = 0; i < 3; ++i) {
          way(p, i) += x(p, i);
          d(p, i) += x(p, i);
          v(p, i) += of_velocity * x(p, i);
          a(p, i) += of_acceleration * x(p, i);
        }
      });
}

/// w = a + α v, whose mass is the inertia and the damping by mass.
void inertia_motion(const Motion::Data& m, const Field& w) {
  const auto v = m.now.velocity, a = m.now.acceleration;
  const Real of_velocity = m.damping.mass;
  device::for_each(
      "rockfold::update::inertia", m.unknowns, KOKKOS_LAMBDA(const Index p) {
        for (int i = 0; i < 3; ++i) w(p, i) = a(p, i) + of_velocity * v(p, i);
      });
}

void add(const Field& from, const Field& to, Real factor) {
  device::for_each(
      "rockfold::update::add", static_cast<Index>(to.extent(0)), KOKKOS_LAMBDA(const Index p) {
        for (int i = 0; i < 3; ++i) to(p, i) += factor * from(p, i);
      });
}

/// right = M a + C v of `now`.
void moving_forces(Motion::Data& m) {
  inertia_motion(m, m.work);
  m.rock->apply({0, 1}, m.work, m.right);
  if (m.damping.stiffness > 0) {
    m.rock->apply({1, 0}, m.now.velocity, m.work);
    add(m.work, m.right, m.damping.stiffness);
  }
  add_dashpots(m.dashpots, 1, m.now.velocity, m.right);
}

/// Whether free flight, `increment`, follows accelerations of periods below the step: it would go far from where rock goes, and the forces of
/// its strains would drown all others. Its velocity is not what takes it there (a block that turns needs both), and its strain forces are
/// larger than its inertia over the step, `of_mass` · M.
bool flies_astray(Motion::Data& m, Real dt, Real of_mass) {
  auto norm = [&](const Field& f) { return std::sqrt(solve::dot(m.held.work, f, f)); };
  if (0.5 * dt * norm(m.now.acceleration) <= norm(m.now.velocity)) return false;
  const Field way = m.increment, forces = m.work;
  if (m.rock->linear()) {
    m.rock->apply({1, 0}, way, forces);
  } else {
    const Field there = m.correction, before = m.right, d = m.now.displacement;
    Kokkos::deep_copy(there, d);
    add(way, there, 1);
    m.rock->force(d, before);
    m.rock->force(there, forces);
    add(before, forces, -1);
  }
  const Real of_strain = norm(forces);
  m.rock->apply({0, 1}, way, forces);
  return of_strain > of_mass * norm(forces);
}

/// Whether rock on which nothing acts goes on as predicted: its own forces alone are left, by rounding. Right after find_residual.
bool flies_freely(const Motion::Data& m, Real rounding) {
  if (m.held.springs.any()) return false;
  const std::vector<Real> squares =
      device::to_host(m.sums);  // of loads; inertia and damping; forces of strain
  return squares[0] == 0 && squares[1] == 0 && std::sqrt(squares[2]) <= rounding;
}

}  // namespace

void predict(Motion::Data& m, Real dt) {
  const auto d = m.now.displacement, v = m.now.velocity, a = m.now.acceleration, way = m.increment;
  device::for_each(
      "rockfold::update::free_flight", m.unknowns, KOKKOS_LAMBDA(const Index p) {
        for (int i = 0; i < 3; ++i) way(p, i) = dt * v(p, i) + 0.5 * dt * dt * a(p, i);
      });
  const Real of_mass = 1 / (m.beta * dt * dt);
  const bool stays = flies_astray(m, dt, of_mass);
  const Real left_v = stays ? m.gamma / (m.beta * dt) : 0, left_a = stays ? of_mass : 0;
  device::for_each(
      "rockfold::update::predict", m.unknowns, KOKKOS_LAMBDA(const Index p) {
        for (int i = 0; i < 3; ++i) {
          const Real flight = way(p, i);
          v(p, i) += dt * a(p, i) - left_v * flight;
          a(p, i) -= left_a * flight;
          if (stays)
            way(p, i) = 0;
          else
            d(p, i) += flight;
        }
      });
}

void set_matrix(Motion::Data& m, const solve::Combination& c, Real dashpots, Real springs,
                bool stiffen) {
  m.dashpot_factor = dashpots;
  solve::set_combination(m.held, c, springs, stiffen);
  m.step_length = 0;
}

void set_time(Motion::Data& m, Real t) {
  if (m.varying_loads.any()) varying_load(m.varying_loads, t, m.varying);
  move_supports(m.supports, t, m.held.springs);
}

Real find_residual(Motion::Data& m, bool moving) {
  if (moving)
    moving_forces(m);
  else
    Kokkos::deep_copy(m.right, 0.0);
  m.rock->force(m.now.displacement, m.work);
  const auto load = m.load, varying = m.varying, right = m.right, internal = m.work;
  const bool varies = m.varying_loads.any();
  const auto out = m.sums;
  device::sum_then<3>(
      "rockfold::update::residual", m.unknowns, m.partial,
      KOKKOS_LAMBDA(const Index p, Sums<3>& sum) {
        for (int d = 0; d < 3; ++d) {
          const Real changing = varies ? varying(p, d) : 0, f = load(p, d) + changing;
          sum.value[0] += load(p, d) * load(p, d) + changing * changing;
          sum.value[1] += right(p, d) * right(p, d);
          sum.value[2] += internal(p, d) * internal(p, d);
          right(p, d) = f - right(p, d) - internal(p, d);
        }
      },
      KOKKOS_LAMBDA(const Sums<3>& sum) {
        for (int k = 0; k < 3; ++k) out(k) = sum.value[k];
      });
  const std::vector<Real> squares = device::to_host(m.sums);
  return std::max(std::sqrt(std::max({squares[0], squares[1], squares[2]})), m.initial_force);
}

solve::HeldOptions solve_options(const Motion::Data& m, Real reference) {
  solve::HeldOptions how;
  how.pcg.tolerance = m.solver.tolerance;
  how.pcg.max_iterations = m.solver.max_iterations;
  how.pcg.reference = reference;
  how.pcg.rounding = m.rock->rounding(m.now.displacement);
  how.gap_tolerance = m.solver.gap_tolerance;
  how.max_outer = m.solver.max_outer;
  return how;
}

void close_gaps(solve::HeldOptions& how) {
  how.patience = 40;
  how.plain_at_last = true;
  how.max_outer = std::max<Index>(how.max_outer, 400);
}

SolveReport advance(Motion::Data& m, Real dt) {
  prepare(m, dt);
  leave_out_idle_motion(m);
  if (m.varying_loads.any()) {
    varying_load(m.varying_loads, m.now.time, m.varying_before);
  }
  const bool steered = m.dynamic_ratio > 0;
  if (steered) steer(m, dt);
  m.now.time += dt;
  set_time(m, m.now.time);
  predict(m, dt);
  const Real reference = find_residual(m, steered || m.now.steps == 0);
  const bool free = flies_freely(m, m.rock->rounding(m.now.displacement));
  aim(m);
  if (steered) aim_steered(m);
  Kokkos::deep_copy(m.correction, 0.0);
  solve::HeldOptions how = solve_options(m, reference);
  how.rounding = [&](const Field& x) { return m.rock->rounding(x); };
  how.stop_at_rounding = !steered;
  if (!steered) close_gaps(how);
  SolveReport report;
  if (!free)
    report = solve::solve_held(m.held, m.right, m.goal, m.correction, m.now.displacement, how);
  correct(m, dt);
  update_reactions(m);
  count_work(m, dt);
  ++m.now.steps;
  return report;
}

void hand_on(Motion::Data& m) {
  if (m.dynamic_ratio == 1 || m.now.steps == 0) return;
  const Real share = m.handed = m.dynamic_ratio;
  m.now.work.ratio += (1 - share * share) * kinetic_energy(m);
  const bool keep_acceleration = share > 0;
  const auto v = m.now.velocity, a = m.now.acceleration;
  device::for_each(
      "rockfold::update::hand_on", m.unknowns, KOKKOS_LAMBDA(const Index p) {
        for (int d = 0; d < 3; ++d) {
          v(p, d) *= share;
          if (!keep_acceleration) a(p, d) = 0;
        }
      });
}

}  // namespace rockfold::update
