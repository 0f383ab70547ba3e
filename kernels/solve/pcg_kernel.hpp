// Preconditioned conjugate gradients on the device (Hestenes & Stiefel 1952; Saad, Iterative Methods, algorithm 9.1).
//
// Bytes moved a cover and iteration, beside the operator: p·q reads 48; the fused update reads x p r q 96 and the inverse blocks
// 48 and writes x r z 72; p = z + βp reads 48 and writes 24: 336 in all. Two scalars decide: one transfer to the host.
// With multigrid: 48; 144; the cycle; r·z reads 36; p = z + βp reads 36 and writes 24.
#pragma once

#include "kernels/device/sums_kernel.hpp"
#include "kernels/solve/cover_grid_kernel.hpp"
#include "kernels/solve/direct_kernel.hpp"
#include "kernels/solve/multigrid_kernel.hpp"

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
  Real residual = 0;  ///< true ‖b − A x‖ / `reference` at the end; NaN if the solve broke down
  Real reference = 0;      ///< max(‖b‖, reference), or that asked for
  bool converged = false;  ///< the tolerance, or the reduction asked for, was reached
};

/// What approximates A⁻¹: factors where there are some, otherwise multigrid where there is one, otherwise the inverted blocks of whole
/// covers, otherwise the inverted 3×3 blocks of the diagonal.
struct Preconditioning {
  Blocks inverse;
  const Multigrid* grid = nullptr;
  const CoverGrid* cover_grid = nullptr;
  const CoverBlocks* covers = nullptr;
  const Factors* factors = nullptr;
  Real spring_factor = 1;  ///< of the cover grid

  bool any_grid() const { return grid != nullptr || cover_grid != nullptr; }
  /// Whether z = B r takes more than a row at a time.
  bool whole() const { return any_grid() || factors != nullptr; }
};

/// Solves A x = b from the x given.
PcgReport solve_pcg(PcgWork& work, const Apply& a, const Preconditioning& preconditioning,
                    const Field& b, const Field& x, const PcgOptions& options);

}  // namespace rockfold::solve
