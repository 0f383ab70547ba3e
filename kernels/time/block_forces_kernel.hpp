// The balance of forces, block by block: what is unbalanced on one beside what acts on it. A share of all forces may be more than a small
// block weighs among large ones, and a share of the least weight less than rounding leaves where others press with a thousand times that.
#pragma once

#include "kernels/device/device_kernel.hpp"
#include "src/arrays/cover_arrays.hpp"

namespace rockfold::motion {

struct BlockForces {
  Index blocks = 0;
  device::Array<Real> acting;  ///< [unknowns] N, ‖load‖ + ‖inertia‖ + Σ ‖contact force‖
  device::Array<Index> unknown;      ///< [unknowns] of block after block
  device::Array<Index> chunk;        ///< [chunks+1] into `unknown`; no chunk is of two blocks
  device::Array<Index> block_begin;  ///< [blocks+1] into the chunks
  device::Array<Real> sum;           ///< [chunks][2]: Σ acting, Σ unbalanced²; work space
};
BlockForces make_block_forces(const CoverArrays& covers);

struct BlockBalance {
  Real worst = 0;   ///< of what is unbalanced on a block over what may be
  Real wanted = 0;  ///< N, the least that may be on a block that is not balanced
};
/// right + supports: what is unbalanced, N; the supports' part acts too. May be: `share` of what acts on the block, `least` (N) always.
BlockBalance find_balance(const BlockForces& of_blocks, const device::Field& right,
                          const device::Field& supports, Real share, Real least);

}  // namespace rockfold::motion
