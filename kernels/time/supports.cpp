// Where fixed points have to go in a step.
//
// A step whose points held go exactly to their places leaves their velocity and acceleration to Newmark's formulas. For
// average acceleration those have the double root −1: an error of velocity, from a multiplier that is not quite right yet, swings
// on for ever and makes the acceleration, and with it the next multiplier's error, grow without bound (the weak instability of
// differential-algebraic systems of index 3: Cardona & Géradin 1989; Hairer & Wanner, Solving ODEs II, ch. VII). So the points
// are stabilised: with p, w, a what their place, velocity and acceleration are off by, they move by
//   Δū − (k₀ p + k₁ Δt w + k₂ Δt² a),
// k such that all three roots are zero (Ackermann's formula): any error is gone after three steps, and points without error
// go exactly where they should. For average acceleration k = 1/4, −1/2, −1/16.
#include <array>
#include <cmath>

#include "kernels/time/motion_kernel.hpp"

namespace rockfold::motion {
namespace {

using Row = std::array<Real, 3>;
using Matrix = std::array<Row, 3>;

Row times(const Matrix& f, const Row& x) {
  Row y{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) y[i] += f[i][j] * x[j];
  return y;
}

Row cross_product(const Row& a, const Row& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Interpolated motion of fixed points against that of their tables, from t to t + Δt.
struct Tables {
  Array<Real> before, now, after;  ///< values at t − Δt, t, t + Δt
  Array<Index> table;
  bool any;
};

/// In the middle rule w follows from p alone: k₀, k₁ such that both roots are zero.
constexpr std::array<Real, 3> gains_by_mean{0.5, -0.25, 0};

}  // namespace

std::array<Real, 3> stabilisation_gains(Real beta, Real gamma) {
  // x = (p, Δt w, Δt² a) becomes F x + b u where the point moves by u more than its table.
  const Matrix f{{{1, 0, 0},
                  {0, 1 - gamma / beta, 1 - gamma / (2 * beta)},
                  {0, -1 / beta, 1 - 1 / (2 * beta)}}};
  const Row b{1, gamma / beta, 1 / beta};
  const Row fb = times(f, b), ffb = times(f, fb);
  // The row r with r·b = r·Fb = 0 and r·F²b = 1; then k = r F³.
  const Row normal = cross_product(b, fb);
  Real size = 0;
  for (int i = 0; i < 3; ++i) size += normal[i] * ffb[i];
  if (std::abs(size) < 1e-6) return {1, 0, 0};  // no stabilisation: straight to the place
  Row k{};
  for (int j = 0; j < 3; ++j) {
    Row unit{};
    unit[j] = 1;
    const Row column = times(f, times(f, times(f, unit)));
    for (int i = 0; i < 3; ++i) k[j] += normal[i] / size * column[i];
  }
  return k;
}

void stabilise_supports(const Motion::Data& m, Real dt, bool middle) {
  if (!m.system.springs.any()) return;
  const solve::Springs s = m.system.springs;
  const auto d = m.now.displacement, v = m.now.velocity, a = m.now.acceleration;
  const auto way = m.support_way;
  const auto k = middle ? gains_by_mean : stabilisation_gains(m.beta, m.gamma);
  const Real k0 = k[0], k1 = k[1], k2 = k[2], share = m.now.dynamic_ratio;
  const Real t = m.now.time;
  const bool any = m.supports.tables.any();
  Tables tables{{}, {}, {}, m.supports.table, any};
  if (any)
    tables = {m.supports.tables.at_or_before(t - dt, 0), m.supports.tables.at(t),
              m.supports.tables.at(t + dt), m.supports.table, any};
  device::for_each(
      "rockfold::motion::steer", s.points.count, KOKKOS_LAMBDA(const Index n) {
        const Index row = any && tables.table(n) != none ? 3 * tables.table(n) : none;
        for (int i = 0; i < 3; ++i) {
          Real before = s.target(n, i), now = before, after = before;
          if (row != none) {
            before = tables.before(row + i);
            now = tables.now(row + i);
            after = tables.after(row + i);
          }
          const Real p = solve::interpolate_one(s.points, n, i, d) - now;
          const Real w =
              dt * solve::interpolate_one(s.points, n, i, v) - share * (after - before) / 2;
          const Real off =
              dt * dt * solve::interpolate_one(s.points, n, i, a) - (after - 2 * now + before);
          way(n, i) = after - now - (k0 * p + k1 * w + k2 * off);
        }
      });
}

void find_pull_of_springs(const Motion::Data& m) {
  const solve::Springs s = m.system.springs;
  const auto d = m.now.displacement, reaction = m.now.reaction;
  device::for_each(
      "rockfold::motion::pull_of_springs", s.points.count, KOKKOS_LAMBDA(const Index n) {
        for (int i = 0; i < 3; ++i)
          if (!(s.held(n, i) > 0))
            reaction(n, i) =
                s.stiffness(n, i) * (s.target(n, i) - solve::interpolate_one(s.points, n, i, d));
      });
}

void prescribe_acceleration(const Motion::Data& m) {
  const solve::Springs s = m.system.springs;
  const Real factor = m.system.spring_factor;
  const auto d = m.now.displacement, prescribed = m.prescribed;
  device::for_each(
      "rockfold::motion::prescribe_acceleration", s.points.count, KOKKOS_LAMBDA(const Index n) {
        for (int i = 0; i < 3; ++i)
          prescribed(n, i) =
              s.held(n, i) > 0
                  ? 0
                  : (s.target(n, i) - solve::interpolate_one(s.points, n, i, d)) / factor;
      });
}

void prescribe_velocity(const Motion::Data& m) {
  const solve::Springs s = m.system.springs;
  const auto slope = m.supports.tables.slope_after(m.now.time);
  const auto table = m.supports.table;
  const bool any_table = m.supports.tables.any();
  const auto v = m.now.velocity, prescribed = m.prescribed;
  device::for_each(
      "rockfold::motion::prescribe_velocity", s.points.count, KOKKOS_LAMBDA(const Index n) {
        for (int i = 0; i < 3; ++i)
          prescribed(n, i) = !(s.held(n, i) > 0) ? solve::interpolate_one(s.points, n, i, v)
                             : any_table && table(n) != none ? slope(3 * table(n) + i)
                                                             : 0;
      });
}

}  // namespace rockfold::motion
