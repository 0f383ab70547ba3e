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

/// Moments of the cut elements on the device, [E][10]: volume, first, second.
Array<Real> element_moments(const CoverArrays& covers, const PieceMoments& moments);

Operator build_operator(const CoverArrays& covers, const PieceMoments& moments,
                        const std::vector<ElasticMaterial>& materials);

void apply(const Operator& op, const Combination& c, const Field& x, const Field& y);

/// The diagonal blocks of αK + βM, [P] xx yy zz xy yz zx.
using Blocks = Kokkos::View<Real* [6], Kokkos::LayoutLeft, device::Memory>;
void diagonal_blocks(const Operator& op, const Combination& c, const Blocks& d);

/// Inverts the diagonal blocks in place. A block is first scaled to a unit diagonal, so that an element of volume 1e-20 is as
/// good as any other; where even that is singular the diagonal alone is inverted; a row without any stiffness stays at rest.
void invert_blocks(const Blocks& d);

}  // namespace rockfold::solve
