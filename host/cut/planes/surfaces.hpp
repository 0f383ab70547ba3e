// What cuts: the model's shapes and joints as exact planes with polygons, with the rules of intent applied (docs/decisions/0005-exact-inside.md,
// rules 1 to 3).
#pragma once

#include "host/cut/cells/complex.hpp"
#include "host/joints/cell_limit.hpp"
#include "src/model/model.hpp"

namespace rockfold {

/// Where numbers were taken for what the user meant, before anything was cut (rules 2 and 3).
struct GivenIntent {
  std::vector<Index> planes;  ///< that given planes coincide with, one entry for each of those
  Index edges = 0, corners = 0;
};

struct CuttingInput {
  Complex complex;  ///< planes, origins, bodies, facets and joints; no cells yet
  CellStore start;  ///< one box around all rock
  GivenIntent intent;
  std::vector<PlaneSet> plane_sets;
};

/// Throws Error(model) for solids without volume or bounds, and joints that are absurdly many.
CuttingInput make_surfaces(const Model& model);

}  // namespace rockfold
