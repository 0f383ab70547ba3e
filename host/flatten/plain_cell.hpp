// The common case of a block's surface: a block that is one cell, each face of one origin.
#pragma once

#include <vector>

#include "host/flatten/block_surface.hpp"

namespace rockfold {

/// Whether the areas are those of such a block; then `origin` is that of each of its cell's faces.
bool is_plain_cell(const Complex& complex, const std::vector<BoundaryArea>& areas,
                   std::vector<Index>& origin);

/// Its surface, written over `surface`, whose memory is used again. O(corners).
void write_cell_surface(const Complex& complex, const std::vector<BoundaryArea>& areas,
                        const std::vector<Index>& origin, BlockSurface& surface);

}  // namespace rockfold
