// The critical substep of each block. With N of the two sides of a point, NᵀDN ≤ 2 (N₁ᵀDN₁ + N₂ᵀDN₂), so that no mode of all blocks is faster than the
// fastest of one block by itself with twice the stiffness of its points: ω² ≤ max λ((M + θh²K)⁻¹ (K + 2 ΣNᵀDN)). Of that K has 1/(θh²) at most,
// and the rest is found by power iteration, block by block. The inertia that strain is given grows with h and the frequency falls, so that
// each h is one for which a longer one was safe; a few rounds find most of it.
#include <algorithm>
#include <cmath>
#include <limits>

#include "kernels/device/sums_kernel.hpp"
#include "kernels/finite/cover_force_kernel.hpp"
#include "kernels/time/explicit/explicit_kernel.hpp"

namespace rockfold::motion {
namespace {

/// θ, and the factor of the damping. A mode of strain goes by v' = (1 − d) v − (1 − d/2) p x/h, x' = x + h v', p = θ(ωh)²/(1 + θ(ωh)²), d = p²/2: as it is
/// where it is slow, and into balance where it is stiff (p = 1: what is left of x and v falls by √2 in a substep). With more damping stiff strain
/// lags behind forces that grow, by h v d/(1 − d/2), and takes as much of an impact's energy.
constexpr Real inertia_of_strain = 1, damping_of_strain = 0.5;

/// (ωh)² of contact. Beside strain it must be below (4 − 2d)/(1 − d/2) − p = 4 − p ≥ 3. (Beside none an oscillator whose spring is dragged by its
/// share s of h goes by z² − (2 − (1 + s) a) z + (1 − s a) = 0, a = (ωh)²: stable to 4/(1 + 2s), 1 for the s = 1.5 of most_drag.)
constexpr Real of_contact = 0.9;
/// Where blocks rebound: what weighs on one takes g h off the speed e w at which it leaves, and adds as much to w.
constexpr Real of_rebounds = 0.1;

constexpr int rounds = 3, iterations = 16;

/// Radians: a block that turns by ϑ along its tangent in a substep is stretched by ϑ²/2, here 5e-7.
constexpr Real most_turn = 1e-3;

/// λK over M: of the digits that a matrix has, half.
constexpr Real beyond_all = 1e8;

/// a ← (factor · M + θh²K)⁻¹, K [3n][3n].
KOKKOS_INLINE_FUNCTION void invert_slowed(const Real* mass, Real factor, const Real* k, Real h,
                                          int n, Real* a) {
  const int width = 3 * n;
  Real scale[solve::most_block_width];
  const Real share = inertia_of_strain * h * h;
  for (int i = 0; i < width; ++i)
    for (int j = 0; j < width; ++j)
      a[i * width + j] =
          share * k[i * width + j] + (i % 3 == j % 3 ? factor * mass[(i / 3) * n + j / 3] : 0);
  for (int i = 0; i < width; ++i)
    scale[i] = a[i * width + i] > 0 ? 1 / device::math::sqrt(a[i * width + i]) : 0;
  for (int i = 0; i < width; ++i)
    for (int j = 0; j < width; ++j) a[i * width + j] *= scale[i] * scale[j];
  solve::invert_symmetric(width, a);
  for (int i = 0; i < width; ++i)
    for (int j = i; j < width; ++j)
      a[i * width + j] = a[j * width + i] = scale[i] * scale[j] * a[i * width + j];
}

/// Largest λ of A R ᵀC R, A symmetric: in the measure of A⁻¹, as ‖·‖ of x ← A Rᵀ C R x.
KOKKOS_INLINE_FUNCTION Real largest_value(const Real* a, const Real* c, const Real* turn, int n) {
  const int width = 3 * n;
  Real x[solve::most_block_width], y[solve::most_block_width], z[solve::most_block_width];
  for (int i = 0; i < width; ++i)  // no symmetry of a block's has this for a zero
    x[i] = device::math::sqrt(a[i * width + i]) * (1 + 0.1 * ((7 * i) % 11));
  Real value = 0;
  for (int step = 0; step < iterations; ++step) {
    turn_vector(turn, false, n, x, y);
    for (int i = 0; i < width; ++i) {
      z[i] = 0;
      for (int j = 0; j < width; ++j) z[i] += c[i * width + j] * y[j];
    }
    turn_vector(turn, true, n, z, y);
    Real below = 0, above = 0;  // x·y = xᵀCx, y·Ay = ‖A C x‖ in the measure of A⁻¹
    for (int i = 0; i < width; ++i) {
      z[i] = 0;
      for (int j = 0; j < width; ++j) z[i] += a[i * width + j] * y[j];
      below += x[i] * y[i];
      above += z[i] * y[i];
    }
    if (!(below > 0)) return 0;
    value = above / below;
    for (int i = 0; i < width; ++i) x[i] = z[i] / value;
  }
  return value;
}

/// rad/s: how fast a block turns that is turned by R, from the mean of Ḟ: |½ (Ḟ Rᵀ − R Ḟᵀ)|.
KOKKOS_INLINE_FUNCTION Real find_spin(const finite::Deformation& body, const Field& v, Index p,
                                      const Real* turn) {
  Real mean[9] = {}, weights = 0;
  for (Index s = body.begin(p); s < body.begin(p + 1); ++s) {
    const Index e = static_cast<Index>(body.entry(s) / body.nodes);
    for (int q = 0; q < body.points; ++q) {
      Real rate[9];
      finite::gradient_at(body, v, e, q, rate);
      const Real weight =
          device::math::fabs(body.weight(static_cast<std::size_t>(e) * body.points + q));
      for (int i = 0; i < 9; ++i) mean[i] += weight * rate[i];
      weights += weight;
    }
  }
  Real square = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = i + 1; j < 3; ++j) {
      Real w = 0;
      for (int k = 0; k < 3; ++k)
        w += mean[3 * i + k] * turn[3 * j + k] - mean[3 * j + k] * turn[3 * i + k];
      square += 0.25 * w * w;
    }
  return weights > 0 ? device::math::sqrt(square) / weights : 0;
}

/// ExplicitScheme::turn.
void find_turns(const Motion::Data& m) {
  const finite::Deformation rock = *m.rock->finite_strain();
  const Field d = m.now.displacement;
  const auto turn = m.explicit_scheme.turn;
  device::for_each(
      "rockfold::motion::turns", m.covers, KOKKOS_LAMBDA(const Index p) {
        Real f[solve::most_block_width] = {};
        finite::take_internal_force(rock, d, p, f, &turn(9 * static_cast<std::size_t>(p)));
      });
}

void write_spring_tangents(const Motion::Data& m) {
  const solve::Springs s = m.system.springs;
  const auto tangent = m.system.terms.tangent;
  device::for_each(
      "rockfold::motion::spring_stiffness", s.points.count, KOKKOS_LAMBDA(const Index n) {
        for (int d = 0; d < 3; ++d) {
          tangent(n, d) = s.held(n, d) > 0 ? 0 : s.stiffness(n, d);
          tangent(n, 3 + d) = 0;
        }
      });
}

}  // namespace

