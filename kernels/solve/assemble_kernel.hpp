// Values of block rows: each row (function k of a cover) is summed by the one thread that owns it, over the regular cells and cut
// elements at its cover in ascending order.
#pragma once

#include "kernels/solve/operator_kernel.hpp"

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

  /// Adds the coupling (block of 9, mass) with function l of the cover that `find` has placed.
  KOKKOS_INLINE_FUNCTION void add(Index at, int l, const Real* entry) const {
    Real* v = at == none ? block.diagonals(slice, k, l) + lane
                         : block.values(slice, k, l) + at * entry_size * slice_lanes + lane;
    for (int m = 0; m < entry_size; ++m) v[m * slice_lanes] += entry[m];
  }
};

/// Calls add_regular(sink, cell, node) and add_cut(sink, element, node) for all that is integrated into each row.
template <class AddRegular, class AddCut>
void fill_rows(const DeviceBlocks& block, int cell_nodes, int part_nodes,
               const AddRegular& add_regular, const AddCut& add_cut) {
  const int n = block.functions;
  device::for_each(
      "rockfold::solve::assemble", block.slots() * n, KOKKOS_LAMBDA(const Index i) {
        const RowSink sink(block, i / n, i % n);
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

/// Fills block rows from element matrices, whole cells' elements included, replacing what was there. For a row f of
/// element e (its number in CoverArrays), row(e, f) makes an object whose couple(g, entry) writes the coupling with
/// function g of the element: entry[10] = block of 9 of stiffness, row by row, and mass. f, g count as in part_table_kernel.hpp.
template <class MakeRow>
void fill_blocks(const DeviceBlocks& block, const ElementTable& table, const MakeRow& row) {
  Kokkos::deep_copy(block.value, 0.0);
  Kokkos::deep_copy(block.diagonal, 0.0);
  const PartTable parts = table.parts;
  const auto add_element = KOKKOS_LAMBDA(const RowSink& sink, Index e, int a) {
    const auto of_row = row(e, a * parts.functions + sink.k);
    for (int b = 0; b < parts.nodes; ++b) {
      const Index at = sink.find(table.cover(e, b));
      for (int l = 0; l < parts.functions; ++l) {
        Real entry[entry_size];
        of_row.couple(b * parts.functions + l, entry);
        sink.add(at, l, entry);
      }
    }
  };
  const auto add_cell = KOKKOS_LAMBDA(const RowSink& sink, Index cell, int node) {
    for (int t = 0; t < parts.parts; ++t) {
      const Index e = parts.parts * cell + t;
      const int part = table.part(e);
      for (int a = 0; a < parts.nodes; ++a)
        if (parts.cell_node(part, a) == node) add_element(sink, e, a);
    }
  };
  const auto add_cut = KOKKOS_LAMBDA(const RowSink& sink, Index e, int a) {
    add_element(sink, parts.parts * table.regular + e, a);
  };
  fill_rows(block, parts.cell_nodes, parts.nodes, add_cell, add_cut);
}

}  // namespace rockfold::solve
