// What the stresses of elements say of blocks and of the rock's strength.
#pragma once

#include <vector>

#include "src/arrays/cover_arrays.hpp"
#include "src/arrays/element_arrays.hpp"
#include "src/model/model.hpp"
#include "src/run/run_result.hpp"

namespace rockfold {

/// [B] of [nR + E] stresses: averages over the blocks' volume.
std::vector<Stress> average_block_stress(const CoverArrays& covers, const PieceMoments& moments,
                                         const std::vector<Stress>& element_stress, Index blocks);

/// Over the elements whose material has a strength.
RockStrength find_strength(const CoverArrays& covers, const PieceMoments& moments,
                           const std::vector<Stress>& element_stress,
                           const std::vector<Material>& materials);

}  // namespace rockfold
