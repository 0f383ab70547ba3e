// The common case of a block's surface: a block that is one cell, each face of one origin.
#pragma once

#include <vector>

#include "host/flatten/block_surface.hpp"

namespace rockfold {

/// What its areas make of each face of a cell.
struct CellFaces {
  std::vector<Index> origin;
  std::vector<Real> area;  ///< m²
};

/// Whether the areas are those of such a block, of `cells` cells, and none of its faces and edges is as narrow or short as the
/// tolerance.
bool is_plain_cell(const Complex& complex, Index cells, const std::vector<BoundaryArea>& areas,
                   CellFaces& workspace);

}  // namespace rockfold
