// The common case of a block's surface: a block that is one cell, each face of one origin.
#pragma once

#include <vector>

#include "host/flatten/block_surface.hpp"

namespace rockfold {

/// Whether the areas are those of such a block.
bool is_plain_cell(const Complex& complex, const std::vector<BoundaryArea>& areas,
                   std::vector<Index>& workspace);

/// Where a face thinner than rounding comes from, which has no area of its own: the first joint there; none if there is none.
Index origin_of_thin_face(const Complex& complex, const ConvexCell::Face& face);

/// The area of face_polygon(), without making it.
Real area_from_above(const CellView& cell, const ConvexCell::Face& face);

}  // namespace rockfold
