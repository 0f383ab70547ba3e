// Boxes near each other.
#pragma once

#include <vector>

#include "host/cut/cells/patch.hpp"

namespace rockfold {

/// For each box those before it in the list that are nearer than `slack` on every axis, ascending.
/// O(n log n) and what is found.
std::vector<std::vector<Index>> earlier_near_boxes(const std::vector<Box>& boxes, Real slack);

/// For each box of `of` the boxes of `among` that are nearer than `slack` on every axis, ascending.
std::vector<std::vector<Index>> near_boxes(const std::vector<Box>& of,
                                           const std::vector<Box>& among, Real slack);

}  // namespace rockfold
