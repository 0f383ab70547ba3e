// The inner loops of the operator on a core. Plain C++, compiled for each instruction set where the compiler can; without
// contracted multiply-adds (see src/build_settings.cmake) all versions give the same digits.
#pragma once

#include "src/base/types.hpp"

namespace rockfold::solve {

/// Pointers to the three components of consecutive covers.
struct Components {
  const Real* x[3];
};

/// y_i[k] = scale · x_i[k] for k < length.
void stencil_start(Index length, Real scale, const Components& x, Real* const* y);

/// y_i[k] += Σ_j c[3i+j] ((plus_j[k] − x_j[k]) + (minus_j[k] − x_j[k])) for k < length.
void stencil_add(Index length, const Real* c, const Components& x, const Components& plus,
                 const Components& minus, Real* const* y);

/// Rows k < length that stand `stride` apart, each the sum of `terms` couplings to vectors that run along with them:
/// y = own_mass · own + Σ_c block_c (at_c − own for c < differences, else at_c). block: [terms][9].
void stencil_gather(Index length, Index stride, Index differences, Index terms, const Real* block,
                    const Components* at, const Components& own, Real own_mass, Real* const* y);

/// Rows that stand side by side in a slice of block rows on a core: one AVX-512 register, two of AVX2.
inline constexpr int simd_lanes = 8;

/// sum_i[l] += Σ over `columns` of the block times stiffness · (x there − own) + mass entry · mass · x there.
/// column: [columns][8]; value: [columns][10][8], block of 9 and mass entry; own, sum: [3][8].
void slice_add(Index columns, const Index* column, const Real* value, Real stiffness, Real mass,
               const Components& x, const Real (*own)[simd_lanes], Real (*sum)[simd_lanes]);

/// sum[r] += Σ_e value[e][r] u[e], r, e < width.
void block_add(int width, const Real* value, const Real* u, Real* sum);

}  // namespace rockfold::solve
