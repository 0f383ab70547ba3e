// The linear operator y = (αK + βM) x over the functions of all covers, by rows, one writer a row: no atomics, and the same digits
// for any number of threads. K is applied to differences of the functions 0 (its rows sum to zero over them): a
// translation gives exactly no force however far a block has travelled.
//
// Unknown k · P + p is function k of cover p; n functions a cover.
#pragma once

#include "kernels/device/device_kernel.hpp"
#include "kernels/operator/elements/element_table_kernel.hpp"
#include "kernels/operator/simd.hpp"
#include "src/system/rows.hpp"

namespace rockfold::solve {

using device::Array;
using device::Field;

/// Covers of a slice: SIMD lanes on a core, a warp on a GPU.
inline constexpr int slice_lanes = device::on_gpu ? 32 : simd_lanes;

/// y = (stiffness · K + mass · M) x.
struct Combination {
  Real stiffness = 0, mass = 0;

  /// Entry k = 3i + j of the block of a coupling v, whose entry_size values stand `step` apart.
  KOKKOS_INLINE_FUNCTION Real entry(const Real* v, int k, int step = 1) const {
    return stiffness * v[k * step] + (k % 4 == 0 ? mass * v[9 * step] : 0);
  }
};

/// Stencil rows. For each material and node class a table of couplings: with the offsets 0, +1, −1, +2, −2, … of the class,
/// [k][offset][l] entries of 10 (block of 9, mass), then for each k the mass of its whole row over the functions 0.
struct DeviceStencil {
  int functions = 1, classes = 0, stride = 1;
  Array<Index> first, length, material, node_class, neighbour_begin, neighbour;
  Array<Index> pairs;        ///< [classes] of opposite offsets
  Array<Index> table_begin;  ///< [materials][classes]
  Array<Real> table;

  Index runs() const { return static_cast<Index>(first.extent(0)); }
  KOKKOS_INLINE_FUNCTION Index run_offsets(Index run) const {
    return 1 + 2 * pairs(node_class(run));
  }
  KOKKOS_INLINE_FUNCTION const Real* of_run(Index run) const {
    return &table(table_begin(material(run) * classes + node_class(run)));
  }
  /// Where in a table of so many offsets a coupling stands.
  KOKKOS_INLINE_FUNCTION int entry(Index offsets, int k, Index offset, int l) const {
    return static_cast<int>(entry_size * ((k * offsets + offset) * functions + l));
  }
  KOKKOS_INLINE_FUNCTION int row_mass(Index offsets, int k) const {
    return static_cast<int>(entry_size * functions * functions * offsets + k);
  }
};

/// Block rows. With L the columns of a slice, its values stand as [k][l][column < L][10][lane]: block of 9, mass; those of the
/// covers with themselves as [k][l][10][lane]. The first value of slice s is at n² · 10 · lanes · (value_begin[s], owner[s]).
/// Slices of rows that are alike share values.
struct DeviceBlocks {
  int functions = 1;
  Array<Index> row, slice_begin, column;
  Array<Index> value_begin, owner, owning;  ///< see BlockRows
  Array<Index> source_begin;                ///< empty once assembled, as `source`
  Array<Source> source;
  Array<Real> value, diagonal;
  /// [slots] 1: the row works on differences of constants to its own, so that a translation leaves nothing. 0: on the constants as they
  /// are, because its own stiffness would drown in the rounding of the others' sum (slivers of hexahedra).
  Array<Real> by_difference;

  Index slots() const { return static_cast<Index>(row.extent(0)); }
  KOKKOS_INLINE_FUNCTION Real* values(Index slice, int k, int l) const {
    const Index begin = value_begin(slice), length = slice_begin(slice + 1) - slice_begin(slice);
    const std::size_t pairs = static_cast<std::size_t>(functions) * functions;
    return &value(entry_size * slice_lanes *
                  (pairs * begin + static_cast<std::size_t>(k * functions + l) * length));
  }
  KOKKOS_INLINE_FUNCTION Real* diagonals(Index slice, int k, int l) const {
    return &diagonal(
        entry_size * slice_lanes *
        (static_cast<std::size_t>(owner(slice)) * functions * functions + k * functions + l));
  }
};

struct Operator {
  Index covers = 0;    ///< P
  Index unknowns = 0;  ///< U
  int functions = 1;
  Index stencil_covers = 0, block_covers = 0;
  std::int64_t neighbours = 0;  ///< see Rows
  DeviceStencil stencil;
  DeviceBlocks block;
};

/// `stencils`: see sort_rows; without them all values may be written anew, row by row (assemble_kernel.hpp).
Operator build_operator(const CoverArrays& covers, const PieceMoments& moments,
                        const std::vector<ElasticMaterial>& materials, bool stencils = true);

void apply(const Operator& op, const Combination& c, const Field& x, const Field& y);

/// The diagonal blocks of αK + βM, [U] xx yy zz xy yz zx.
using Blocks = Kokkos::View<Real* [6], Kokkos::LayoutLeft, device::Memory>;
void diagonal_blocks(const Operator& op, const Combination& c, const Blocks& d);

/// Inverts the diagonal blocks in place. A block is first scaled to a unit diagonal, so that an element of volume 1e-20 is as
/// good as any other; where even that is singular the diagonal alone is inverted; a row without any stiffness stays at rest.
void invert_blocks(const Blocks& d);

}  // namespace rockfold::solve
