// The surfaces of blocks as contact needs them: convex parts, and convex polygons of their real faces.
#pragma once

#include "host/cut/cut.hpp"
#include "src/arrays/block_arrays.hpp"
#include "src/arrays/surface_arrays.hpp"

namespace rockfold {

/// A convex block is one part with the polygons of its shown faces. Any other block has a part for each cell that is no sliver, with
/// the polygons in which joints, free faces and, through slivers, other blocks lie on it. Dead ends have none.
SurfaceArrays contact_surfaces(const Cutting& cutting, const BlockArrays& blocks,
                               const FaceMaterials& materials = {});

}  // namespace rockfold
