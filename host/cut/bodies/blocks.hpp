// Blocks: the components of wide cells over glue, with the slivers that they own.
#pragma once

#include "host/cut/cells/complex.hpp"
#include "src/model/model.hpp"

namespace rockfold {

/// Fills cell_block, block_count, block_stage, block_is_analysed and the fragments' dead ends; blocks are ordered by centroid (z, then y, then x).
/// Joints inside what a [[merge]] by points joins become virtual. Throws Error(model) for such a point outside of the rock.
void find_blocks(Complex& complex, const Model& model);

/// Throws the same for points outside of all cells.
void check_merge_points(const CellStore& cells, const PlaneTable& planes, const Model& model);

}  // namespace rockfold