void find_rigid(const Motion::Data& m) {
  const ExplicitScheme& s = m.explicit_scheme;
  const auto stiffness = s.stiffness, mass = s.mass, rigid = s.rigid;
  const int n = s.functions, width = 3 * n;
  device::for_each(
      "rockfold::motion::rigid", m.covers,
      KOKKOS_LAMBDA(const Index p) {
        const std::size_t own = static_cast<std::size_t>(p) * width * width;
        const Real *k = &stiffness(own), *small = &mass(static_cast<std::size_t>(p) * n * n);
        Real softest = 0;  // 1/ω² of the softest function
        for (int i = 3; i < width; ++i)
          softest = device::math::fmax(softest, small[(i / 3) * n + i / 3] / k[i * width + i]);
        invert_slowed(small, 1, k, device::math::sqrt(beyond_all * softest / inertia_of_strain), n,
                      &rigid(own));
      },
      width * width);
}

void find_block_steps(Motion::Data& m) {
  const ExplicitScheme& s = m.explicit_scheme;
  find_turns(m);
  set_tangents(m.dashpots, 0, m.system.terms, m.system.springs.points.count);
  write_spring_tangents(m);
  constexpr Real both_sides = 2;
  bolts::write_stiffest(m.bolts, both_sides, m.system.terms, m.first_link);
  if (m.contact) {
    contact::write_stiffest(m.contact->contacts, both_sides, m.system.contacts.tangent);
  }
  m.step_length = 0;  // the terms' tangents are no matrix of a step
  const solve::PointTerms terms = m.system.terms, contacts = m.system.contacts;
  const bool touches = m.contact != nullptr;
  const finite::Deformation rock = *m.rock->finite_strain();
  const Field velocity = m.now.velocity;
  const auto stiffness = s.stiffness, mass = s.mass, turn = s.turn, step = s.step,
             turning = s.turning;
  const auto gone = m.gone;
  const Index covers = m.covers;
  const int n = s.functions, width = 3 * n;
  const bool rebounds = touches && m.contact->contacts.options.restitution > 0;
  const Real limit = rebounds ? of_rebounds : of_contact;
  const Real unlimited = std::numeric_limits<Real>::infinity();
  device::for_each(
      "rockfold::motion::block_step", covers,
      KOKKOS_LAMBDA(const Index p) {
        const std::size_t own = static_cast<std::size_t>(p) * width * width;
        const Real* small = &mass(static_cast<std::size_t>(p) * n * n);
        constexpr int most = solve::most_block_width * solve::most_block_width;
        Real a[most], c[most];
        for (int e = 0; e < width * width; ++e) c[e] = 0;
        if (terms.any()) solve::add_terms(terms, p, covers, n, c);
        if (touches && contacts.any()) solve::add_terms(contacts, p, covers, n, c);
        Real h = 0;
        for (int round = 0; round < rounds && h < unlimited; ++round) {
          invert_slowed(small, 1, &stiffness(own), h, n, a);
          const Real value =
              gone(p) != 0 ? 0 : largest_value(a, c, &turn(9 * static_cast<std::size_t>(p)), n);
          h = value > 0 ? device::math::sqrt(limit / value) : unlimited;
        }
        const Real spin =
            gone(p) != 0 ? 0 : find_spin(rock, velocity, p, &turn(9 * static_cast<std::size_t>(p)));
        step(p) = h;
        turning(p) = spin > 0 ? most_turn / spin : unlimited;
      },
      width * width);
}

