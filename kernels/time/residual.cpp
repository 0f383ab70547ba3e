#include <algorithm>
#include <cmath>

#include "kernels/time/step_kernel.hpp"

namespace rockfold::motion {
namespace {

using device::Sums;

/// w = a + α v, of both ends where `middle`; the velocity at the start as it was when forces were balanced with it.
void find_inertia_motion(const Motion::Data& m, bool middle, const Field& w) {
  const auto v = m.now.velocity, a = m.now.acceleration;
  const auto v0 = m.velocity_before, a0 = m.acceleration_before;
  const Real of_velocity = m.damping.mass, whole = 1 / m.handed;
  device::for_each(
      "rockfold::motion::inertia_motion", m.unknowns, KOKKOS_LAMBDA(const Index p) {
        for (int i = 0; i < 3; ++i)
          w(p, i) = a(p, i) + of_velocity * v(p, i) +
                    (middle ? a0(p, i) + of_velocity * whole * v0(p, i) : 0);
      });
}

/// v' (+ v)
void find_damped_velocity(const Motion::Data& m, bool middle, const Field& w) {
  const auto v = m.now.velocity, v0 = m.velocity_before;
  const Real whole = 1 / m.handed;
  device::for_each(
      "rockfold::motion::damped_velocity", m.unknowns, KOKKOS_LAMBDA(const Index p) {
        for (int i = 0; i < 3; ++i) w(p, i) = v(p, i) + (middle ? whole * v0(p, i) : 0);
      });
}

/// right = M a + C v.
void find_moving_forces(Motion::Data& m, const Step& step) {
  find_inertia_motion(m, step.middle, m.work);
  m.rock->apply({0, 1}, m.work, m.right);
  if (step.rate && m.damping.stiffness > 0) {
    find_damped_velocity(m, step.middle, m.correction);
    m.rock->apply({1, 0}, m.correction, m.work);
    Kokkos::deep_copy(m.correction, 0.0);
    const auto from = m.work, to = m.right;
    const Real factor = m.damping.stiffness;
    device::for_each(
        "rockfold::motion::add_damping", m.unknowns, KOKKOS_LAMBDA(const Index p) {
          for (int i = 0; i < 3; ++i) to(p, i) += factor * from(p, i);
        });
  }
  if (m.dashpots.any()) {
    find_damped_velocity(m, step.middle, m.work);
    add_dashpots(m.dashpots, 1, m.work, m.right);
  }
}

/// Takes the pressures that follow off the internal force in `work`, so that both change together.
void follow(Motion::Data& m, const Step& step) {
  // Internal forces are doubled later in the middle rule: of both ends half each.
  const Real share = step.load * (step.middle ? 0.5 : 1);
  add_following_pressures(m.following, m.now.time, m.now.displacement, -share, m.work);
  if (!step.middle) return;
  const Field before = m.following_before, work = m.work;
  device::for_each(
      "rockfold::motion::following_before", m.unknowns, KOKKOS_LAMBDA(const Index p) {
        for (int i = 0; i < 3; ++i) work(p, i) -= 0.5 * before(p, i);
      });
}

/// right += what bolts do to the rock where it is now. Returns the norm, N.
Real add_bolt_forces(Motion::Data& m, const Step& step) {
  bolts::find_forces(m.bolts, m.now.displacement, true);
  Kokkos::deep_copy(m.work, 0.0);
  bolts::add_forces(m.bolts, 1, m.work);
  const Field forces = m.work, right = m.right, before = m.bolts_before;
  const Real of_start = step.middle ? 1 : 0;
  device::for_each(
      "rockfold::motion::add_bolt_forces", m.unknowns, KOKKOS_LAMBDA(const Index p) {
        for (int i = 0; i < 3; ++i) right(p, i) += forces(p, i) + of_start * before(p, i);
      });
  return std::sqrt(solve::dot(m.system.work, forces, forces));
}

/// stretch_before = what springs are stretched by at the step's start; at that of the first they pull as they did before it, which at the
/// very start is not at all: supports that are moved at once would else swing about their places for ever.
void keep_stretch(Motion::Data& m) {
  find_prescribed(m, {});
  const solve::Springs s = m.system.springs;
  const auto prescribed = m.prescribed, before = m.stretch_before, reaction = m.now.reaction;
  const bool first = m.now.steps == 0;
  device::for_each(
      "rockfold::motion::keep_stretch", s.points.count, KOKKOS_LAMBDA(const Index n) {
        for (int i = 0; i < 3; ++i) {
          const Real k = s.stiffness(n, i);
          before(n, i) = first && k > 0 ? reaction(n, i) / k : prescribed(n, i);
        }
      });
}

}  // namespace

Forces find_residual(Motion::Data& m, const Step& step) {
  if (step.inertia)
    find_moving_forces(m, step);
  else
    Kokkos::deep_copy(m.right, 0.0);
  m.rock->force(m.now.displacement, m.work);
  Forces forces;
  if (m.following.any()) {
    forces.reference = std::sqrt(solve::dot(m.system.work, m.work, m.work));
    follow(m, step);
  }
  const auto load = m.load, varying = m.varying, before = m.varying_before, right = m.right,
             internal = m.work;
  const auto gone = m.gone;
  const auto wall = m.now.wall;
  const Real walls = step.walls;
  const bool varies = m.varying_loads.any(), middle = step.middle;
  const Real times = middle ? 2 : 1, share = step.load;
  const bool judged = m.contact != nullptr;
  const auto acting = m.of_blocks.acting;
  const auto out = m.sums;
  device::sum_then<3>(
      "rockfold::motion::residual", m.unknowns, m.partial,
      KOKKOS_LAMBDA(const Index p, Sums<3>& sum) {
        if (gone(p) != 0) {
          for (int d = 0; d < 3; ++d) right(p, d) = 0;
          if (judged) acting(p) = 0;
          return;
        }
        Real loads = 0, moving = 0;
        for (int d = 0; d < 3; ++d) {
          const Real constant = share * times * load(p, d);
          const Real changing =
              (varies ? share * (varying(p, d) + (middle ? before(p, d) : 0)) : 0) +
              (walls > 0 ? walls * wall(p, d) : 0);
          const Real f = constant + changing, inner = times * internal(p, d);
          sum.value[0] += constant * constant + changing * changing;
          sum.value[1] += right(p, d) * right(p, d);
          sum.value[2] += inner * inner;
          loads += f * f;
          moving += right(p, d) * right(p, d);
          right(p, d) = f - right(p, d) - inner;
        }
        if (judged) acting(p) = device::math::sqrt(loads) + device::math::sqrt(moving);
      },
      KOKKOS_LAMBDA(const Sums<3>& sum) {
        for (int k = 0; k < 3; ++k) out(k) = sum.value[k];
      });
  const std::vector<Real> squares = device::to_host(m.sums);
  if (m.contact) forces.reference = std::max(forces.reference, add_contact_forces(m, step));
  if (m.bolts.any()) forces.reference = std::max(forces.reference, add_bolt_forces(m, step));
  forces.loads = std::sqrt(squares[0]);
  forces.inertia = std::sqrt(squares[1]);
  forces.internal = std::sqrt(squares[2]);
  forces.reference =
      std::max({forces.reference, forces.loads, forces.inertia, forces.internal, m.initial_force});
  return forces;
}

void find_prescribed(const Motion::Data& m, const Step& step) {
  const solve::Springs s = m.system.springs;
  const auto d = m.now.displacement, prescribed = m.prescribed, before = m.stretch_before;
  const auto increment = m.increment, way = m.support_way;
  const bool middle = step.middle, stabilised = step.stabilised;
  const Real share = step.load;
  device::for_each(
      "rockfold::motion::find_prescribed", s.points.count, KOKKOS_LAMBDA(const Index n) {
        for (int i = 0; i < 3; ++i) {
          if (stabilised && s.held(n, i) > 0)
            prescribed(n, i) = way(n, i) - solve::interpolate_one(s.points, n, i, increment);
          else
            prescribed(n, i) = share * s.target(n, i) - solve::interpolate_one(s.points, n, i, d);
          if (middle && !(s.held(n, i) > 0)) prescribed(n, i) += before(n, i);
        }
      });
}

void keep_bolts(Motion::Data& m) {
  if (!m.bolts.any()) return;
  bolts::find_forces(m.bolts, m.now.displacement, false);
  Kokkos::deep_copy(m.bolts_before, 0.0);
  bolts::add_forces(m.bolts, 1, m.bolts_before);
}

void keep_start(Motion::Data& m) {
  Kokkos::deep_copy(m.velocity_before, m.now.velocity);
  Kokkos::deep_copy(m.acceleration_before, m.now.acceleration);
  keep_stretch(m);
  if (!m.following.any()) return;
  Kokkos::deep_copy(m.following_before, 0.0);
  add_following_pressures(m.following, m.now.time, m.now.displacement, 1, m.following_before);
}

Real find_imbalance(Motion::Data& m, Real& reference) {
  const Field work = m.work, right = m.right;
  Kokkos::deep_copy(work, 0.0);
  solve::add_spring_load(m.system.springs, m.prescribed, work);
  if (m.system.springs.any()) {
    const Field left = m.left;
    device::for_each(
        "rockfold::motion::left_to_supports", m.unknowns, KOKKOS_LAMBDA(const Index p) {
          for (int d = 0; d < 3; ++d) left(p, d) = right(p, d) + work(p, d);
        });
    solve::take_off_multipliers(m.system.constraints, left);
    device::for_each(
        "rockfold::motion::forces_of_supports", m.unknowns, KOKKOS_LAMBDA(const Index p) {
          for (int d = 0; d < 3; ++d) work(p, d) = left(p, d) - right(p, d);
        });
  }
  const auto out = m.sums;
  device::sum_then<2>(
      "rockfold::motion::unbalanced", m.unknowns, m.partial,
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

Real gap_of_supports(Motion::Data& m, Real reference) {
  const solve::Springs s = m.system.springs;
  if (!s.any()) return 0;
  const auto prescribed = m.prescribed;
  const Real gap = device::largest(
      "rockfold::motion::large_gap", s.points.count, KOKKOS_LAMBDA(const Index n) {
        Real worst = 0;
        for (int d = 0; d < 3; ++d)
          if (s.held(n, d) > 0)
            worst =
                device::math::fmax(worst, s.motion_ratio(n) * device::math::fabs(prescribed(n, d)));
        return worst;
      });
  if (!(gap > 0)) return 0;
  const Real diagonal = m.system.largest_diagonal;
  const Real least = diagonal > 0 ? reference / diagonal : 0;
  return gap / std::max({solve::largest_motion(m.system, m.now.displacement, Field()), gap, least});
}

}  // namespace rockfold::motion
