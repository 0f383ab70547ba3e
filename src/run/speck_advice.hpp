// Blocks far smaller than the others, which ask for far more of contact and of the solver than their rock is worth.
#pragma once

#include <string>

#include "src/arrays/block_arrays.hpp"
#include "src/model/model.hpp"

namespace rockfold {

/// What a message of a run that was stopped says of such blocks, from ". " on; empty where there is none. `block`: one that is known
/// to be in trouble, named if it is one of them; else the smallest is.
std::string speck_advice(const BlockArrays& blocks, const CutSpec& cut, Index block);

}  // namespace rockfold
