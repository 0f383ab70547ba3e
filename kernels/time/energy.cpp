// Energies, and the work that changes them.
//
// With average acceleration Δd = Δt/2 (v + v') and Δt/2 ((F − C v − f) + (F' − C v' − f')) = M (v' − v), so that
//   T' − T + ½ (f + f')·Δd + ½ (C v + C v')·Δd = ½ (F + F')·Δd
// to the last digit: with the mean of forces over a step every work is exact. Damping takes C Δd·Δd/Δt, the work at the step's mean
// velocity, which is ½ (C v + C v')·Δd there and never negative. What other β, γ add or take is `numerical`.
#include "kernels/time/motion_kernel.hpp"

namespace rockfold {
namespace motion {
namespace {

using device::Sums;

/// ½ (x + y)·Δd
Real mean_work(const Motion::Data& m, const Field& x, const Field& y) {
  return 0.5 *
         (solve::dot(m.system.work, x, m.increment) + solve::dot(m.system.work, y, m.increment));
}

}  // namespace

void update_reactions(Motion::Data& m, bool middle) {
  const solve::Springs s = m.system.springs;
  if (!s.any()) return;
  const auto way = m.increment, before = m.now.reaction;
  const auto out = m.sums;
  solve::spring_reactions(s, m.correction, m.prescribed, s.force);
  device::sum_then<1>(
      "rockfold::motion::support_work", s.points.count, m.partial,
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

void count_work(Motion::Data& m, Real dt) {
  Work& work = m.now.work;
  if (m.varying_loads.any()) work.loads += mean_work(m, m.varying_before, m.varying);
  Rayleigh by = m.damping;
  if (!m.rock->linear() && (by.stiffness > 0 || m.rebounds.any())) {
    work.damping += m.rock->viscous_work(m.now.displacement, by.stiffness / dt);
    by.stiffness = 0;
  }
  if (by.mass > 0 || by.stiffness > 0) {
    m.rock->apply({by.stiffness, by.mass}, m.increment, m.work);
    work.damping += solve::dot(m.system.work, m.work, m.increment) / dt;
  }
  if (m.dashpots.any()) {
    Kokkos::deep_copy(m.work, 0.0);
    add_dashpots(m.dashpots, 1, m.increment, m.work);
    work.quiet += solve::dot(m.system.work, m.work, m.increment) / dt;
  }
}

void count_wall_work(Motion::Data& m, Real before, Real after) {
  if (before == 0 && after == 0) return;
  m.now.work.excavated -=
      0.5 * (before + after) * solve::dot(m.system.work, m.now.wall, m.increment);
}

void count_bolt_work(Motion::Data& m) {
  if (!m.bolts.any()) return;
  Kokkos::deep_copy(m.work, 0.0);
  bolts::add_forces(m.bolts, 1, m.work);
  m.now.work.bolts -= mean_work(m, m.bolts_before, m.work);
}

void count_following_work(Motion::Data& m) {
  if (!m.following.any()) return;
  Kokkos::deep_copy(m.work, m.following_before);
  add_following_pressures(m.following, m.now.time, m.now.displacement, 1, m.work);
  m.now.work.loads += 0.5 * solve::dot(m.system.work, m.work, m.increment);
}

void count_loads_at_once(Motion::Data& m) {
  Real& work = m.now.work.loads;
  if (m.varying_loads.any()) work += solve::dot(m.system.work, m.varying, m.increment);
  if (!m.following.any()) return;
  const Field in_place = m.correction;
  Kokkos::deep_copy(in_place, 0.0);
  Kokkos::deep_copy(m.work, 0.0);
  add_following_pressures(m.following, m.now.time, in_place, 0.5, m.work);
  add_following_pressures(m.following, m.now.time, m.now.displacement, 0.5, m.work);
  work += solve::dot(m.system.work, m.work, m.increment);
}

Real kinetic_energy(const Motion::Data& m, const Field& velocity) {
  m.rock->apply({0, 1}, velocity, m.work);
  return 0.5 * solve::dot(m.system.work, velocity, m.work);
}

Real kinetic_energy(const Motion::Data& m) {
  return kinetic_energy(m, m.now.velocity);
}

}  // namespace motion

Energy Motion::energy() const {
  const Data& m = *data_;
  const motion::Work& work = m.now.work;
  Energy e;
  e.kinetic = motion::kinetic_energy(m);
  e.strain = m.rock->energy(m.now.displacement);
  e.potential = -solve::dot(m.system.work, m.load, m.now.displacement);
  e.loads = work.loads;
  e.supports = work.supports;
  e.contact = m.now.contact_energy;
  e.friction = work.friction;
  e.impact = work.impact;
  e.damping = work.damping;
  e.quiet = work.quiet;
  e.ratio = work.ratio;
  e.excavated = work.excavated;
  e.bolts = work.bolts;
  e.dissipated = m.now.initial_energy + e.loads + e.supports - e.excavated -
                 (e.kinetic + e.strain + e.potential + e.contact - m.now.substep_energy);
  e.dissipated -= e.bolts;
  e.numerical = e.dissipated - (e.damping + e.quiet + e.ratio + e.friction + e.impact);
  return e;
}

}  // namespace rockfold
