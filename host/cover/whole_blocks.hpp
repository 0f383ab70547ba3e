// A block is one body in its covers too: each of its elements hangs on each other one by covers that elements share.
#pragma once

#include "src/arrays/cover_arrays.hpp"
#include "src/model/model.hpp"

namespace rockfold {

/// Throws Error(model) where a body lies inside the middle parts of both splits, which have no node in common: each split would
/// move half of it alone. Names the lattice cell and the block. O(elements)
void refuse_halved_blocks(const CoverSpec& cover, const CoverArrays& covers);

/// Throws Error(model) where a block has parts that no cover joins, which would move apart from each other: between joints that all
/// but coincide, rock may hang together by slivers that no element knows. Names the block and the place. For separate joints
/// that are not prolonged. O(elements)
void refuse_parted_blocks(const CoverSpec& cover, const CoverArrays& covers);

}  // namespace rockfold
