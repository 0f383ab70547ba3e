// What `check` looks at beyond the text of a model: the rock before joints cut it.
#pragma once

#include "src/model/model.hpp"

namespace rockfold {

/// Builds the solids, places the joints and looks where points of loads, supports and monitors lie. Throws Error(model) with the first
/// error of the shapes and joints, for joints that would make more than `most_blocks` (cut.hpp), with all points that are not in the
/// rock, or for a [cover] that is too fine. Files have been read before (host/files).
void check_rock(const Model& model, Real most_blocks);

}  // namespace rockfold
