// The cells inside closed surfaces: a walk from the outside through all cells, which enters or leaves a body at each area of
// its surface. Cells meet exactly, so that nothing leaks.
#pragma once

#include <vector>

#include "host/cut/cells/complex.hpp"

namespace rockfold {

/// [cells] the bodies with closed surfaces that hold each cell, ascending. O(areas shared).
std::vector<std::vector<Index>> surfaces_around_cells(const Complex& complex,
                                                      const CellStore& cells);

}  // namespace rockfold
