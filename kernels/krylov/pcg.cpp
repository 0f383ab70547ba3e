#include <algorithm>
#include <cmath>
#include <limits>

#include "kernels/krylov/pcg_kernel.hpp"
#include "src/base/interrupt.hpp"

namespace rockfold::solve {
namespace {

using device::Sums;

/// Places in KrylovWork::scalar. The first three go to the host.
enum Scalar { squared_residual, direction_energy, result, energy_before, alpha, scalars };

KOKKOS_INLINE_FUNCTION Real dot_row(const Field& x, const Field& y, Index p) {
  return x(p, 0) * y(p, 0) + x(p, 1) * y(p, 1) + x(p, 2) * y(p, 2);
}

Index rows(const KrylovWork& work) {
  return static_cast<Index>(work.r.extent(0));
}

/// The one transfer of an iteration.
void fetch_scalars(const KrylovWork& work) {
  Kokkos::deep_copy(work.host_scalar, work.scalar);
}

/// r = b − A x; returns ‖r‖.
Real find_residual(const KrylovWork& work, const Apply& a, const Field& b, const Field& x) {
  a(x, work.q);
  const KrylovWork w = work;
  device::sum_then<1>(
      "rockfold::solve::pcg_residual", rows(w), w.partial,
      KOKKOS_LAMBDA(const Index i, Sums<1>& sum) {
        for (int d = 0; d < 3; ++d) w.r(i, d) = b(i, d) - w.q(i, d);
        sum.value[0] += dot_row(w.r, w.r, i);
      },
      KOKKOS_LAMBDA(const Sums<1>& sum) { w.scalar(squared_residual) = sum.value[0]; });
  fetch_scalars(work);
  return std::sqrt(work.host_scalar(squared_residual));
}

/// z = B r; p = z + β p with β = new r·z / old r·z, or p = z at the first step.
void turn(const KrylovWork& work, const ApplyInverse& b_inverse, bool first) {
  b_inverse(work.r, work.z, work.energy);
  const KrylovWork w = work;
  device::for_each(
      "rockfold::solve::pcg_direction", rows(w), KOKKOS_LAMBDA(const Index i) {
        const Real share = first ? 0 : w.energy(0) / w.scalar(energy_before);
        for (int d = 0; d < 3; ++d) w.p(i, d) = w.z(i, d) + (first ? 0 : share * w.p(i, d));
      });
}

/// q = A p, α = r·z / p·q, x += α p, r −= α q.
void take_step(const KrylovWork& work, const Apply& a, const Field& x) {
  a(work.p, work.q);
  const KrylovWork w = work;
  device::sum_then<1>(
      "rockfold::solve::pcg_dot", rows(w), w.partial,
      KOKKOS_LAMBDA(const Index i, Sums<1>& sum) { sum.value[0] += dot_row(w.p, w.q, i); },
      KOKKOS_LAMBDA(const Sums<1>& sum) {
        w.scalar(direction_energy) = sum.value[0];
        w.scalar(alpha) = sum.value[0] > 0 ? w.energy(0) / sum.value[0] : 0;
        w.scalar(energy_before) = w.energy(0);
      });
  device::sum_then<1>(
      "rockfold::solve::pcg_step", rows(w), w.partial,
      KOKKOS_LAMBDA(const Index i, Sums<1>& sum) {
        const Real step = w.scalar(alpha);
        for (int d = 0; d < 3; ++d) {
          x(i, d) += step * w.p(i, d);
          w.r(i, d) -= step * w.q(i, d);
        }
        sum.value[0] += dot_row(w.r, w.r, i);
      },
      KOKKOS_LAMBDA(const Sums<1>& sum) { w.scalar(squared_residual) = sum.value[0]; });
}

/// Of the energy of x: what is less is rounding of x, ε² in energy. What residual is then left lies where B is nothing (functions that
/// depend on each other), and to follow it blows x up.
constexpr Real least_energy =
    std::numeric_limits<Real>::epsilon() * std::numeric_limits<Real>::epsilon();

enum class End { target, limit, no_energy, broken };

/// Iterates until the recurrence's residual is at most `target`, or a direction has no energy: rounding where A is singular or nearly so (no
/// step was taken), or A is not positive. Broken where A, B or b are not fit. `energy`: the largest of x and of steps to it so far.
End iterate(const KrylovWork& work, const Apply& a, const ApplyInverse& b_inverse, const Field& x,
            Real target, Index max_iterations, Index& iterations, Real& energy) {
  for (bool first = true; iterations < max_iterations && !interrupt_signal; first = false) {
    turn(work, b_inverse, first);
    take_step(work, a, x);
    fetch_scalars(work);
    ++iterations;
    const Real residual = std::sqrt(work.host_scalar(squared_residual));
    if (!std::isfinite(residual)) return End::broken;
    if (!(work.host_scalar(direction_energy) > 0)) return End::no_energy;
    if (residual <= target) return End::target;
    energy = std::max(energy, work.host_scalar(energy_before));
    if (work.host_scalar(energy_before) <= least_energy * energy) return End::no_energy;
  }
  return End::limit;
}

/// Share of the tolerance below which no reduction goes.
constexpr Real far_below = 1e-3;

}  // namespace

KrylovWork make_krylov_work(Index unknowns) {
  KrylovWork work;
  work.r = device::make_field("solve::krylov_r", unknowns);
  work.p = device::make_field("solve::krylov_p", unknowns);
  work.q = device::make_field("solve::krylov_q", unknowns);
  work.z = device::make_field("solve::krylov_z", unknowns);
  work.before = device::make_field("solve::krylov_before", unknowns);
  work.partial = device::allocate<Real>("solve::krylov_partial", 2 * device::chunk_count(unknowns));
  work.energy = Array<Real>("rockfold::solve::krylov_energy", 1);
  work.scalar = Array<Real>("rockfold::solve::krylov_scalar", scalars);
  work.host_scalar = Kokkos::create_mirror_view(work.scalar);
  return work;
}

void dot_on_device(const KrylovWork& work, const Field& x, const Field& y, const Array<Real>& to) {
  device::sum_then<1>(
      "rockfold::solve::dot", static_cast<Index>(x.extent(0)), work.partial,
      KOKKOS_LAMBDA(const Index i, Sums<1>& sum) { sum.value[0] += dot_row(x, y, i); },
      KOKKOS_LAMBDA(const Sums<1>& sum) { to(0) = sum.value[0]; });
}

Real dot(const KrylovWork& work, const Field& x, const Field& y) {
  const auto scalar = work.scalar;
  device::sum_then<1>(
      "rockfold::solve::dot", static_cast<Index>(x.extent(0)), work.partial,
      KOKKOS_LAMBDA(const Index i, Sums<1>& sum) { sum.value[0] += dot_row(x, y, i); },
      KOKKOS_LAMBDA(const Sums<1>& sum) { scalar(result) = sum.value[0]; });
  fetch_scalars(work);
  return work.host_scalar(result);
}

PcgReport solve_pcg(const KrylovWork& work, const Apply& a, const ApplyInverse& b_inverse,
                    const Field& b, const Field& x, const PcgOptions& options) {
  PcgReport report;
  report.reference = options.reference;
  if (options.measure_load || options.reference == 0)
    report.reference = std::max(std::sqrt(dot(work, b, b)), options.reference);
  if (report.reference == 0) {  // nothing pulls: the answer is rest
    Kokkos::deep_copy(x, 0.0);
    report.residual = 0;
    report.converged = true;
    return report;
  }
  if (!std::isfinite(report.reference)) {
    report.residual = std::numeric_limits<Real>::quiet_NaN();
    return report;
  }
  Real residual = find_residual(work, a, b, x);
  // What is left far below the tolerance is rounding, of b and of what b was found from: to reduce that further moves x along what
  // A does not resist.
  const Real floor =
      std::max(std::max(std::numeric_limits<Real>::epsilon(), far_below * options.tolerance) *
                   report.reference,
               std::min(options.rounding, options.tolerance * report.reference));
  const Real target = options.reduction > 0 ? std::max(options.reduction * residual, floor)
                                            : options.tolerance * report.reference;
  // The recurrence drifts from the true residual: that is measured anew, and the search restarted where it had drifted.
  Real before = std::numeric_limits<Real>::infinity(), energy = 0;
  while (!(residual <= target) && report.iterations < options.max_iterations && !interrupt_signal) {
    if (!(residual < 0.5 * before)) break;  // a restart that gains nothing: rounding, or NaN
    before = residual;
    Kokkos::deep_copy(work.before, x);
    energy = std::max(energy, dot(work, x, work.q));  // q = A x
    const End end =
        iterate(work, a, b_inverse, x, target, options.max_iterations, report.iterations, energy);
    report.nothing_resists = end == End::no_energy;
    residual =
        end == End::broken ? std::numeric_limits<Real>::quiet_NaN() : find_residual(work, a, b, x);
    if (end == End::no_energy && !(residual <= before)) {
      Kokkos::deep_copy(x, work.before);
      residual = before;
    }
  }
  report.residual = residual / report.reference;
  report.converged = residual <= target;
  return report;
}

}  // namespace rockfold::solve
