// What several documents share.
#pragma once

#include <nlohmann/json.hpp>

#include "src/report/documents.hpp"

namespace rockfold {

/// totals, keyblocks and blocks of block theory.
void add_support(Json& document, const BlockArrays& blocks, const KeyblockReport& report);

/// m³, summed in the order of the blocks.
Real total_volume(const BlockArrays& blocks);

}  // namespace rockfold
