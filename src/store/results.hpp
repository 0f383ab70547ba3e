// From what the stages made to what the result file stores.
#pragma once

#include "host/bolting/bolting.hpp"
#include "host/keyblock/keyblock.hpp"
#include "src/arrays/cover_arrays.hpp"
#include "src/io/result_file.hpp"
#include "src/run/run_result.hpp"

namespace rockfold {

/// Block theory's answers by block instead of by key block.
BlockFields block_fields(const KeyblockReport& report);

/// What bolts and shotcrete do for each block.
void add_bolting(BlockFields& fields, const BoltingReport& bolting);

/// Appends a state; `block_vertices` are the points of BlockArrays::vertex.
void add_stored_state(ResultWriter& writer, const MaterialPoints& block_vertices,
                      const StoredState& state);

}  // namespace rockfold
