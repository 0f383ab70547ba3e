// The linear operator y = (αK + βM) x over all covers, by rows, one writer a row: no atomics, and the same digits for any
// number of threads. K is applied to differences of displacements (its rows sum to zero): a translation gives
// exactly no force however far a block has travelled.
#pragma once

#include "kernels/device/device_kernel.hpp"
#include "kernels/solve/element_kernel.hpp"
#include "kernels/solve/rows.hpp"
#include "kernels/solve/simd.hpp"

namespace rockfold::solve {

using device::Array;
using device::Field;

/// Rows of a slice: SIMD lanes on a core, a warp on a GPU.
inline constexpr int slice_lanes = device::on_gpu ? 32 : simd_lanes;

/// y = (stiffness · K + mass · M) x.
struct Combination {
  Real stiffness = 0, mass = 0;
};

/// Stencil rows. `table` holds for each material 7 × (block of 9, mass), one for each pair of opposite offsets, then the mass
/// of a whole row and the diagonal: block of 9, mass.
struct DeviceStencil {
  static constexpr int table_size = 10 * half_neighbours + 11;
  Array<Index> first, length, material, neighbour;
  Array<Real> table;
};

/// Block rows. A slice's values stand as [column][10][lane]: block of 9, mass.
struct DeviceBlocks {
  Array<Index> row, slice_begin, column, source_begin;
  Array<Source> source;
  Array<Real> value;
  Array<Real> diagonal;  ///< [S·lanes][7] xx yy zz xy yz zx of the diagonal block, mass
};

struct Operator {
  Index covers = 0;
  Index stencil_rows = 0, block_rows = 0;
  std::int64_t block_entries = 0;
  DeviceStencil stencil;
  DeviceBlocks block;
};

/// The place of column q among the sorted columns of a row; padding repeats the row's own id at the end.
KOKKOS_INLINE_FUNCTION Index find_column(const DeviceBlocks& block, Index begin, Index end,
                                         int lane, Index q) {
  while (begin < end && block.column(begin * slice_lanes + lane) != q) ++begin;
  return begin;
}

/// The stiffness of a block row becomes 0; its mass stays.
KOKKOS_INLINE_FUNCTION void clear_stiffness(const DeviceBlocks& block, Index slot) {
  for (int k = 0; k < 6; ++k) block.diagonal(7 * static_cast<std::size_t>(slot) + k) = 0;
  const Index slice = slot / slice_lanes;
  for (Index k = block.slice_begin(slice); k < block.slice_begin(slice + 1); ++k)
    for (int m = 0; m < 9; ++m)
      block.value((static_cast<std::size_t>(k) * 10 + m) * slice_lanes + slot % slice_lanes) = 0;
}

/// Adds a block of 9 to column q of a block row.
KOKKOS_INLINE_FUNCTION void add_stiffness_entry(const DeviceBlocks& block, Index slot, Index q,
                                                const Real* entry) {
  if (q == block.row(slot)) {
    Real* d = &block.diagonal(7 * static_cast<std::size_t>(slot));
    const int at[6] = {0, 4, 8, 1, 5, 2};
    for (int k = 0; k < 6; ++k) d[k] += entry[at[k]];
    return;
  }
  const int lane = slot % slice_lanes;
  const Index slice = slot / slice_lanes;
  const Index k =
      find_column(block, block.slice_begin(slice), block.slice_begin(slice + 1), lane, q);
  Real* v = &block.value(static_cast<std::size_t>(k) * 10 * slice_lanes + lane);
  for (int m = 0; m < 9; ++m) v[m * slice_lanes] += entry[m];
}

/// Moments of the cut elements on the device, [E][10]: volume, first, second.
Array<Real> element_moments(const CoverArrays& covers, const PieceMoments& moments);

/// `stencils`: see sort_rows. Without them all values may be written anew, row by row (below).
Operator build_operator(const CoverArrays& covers, const PieceMoments& moments,
                        const std::vector<ElasticMaterial>& materials, bool stencils = true);

void apply(const Operator& op, const Combination& c, const Field& x, const Field& y);

/// The diagonal blocks of αK + βM, [P] xx yy zz xy yz zx.
using Blocks = Kokkos::View<Real* [6], Kokkos::LayoutLeft, device::Memory>;
void diagonal_blocks(const Operator& op, const Combination& c, const Blocks& d);

/// Inverts the diagonal blocks in place. A block is first scaled to a unit diagonal, so that an element of volume 1e-20 is as
/// good as any other; where even that is singular the diagonal alone is inverted; a row without any stiffness stays at rest.
void invert_blocks(const Blocks& d);

}  // namespace rockfold::solve
