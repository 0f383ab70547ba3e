// The keys that stand in a model file: what stages of the program use is told from what they do not (src/check/key_use.hpp).
#pragma once

#include <vector>

#include "src/model/model.hpp"
#include "src/model/text/diagnostics.hpp"
#include "src/model/text/value.hpp"

namespace rockfold {

/// Each key with a value that is no table, once for all entries of a list.
std::vector<GivenKey> given_keys(const Table& root, const Diagnostics& out);

}  // namespace rockfold
