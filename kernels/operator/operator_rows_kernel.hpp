// The rows of the operator as blocks of whole covers, for those who need the matrix itself.
#pragma once

#include "kernels/precondition/cover_blocks_kernel.hpp"

namespace rockfold::solve {

/// The rows of the operator, block by block.
struct OperatorRows {
  DeviceStencil stencil;
  DeviceBlocks block;
  Array<Index> place;
  Combination c;
  int functions;

  /// How many blocks a row has room for.
  KOKKOS_INLINE_FUNCTION Index count(Index i) const {
    const Index at = place(i);
    if (at < 0) return stencil.run_offsets(-1 - at);
    const Index slice = at / slice_lanes;
    return 1 + block.slice_begin(slice + 1) - block.slice_begin(slice);
  }
  /// The cover of the column of block m, none for padding. Block 0 is that of the cover itself.
  KOKKOS_INLINE_FUNCTION Index column(Index i, Index m) const {
    if (m == 0) return i;
    const Index at = place(i);
    if (at < 0) {
      const Index run = -1 - at;
      return stencil.neighbour(stencil.neighbour_begin(run) + m - 1) + i - stencil.first(run);
    }
    const Index slice = at / slice_lanes, lane = at % slice_lanes;
    const Index j = block.column((block.slice_begin(slice) + m - 1) * slice_lanes + lane);
    return j == i ? none : j;
  }
  /// Block m as [column][row]; returns column(i, m).
  KOKKOS_INLINE_FUNCTION Index load(Index i, Index m, Real* a) const {
    const Index at = place(i), j = column(i, m);
    if (j == none) return none;
    if (at < 0) {
      const Index run = -1 - at, offsets = stencil.run_offsets(run);
      for (int k = 0; k < functions; ++k)
        for (int l = 0; l < functions; ++l)
          store(k, l, stencil.of_run(run) + stencil.entry(offsets, k, m, l), 1, a);
      return j;
    }
    const Index slice = at / slice_lanes, lane = at % slice_lanes;
    for (int k = 0; k < functions; ++k)
      for (int l = 0; l < functions; ++l)
        store(k, l,
              m == 0 ? block.diagonals(slice, k, l) + lane
                     : block.values(slice, k, l) +
                           static_cast<std::size_t>(m - 1) * entry_size * slice_lanes + lane,
              slice_lanes, a);
    return j;
  }

 private:
  KOKKOS_INLINE_FUNCTION void store(int k, int l, const Real* v, int lanes, Real* a) const {
    const int width = 3 * functions;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) a[(3 * l + j) * width + 3 * k + i] = c.entry(v, 3 * i + j, lanes);
  }
};

inline OperatorRows rows_of(const Operator& op, const Combination& c) {
  return {op.stencil, op.block, cover_places(op), c, op.functions};
}

}  // namespace rockfold::solve
