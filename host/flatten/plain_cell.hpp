// The common case of a block's surface: a block that is one cell, each face of one origin.
#pragma once

#include <vector>

#include "host/flatten/block_surface.hpp"

namespace rockfold {

/// Whether the areas are those of such a block, of `cells` cells, and none of its faces and edges is as narrow or short as the
/// tolerance.
bool is_plain_cell(const Complex& complex, Index cells, const std::vector<BoundaryArea>& areas,
                   std::vector<Index>& workspace);

/// The area of face_polygon(), without making it.
Real area_from_above(const CellView& cell, const ConvexCell::Face& face);

}  // namespace rockfold
