// Application of the operator.
//
// Bytes moved: a stencil row reads x and writes y once (neighbours come from cache): 48 bytes, with the write-allocate 72.
// A block row reads for each neighbour 80 bytes of values and 4 of column, which is nearly all that it moves.
#include "kernels/solve/operator_kernel.hpp"
#include "kernels/solve/simd.hpp"

namespace rockfold::solve {
namespace {

/// αK + βM of one pair of opposite offsets.
KOKKOS_INLINE_FUNCTION void combine(const Combination& c, const Real* entry, Real* block) {
  for (int k = 0; k < 9; ++k) block[k] = c.stiffness * entry[k];
  for (int d = 0; d < 3; ++d) block[4 * d] += c.mass * entry[9];
}

#ifndef ROCKFOLD_ON_GPU
/// A run on a core: pass after pass over rows that stay in the first-level cache.
void apply_run(const DeviceStencil& stencil, Index run, const Combination& c, const Field& x,
               const Field& y) {
  const Index first = stencil.first(run), length = stencil.length(run);
  const Real* table = &stencil.table(stencil.material(run) * DeviceStencil::table_size);
  auto at = [&](Index p) { return Components{{&x(p, 0), &x(p, 1), &x(p, 2)}}; };
  const Components own = at(first);
  Real* const out[3] = {&y(first, 0), &y(first, 1), &y(first, 2)};
  stencil_start(length, c.mass * table[10 * half_neighbours], own, out);
  for (int o = 0; o < half_neighbours; ++o) {
    Real block[9];
    combine(c, table + 10 * o, block);
    const Index* q = &stencil.neighbour(2 * (half_neighbours * run + o));
    stencil_add(length, block, own, at(q[0]), at(q[1]), out);
  }
}

/// A slice of block rows on a core.
void apply_slice(const DeviceBlocks& block, Index slice, const Combination& c, const Field& x,
                 const Field& y) {
  const Index slot = slice * slice_lanes, begin = block.slice_begin(slice);
  Real own[3][slice_lanes], sum[3][slice_lanes];
  for (int l = 0; l < slice_lanes; ++l) {
    const Index p = block.row(slot + l);
    const Real mass = c.mass * block.diagonal(7 * static_cast<std::size_t>(slot + l) + 6);
    for (int i = 0; i < 3; ++i) {
      own[i][l] = p == none ? 0 : x(p, i);
      sum[i][l] = mass * own[i][l];
    }
  }
  slice_add(block.slice_begin(slice + 1) - begin, block.column.data() + begin * slice_lanes,
            block.value.data() + static_cast<std::size_t>(begin) * 10 * slice_lanes, c.stiffness,
            c.mass, {{&x(0, 0), &x(0, 1), &x(0, 2)}}, own, sum);
  for (int l = 0; l < slice_lanes; ++l) {
    const Index p = block.row(slot + l);
    if (p == none) continue;
    for (int i = 0; i < 3; ++i) y(p, i) = sum[i][l];
  }
}

#else
/// One row of a slice on a GPU.
KOKKOS_INLINE_FUNCTION void apply_block_row(const DeviceBlocks& block, Index slot,
                                            const Combination& c, const Field& x, const Field& y) {
  const Index p = block.row(slot), slice = slot / slice_lanes;
  if (p == none) return;
  const Real mass = c.mass * block.diagonal(7 * static_cast<std::size_t>(slot) + 6);
  Real own[3], sum[3];
  for (int i = 0; i < 3; ++i) {
    own[i] = x(p, i);
    sum[i] = mass * own[i];
  }
  for (Index k = block.slice_begin(slice); k < block.slice_begin(slice + 1); ++k) {
    const Index q = block.column(k * slice_lanes + slot % slice_lanes);
    const Real* v =
        &block.value(static_cast<std::size_t>(k) * 10 * slice_lanes + slot % slice_lanes);
    const Real m = c.mass * v[9 * slice_lanes];
    Real t[3];
    for (int j = 0; j < 3; ++j) t[j] = c.stiffness * (x(q, j) - own[j]);
    for (int i = 0; i < 3; ++i)
      sum[i] += v[3 * i * slice_lanes] * t[0] + v[(3 * i + 1) * slice_lanes] * t[1] +
                v[(3 * i + 2) * slice_lanes] * t[2] + m * x(q, i);
  }
  for (int i = 0; i < 3; ++i) y(p, i) = sum[i];
}

/// One row of a run on a GPU.
KOKKOS_INLINE_FUNCTION void apply_stencil_row(const DeviceStencil& stencil, Index run, Index k,
                                              const Combination& c, const Field& x,
                                              const Field& y) {
  const Index p = stencil.first(run) + k;
  const Real* table = &stencil.table(stencil.material(run) * DeviceStencil::table_size);
  Real own[3], sum[3];
  for (int i = 0; i < 3; ++i) {
    own[i] = x(p, i);
    sum[i] = c.mass * table[10 * half_neighbours] * own[i];
  }
  for (int o = 0; o < half_neighbours; ++o) {
    const Index plus = stencil.neighbour(2 * (half_neighbours * run + o)) + k;
    const Index minus = stencil.neighbour(2 * (half_neighbours * run + o) + 1) + k;
    Real block[9], t[3];
    combine(c, table + 10 * o, block);
    for (int j = 0; j < 3; ++j) t[j] = (x(plus, j) - own[j]) + (x(minus, j) - own[j]);
    for (int i = 0; i < 3; ++i)
      sum[i] += block[3 * i] * t[0] + block[3 * i + 1] * t[1] + block[3 * i + 2] * t[2];
  }
  for (int i = 0; i < 3; ++i) y(p, i) = sum[i];
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

Index run_count(const Operator& op) {
  return static_cast<Index>(op.stencil.first.extent(0));
}
Index slice_count(const Operator& op) {
  return static_cast<Index>(op.block.slice_begin.extent(0)) - 1;
}

}  // namespace

#ifdef ROCKFOLD_ON_GPU

void apply(const Operator& op, const Combination& c, const Field& x, const Field& y) {
  const DeviceStencil stencil = op.stencil;
  const DeviceBlocks block = op.block;
  device::for_each(
      "rockfold::solve::apply_blocks", slice_count(op) * slice_lanes,
      KOKKOS_LAMBDA(const Index i) { apply_block_row(block, i, c, x, y); });
  device::for_each(
      "rockfold::solve::apply_stencil", run_count(op) * slice_lanes, KOKKOS_LAMBDA(const Index i) {
        const Index run = i / slice_lanes;
        for (Index k = i % slice_lanes; k < stencil.length(run); k += slice_lanes)
          apply_stencil_row(stencil, run, k, c, x, y);
      });
}

#else

void apply(const Operator& op, const Combination& c, const Field& x, const Field& y) {
  // One loop over both kinds of rows, in portions that threads take as they come free: the heavier slices first.
  using Portions = Kokkos::RangePolicy<device::Exec, Kokkos::Schedule<Kokkos::Dynamic>,
                                       Kokkos::IndexType<Index>>;
  const DeviceStencil stencil = op.stencil;
  const DeviceBlocks block = op.block;
  const Index slices = slice_count(op), portions = slices + run_count(op);
  const auto apply_portion = KOKKOS_LAMBDA(const Index i) {
    if (i < slices)
      apply_slice(block, i, c, x, y);
    else
      apply_run(stencil, i - slices, c, x, y);
  };
  if (op.covers <= device::serial_limit)
    for (Index i = 0; i < portions; ++i) apply_portion(i);
  else
    Kokkos::parallel_for("rockfold::solve::apply", Portions(0, portions, Kokkos::ChunkSize(16)),
                         apply_portion);
}

#endif

void diagonal_blocks(const Operator& op, const Combination& c, const Blocks& d) {
  const DeviceStencil stencil = op.stencil;
  const DeviceBlocks block = op.block;
  device::for_each(
      "rockfold::solve::stencil_diagonal", static_cast<Index>(stencil.first.extent(0)),
      KOKKOS_LAMBDA(const Index run) {
        const Real* diagonal = &stencil.table(stencil.material(run) * DeviceStencil::table_size +
                                              10 * half_neighbours + 1);
        Real combined[9];
        combine(c, diagonal, combined);
        for (Index p = stencil.first(run); p < stencil.first(run) + stencil.length(run); ++p) {
          const int at[6] = {0, 4, 8, 1, 5, 2};
          for (int k = 0; k < 6; ++k) d(p, k) = combined[at[k]];
        }
      });
  device::for_each(
      "rockfold::solve::block_diagonal", static_cast<Index>(block.row.extent(0)),
      KOKKOS_LAMBDA(const Index slot) {
        const Index p = block.row(slot);
        if (p == none) return;
        const Real* diagonal = &block.diagonal(7 * static_cast<std::size_t>(slot));
        for (int k = 0; k < 6; ++k)
          d(p, k) = c.stiffness * diagonal[k] + (k < 3 ? c.mass * diagonal[6] : 0);
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
