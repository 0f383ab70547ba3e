// Values of block rows: each row (function k of a cover) is summed by the one thread that owns it, over the regular cells and cut
// elements at its cover in ascending order.
#pragma once

#include "kernels/operator/operator_kernel.hpp"

namespace rockfold::solve {

/// Where the couplings of one row go.
struct RowSink {
  DeviceBlocks block;
  Index slot, slice;
  int lane, k;

  KOKKOS_INLINE_FUNCTION RowSink(const DeviceBlocks& to, Index of_slot, int function)
      : block(to),
        slot(of_slot),
        slice(of_slot / slice_lanes),
        lane(of_slot % slice_lanes),
        k(function) {}

  KOKKOS_INLINE_FUNCTION Index cover() const { return block.row(slot); }

  /// Finds the neighbour q once; its functions are then added by `add`.
  KOKKOS_INLINE_FUNCTION Index find(Index q) const {
    if (q == block.row(slot)) return none;
    const Index begin = block.slice_begin(slice);
    Index at = begin;
    while (block.column(at * slice_lanes + lane) != q) ++at;
    return at - begin;
  }

  /// Adds the first `size` numbers of the coupling (block of 9 of stiffness, row by row, and mass) with function l of the cover
  /// that `find` has placed.
  KOKKOS_INLINE_FUNCTION void add(Index at, int l, const Real* entry, int size = entry_size) const {
    Real* v = at == none ? block.diagonals(slice, k, l) + lane
                         : block.values(slice, k, l) + at * entry_size * slice_lanes + lane;
    for (int m = 0; m < size; ++m) v[m * slice_lanes] += entry[m];
  }

  /// The row's stiffness becomes 0; its mass stays.
  KOKKOS_INLINE_FUNCTION void clear_stiffness() const {
    const Index columns = block.slice_begin(slice + 1) - block.slice_begin(slice);
    for (int l = 0; l < block.functions; ++l)
      for (Index at = -1; at < columns; ++at) {
        Real* v = at < 0 ? block.diagonals(slice, k, l) + lane
                         : block.values(slice, k, l) + at * entry_size * slice_lanes + lane;
        for (int m = 0; m < 9; ++m) v[m * slice_lanes] = 0;
      }
  }
};

/// Calls add_regular(sink, cell, node) and add_cut(sink, element, node) for all that is integrated into each row that has values of
/// its own.
template <class AddRegular, class AddCut>
void fill_rows(const DeviceBlocks& block, int cell_nodes, int part_nodes,
               const AddRegular& add_regular, const AddCut& add_cut) {
  const int n = block.functions;
  const Index owned = static_cast<Index>(block.owning.extent(0)) * slice_lanes;
  device::for_each(
      "rockfold::solve::assemble", owned * n, KOKKOS_LAMBDA(const Index i) {
        const Index slot = block.owning(i / n / slice_lanes) * slice_lanes + i / n % slice_lanes;
        const RowSink sink(block, slot, i % n);
        for (Index s = block.source_begin(sink.slot); s < block.source_begin(sink.slot + 1); ++s) {
          const Source source = block.source(s);
          if (source >= 0)
            add_regular(sink, static_cast<Index>(source / cell_nodes),
                        static_cast<int>(source % cell_nodes));
          else
            add_cut(sink, static_cast<Index>((-1 - source) / part_nodes),
                    static_cast<int>((-1 - source) % part_nodes));
        }
      });
}

}  // namespace rockfold::solve
