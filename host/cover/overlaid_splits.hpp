// Two splits of the lattice over each other (tet5, mixed) hold a block together only where a node of both is theirs.
#pragma once

#include "src/arrays/cover_arrays.hpp"
#include "src/model/model.hpp"

namespace rockfold {

/// Throws Error(model) where a body lies inside the middle parts of both splits, which have no node in common: each split would
/// move half of it alone. Names the lattice cell and the block. O(elements)
void refuse_halved_blocks(const CoverSpec& cover, const CoverArrays& covers);

}  // namespace rockfold
