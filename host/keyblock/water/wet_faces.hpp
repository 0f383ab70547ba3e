// The pressure of the water in joints on the faces of blocks, as block theory has it for each block alone.
#pragma once

#include <vector>

#include "host/keyblock/face_shape.hpp"
#include "src/arrays/block_arrays.hpp"
#include "src/model/model.hpp"

namespace rockfold {

/// [wanted] Linear functions whose least, no less than zero, is the pressure on each of these faces, Pa; none: it is dry.
/// `waters`: in place of Model::waters; `gone` [B]: not 0 where a block is not there.
std::vector<std::vector<LinearPressure>> water_on_faces(const BlockArrays& blocks,
                                                        const Model& model,
                                                        const std::vector<Water>& waters,
                                                        const std::vector<Index>& gone,
                                                        const std::vector<Index>& wanted);

}  // namespace rockfold