void slow_strain(const Motion::Data& m) {
  const ExplicitScheme& s = m.explicit_scheme;
  const Schedule schedule = s.schedule;
  const auto stiffness = s.stiffness, mass = s.mass, factor = s.factor, slowed = s.slowed,
             damped = s.damped;
  const int n = s.functions, width = 3 * n;
  device::for_each(
      "rockfold::motion::slow_strain", m.covers,
      KOKKOS_LAMBDA(const Index p) {
        const Real h = schedule.interval(schedule.block_level(p)),
                   share = inertia_of_strain * h * h;
        const std::size_t own = static_cast<std::size_t>(p) * width * width;
        const Real *a = &slowed(own), *k = &stiffness(own);
        invert_slowed(&mass(static_cast<std::size_t>(p) * n * n), factor(p), k, h, n, &slowed(own));
        Real once[solve::most_block_width * solve::most_block_width];
        for (int i = 0; i < width; ++i)
          for (int j = 0; j < width; ++j) {
            Real sum = 0;
            for (int l = 0; l < width; ++l) sum += a[i * width + l] * k[l * width + j];
            once[i * width + j] = share * sum;
          }
        for (int i = 0; i < width; ++i)
          for (int j = 0; j < width; ++j) {
            Real sum = 0;
            for (int l = 0; l < width; ++l) sum += k[i * width + l] * once[l * width + j];
            damped(own + i * width + j) = damping_of_strain * share * sum;
          }
      },
      width * width);
}

Real added_inertia(const Motion::Data& m) {
  const ExplicitScheme& s = m.explicit_scheme;
  const Schedule schedule = s.schedule;
  const auto stiffness = s.stiffness, turn = s.turn, mass = s.mass, factor = s.factor;
  const Field velocity = m.now.velocity;
  const Index covers = m.covers;
  const int n = s.functions, width = 3 * n;
  const auto out = m.sums;
  device::sum_then<1>(
      "rockfold::motion::added_inertia", covers, m.partial,
      KOKKOS_LAMBDA(const Index p, device::Sums<1>& sum) {
        const Real h = schedule.interval(schedule.block_level(p));
        const Real* k = &stiffness(static_cast<std::size_t>(p) * width * width);
        Real x[solve::most_block_width], v[solve::most_block_width];
        for (int i = 0; i < width; ++i) x[i] = velocity(i / 3 * covers + p, i % 3);
        turn_vector(&turn(9 * static_cast<std::size_t>(p)), true, n, x, v);
        const Real* own = &mass(static_cast<std::size_t>(p) * n * n);
        for (int i = 0; i < width; ++i)
          for (int j = 0; j < width; ++j) {
            const Real more = i % 3 == j % 3 ? (factor(p) - 1) * own[(i / 3) * n + j / 3] : 0;
            sum.value[0] +=
                0.5 * v[i] * (inertia_of_strain * h * h * k[i * width + j] + more) * v[j];
          }
      },
      KOKKOS_LAMBDA(const device::Sums<1>& sum) { out(0) = sum.value[0]; });
  return device::to_host(m.sums)[0];
}

}  // namespace rockfold::motion
