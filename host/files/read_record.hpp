// Records of acceleration over time in memory.
#pragma once

#include <string_view>

#include "src/arrays/time_table.hpp"
#include "src/base/error.hpp"

namespace rockfold {

/// Rows t, ax, ay, az (s, m/s²), separated by commas, semicolons or blanks, times ascending; a first line with these names,
/// blank lines and lines that begin with '#' are passed over. `place` names the file and the key that names it.
/// Throws Error(model) with all that is wrong.
TimeTable read_record(std::string_view text, const Place& place);

}  // namespace rockfold
