// Block Jacobi over covers: the inverse of the couplings of all functions of each cover, 3n × 3n numbers. For covers of order 1
// and 2 this takes in what the functions of one cover share, which their 3×3 blocks alone leave to the iteration.
#pragma once

#include "kernels/operator/point_terms_kernel.hpp"
#include "kernels/operator/simd.hpp"
#include "src/space/shape_functions.hpp"

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
CoverBlocks make_cover_blocks(Index covers, int functions);

/// Of αK + βM and the terms.
void set_values(const CoverBlocks& blocks, const Operator& op, const PointTerms& terms,
                const Combination& c, const PointTerms& contacts = {});

/// With the terms, from `blocks.inverse` as it holds the blocks of the rock.
void invert_cover_blocks(const CoverBlocks& blocks, const PointTerms& terms,
                         const PointTerms& contacts = {});

/// Where the couplings of each cover with itself stand: its slot of block rows, or −1 − its run.
Array<Index> cover_places(const Operator& op);

/// The widest block.
inline constexpr int most_block_width = 3 * most_functions;

/// Pivots of a matrix of unit diagonal below this are rounding: what they stand for gets no answer. Search directions then have none of it;
/// with some, conjugate gradients follow its energy of rounding, which may be negative, as soon as there is little else left.
constexpr Real least_pivot = 1e-10;

/// a ← its inverse; a symmetric with unit (or zero) diagonal. Cholesky: a = L Lᵀ, then L⁻¹, then L⁻ᵀ L⁻¹.
KOKKOS_INLINE_FUNCTION void invert_symmetric(int n, Real* a) {
  for (int j = 0; j < n; ++j) {
    Real pivot = a[j * n + j];
    for (int k = 0; k < j; ++k) pivot -= a[j * n + k] * a[j * n + k];
    const bool resists = pivot > least_pivot;
    const Real root = resists ? device::math::sqrt(pivot) : 0;
    a[j * n + j] = root;
    for (int k = 0; !resists && k < j; ++k) a[j * n + k] = 0;  // left to itself
    for (int i = j + 1; i < n; ++i) {
      Real sum = a[i * n + j];
      for (int k = 0; k < j; ++k) sum -= a[i * n + k] * a[j * n + k];
      a[i * n + j] = resists ? sum / root : 0;
    }
  }
  for (int j = 0; j < n; ++j) {
    a[j * n + j] = a[j * n + j] > 0 ? 1 / a[j * n + j] : 0;
    for (int i = j + 1; i < n; ++i) {
      Real sum = 0;
      for (int k = j; k < i; ++k) sum -= a[i * n + k] * a[k * n + j];
      a[i * n + j] = a[i * n + i] > 0 ? sum / a[i * n + i] : 0;
    }
  }
  for (int i = 0; i < n; ++i)
    for (int j = 0; j <= i; ++j) {
      Real sum = 0;
      for (int k = i; k < n; ++k) sum += a[k * n + i] * a[k * n + j];
      a[j * n + i] = sum;  // into the upper half: row i of L⁻¹ is needed no more
    }
}

/// a += Nᵀ D N of cover p with itself.
KOKKOS_INLINE_FUNCTION void add_terms(const PointTerms& s, Index p, Index covers, int n, Real* a) {
  const int width = 3 * n;
  for (int k = 0; k < n; ++k) {
    const Index t = find_row(s.row, k * covers + p);
    if (t == none) continue;
    for (Index i = s.row_begin(t); i < s.row_begin(t + 1); ++i) {
      const Index point = s.row_point(i);
      for (Index j = s.points.begin(point); j < s.points.begin(point + 1); ++j) {
        if (s.points.unknown(j) % covers != p) continue;
        const int l = s.points.unknown(j) / covers;
        const Real w = s.row_weight(i) * s.points.weight(j);
        for (int d = 0; d < 3; ++d)
          for (int e = 0; e < 3; ++e)
            a[(3 * k + d) * width + 3 * l + e] += w * s.tangent(point, symmetric_entry(d, e));
      }
    }
  }
}

/// z = B r for one cover; r and z by index 3k + d.
KOKKOS_INLINE_FUNCTION void precondition_cover(const CoverBlocks& blocks, Index p, const Real* r,
                                               Real* z) {
  const int width = blocks.width();
  const Real* row = &blocks.inverse(static_cast<std::size_t>(p) * width * width);  // symmetric
  Real scaled[most_block_width] = {};
  for (int i = 0; i < width; ++i) scaled[i] = r[i] * blocks.scale(i / 3 * blocks.covers + p, i % 3);
  for (int i = 0; i < width; ++i) z[i] = 0;
#ifdef ROCKFOLD_ON_GPU
  for (int j = 0; j < width; ++j, row += width)
    for (int i = 0; i < width; ++i) z[i] += row[i] * scaled[j];
#else
  block_add(width, row, scaled, z);
#endif
  for (int i = 0; i < width; ++i) z[i] *= blocks.scale(i / 3 * blocks.covers + p, i % 3);
}

}  // namespace rockfold::solve
