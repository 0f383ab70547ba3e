// Block Jacobi over covers: the inverse of the couplings of all functions of each cover, 3n × 3n numbers. For covers of order 1
// and 2 this takes in what the functions of one cover share, which their 3×3 blocks alone leave to the iteration.
#pragma once

#include "kernels/solve/springs_kernel.hpp"

namespace rockfold::solve {

/// B = S C S with S the roots of the diagonal's inverses, and C the inverse of a cover's matrix once that is scaled to a
/// unit diagonal, so that slivers are as good as other covers. A direction that the matrix does not resist is left
/// to itself with unit stiffness; a function without any stiffness stays at rest.
struct CoverBlocks {
  Index covers = 0;
  int functions = 0;
  Array<Real> inverse;  ///< [P][3n][3n] C, index 3k + d
  Field scale;          ///< [U] S

  KOKKOS_INLINE_FUNCTION int width() const { return 3 * functions; }
};
CoverBlocks make_cover_blocks(const Operator& op);

/// Of αK + βM + γ NᵀkN.
void set_values(const CoverBlocks& blocks, const Operator& op, const Springs& springs,
                const Combination& c, Real spring_factor);

/// The widest block: ten functions.
inline constexpr int most_block_width = 30;

/// z = B r for one cover; r and z by index 3k + d.
KOKKOS_INLINE_FUNCTION void precondition_cover(const CoverBlocks& blocks, Index p, const Real* r,
                                               Real* z) {
  const int width = blocks.width();
  const Real* row = &blocks.inverse(static_cast<std::size_t>(p) * width * width);
  Real scaled[most_block_width];
  for (int i = 0; i < width; ++i) scaled[i] = r[i] * blocks.scale(i / 3 * blocks.covers + p, i % 3);
  for (int i = 0; i < width; ++i, row += width) {
    Real sum = 0;
    for (int j = 0; j < width; ++j) sum += row[j] * scaled[j];
    z[i] = sum * blocks.scale(i / 3 * blocks.covers + p, i % 3);
  }
}

}  // namespace rockfold::solve
