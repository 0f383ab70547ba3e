// The finest level of the multigrid preconditioner: the operator's rows in single precision.
#include "kernels/precondition/levels/level_kernel.hpp"

namespace rockfold::solve {
namespace {

/// The stencils of all materials and node classes between functions 0, combined and scaled.
SingleStencil combined_stencils(const DeviceStencil& from, const Combination& c, Real scale) {
  SingleStencil to;
  to.stride = from.stride;
  to.first = from.first;
  to.length = from.length;
  to.neighbour_begin = from.neighbour_begin;
  to.neighbour = from.neighbour;
  if (from.runs() == 0) return to;
  const std::vector<Real> values = device::to_host(from.table);
  const std::vector<Index> begin = device::to_host(from.table_begin),
                           pairs = device::to_host(from.pairs);
  std::vector<float> table;
  std::vector<Index> table_begin;
  for (std::size_t t = 0; t < begin.size(); ++t) {
    table_begin.push_back(static_cast<Index>(table.size()));
    const Index offsets = 1 + 2 * pairs[t % from.classes];
    const Real* of = &values[begin[t]];
    for (Index o = 1; o < offsets; ++o)
      for (int k = 0; k < 9; ++k) {
        table.push_back(static_cast<float>(c.entry(of + from.entry(offsets, 0, o, 0), k) / scale));
      }
    table.push_back(static_cast<float>(c.mass * of[from.row_mass(offsets, 0)] / scale));
  }
  to.table = device::to_device("solve::single_stencil", table);
  const auto of_table = device::to_device("solve::single_table_begin", table_begin);
  to.run_table = device::allocate<Index>("solve::run_table", from.first.extent(0));
  to.run_pairs = device::allocate<Index>("solve::run_pairs", from.first.extent(0));
  const SingleStencil runs = to;
  const DeviceStencil stencil = from;
  device::for_each(
      "rockfold::solve::run_tables", from.runs(), KOKKOS_LAMBDA(const Index run) {
        runs.run_table(run) =
            of_table(stencil.material(run) * stencil.classes + stencil.node_class(run));
        runs.run_pairs(run) = stencil.pairs(stencil.node_class(run));
      });
  return to;
}

SingleBlocks combined_blocks(const DeviceBlocks& from, const Combination& c, Real scale) {
  SingleBlocks block{from.row,
                     from.slice_begin,
                     from.column,
                     from.value_begin,
                     device::allocate<float>(
                         "solve::single_value",
                         from.value.extent(0) / (entry_size * from.functions * from.functions) * 9),
                     device::allocate<float>("solve::single_own", from.row.extent(0) * 3)};
  device::for_each(
      "rockfold::solve::combine", from.slots(), KOKKOS_LAMBDA(const Index slot) {
        const Index slice = slot / slice_lanes, lane = slot % slice_lanes;
        const Index begin = from.slice_begin(slice), end = from.slice_begin(slice + 1);
        const Real mass = from.diagonals(slice, 0, 0)[9 * slice_lanes + lane];
        const bool owns = from.owning(from.owner(slice)) == slice;
        Real sum = 0;
        for (Index k = begin; k < end; ++k) {
          const Real* v = from.values(slice, 0, 0) +
                          static_cast<std::size_t>(k - begin) * entry_size * slice_lanes + lane;
          float* to =
              block.values(slice) + static_cast<std::size_t>(k - begin) * 9 * slice_lanes + lane;
          sum += v[9 * slice_lanes];
          for (int j = 0; owns && j < 9; ++j)
            to[j * slice_lanes] = static_cast<float>(c.entry(v, j, slice_lanes) / scale);
        }
        for (int d = 0; d < 3; ++d)
          block.own(3 * static_cast<std::size_t>(slot) + d) =
              static_cast<float>(c.mass * (mass + sum) / scale);
      });
  return block;
}

}  // namespace

SingleTerms level_terms(const PointTerms& terms, const PointRows& points, Real scale) {
  const Index count = points.points.count;
  SingleTerms single{points, decltype(SingleTerms::tangent)("rockfold::solve::single_terms", count),
                     SingleField("rockfold::solve::single_force", count)};
  const auto from = terms.tangent;
  const auto to = single.tangent;
  device::for_each(
      "rockfold::solve::single_terms", count, KOKKOS_LAMBDA(const Index n) {
        for (int m = 0; m < 6; ++m) to(n, m) = static_cast<float>(from(n, m) / scale);
      });
  return single;
}

std::vector<Index> finest_classes(const Operator& op) {
  std::vector<Index> classes(op.covers, none);
  const std::vector<Index> first = device::to_host(op.stencil.first),
                           length = device::to_host(op.stencil.length),
                           material = device::to_host(op.stencil.material),
                           node_class = device::to_host(op.stencil.node_class);
  for (std::size_t run = 0; run < first.size(); ++run)
    for (Index k = 0; k < length[run]; ++k)
      classes[first[run] + op.stencil.stride * k] =
          material[run] * op.stencil.classes + node_class[run];
  return classes;
}

LevelMatrix finest_matrix(const Operator& op, const Combination& c, Real scale) {
  LevelMatrix a;
  a.rows = op.covers;
  a.stencil = combined_stencils(op.stencil, c, scale);
  a.block = combined_blocks(op.block, c, scale);
  a.place = device::allocate<Index>("solve::row_place", op.covers);
  const auto place = a.place, row = op.block.row;
  const SingleStencil runs = a.stencil;
  device::for_each(
      "rockfold::solve::place_blocks", static_cast<Index>(row.extent(0)),
      KOKKOS_LAMBDA(const Index slot) {
        if (row(slot) != none) place(row(slot)) = slot;
      });
  device::for_each(
      "rockfold::solve::place_runs", runs.runs(), KOKKOS_LAMBDA(const Index run) {
        for (Index k = 0; k < runs.length(run); ++k)
          place(runs.first(run) + runs.stride * k) = -1 - run;
      });
  return a;
}

}  // namespace rockfold::solve
