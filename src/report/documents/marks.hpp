// Where conditions act, for drawings: a few points of each fixing, load, quiet boundary and monitor, and the water's level.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "src/arrays/block_arrays.hpp"
#include "src/model/model.hpp"

namespace rockfold {

/// A list of {kind, name, points [n][3] (m), directions [n][3] (unit; of loads and water levels)}; kind is "fixed", "load",
/// "quiet", "monitor" or "water".
nlohmann::ordered_json marks_json(const Model& model, const BlockArrays& blocks);

}  // namespace rockfold
