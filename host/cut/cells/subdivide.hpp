// Depth-first subdivision of convex cells by convex polygons on planes.
#pragma once

#include <functional>
#include <vector>

#include "host/cut/cells/aux_tree.hpp"
#include "host/cut/cells/complex.hpp"
#include "src/base/progress.hpp"

namespace rockfold {

struct CuttingSurface {
  const Patch* patch = nullptr;
  Index within = none;  ///< cuts only cells for which `applies` says so; none = all
  /// m: a section whose part inside the patch is narrower is not cut (rule 7); 0 cuts all that has an area.
  Real least_width = 0;
};

struct CuttingJob {
  const PlaneTable& planes;
  const CellStore& cells;
  std::vector<Index> which;  ///< of the cells
  std::vector<CuttingSurface> surfaces;
  const AuxTree& tree;
  std::function<bool(Index cell, Index within)> applies;
  std::int64_t max_cells = 0;  ///< where cutting is given up
};

/// What is thrown for more than CuttingJob::max_cells.
struct TooManyCells {};

struct Subdivision {
  std::vector<CellStore> parts;             ///< of independent subtrees, in a fixed order
  std::vector<std::vector<Index>> parents;  ///< likewise: the given cell that each is part of
};

/// Cuts each of the cells by the surfaces whose interior meets its section. The order of the result depends on the
/// surfaces' order but not on the number of threads. O(cells made · log(surfaces)) for sets of parallel planes in
/// bisecting order. Throws TooManyCells.
Subdivision subdivide(const CuttingJob& job, Progress& progress);

}  // namespace rockfold
