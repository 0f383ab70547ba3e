// The `where` of a condition.
#pragma once

#include <optional>

#include "src/model/read/draft.hpp"

namespace rockfold {

enum class Regions {
  any,      ///< face, box, point, plane, block_at
  surface,  ///< face, plane, box: the free faces there
};

/// Reads the key "where" of an entry: exactly one way to say it. Nothing if it is wrong.
std::optional<Region> read_region(TableReader& entry, const Draft& draft, Regions regions);

}  // namespace rockfold
