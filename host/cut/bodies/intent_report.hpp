// What was decided for the user, and what might as well have been decided otherwise (docs/decisions/0005-exact-inside.md).
#pragma once

#include <vector>

#include "host/cut/bodies/width.hpp"
#include "host/cut/cells/complex.hpp"
#include "host/cut/cut.hpp"
#include "host/cut/planes/surfaces.hpp"

namespace rockfold {

/// Of a complex with its blocks. `measures` are those of its cells, `doubtful_glue` the fragments that mark_narrow_glue told of.
/// O(cells and fragments).
IntentReport intent_report(const Complex& complex, const GivenIntent& given,
                           const std::vector<CellMeasure>& measures,
                           const std::vector<Index>& doubtful_glue);

}  // namespace rockfold
