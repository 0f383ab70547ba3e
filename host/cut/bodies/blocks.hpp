// Blocks: the components of wide cells over glue, with the slivers that they own.
#pragma once

#include <optional>

#include "host/cut/cells/complex.hpp"
#include "host/cut/cut.hpp"
#include "src/model/model.hpp"

namespace rockfold {

/// Fills cell_block, block_count, block_stage, block_is_analysed and the fragments' dead ends; blocks are ordered by centroid (z, then y, then x).
/// Joints inside what a [[merge]] by points joins become virtual, and where [cut] says specks = "merge" those between a speck and
/// the block that takes it. Returns what became of the specks then. Throws Error(model) for a point of a merge outside of the rock.
std::optional<SpeckReport> find_blocks(Complex& complex, const Model& model);

/// Throws the same for points outside of all cells.
void check_merge_points(const CellStore& cells, const PlaneTable& planes, const Model& model);

}  // namespace rockfold
