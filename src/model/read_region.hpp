// The `where` of a condition.
#pragma once

#include <optional>

#include "src/model/draft.hpp"

namespace rockfold {

/// Reads the key "where" of an entry: exactly one way to say it. Nothing if it is wrong.
std::optional<Region> read_region(TableReader& entry, const Draft& draft);

}  // namespace rockfold
