// Support design as text for people.
#pragma once

#include <string>

#include "src/app/support_design.hpp"
#include "src/model/model.hpp"

namespace rockfold {

/// Bolts, the pattern that was searched for, Q and RMR: what the model asks for, each after an empty line.
std::string design_summary(const Model& model, const KeyblockReport& keyblocks,
                           const SupportDesign& design);

}  // namespace rockfold
