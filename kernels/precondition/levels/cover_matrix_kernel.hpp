// Block rows of covers with all functions, and Galerkin's product of such rows.
#pragma once

#include "kernels/precondition/cover_blocks_kernel.hpp"

namespace rockfold::solve {

/// Rows of covers with all functions: y_p = Σ_q A_pq x_q. In double: what slivers hardly resist would drown in single precision.
struct CoverMatrix {
  Index covers = 0;
  int functions = 0;
  Array<Index> begin, column;  ///< [P+1]; ascending
  Array<Real> value;           ///< [columns][3n of q][3n of p], index 3k + d

  KOKKOS_INLINE_FUNCTION int width() const { return 3 * functions; }
};

/// From the covers of a level to those of the next finer one, and back.
struct CoverTransfer {
  Array<Index> parent_begin, parent, child_begin, child;
  Array<Real> parent_weight, child_weight;
  Array<Real> parent_step,
      child_step;  ///< [entries][3] finer place − coarser place, in cells of the lattice
  bool quadratic =
      false;  ///< whether functions 4 … 9 are ξξ, whose coarse ones carry along functions ξ

  KOKKOS_INLINE_FUNCTION Real weight_of_parent(Index, Index entry) const {
    return parent_weight(entry);
  }
  KOKKOS_INLINE_FUNCTION const Real* step_of_parent(Index entry) const {
    return &parent_step(3 * entry);
  }
  KOKKOS_INLINE_FUNCTION const Real* step_of_child(Index entry) const {
    return &child_step(3 * entry);
  }
};

/// f += weight · what the coarse functions c are there (cover_grid_kernel.hpp's G), by function.
KOKKOS_INLINE_FUNCTION void prolong(int n, bool quadratic, Real weight, const Real* step,
                                    const Real* c, Real* f) {
  for (int k = 0; k < n; ++k) f[k] += weight * c[k];
  if (!quadratic) return;
  for (int d = 0; d < 3; ++d) {
    const int e = (d + 1) % 3, g = (d + 2) % 3;
    f[1 + d] += weight * (step[d] * c[4 + d] + 0.5 * step[e] * c[7 + d] + 0.5 * step[g] * c[7 + g]);
  }
}

/// The transpose, without weight, in place: entries of one function are `stride` apart.
KOKKOS_INLINE_FUNCTION void restrict_in_place(bool quadratic, const Real* step, Real* f,
                                              int stride) {
  if (!quadratic) return;
  for (int d = 0; d < 3; ++d) {
    const int e = (d + 1) % 3;
    f[(4 + d) * stride] += step[d] * f[(1 + d) * stride];
    f[(7 + d) * stride] += 0.5 * (step[e] * f[(1 + d) * stride] + step[d] * f[(1 + e) * stride]);
  }
}

/// The rows of a level.
struct MatrixRows {
  CoverMatrix a;

  KOKKOS_INLINE_FUNCTION Index count(Index i) const { return a.begin(i + 1) - a.begin(i); }
  KOKKOS_INLINE_FUNCTION Index load(Index i, Index m, Real* to) const {
    const int size = a.width() * a.width();
    const Real* v = &a.value(static_cast<std::size_t>(a.begin(i) + m) * size);
    for (int e = 0; e < size; ++e) to[e] = v[e];
    return a.column(a.begin(i) + m);
  }
};

KOKKOS_INLINE_FUNCTION Real* find_block(const CoverMatrix& a, Index row, Index column) {
  Index low = a.begin(row), high = a.begin(row + 1);
  while (low < high) {
    const Index middle = (low + high) / 2;
    if (a.column(middle) < column)
      low = middle + 1;
    else
      high = middle;
  }
  if (low == a.begin(row + 1) || a.column(low) != column) return nullptr;
  return &a.value(static_cast<std::size_t>(low) * a.width() * a.width());
}

/// Adds weight · a P of a block in the finer cover j's column to a coarse row, in the columns of j's parents.
template <class Transfer>
KOKKOS_INLINE_FUNCTION void add_to_parents(const Transfer& p, const CoverMatrix& to, Index row,
                                           Index j, Real weight, const Real* a) {
  const int n = to.functions, width = 3 * n, size = width * width;
  for (Index q = p.parent_begin(j); q < p.parent_begin(j + 1); ++q) {
    Real* sum = find_block(to, row, p.parent(q));
    if (sum == nullptr) continue;
    const Real w = weight * p.weight_of_parent(j, q);
    if (!p.quadratic) {
      for (int e = 0; e < size; ++e) sum[e] += w * a[e];
      continue;
    }
    Real b[most_block_width];
    for (int r = 0; r < width; ++r)
      for (int d = 0; d < 3; ++d) {
        for (int f = 0; f < n; ++f) b[f] = a[(3 * f + d) * width + r];
        restrict_in_place(true, p.step_of_parent(q), b, 1);
        for (int f = 0; f < n; ++f) sum[(3 * f + d) * width + r] += w * b[f];
      }
  }
}

/// One row of Pᵀ A P: a coarse row gathers from the rows of its children, so that each value is summed by one thread in one order.
template <class Rows, class Transfer>
KOKKOS_INLINE_FUNCTION void multiply_row(const Rows& fine, const Transfer& p, const CoverMatrix& to,
                                         Index row) {
  const int width = to.width(), size = width * width;
  Real a[most_block_width * most_block_width];
  for (Index k = to.begin(row); k < to.begin(row + 1); ++k)
    for (int e = 0; e < size; ++e) to.value(static_cast<std::size_t>(k) * size + e) = 0;
  for (Index c = p.child_begin(row); c < p.child_begin(row + 1); ++c) {
    const Index i = p.child(c), blocks = fine.count(i);
    for (Index m = 0; m < blocks; ++m) {
      const Index j = fine.load(i, m, a);
      if (j == none) continue;
      for (int e = 0; p.quadratic && e < width; ++e)
        for (int d = 0; d < 3; ++d)
          restrict_in_place(true, p.step_of_child(c), a + e * width + d, 3);
      add_to_parents(p, to, row, j, p.child_weight(c), a);
    }
  }
}

}  // namespace rockfold::solve
