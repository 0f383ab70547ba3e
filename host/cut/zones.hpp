// Which shapes each cell lies in, once all of their faces have cut: rock or void by the block operations, the stage of
// excavation, regions of joints and merges.
#pragma once

#include "host/cut/cells/complex.hpp"
#include "src/model/model.hpp"

namespace rockfold {

struct ZonedCells {
  std::vector<Zone> zones;       ///< sorted, each once
  std::vector<Index> cell_zone;  ///< [cells given] into zones; none = void
};

/// Each cell lies wholly inside or outside of every body.
ZonedCells find_zones(const Complex& complex, const CellStore& cells, const Model& model);

}  // namespace rockfold
