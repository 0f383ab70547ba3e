// Preconditioned conjugate gradients on the device (Hestenes & Stiefel 1952; Saad, Iterative Methods, algorithm 9.1).
//
// Bytes moved a cover and iteration, beside the operator: p·q reads 48; the fused update reads x p r q 96 and the inverse blocks
// 48 and writes x r z 72; p = z + βp reads 48 and writes 24: 336 in all. Two scalars decide: one transfer to the host.
// With multigrid: 48; 144; the cycle; r·z reads 36; p = z + βp reads 36 and writes 24.
#pragma once

#include <functional>

#include "kernels/device/sums_kernel.hpp"
#include "kernels/solve/cover_blocks_kernel.hpp"
#include "kernels/solve/multigrid_kernel.hpp"
#include "kernels/solve/operator_kernel.hpp"

namespace rockfold::solve {

struct PcgOptions {
  Real tolerance = 1e-8;  ///< ‖r‖ / reference
  Index max_iterations = 5000;
  Real reference = 0;  ///< N, what residuals are measured against where it exceeds ‖b‖
  Real reduction = 0;  ///< > 0: stop where the starting residual has shrunk to this share instead
};

struct PcgReport {
  Index iterations = 0;
  Real residual =
      0;  ///< true ‖b − A x‖ / max(‖b‖, reference) at the end; NaN if the solve broke down
  Real reference = 0;      ///< max(‖b‖, reference)
  bool converged = false;  ///< the tolerance, or the reduction asked for, was reached
};

/// y = A x, A symmetric and positive semi-definite.
using Apply = std::function<void(const Field& x, const Field& y)>;

/// What approximates A⁻¹: multigrid where there is one, otherwise the inverted blocks of whole covers, otherwise the inverted 3×3
/// blocks of the diagonal.
struct Preconditioning {
  Blocks inverse;
  const Multigrid* grid = nullptr;
  const CoverBlocks* covers = nullptr;
};

/// The vectors that a solve needs; allocated once.
struct PcgWork {
  Field r, p, q;
  Field z;              ///< empty until a solve without multigrid needs it
  Array<Real> partial;  ///< sums of chunks
  Array<Real> scalar;   ///< see pcg.cpp
  decltype(Kokkos::create_mirror_view(Array<Real>())) host_scalar;
};
PcgWork make_pcg_work(Index covers);

/// Solves A x = b from the x given.
PcgReport solve_pcg(PcgWork& work, const Apply& a, const Preconditioning& preconditioning,
                    const Field& b, const Field& x, const PcgOptions& options);

/// Σ x·y, the same for any number of threads.
Real dot(const PcgWork& work, const Field& x, const Field& y);

}  // namespace rockfold::solve
