// The blocks' cells as flat arrays, for exports.
#pragma once

#include "host/cut/cut.hpp"
#include "src/arrays/block_arrays.hpp"
#include "src/arrays/part_arrays.hpp"

namespace rockfold {

/// A convex block is one part, with one face a plane; any other block has the cells that the cutting left of it.
PartArrays convex_parts(const Cutting& cutting, const BlockArrays& blocks);

}  // namespace rockfold
