// Records of acceleration over time in memory.
#pragma once

#include <string_view>
#include <vector>

#include "src/model/model.hpp"

namespace rockfold {

/// Rows of times and accelerations, separated by commas, semicolons or blanks, times ascending. A heading names the columns in any
/// order: t or time (s), ax, ay, az or, of a record with one component, a or acc, with units in brackets (m/s2, cm/s2, gal, g).
/// Without a heading rows are t, ax, ay, az, or t, a. Blank lines and lines that begin with '#' are passed over.
/// `base` has the direction of one component and the unit where the model gives them; without any unit numbers are m/s², and
/// `warnings`, unless it is null, tells of a size that only other units have. Values come in m/s², not yet scaled.
/// `place` names the file and the key that names it. Throws Error(model) with all that is wrong.
TimeTable read_record(std::string_view text, const BaseAcceleration& base, const Place& place,
                      std::vector<Diagnostic>* warnings = nullptr);

}  // namespace rockfold
