// Preconditioned conjugate gradients on the device (Hestenes & Stiefel 1952; Saad, Iterative Methods, algorithm 9.1).
//
// Bytes moved an unknown vector and iteration, beside A and B: p·q reads 48; x and r read 96 and write 48; p = z + βp reads 48 and writes
// 24: 264 in all. One transfer of two scalars to the host.
#pragma once

#include <limits>

#include "kernels/krylov/krylov_work_kernel.hpp"

namespace rockfold::solve {

struct PcgOptions {
  Real tolerance = 1e-8;  ///< ‖r‖ / reference
  Index max_iterations = 5000;
  Real reference = 0;  ///< N, what residuals are measured against where it exceeds ‖b‖ …
  bool measure_load = true;  ///< … or, if false and it is not zero, whatever ‖b‖ is
  Real rounding =
      0;  ///< N, of b: no reduction goes below it, nor below a thousandth of the tolerance
  Real reduction = 0;  ///< > 0: stop where the starting residual has shrunk to this share instead
};

struct PcgReport {
  Index iterations = 0;
  Real residual = std::numeric_limits<Real>::
      infinity();  ///< true ‖b − A x‖ / `reference` at the end; NaN if the solve broke down, infinite before it
  Real reference = 0;      ///< max(‖b‖, reference), or that asked for
  bool converged = false;  ///< the tolerance, or the reduction asked for, was reached
  /// The search ended in a direction that A does not resist, or that B does not see: what is left of the residual is rounding of A x, as
  /// far as both can tell.
  bool nothing_resists = false;
};

/// Solves A x = b from the x given, A symmetric and positive semi-definite.
PcgReport solve_pcg(const KrylovWork& work, const Apply& a, const ApplyInverse& b_inverse,
                    const Field& b, const Field& x, const PcgOptions& options);

}  // namespace rockfold::solve
