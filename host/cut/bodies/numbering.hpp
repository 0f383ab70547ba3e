// Blocks in the order of their centroids.
#pragma once

#include <vector>

#include "host/cut/cells/complex.hpp"

namespace rockfold {

/// B blocks, ordered by centroid (z, then y, then x).
struct NumberedBlocks {
  std::vector<Index> of_cell;        ///< [cells] < B
  std::vector<CellMoments> moments;  ///< [B] about the table's centre, slivers too
};

/// `part`: [cells] any number below that of the cells for each block, equal for cells of one block. O(cells + B log B).
NumberedBlocks number_blocks(const Complex& complex, const std::vector<Index>& part);

}  // namespace rockfold
