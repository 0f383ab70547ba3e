// The finest level of the multigrid preconditioner: the operator's rows in single precision.
#include "kernels/solve/level_kernel.hpp"

namespace rockfold::solve {
namespace {

/// The stencils of all materials, combined and scaled.
Array<float> combined_stencils(const DeviceStencil& stencil, const Combination& c, Real scale) {
  const std::vector<Real> from = device::to_host(stencil.table);
  std::vector<float> table;
  for (std::size_t m = 0; m < from.size(); m += DeviceStencil::table_size) {
    for (int o = 0; o < half_neighbours; ++o)
      for (int k = 0; k < 9; ++k) {
        const Real* entry = &from[m + 10 * o];
        table.push_back(static_cast<float>(
            (c.stiffness * entry[k] + (k % 4 == 0 ? c.mass * entry[9] : 0)) / scale));
      }
    table.push_back(static_cast<float>(c.mass * from[m + 10 * half_neighbours] / scale));
  }
  return device::to_device("solve::single_stencil", table);
}

SingleBlocks combined_blocks(const DeviceBlocks& from, const Combination& c, Real scale) {
  SingleBlocks block{from.row, from.slice_begin, from.column,
                     device::allocate<float>("solve::single_value", from.column.extent(0) * 9),
                     device::allocate<float>("solve::single_own", from.row.extent(0) * 3)};
  device::for_each(
      "rockfold::solve::combine", static_cast<Index>(from.row.extent(0)),
      KOKKOS_LAMBDA(const Index slot) {
        const Index slice = slot / slice_lanes, lane = slot % slice_lanes;
        Real mass = from.diagonal(7 * static_cast<std::size_t>(slot) + 6);
        for (Index k = from.slice_begin(slice); k < from.slice_begin(slice + 1); ++k) {
          const Real* v = &from.value(static_cast<std::size_t>(k) * 10 * slice_lanes + lane);
          float* to = &block.value(static_cast<std::size_t>(k) * 9 * slice_lanes + lane);
          const Real m = v[9 * slice_lanes];
          mass += m;
          for (int j = 0; j < 9; ++j)
            to[j * slice_lanes] = static_cast<float>(
                (c.stiffness * v[j * slice_lanes] + (j % 4 == 0 ? c.mass * m : 0)) / scale);
        }
        for (int d = 0; d < 3; ++d)
          block.own(3 * static_cast<std::size_t>(slot) + d) =
              static_cast<float>(c.mass * mass / scale);
      });
  return block;
}

SingleSprings combined_springs(const Springs& from, Real factor, Real scale) {
  const Index count = from.points.count;
  SingleSprings springs{from.points,
                        SingleField("rockfold::solve::single_stiffness", count),
                        SingleField("rockfold::solve::single_force", count),
                        from.row,
                        from.row_begin,
                        from.row_entry,
                        from.entry_point};
  const auto stiffness = from.stiffness;
  device::for_each(
      "rockfold::solve::single_springs", count, KOKKOS_LAMBDA(const Index n) {
        for (int d = 0; d < 3; ++d)
          springs.stiffness(n, d) = static_cast<float>(factor * stiffness(n, d) / scale);
      });
  return springs;
}

}  // namespace

LevelMatrix finest_matrix(const Operator& op, const Springs& springs, const Combination& c,
                          Real spring_factor, Real scale) {
  LevelMatrix a;
  a.rows = op.covers;
  const DeviceStencil& runs = op.stencil;
  a.stencil = {runs.first, runs.length, runs.material, runs.neighbour,
               combined_stencils(runs, c, scale)};
  a.block = combined_blocks(op.block, c, scale);
  if (springs.any()) a.springs = combined_springs(springs, spring_factor, scale);
  a.place = device::allocate<Index>("solve::row_place", op.covers);
  const auto place = a.place, row = op.block.row, first = runs.first, length = runs.length;
  device::for_each(
      "rockfold::solve::place_blocks", static_cast<Index>(row.extent(0)),
      KOKKOS_LAMBDA(const Index slot) {
        if (row(slot) != none) place(row(slot)) = slot;
      });
  device::for_each(
      "rockfold::solve::place_runs", static_cast<Index>(first.extent(0)),
      KOKKOS_LAMBDA(const Index run) {
        for (Index k = 0; k < length(run); ++k) place(first(run) + k) = -1 - run;
      });
  return a;
}

}  // namespace rockfold::solve
