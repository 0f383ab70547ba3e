// From exact geometry to flat arrays of doubles: the only place that rounds.
#pragma once

#include "host/cut/cut.hpp"
#include "src/arrays/block_arrays.hpp"

namespace rockfold {

/// The blocks of a cutting with merged faces, exact counts, volumes and centroids.
BlockArrays flatten_blocks(const Cutting& cutting, const Model& model);

}  // namespace rockfold
