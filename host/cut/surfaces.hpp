// What cuts: the model's solids and joints as exact planes, with the rules of intent applied (DESIGN.md, "Intent is
// kept at the door", rules 1 and 2).
#pragma once

#include <vector>

#include "host/cut/complex.hpp"
#include "host/cut/cut.hpp"

namespace rockfold {

/// A convex polygon on a plane: the plane and the half-spaces of its edges, which only classify and clip. None =
/// through-going.
struct CuttingSurface {
  Index plane = none;
  std::vector<HalfSpaceId> edges;
};

struct CuttingInput {
  Complex complex;                          ///< planes, bodies and origins; no cells yet
  Vec3 box_min{}, box_max{};                ///< of the '+' solids, about the centre
  std::vector<CuttingSurface> solid_faces;  ///< in the solids' order
  std::vector<CuttingSurface>
      joints;  ///< in an order that balances the cutting, independent of the model's
  Index planes_identified = 0;
};

/// Throws Error(model) for solids without volume or bounds, and joint sets with absurdly many planes.
CuttingInput make_surfaces(const Model& model);

}  // namespace rockfold
