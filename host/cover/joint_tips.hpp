// cover.joint_tips = "extend": joints that end inside an element are prolonged to its boundary, those that end inside a facet
// between two elements to the facet's edges.
#pragma once

#include "host/cover/lattice/pieces.hpp"

namespace rockfold {

/// Cuts the pieces of each element (of one block and material) that holds a part of a joint without being cut in two by it
/// along the joint's plane. Elements with a part of a joint on a facet between them get its plane as a cut that only parts them; whole
/// lattice cells become pieces for it. Joints whose covers are welded are no joints. O(n log n) in the pieces.
void extend_joint_tips(const Complex& complex, const Model& model, const LatticePlanes& lattice,
                       const PlaneTable& planes, Pieces& pieces);

}  // namespace rockfold
