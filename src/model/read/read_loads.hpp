// Values over time, as [[fixed]] and the loads give them.
#pragma once

#include "src/arrays/time_table.hpp"
#include "src/model/text/table_reader.hpp"

namespace rockfold {

/// An optional table under `key`; see time_table_from. Stores a good one.
void read_time_table(TableReader& in, const std::string& key, int width, const Range& range,
                     TimeTable& target);

}  // namespace rockfold
