// The inner loops of the multigrid levels on a core, in single precision: see simd.hpp.
#pragma once

#include "kernels/operator/simd.hpp"

namespace rockfold::solve {

/// Pointers to the three components of consecutive rows.
struct SingleComponents {
  const float* x[3];
};

/// y_i[k] += Σ_j c[3i+j] ((plus_j[k] − x_j[k]) + (minus_j[k] − x_j[k])) for k < length.
void stencil_add(Index length, const float* c, const SingleComponents& x,
                 const SingleComponents& plus, const SingleComponents& minus, float* const* y);

/// sum_i[l] += Σ over `columns` of the block times (x there − own). column: [columns][8]; value: [columns][9][8]; own, sum: [3][8].
void slice_add(Index columns, const Index* column, const float* value, const SingleComponents& x,
               const float (*own)[simd_lanes], float (*sum)[simd_lanes]);

/// One step of a smoother for consecutive rows: r −= y; step = old_share · d + new_share · B r; x += step.
struct SingleStep {
  const float* y[3];
  const float* d[3];
  const float* inverse[6];  ///< B: xx yy zz xy yz zx
  float* r[3];
  float* x[3];
  float* step[3];
};
void smooth_rows(Index length, float old_share, float new_share, const SingleStep& rows);

}  // namespace rockfold::solve
