#include <algorithm>
#include <cmath>
#include <limits>

#include "kernels/krylov/bicgstab_kernel.hpp"
#include "src/base/interrupt.hpp"

namespace rockfold::solve {
namespace {

/// y = a x + b y
void combine(Real a, const Field& x, Real b, const Field& y) {
  device::for_each(
      "rockfold::solve::combine", static_cast<Index>(y.extent(0)), KOKKOS_LAMBDA(const Index p) {
        for (int d = 0; d < 3; ++d) y(p, d) = a * x(p, d) + (b == 0 ? 0 : b * y(p, d));
      });
}

Real find_residual(const KrylovWork& work, const Apply& a, const Field& b, const Field& x) {
  a(x, work.r);
  combine(1, b, -1, work.r);
  return std::sqrt(dot(work, work.r, work.r));
}

/// From r as it is until its norm is at most `target`, or rounding ends it. The norm that the recurrence has.
Real iterate(const KrylovWork& work, const BicgstabWork& more, const Apply& a,
             const ApplyInverse& b_inverse, const Field& x, Real target, Index most,
             Index& iterations) {
  const Field r = work.r, p = work.p, t = work.q, z = work.z, v = more.v, y = more.step;
  Kokkos::deep_copy(more.shadow, r);
  Real size = std::sqrt(dot(work, r, r));
  const Real shadow = size;
  Real rho = 1, alpha = 1, omega = 1;
  for (bool first = true; iterations < most && size > target && !interrupt_signal; first = false) {
    const Real now = dot(work, more.shadow, r);
    // Orthogonal to rounding: no direction to go on in.
    if (!(std::abs(now) > std::numeric_limits<Real>::epsilon() * shadow * size)) break;
    if (first) {
      Kokkos::deep_copy(p, r);
    } else {
      combine(-omega, v, 1, p);
      combine(1, r, now / rho * alpha / omega, p);
    }
    rho = now;
    b_inverse(p, y, work.energy);
    a(y, v);
    const Real along = dot(work, more.shadow, v);
    if (along == 0 || !std::isfinite(along)) break;
    alpha = rho / along;
    combine(-alpha, v, 1, r);
    b_inverse(r, z, work.energy);
    a(z, t);
    const Real square = dot(work, t, t);
    omega = square > 0 ? dot(work, t, r) / square : 0;
    combine(alpha, y, 1, x);
    combine(omega, z, 1, x);
    combine(-omega, t, 1, r);
    size = std::sqrt(dot(work, r, r));
    ++iterations;
    if (omega == 0 || !std::isfinite(size)) break;
  }
  return size;
}

}  // namespace

BicgstabWork make_bicgstab_work(Index unknowns) {
  return {device::make_field("solve::bicgstab_shadow", unknowns),
          device::make_field("solve::bicgstab_v", unknowns),
          device::make_field("solve::bicgstab_step", unknowns)};
}

PcgReport solve_bicgstab(const KrylovWork& work, const BicgstabWork& more, const Apply& a,
                         const ApplyInverse& b_inverse, const Field& b, const Field& x,
                         const PcgOptions& options) {
  PcgReport report;
  report.reference = options.reference;
  if (options.measure_load || options.reference == 0)
    report.reference = std::max(std::sqrt(dot(work, b, b)), options.reference);
  if (report.reference == 0) {
    Kokkos::deep_copy(x, 0.0);
    report.residual = 0;
    report.converged = true;
    return report;
  }
  Real residual = find_residual(work, a, b, x);
  const Real target = std::max(
      options.reduction > 0 ? options.reduction * residual : options.tolerance * report.reference,
      std::numeric_limits<Real>::epsilon() * report.reference);
  // The recurrence drifts from the true residual, and may end in a shadow that says nothing: both begin again from there.
  constexpr int most_vain = 3;  // starts in a row that have not halved it
  Real best = residual;
  for (int vain = 0; residual > target && vain < most_vain &&
                     report.iterations < options.max_iterations && !interrupt_signal;) {
    if (!std::isfinite(iterate(work, more, a, b_inverse, x, target, options.max_iterations,
                               report.iterations))) {
      residual = std::numeric_limits<Real>::quiet_NaN();
      break;
    }
    residual = find_residual(work, a, b, x);
    vain = residual < 0.5 * best ? 0 : vain + 1;
    best = std::min(best, residual);
  }
  report.residual = residual / report.reference;
  report.converged = residual <= target;
  return report;
}

}  // namespace rockfold::solve
