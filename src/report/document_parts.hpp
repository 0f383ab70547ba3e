// What several documents share.
#pragma once

#include <nlohmann/json.hpp>

#include "src/report/documents.hpp"

namespace rockfold {

/// totals, keyblocks and blocks of block theory.
void add_support(Json& document, const BlockArrays& blocks, const KeyblockReport& report);

/// statistics, intensities, stages and flagged.
void add_measures(Json& document, const RockMeasures& measures);

/// "small_volume", "elongated" of a block's flags.
Json flags_json(std::uint8_t flags);

/// m³, summed in the order of the blocks.
Real total_volume(const BlockArrays& blocks);

}  // namespace rockfold
