// cover.joint_tips = "extend": joints that end inside an element are prolonged to its boundary.
#pragma once

#include "host/cover/pieces.hpp"

namespace rockfold {

/// Cuts the pieces of each element (of one block and material) that holds a part of a joint without being cut in two by it
/// along the joint's plane. Joints whose covers are welded are no joints. O(n log n) in the pieces.
void extend_joint_tips(const Complex& complex, const Model& model, const LatticePlanes& lattice,
                       const CoverPlanes& planes, Pieces& pieces);

}  // namespace rockfold
