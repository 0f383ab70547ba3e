// The shape of a solid.
#pragma once

#include <optional>

#include "src/model/model.hpp"
#include "src/model/table_reader.hpp"

namespace rockfold {

/// Reads "shape" and the keys that belong to it; nothing if any of them is wrong. A solid that is
/// added must be bounded, so that it needs 4 planes or more.
std::optional<Shape> read_shape(TableReader& in, bool add);

}  // namespace rockfold
