// An order in which to visit blocks: neighbours in it are neighbours in memory too.
#pragma once

#include <vector>

#include "host/cut/cells/complex.hpp"

namespace rockfold {

/// Blocks by their first cells. Cells and areas lie in the order of the cutting, so that a visit in this order reads
/// them nearly in sequence; block numbers, by height, would jump through all of memory.
struct BlockOrder {
  std::vector<Index> block;           ///< [ranks] the block of each rank
  std::vector<Index> rank_of_cell;    ///< [cells]
  std::vector<Index> cells_of_block;  ///< [blocks] how many cells it has that are not hidden

  explicit BlockOrder(const Complex& complex) {
    std::vector<Index> rank(complex.block_count, none);
    block.reserve(complex.block_count);
    rank_of_cell.reserve(complex.cell_block.size());
    cells_of_block.assign(complex.block_count, 0);
    for (std::size_t c = 0; c < complex.cell_block.size(); ++c) {
      const Index b = complex.cell_block[c];
      cells_of_block[b] += complex.is_hidden[c] == 0 ? 1 : 0;
      if (rank[b] == none) {
        rank[b] = static_cast<Index>(block.size());
        block.push_back(b);
      }
      rank_of_cell.push_back(rank[b]);
    }
  }
};

}  // namespace rockfold
