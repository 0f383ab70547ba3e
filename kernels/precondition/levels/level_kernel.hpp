// One level of the multigrid preconditioner: a matrix in single precision, y = A x with
//   y_i = D_i x_i + Σ_j A_ij (x_j − x_i),   D_i the sum of a row's blocks (mass; diagonal),
// so that a translation meets exactly what it ought to: nothing where the rock is free. All values are divided by `scale`.
// The finest level shares the rows of the operator; coarser ones are block rows. Terms and contacts stand beside them.
#pragma once

#include "kernels/operator/point_terms_kernel.hpp"
#include "kernels/precondition/levels/contact_levels_kernel.hpp"
#include "src/system/coarse_covers.hpp"

namespace rockfold::solve {

using SingleField = Kokkos::View<float* [3], Kokkos::LayoutLeft, device::Memory>;

/// Stencil rows. A table holds the blocks of 9 at offsets +1, −1, +2, −2, … and D.
struct SingleStencil {
  int stride = 1;  ///< between the covers of a run
  Array<Index> first, length, neighbour_begin, neighbour;
  Array<Index> run_table,
      run_pairs;  ///< [runs] where its table begins, how many pairs of offsets it has
  Array<float> table;

  KOKKOS_INLINE_FUNCTION Index runs() const { return static_cast<Index>(first.extent(0)); }
};

/// Block rows, as DeviceBlocks: a slice's values stand as [column][9][lane]. Slices of rows that are alike share them.
struct SingleBlocks {
  Array<Index> row, slice_begin, column;
  Array<Index> value_begin;  ///< [S] where a slice's values begin, in columns
  Array<float> value;
  Array<float> own;  ///< [S·lanes][3] D

  Index slices() const { return static_cast<Index>(slice_begin.extent(0)) - 1; }
  /// Of a slice, [columns][9][lane].
  KOKKOS_INLINE_FUNCTION float* values(Index slice) const {
    return value.data() + static_cast<std::size_t>(value_begin(slice)) * 9 * slice_lanes;
  }
};

/// PointTerms in single precision.
struct SingleTerms : PointRows {
  Kokkos::View<float* [6], Kokkos::LayoutLeft, device::Memory> tangent;
  SingleField force;
};

/// Inverted diagonal blocks, [rows] xx yy zz xy yz zx.
using SingleInverse = Kokkos::View<float* [6], Kokkos::LayoutLeft, device::Memory>;

struct LevelMatrix {
  Index rows = 0;
  SingleStencil stencil;
  SingleBlocks block;
  SingleTerms terms;
  ContactRows contacts;  ///< in double precision
  Array<Index> place;    ///< [rows] where a row stands: its slot of `block`, or −1 − its run
};

/// The finest level: functions 0 of all covers.
LevelMatrix finest_matrix(const Operator& op, const Combination& c, Real scale);

/// The terms of a level whose functions have the weights `points` there.
SingleTerms level_terms(const PointTerms& terms, const PointRows& points, Real scale);

/// Interpolation from a level to the next finer one, and its transpose. A cover between 2ⁿ coarse ones takes as much of each.
struct Interpolation {
  Array<Index> parent_begin, parent;
  Array<Index> child_begin, child;
  Array<std::uint8_t> child_parents;  ///< how many parents a child has: 1, 2, 4 or 8
  KOKKOS_INLINE_FUNCTION float parent_weight(Index cover) const {
    return 1.0F / static_cast<float>(parent_begin(cover + 1) - parent_begin(cover));
  }
  KOKKOS_INLINE_FUNCTION float child_weight(Index entry) const {
    return 1.0F / static_cast<float>(child_parents(entry));
  }

  // as CoverTransfer
  static constexpr bool quadratic = false;
  KOKKOS_INLINE_FUNCTION Real weight_of_parent(Index cover, Index) const {
    return parent_weight(cover);
  }
  KOKKOS_INLINE_FUNCTION static const Real* step_of_parent(Index) { return nullptr; }
  KOKKOS_INLINE_FUNCTION static const Real* step_of_child(Index) { return nullptr; }
};
Interpolation make_interpolation(const CoarseCovers& coarse);

/// The rows of a coarse level, without values: allocated once.
struct CoarseRows {
  SingleBlocks block;
  Array<Index> like;            ///< [S] the first slice with the same values, perhaps itself
  std::vector<Index> unlike;    ///< those that have values of their own, ascending
  Array<Index> place;           ///< see LevelMatrix
  Array<std::int64_t> lattice;  ///< [rows] x + 2²¹ y + 2⁴² z of the row's node
};

/// Rows of one class are alike: the same couplings to the covers around, or `none`. Those of the finest level: full stencils of one
/// table.
std::vector<Index> finest_classes(const Operator& op);
/// Those of a coarse level: rows with one cover at each of the nodes around, whose children are alike in their order.
std::vector<Index> coarse_classes(const CoarseCovers& coarse, const std::vector<Index>& fine);

CoarseRows make_coarse_rows(const CoarseCovers& coarse, const std::vector<Index>& classes);

/// Galerkin's product Pᵀ A P into the rows of the coarse level, without springs.
LevelMatrix coarse_matrix(const LevelMatrix& fine, const Interpolation& p, const CoarseRows& rows);

/// The inverted diagonal blocks of a coarse level.
void invert_diagonal(const LevelMatrix& a, const SingleInverse& inverse);

/// r −= A d; step = old_share · d + new_share · B r; x += step. `step` must be another field than d.
void smooth(const LevelMatrix& a, const SingleInverse& inverse, float old_share, float new_share,
            const SingleField& d, const SingleField& r, const SingleField& x,
            const SingleField& step);

/// r −= A d.
void subtract_product(const LevelMatrix& a, const SingleField& d, const SingleField& r);

}  // namespace rockfold::solve
