// Application of the operator.
//
// Bytes moved: a stencil row reads x and writes y once (neighbours come from cache): 48 bytes, with the write-allocate 72.
// A block row reads for each neighbour 80 bytes of values and 4 of column, which is nearly all that it moves.
#include "kernels/operator/operator_kernel.hpp"
#include "kernels/operator/simd.hpp"
#include "src/space/shape_functions.hpp"

namespace rockfold::solve {
namespace {

/// Where function `l` of cover p stands, and those after it.
[[maybe_unused]] KOKKOS_INLINE_FUNCTION Components components(const Field& x, Index unknown) {
  return {{&x(unknown, 0), &x(unknown, 1), &x(unknown, 2)}};
}

#ifndef ROCKFOLD_ON_GPU
/// A run of covers with one function on a core: pass after pass over rows that stay in the first-level cache, opposite
/// neighbours together (their couplings are equal: K_ab − K_ba is a boundary term, and none is near).
void apply_run_of_one(const DeviceStencil& stencil, Index run, const Combination& c, const Field& x,
                      const Field& y) {
  const Index first = stencil.first(run), length = stencil.length(run);
  const Index offsets = stencil.run_offsets(run);
  const Real* table = stencil.of_run(run);
  const Components own = components(x, first);
  Real* const out[3] = {&y(first, 0), &y(first, 1), &y(first, 2)};
  stencil_start(length, c.mass * table[stencil.row_mass(offsets, 0)], own, out);
  const Index* q = &stencil.neighbour(stencil.neighbour_begin(run));
  for (Index o = 1; o < offsets; o += 2, q += 2) {
    Real block[9];
    for (int m = 0; m < 9; ++m) block[m] = c.entry(table + entry_size * o, m);
    stencil_add(length, block, own, components(x, q[0]), components(x, q[1]), out);
  }
}

/// A run of covers on a core, function by function.
void apply_run(const DeviceStencil& stencil, Index run, const Combination& c, Index covers,
               const Field& x, const Field& y) {
  const int n = stencil.functions;
  if (n == 1 && stencil.stride == 1) return apply_run_of_one(stencil, run, c, x, y);
  constexpr int most_offsets = 27, most = most_offsets * most_functions;
  Real block[9 * most];
  Components at[most];
  const Index first = stencil.first(run), offsets = stencil.run_offsets(run);
  const Real* table = stencil.of_run(run);
  const Index* q = &stencil.neighbour(stencil.neighbour_begin(run));
  for (int k = 0; k < n; ++k) {
    Index term = 0;
    for (int l = 0; l < n; ++l)
      for (Index o = l == 0 ? 1 : 0; o < offsets; ++o, ++term) {
        for (int m = 0; m < 9; ++m)
          block[9 * term + m] = c.entry(table + stencil.entry(offsets, k, o, l), m);
        at[term] = components(x, l * covers + (o == 0 ? first : q[o - 1]));
      }
    const Index row = k * covers + first;
    Real* const out[3] = {&y(row, 0), &y(row, 1), &y(row, 2)};
    stencil_gather(stencil.length(run), stencil.stride, offsets - 1, term, block, at,
                   components(x, first), c.mass * table[stencil.row_mass(offsets, k)], out);
  }
}

/// A slice of block rows on a core.
void apply_slice(const DeviceBlocks& block, Index slice, const Combination& c, Index covers,
                 const Field& x, const Field& y) {
  constexpr Real nothing[3][slice_lanes] = {};
  const int n = block.functions;
  const Index begin = block.slice_begin(slice), columns = block.slice_begin(slice + 1) - begin;
  Index id[slice_lanes];
  Real own[3][slice_lanes], base[3][slice_lanes];
  bool all_by_difference = true;
  for (int l = 0; l < slice_lanes; ++l) {
    const Index slot = slice * slice_lanes + l, p = block.row(slot);
    id[l] = p == none ? 0 : p;
    all_by_difference &= block.by_difference(slot) != 0;
    for (int i = 0; i < 3; ++i) {
      own[i][l] = p == none ? 0 : x(p, i);
      base[i][l] = own[i][l] * block.by_difference(slot);
    }
  }
  const Index* column = block.column.data() + static_cast<std::size_t>(begin) * slice_lanes;
  for (int k = 0; k < n; ++k) {
    Real sum[3][slice_lanes];
    const Real* mass = block.diagonals(slice, k, 0) + 9 * slice_lanes;
    for (int i = 0; i < 3; ++i)
      for (int l = 0; l < slice_lanes; ++l) sum[i][l] = c.mass * mass[l] * own[i][l];
    for (int f = 0; f < n; ++f) {
      const Components at = components(x, f * covers);
      const auto* from = f == 0 ? base : nothing;
      if (columns > 0)
        slice_add(columns, column, block.values(slice, k, f), c.stiffness, c.mass, at, from, sum);
      if (f > 0)
        slice_add(1, id, block.diagonals(slice, k, f), c.stiffness, c.mass, at, nothing, sum);
      else if (!all_by_difference)
        slice_add(1, id, block.diagonals(slice, k, 0), c.stiffness, 0, at, base, sum);
    }
    for (int l = 0; l < slice_lanes; ++l)
      if (block.row(slice * slice_lanes + l) != none)
        for (int i = 0; i < 3; ++i) y(k * covers + id[l], i) = sum[i][l];
  }
}

#else
/// sum += a coupling times x − own (stiffness) and x (mass); values of one lane stand `lanes` apart.
KOKKOS_INLINE_FUNCTION void add_coupling(const Real* v, int lanes, const Combination& c,
                                         const Field& x, Index q, const Real* own, Real* sum) {
  Real t[3];
  for (int j = 0; j < 3; ++j) t[j] = c.stiffness * (x(q, j) - own[j]);
  const Real m = c.mass * v[9 * lanes];
  for (int i = 0; i < 3; ++i)
    sum[i] += v[3 * i * lanes] * t[0] + v[(3 * i + 1) * lanes] * t[1] +
              v[(3 * i + 2) * lanes] * t[2] + m * x(q, i);
}

/// One row of a slice on a GPU.
KOKKOS_INLINE_FUNCTION void apply_block_row(const DeviceBlocks& block, Index slot, int k,
                                            const Combination& c, Index covers, const Field& x,
                                            const Field& y) {
  const Index p = block.row(slot), slice = slot / slice_lanes, lane = slot % slice_lanes;
  if (p == none) return;
  const Real nothing[3] = {0, 0, 0};
  const Index begin = block.slice_begin(slice), columns = block.slice_begin(slice + 1) - begin;
  const Real mass = c.mass * block.diagonals(slice, k, 0)[9 * slice_lanes + lane];
  Real base[3], sum[3];
  for (int i = 0; i < 3; ++i) {
    base[i] = x(p, i) * block.by_difference(slot);
    sum[i] = mass * x(p, i);
  }
  for (int f = 0; f < block.functions; ++f) {
    const Real* v = block.values(slice, k, f) + lane;
    for (Index j = 0; j < columns; ++j, v += entry_size * slice_lanes)
      add_coupling(v, slice_lanes, c, x,
                   f * covers + block.column((begin + j) * slice_lanes + lane),
                   f == 0 ? base : nothing, sum);
    if (f > 0)
      add_coupling(block.diagonals(slice, k, f) + lane, slice_lanes, c, x, f * covers + p, nothing,
                   sum);
    else
      add_coupling(block.diagonals(slice, k, 0) + lane, slice_lanes, Combination{c.stiffness, 0}, x,
                   p, base, sum);
  }
  for (int i = 0; i < 3; ++i) y(k * covers + p, i) = sum[i];
}

/// One row of a run on a GPU.
KOKKOS_INLINE_FUNCTION void apply_stencil_row(const DeviceStencil& stencil, Index run, Index at,
                                              int k, const Combination& c, Index covers,
                                              const Field& x, const Field& y) {
  const Real nothing[3] = {0, 0, 0};
  const Index along = stencil.stride * at, p = stencil.first(run) + along;
  const Index offsets = stencil.run_offsets(run);
  const Real* table = stencil.of_run(run);
  const Index* q = &stencil.neighbour(stencil.neighbour_begin(run));
  Real own[3], sum[3];
  for (int i = 0; i < 3; ++i) {
    own[i] = x(p, i);
    sum[i] = c.mass * table[stencil.entry(offsets, k, 0, 0) + 9] * own[i];
  }
  for (int f = 0; f < stencil.functions; ++f)
    for (Index o = f == 0 ? 1 : 0; o < offsets; ++o)
      add_coupling(table + stencil.entry(offsets, k, o, f), 1, c, x,
                   f * covers + (o == 0 ? p : q[o - 1] + along), f == 0 ? own : nothing, sum);
  for (int i = 0; i < 3; ++i) y(k * covers + p, i) = sum[i];
}
#endif

/// The inverse of a symmetric block with unit diagonal, or of its diagonal alone where it is singular: its determinant, 1 for
/// the identity, is then rounding alone.
KOKKOS_INLINE_FUNCTION void invert_unit_block(Real xy, Real yz, Real zx, Real* inverse) {
  const Real cofactor[6] = {1 - yz * yz,  1 - zx * zx,  1 - xy * xy,
                            yz * zx - xy, xy * zx - yz, xy * yz - zx};
  const Real determinant = cofactor[0] + xy * cofactor[3] + zx * cofactor[5];
  const bool regular = determinant > 1e-12;
  for (int k = 0; k < 6; ++k)
    inverse[k] = regular ? cofactor[k] / determinant : (k < 3 ? 1.0 : 0.0);
}

[[maybe_unused]] Index slice_count(const Operator& op) {  // on cores
  return static_cast<Index>(op.block.slice_begin.extent(0)) - 1;
}

}  // namespace

#ifdef ROCKFOLD_ON_GPU

void apply(const Operator& op, const Combination& c, const Field& x, const Field& y) {
  const DeviceStencil stencil = op.stencil;
  const DeviceBlocks block = op.block;
  const Index slots = block.slots(), covers = op.covers, n = op.functions;
  device::for_each(
      "rockfold::solve::apply_blocks", slots * n, KOKKOS_LAMBDA(const Index i) {
        apply_block_row(block, i % slots, i / slots, c, covers, x, y);
      });
  device::for_each(
      "rockfold::solve::apply_stencil", stencil.runs() * slice_lanes * n,
      KOKKOS_LAMBDA(const Index i) {
        const Index run = i / slice_lanes / n;
        const int k = i / slice_lanes % n;
        for (Index at = i % slice_lanes; at < stencil.length(run); at += slice_lanes)
          apply_stencil_row(stencil, run, at, k, c, covers, x, y);
      });
}

#else

void apply(const Operator& op, const Combination& c, const Field& x, const Field& y) {
  // One loop over both kinds of rows, in portions that threads take as they come free: the heavier slices first.
  using Portions = Kokkos::RangePolicy<device::Exec, Kokkos::Schedule<Kokkos::Dynamic>,
                                       Kokkos::IndexType<Index>>;
  const DeviceStencil stencil = op.stencil;
  const DeviceBlocks block = op.block;
  const Index slices = slice_count(op), portions = slices + stencil.runs(), covers = op.covers;
  const auto apply_portion = KOKKOS_LAMBDA(const Index i) {
    if (i < slices)
      apply_slice(block, i, c, covers, x, y);
    else
      apply_run(stencil, i - slices, c, covers, x, y);
  };
  const int at_a_time = op.functions == 1 ? 16 : 1;
  if (op.unknowns <= device::serial_limit)
    for (Index i = 0; i < portions; ++i) apply_portion(i);
  else
    Kokkos::parallel_for("rockfold::solve::apply",
                         Portions(0, portions, Kokkos::ChunkSize(at_a_time)), apply_portion);
}

#endif

void diagonal_blocks(const Operator& op, const Combination& c, const Blocks& d) {
  const DeviceStencil stencil = op.stencil;
  const DeviceBlocks block = op.block;
  const Index covers = op.covers;
  const int n = op.functions;
  device::for_each(
      "rockfold::solve::stencil_diagonal", stencil.runs(), KOKKOS_LAMBDA(const Index run) {
        const int at[6] = {0, 4, 8, 1, 5, 2};
        const Index offsets = stencil.run_offsets(run);
        for (int k = 0; k < n; ++k) {
          const Real* own = stencil.of_run(run) + stencil.entry(offsets, k, 0, k);
          for (Index i = 0; i < stencil.length(run); ++i)
            for (int m = 0; m < 6; ++m)
              d(k * covers + stencil.first(run) + stencil.stride * i, m) = c.entry(own, at[m]);
        }
      });
  device::for_each(
      "rockfold::solve::block_diagonal", block.slots(), KOKKOS_LAMBDA(const Index slot) {
        const int at[6] = {0, 4, 8, 1, 5, 2};
        const Index p = block.row(slot);
        if (p == none) return;
        for (int k = 0; k < n; ++k) {
          const Real* v = block.diagonals(slot / slice_lanes, k, k) + slot % slice_lanes;
          for (int m = 0; m < 6; ++m) d(k * covers + p, m) = c.entry(v, at[m], slice_lanes);
        }
      });
}

void invert_blocks(const Blocks& d) {
  device::for_each(
      "rockfold::solve::invert_blocks", static_cast<Index>(d.extent(0)),
      KOKKOS_LAMBDA(const Index p) {
        Real scale[3];
        for (int i = 0; i < 3; ++i) scale[i] = d(p, i) > 0 ? 1 / device::math::sqrt(d(p, i)) : 0;
        Real inverse[6];
        invert_unit_block(d(p, 3) * scale[0] * scale[1], d(p, 4) * scale[1] * scale[2],
                          d(p, 5) * scale[2] * scale[0], inverse);
        for (int i = 0; i < 3; ++i) {
          d(p, i) = inverse[i] * scale[i] * scale[i];
          d(p, 3 + i) = inverse[3 + i] * scale[i] * scale[(i + 1) % 3];
        }
      });
}

}  // namespace rockfold::solve
