// The prediction of a step (Hughes 1987, ch. 9):
//   d' = d + Δt v + Δt²/2 a,  v' = v + Δt a,  a' = a                      exact in free flight
//   d' = d,  v' and a' as Newmark's formulas then ask                     where that would strain rock more than inertia resists
//   d' = d + Δt v, likewise                                               where blocks touch: what they rest on takes their weight
#include <cmath>

#include "kernels/time/step_kernel.hpp"

namespace rockfold::motion {
namespace {

void add(const Field& from, const Field& to, Real factor) {
  device::for_each(
      "rockfold::motion::add", static_cast<Index>(to.extent(0)), KOKKOS_LAMBDA(const Index p) {
        for (int i = 0; i < 3; ++i) to(p, i) += factor * from(p, i);
      });
}

/// Whether free flight, `increment`, follows accelerations of periods below the step: it would go far from where rock goes, and the forces of
/// its strains would drown all others. Its velocity is not what takes it there (a block that turns needs both), and its strain forces are
/// larger than its inertia over the step, `of_mass` · M.
bool flies_astray(Motion::Data& m, Real dt, Real of_mass) {
  auto norm = [&](const Field& f) { return std::sqrt(solve::dot(m.system.work, f, f)); };
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

}  // namespace

void predict(Motion::Data& m, Real dt) {
  const auto d = m.now.displacement, v = m.now.velocity, a = m.now.acceleration, way = m.increment;
  device::for_each(
      "rockfold::motion::free_flight", m.unknowns, KOKKOS_LAMBDA(const Index p) {
        for (int i = 0; i < 3; ++i) way(p, i) = dt * v(p, i) + 0.5 * dt * dt * a(p, i);
      });
  const Real of_mass = 1 / (m.beta * dt * dt), of_damping = m.gamma / (m.beta * dt);
  const bool touching = m.contact != nullptr, stays = !touching && flies_astray(m, dt, of_mass);
  device::for_each(
      "rockfold::motion::predict", m.unknowns, KOKKOS_LAMBDA(const Index p) {
        for (int i = 0; i < 3; ++i) {
          const Real flight = way(p, i);
          const Real left = stays ? flight : touching ? 0.5 * dt * dt * a(p, i) : 0;
          v(p, i) += dt * a(p, i) - of_damping * left;
          a(p, i) -= of_mass * left;
          way(p, i) = flight - left;
          d(p, i) += flight - left;
        }
      });
}

}  // namespace rockfold::motion
