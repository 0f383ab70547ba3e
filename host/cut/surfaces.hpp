// What cuts: the model's shapes and joints as exact planes with polygons, with the rules of intent applied (DESIGN.md,
// "Intent is kept at the door", rules 1 to 4).
#pragma once

#include "host/cut/complex.hpp"
#include "host/joints/cell_limit.hpp"
#include "src/model/model.hpp"

namespace rockfold {

struct CuttingInput {
  Complex complex;  ///< planes, origins, bodies, facets and joints; no cells yet
  CellStore start;  ///< one box around all rock, none of whose planes is one of the model's
  Index planes_identified = 0;
  IntentCount intent;  ///< planes nearly coincident
  std::vector<PlaneSet> plane_sets;
};

/// Throws Error(model) for solids without volume or bounds, and joints that are absurdly many.
CuttingInput make_surfaces(const Model& model);

}  // namespace rockfold
