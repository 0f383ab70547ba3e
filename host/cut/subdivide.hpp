// Depth-first subdivision of convex cells by convex polygons on planes (DESIGN.md, "Cutting").
#pragma once

#include <vector>

#include "host/cut/complex.hpp"
#include "host/cut/surfaces.hpp"
#include "src/base/progress.hpp"

namespace rockfold {

struct Subdivision {
  CellStore cells;
  std::vector<Index> parent;  ///< [cells] the given cell that each is part of
  IntentCount intent;
};

/// Cuts each of `cells` by the surfaces whose interior meets its section. The order of the result depends on the surfaces'
/// order but not on the number of threads. O(cells made · log(surfaces)) for sets of parallel planes in bisecting order.
Subdivision subdivide(const PlaneTable& planes, const CellStore& cells,
                      const std::vector<CuttingSurface>& surfaces, Progress& progress);

}  // namespace rockfold
