// The product at the heart of the tangent: couplings of one function of an element with all of its functions. Compiled for each
// instruction set on a core (see kernels/operator/simd.hpp).
#pragma once

#include "kernels/device/device_kernel.hpp"

namespace rockfold::finite {

/// Gradients of an element's functions at a point stand in columns of this many: width ≥ functions, zero beyond.
inline constexpr int column_lanes = 8;
constexpr int padded(int functions) {
  return (functions + column_lanes - 1) / column_lanes * column_lanes;
}

/// row[9][width] += Σ over points of term[point][9][3] · gradient[point][3][width].
KOKKOS_INLINE_FUNCTION void add_products(int points, const Real* term, const Real* gradient,
                                         int width, Real* row) {
  for (int j = 0; j < width; j += column_lanes)
    for (int rc = 0; rc < 9; ++rc) {
      Real sum[column_lanes];
      for (int l = 0; l < column_lanes; ++l) sum[l] = row[rc * width + j + l];
      for (int q = 0; q < points; ++q) {
        const Real *t = term + 27 * q + 3 * rc, *g = gradient + 3 * width * q + j;
        for (int l = 0; l < column_lanes; ++l)
          sum[l] += t[0] * g[l] + t[1] * g[width + l] + t[2] * g[2 * width + l];
      }
      for (int l = 0; l < column_lanes; ++l) row[rc * width + j + l] = sum[l];
    }
}

/// The same, on a core.
void add_products_on_core(int points, const Real* term, const Real* gradient, int width, Real* row);

}  // namespace rockfold::finite
