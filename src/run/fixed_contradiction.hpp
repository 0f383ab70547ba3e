// Prescribed displacements that cannot be true at once.
#pragma once

#include <array>
#include <optional>

#include "src/arrays/cover_arrays.hpp"

namespace rockfold {

/// Two conditions (into Model::fixed, ascending) that prescribe different displacements, at some time, of one point in one direction;
/// nothing where there are none. Points are one whose weights agree to 1e-9.
std::optional<std::array<Index, 2>> find_contradiction(const FixedPoints& fixed);

}  // namespace rockfold
