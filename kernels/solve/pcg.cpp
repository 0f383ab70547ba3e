#include <algorithm>
#include <cmath>
#include <limits>

#include "kernels/solve/pcg_kernel.hpp"
#include "src/base/interrupt.hpp"

namespace rockfold::solve {
namespace {

using device::Sums;

/// Places in PcgWork::scalar. The first three go to the host.
enum Scalar { squared_residual, direction_energy, result, residual_energy, alpha, beta, scalars };

KOKKOS_INLINE_FUNCTION Real dot_row(const Field& x, const Field& y, Index p) {
  return x(p, 0) * y(p, 0) + x(p, 1) * y(p, 1) + x(p, 2) * y(p, 2);
}

/// z = D⁻¹ r for one row.
KOKKOS_INLINE_FUNCTION void precondition_row(const Blocks& d, const Real* r, Index p, Real* z) {
  z[0] = d(p, 0) * r[0] + d(p, 3) * r[1] + d(p, 5) * r[2];
  z[1] = d(p, 3) * r[0] + d(p, 1) * r[1] + d(p, 4) * r[2];
  z[2] = d(p, 5) * r[0] + d(p, 4) * r[1] + d(p, 2) * r[2];
}

Index rows(const PcgWork& work) {
  return static_cast<Index>(work.r.extent(0));
}

/// The one transfer of an iteration.
void fetch_scalars(const PcgWork& work) {
  Kokkos::deep_copy(work.host_scalar, work.scalar);
}

/// With the diagonal blocks: r = b − A x, z = D⁻¹ r, p = z.
void start_blocks(const PcgWork& work, const Blocks& inverse, const Field& b) {
  const PcgWork w = work;
  device::sum_then<2>(
      "rockfold::solve::pcg_start", rows(w), w.partial,
      KOKKOS_LAMBDA(const Index i, Sums<2>& sum) {
        Real r[3], z[3];
        for (int d = 0; d < 3; ++d) r[d] = b(i, d) - w.q(i, d);
        precondition_row(inverse, r, i, z);
        for (int d = 0; d < 3; ++d) {
          w.r(i, d) = r[d];
          w.p(i, d) = z[d];
          sum.value[0] += r[d] * r[d];
          sum.value[1] += r[d] * z[d];
        }
      },
      KOKKOS_LAMBDA(const Sums<2>& sum) {
        w.scalar(squared_residual) = sum.value[0];
        w.scalar(residual_energy) = sum.value[1];
      });
}

/// α = r·z / p·q.
void find_step(const PcgWork& work) {
  const PcgWork w = work;
  device::sum_then<1>(
      "rockfold::solve::pcg_dot", rows(w), w.partial,
      KOKKOS_LAMBDA(const Index i, Sums<1>& sum) { sum.value[0] += dot_row(w.p, w.q, i); },
      KOKKOS_LAMBDA(const Sums<1>& sum) {
        w.scalar(direction_energy) = sum.value[0];
        w.scalar(alpha) = sum.value[0] > 0 ? w.scalar(residual_energy) / sum.value[0] : 0;
      });
}

/// With the diagonal blocks: x += α p, r −= α q, z = D⁻¹ r, β = new r·z / old r·z.
void take_step_blocks(const PcgWork& work, const Blocks& inverse, const Field& x) {
  const PcgWork w = work;
  device::sum_then<2>(
      "rockfold::solve::pcg_update", rows(w), w.partial,
      KOKKOS_LAMBDA(const Index i, Sums<2>& sum) {
        const Real step = w.scalar(alpha);
        Real r[3], z[3];
        for (int d = 0; d < 3; ++d) {
          x(i, d) += step * w.p(i, d);
          r[d] = w.r(i, d) - step * w.q(i, d);
        }
        precondition_row(inverse, r, i, z);
        for (int d = 0; d < 3; ++d) {
          w.r(i, d) = r[d];
          w.z(i, d) = z[d];
          sum.value[0] += r[d] * r[d];
          sum.value[1] += r[d] * z[d];
        }
      },
      KOKKOS_LAMBDA(const Sums<2>& sum) {
        w.scalar(beta) = sum.value[1] / w.scalar(residual_energy);
        w.scalar(residual_energy) = sum.value[1];
        w.scalar(squared_residual) = sum.value[0];
      });
}

/// start_blocks with the blocks of whole covers.
void start_covers(const PcgWork& work, const CoverBlocks& blocks, const Field& b) {
  const PcgWork w = work;
  const CoverBlocks m = blocks;
  device::sum_then<2>(
      "rockfold::solve::pcg_start_covers", m.covers, w.partial,
      KOKKOS_LAMBDA(const Index i, Sums<2>& sum) {
        Real r[most_block_width], z[most_block_width];
        for (int e = 0; e < m.width(); ++e) {
          const Index u = e / 3 * m.covers + i;
          r[e] = b(u, e % 3) - w.q(u, e % 3);
        }
        precondition_cover(m, i, r, z);
        for (int e = 0; e < m.width(); ++e) {
          const Index u = e / 3 * m.covers + i;
          w.r(u, e % 3) = r[e];
          w.p(u, e % 3) = z[e];
          sum.value[0] += r[e] * r[e];
          sum.value[1] += r[e] * z[e];
        }
      },
      KOKKOS_LAMBDA(const Sums<2>& sum) {
        w.scalar(squared_residual) = sum.value[0];
        w.scalar(residual_energy) = sum.value[1];
      });
}

/// take_step_blocks with the blocks of whole covers.
void take_step_covers(const PcgWork& work, const CoverBlocks& blocks, const Field& x) {
  const PcgWork w = work;
  const CoverBlocks m = blocks;
  device::sum_then<2>(
      "rockfold::solve::pcg_update_covers", m.covers, w.partial,
      KOKKOS_LAMBDA(const Index i, Sums<2>& sum) {
        const Real step = w.scalar(alpha);
        Real r[most_block_width], z[most_block_width];
        for (int e = 0; e < m.width(); ++e) {
          const Index u = e / 3 * m.covers + i;
          x(u, e % 3) += step * w.p(u, e % 3);
          r[e] = w.r(u, e % 3) - step * w.q(u, e % 3);
        }
        precondition_cover(m, i, r, z);
        for (int e = 0; e < m.width(); ++e) {
          const Index u = e / 3 * m.covers + i;
          w.r(u, e % 3) = r[e];
          w.z(u, e % 3) = z[e];
          sum.value[0] += r[e] * r[e];
          sum.value[1] += r[e] * z[e];
        }
      },
      KOKKOS_LAMBDA(const Sums<2>& sum) {
        w.scalar(beta) = sum.value[1] / w.scalar(residual_energy);
        w.scalar(residual_energy) = sum.value[1];
        w.scalar(squared_residual) = sum.value[0];
      });
}

/// With diagonal blocks of either kind: p = z + β p.
void turn_blocks(const PcgWork& work) {
  const PcgWork w = work;
  device::for_each(
      "rockfold::solve::pcg_direction", rows(w), KOKKOS_LAMBDA(const Index i) {
        const Real share = w.scalar(beta);
        for (int d = 0; d < 3; ++d) w.p(i, d) = w.z(i, d) + share * w.p(i, d);
      });
}

/// With multigrid: r = b − A x.
void start_grid(const PcgWork& work, const Field& b) {
  const PcgWork w = work;
  device::sum_then<1>(
      "rockfold::solve::pcg_residual", rows(w), w.partial,
      KOKKOS_LAMBDA(const Index i, Sums<1>& sum) {
        for (int d = 0; d < 3; ++d) {
          const Real r = b(i, d) - w.q(i, d);
          w.r(i, d) = r;
          sum.value[0] += r * r;
        }
      },
      KOKKOS_LAMBDA(const Sums<1>& sum) { w.scalar(squared_residual) = sum.value[0]; });
}

/// With multigrid: x += α p, r −= α q.
void take_step_grid(const PcgWork& work, const Field& x) {
  const PcgWork w = work;
  device::sum_then<1>(
      "rockfold::solve::pcg_step", rows(w), w.partial,
      KOKKOS_LAMBDA(const Index i, Sums<1>& sum) {
        const Real step = w.scalar(alpha);
        for (int d = 0; d < 3; ++d) {
          x(i, d) += step * w.p(i, d);
          const Real r = w.r(i, d) - step * w.q(i, d);
          w.r(i, d) = r;
          sum.value[0] += r * r;
        }
      },
      KOKKOS_LAMBDA(const Sums<1>& sum) { w.scalar(squared_residual) = sum.value[0]; });
}

/// With multigrid: z = B r; p = z + β p with β = new r·z / old r·z, or p = z at the first step.
void turn_grid(const PcgWork& work, const Multigrid& grid, bool first) {
  precondition(grid, work.r, work.scalar);
  const PcgWork w = work;
  const auto z = grid.levels[0].x;
  const Real scale = grid.scale;
  device::sum_then<1>(
      "rockfold::solve::pcg_energy", rows(w), w.partial,
      KOKKOS_LAMBDA(const Index i, Sums<1>& sum) {
        for (int d = 0; d < 3; ++d) sum.value[0] += w.r(i, d) * z(i, d);
      },
      KOKKOS_LAMBDA(const Sums<1>& sum) {
        const Real share = device::math::sqrt(w.scalar(squared_residual)) / scale;
        w.scalar(beta) = first ? 0 : share * sum.value[0] / w.scalar(residual_energy);
        w.scalar(residual_energy) = share * sum.value[0];
      });
  device::for_each(
      "rockfold::solve::pcg_direction", rows(w), KOKKOS_LAMBDA(const Index i) {
        const Real share = device::math::sqrt(w.scalar(squared_residual)) / scale;
        const Real before = w.scalar(beta);
        for (int d = 0; d < 3; ++d) w.p(i, d) = share * z(i, d) + (first ? 0 : before * w.p(i, d));
      });
}

/// turn_grid with factors, or with the grid of covers with several functions.
void turn_whole(const PcgWork& work, const Apply& a, const Preconditioning& m, bool first) {
  if (m.factors)
    precondition(*m.factors, work.r, work.z);
  else
    precondition(*m.cover_grid, a, m.spring_factor, work.r, work.z);
  const PcgWork w = work;
  device::sum_then<1>(
      "rockfold::solve::pcg_cover_energy", rows(w), w.partial,
      KOKKOS_LAMBDA(const Index i, Sums<1>& sum) { sum.value[0] += dot_row(w.r, w.z, i); },
      KOKKOS_LAMBDA(const Sums<1>& sum) {
        w.scalar(beta) = first ? 0 : sum.value[0] / w.scalar(residual_energy);
        w.scalar(residual_energy) = sum.value[0];
      });
  if (first)
    Kokkos::deep_copy(work.p, work.z);
  else
    turn_blocks(work);
}

void turn(const PcgWork& work, const Apply& a, const Preconditioning& m, bool first) {
  if (m.grid)
    turn_grid(work, *m.grid, first);
  else if (m.whole())
    turn_whole(work, a, m, first);
  else if (!first)
    turn_blocks(work);
}

/// r = b − A x, p = B r; returns ‖r‖.
Real start(const PcgWork& work, const Apply& a, const Preconditioning& m, const Field& b,
           const Field& x) {
  a(x, work.q);
  if (m.whole())
    start_grid(work, b);
  else if (m.covers)
    start_covers(work, *m.covers, b);
  else
    start_blocks(work, m.inverse, b);
  fetch_scalars(work);
  return std::sqrt(work.host_scalar(squared_residual));
}

/// Iterates until the recurrence's residual is at most `target`, or a direction has no energy. Returns that residual; NaN where A, B
/// or b are not fit.
Real iterate(const PcgWork& work, const Apply& a, const Preconditioning& m, const Field& x,
             Real target, Index max_iterations, Index& iterations) {
  turn(work, a, m, true);
  while (iterations < max_iterations && !interrupt_signal) {
    a(work.p, work.q);
    find_step(work);
    if (m.whole())
      take_step_grid(work, x);
    else if (m.covers)
      take_step_covers(work, *m.covers, x);
    else
      take_step_blocks(work, m.inverse, x);
    fetch_scalars(work);
    ++iterations;
    const Real residual = std::sqrt(work.host_scalar(squared_residual));
    if (!std::isfinite(residual)) return std::numeric_limits<Real>::quiet_NaN();
    // A direction without energy: rounding where A is singular or nearly so (no step was taken), or A is not positive.
    if (!(work.host_scalar(direction_energy) > 0)) return residual;
    if (residual <= target) return residual;
    turn(work, a, m, false);
  }
  return std::numeric_limits<Real>::infinity();
}

/// Share of the tolerance below which no reduction goes.
constexpr Real far_below = 1e-3;

}  // namespace

PcgWork make_pcg_work(Index covers) {
  PcgWork work;
  work.r = device::make_field("solve::pcg_r", covers);
  work.p = device::make_field("solve::pcg_p", covers);
  work.q = device::make_field("solve::pcg_q", covers);
  work.partial = device::allocate<Real>("solve::pcg_partial", 2 * device::chunk_count(covers));
  work.scalar = Array<Real>("rockfold::solve::pcg_scalar", scalars);
  work.host_scalar = Kokkos::create_mirror_view(work.scalar);
  return work;
}

Real dot(const PcgWork& work, const Field& x, const Field& y) {
  const auto scalar = work.scalar;
  device::sum_then<1>(
      "rockfold::solve::dot", static_cast<Index>(x.extent(0)), work.partial,
      KOKKOS_LAMBDA(const Index i, Sums<1>& sum) { sum.value[0] += dot_row(x, y, i); },
      KOKKOS_LAMBDA(const Sums<1>& sum) { scalar(result) = sum.value[0]; });
  fetch_scalars(work);
  return work.host_scalar(result);
}

PcgReport solve_pcg(PcgWork& work, const Apply& a, const Preconditioning& preconditioning,
                    const Field& b, const Field& x, const PcgOptions& options) {
  if (!preconditioning.grid && work.z.extent(0) == 0)
    work.z = device::make_field("solve::pcg_z", rows(work));
  PcgReport report;
  report.reference = options.reference;
  if (options.measure_load || options.reference == 0)
    report.reference = std::max(std::sqrt(dot(work, b, b)), options.reference);
  if (report.reference == 0) {  // nothing pulls: the answer is rest
    Kokkos::deep_copy(x, 0.0);
    report.converged = true;
    return report;
  }
  if (!std::isfinite(report.reference)) {
    report.residual = std::numeric_limits<Real>::quiet_NaN();
    return report;
  }
  Real residual = start(work, a, preconditioning, b, x);
  // What is left far below the tolerance is rounding, of b and of what b was found from: to reduce that further moves x along what
  // A does not resist.
  const Real floor =
      std::max(std::max(std::numeric_limits<Real>::epsilon(), far_below * options.tolerance) *
                   report.reference,
               std::min(options.rounding, options.tolerance * report.reference));
  const Real target = options.reduction > 0 ? std::max(options.reduction * residual, floor)
                                            : options.tolerance * report.reference;
  // The recurrence drifts from the true residual: that is measured anew, and the search restarted where it had drifted.
  Real before = std::numeric_limits<Real>::infinity();
  while (!(residual <= target) && report.iterations < options.max_iterations && !interrupt_signal) {
    if (!(residual < 0.5 * before)) break;  // a restart that gains nothing: rounding, or NaN
    before = residual;
    if (std::isnan(iterate(work, a, preconditioning, x, target, options.max_iterations,
                           report.iterations))) {
      residual = std::numeric_limits<Real>::quiet_NaN();
      break;
    }
    residual = start(work, a, preconditioning, b, x);
  }
  report.residual = residual / report.reference;
  report.converged = residual <= target;
  return report;
}

}  // namespace rockfold::solve
