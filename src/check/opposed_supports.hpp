// Supports that cannot all be kept are told before the run.
#pragma once

#include "src/arrays/cover_arrays.hpp"
#include "src/model/model.hpp"
#include "src/report/terminal.hpp"

namespace rockfold {

/// Whether two [[fixed]] prescribe different displacements in one direction, wherever they are.
bool may_oppose(const Model& model);

/// Throws Error(model) where two [[fixed]] prescribe different displacements of the same rock within the analysis, and warns of what
/// the covers cannot follow.
void require_supports_agree(const Model& model, const CoverArrays& covers, const FixedPoints& fixed,
                            Terminal& terminal);

}  // namespace rockfold
