// Which joint materials lose strength once their joints have slipped, in words.
#pragma once

#include <string>
#include <vector>

#include "host/keyblock/keyblock.hpp"
#include "src/arrays/block_arrays.hpp"
#include "src/model/model.hpp"

namespace rockfold {

/// Whether its residual strength is less than its peak strength.
bool loses_strength(const JointMaterial& material);

/// Those of joints between blocks that do, in the order of the model.
std::vector<const JointMaterial*> materials_that_lose_strength(const Model& model,
                                                               const BlockArrays& blocks);

/// "coated (cohesion 10 kPa, then 0; friction 35 deg, then 30)" of each of these.
std::string strength_loss_text(const std::vector<const JointMaterial*>& materials);

/// Whether any key block, or block that stays, is less safe on joints that have slipped.
bool any_residual_factor(const KeyblockReport& report);

}  // namespace rockfold
