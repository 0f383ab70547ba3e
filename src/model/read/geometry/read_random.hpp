// [joint_set.random].
#pragma once

#include <cstdint>

#include "src/model/model.hpp"
#include "src/model/text/table_reader.hpp"

namespace rockfold {

/// Reads the table "random" of a joint set, whose "radius" decides with it whether the set is of
/// discs.
RandomSet read_random(TableReader& set, std::uint64_t default_seed);

}  // namespace rockfold
