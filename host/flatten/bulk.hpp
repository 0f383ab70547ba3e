// What blocks are made of, as opposed to what bounds them.
#pragma once

#include "host/cut/cells/complex.hpp"
#include "host/flatten/block_order.hpp"
#include "src/arrays/block_arrays.hpp"
#include "src/model/model.hpp"

namespace rockfold {

/// Volume, mass, centroid, material and stage of each block, from its cells.
void add_bulk(const Complex& complex, const BlockOrder& order, const Model& model,
              BlockArrays& out);

/// Joints that end inside a block: convex polygons, as seen from above their planes.
void add_dead_ends(const Complex& complex, BlockArrays& out);

}  // namespace rockfold
