// Contact surfaces of blocks that a lattice covers: divided at its cells, so that each part moves as one manifold element does.
#pragma once

#include "host/contact/surfaces.hpp"
#include "src/arrays/cover_arrays.hpp"
#include "src/arrays/surface_arrays.hpp"

namespace rockfold {

/// The same surfaces with parts and faces divided where parts of lattice cells meet. A new part is the convex hull of what one part of
/// a cell holds of one part's faces; where these lie in one plane, it is flat. Vertices are numbered anew, shared within a block.
/// Of two overlaid splits the first divides. O(n) in the faces that result.
/// `curved`: displacements are not linear within a part of a cell. Then sides of joints are triangles with a centre, so that a
/// uniform pressure on them is one on the covers too (the quadrature of contact is exact to degree 2 of what moves corners and centre).
SurfaceArrays divide_surfaces(const SurfaceArrays& blocks, const Lattice& lattice,
                              bool curved = false);

/// Those of the blocks as the covers over them move: each block with a cover of its own is whole.
SurfaceArrays contact_surfaces(const Cutting& cutting, const BlockArrays& blocks,
                               const CoverArrays& covers, const FaceMaterials& materials = {});

}  // namespace rockfold
