// Bolts on an unrolled wall.
#pragma once

#include <string>

#include "src/app/support_design.hpp"
#include "src/arrays/block_arrays.hpp"
#include "src/model/model.hpp"

namespace rockfold {

/// SVG: the wall's free faces, those of key blocks coloured by whether their support is adequate, with block numbers; bolts
/// that start on the wall, those that hold key blocks apart. Tunnels run from left to right, their crown along the middle line,
/// seen from outside: the wall to the right of the path is below. Plane faces stand below each other as seen from the opening.
std::string bolt_layout(const BlockArrays& blocks, const KeyblockReport& keyblocks,
                        const SupportDesign& design, const Model& model, const Drawing& drawing);

}  // namespace rockfold
