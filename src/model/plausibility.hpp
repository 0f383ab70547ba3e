// Numbers that are allowed and hardly meant: other units, radians, another sense.
#pragma once

#include <vector>

#include "src/model/model.hpp"
#include "src/model/text/diagnostics.hpp"

namespace rockfold {

/// A warning for each number of the document `root` that only a slip explains, with what was probably meant. `model` is what was read
/// of it without an error; `out` knows the places.
std::vector<Diagnostic> implausible_numbers(const Table& root, const Model& model,
                                            const Diagnostics& out);

}  // namespace rockfold
