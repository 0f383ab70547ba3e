// Rock that the steps of an analysis have taken away.
#pragma once

#include "src/arrays/load_arrays.hpp"
#include "src/run/run_analysis.hpp"

namespace rockfold {

/// What is gone once the stages of the analysis up to `stage` have begun. Empty vectors where nothing is.
GoneRock gone_rock(const RunInput& input, Index stage);

}  // namespace rockfold
