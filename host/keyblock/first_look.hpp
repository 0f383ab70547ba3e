// What block theory can be done again from with other strengths and loads, for the page.
#pragma once

#include "src/arrays/block_arrays.hpp"
#include "src/arrays/first_look_arrays.hpp"
#include "src/model/model.hpp"

namespace rockfold {

/// Whether first looks say all: not where in-situ stress acts on joints.
bool has_first_looks(const Model& model);

/// The removable blocks of each stage, as if none had moved before. Empty where in-situ stress acts on joints.
/// Cost: one look at each block with a free face.
FirstLookArrays find_first_looks(const BlockArrays& blocks, const Model& model);

}  // namespace rockfold
