// The cells inside closed surfaces: from the cells on the inner side of a surface through all areas that are no part of it.
#pragma once

#include <vector>

#include "host/cut/complex.hpp"

namespace rockfold {

/// What is thrown where a way leads from the inner to the outer side of a body's surface.
struct LeakingSurface {
  Index body;
  Vec3 near;  ///< m, model coordinates
};

/// [bodies] the cells inside each body that is a closed surface, ascending; empty for the others. Throws LeakingSurface.
std::vector<std::vector<Index>> cells_inside_surfaces(const Complex& complex,
                                                      const CellStore& cells);

}  // namespace rockfold
