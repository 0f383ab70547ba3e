// Who touches whom, plane by plane: the faces on the two sides of a plane tile the same region, and their overlaps are
// the fragments that cells share (DESIGN.md, "Adjacency afterwards").
#pragma once

#include "host/cut/complex.hpp"

namespace rockfold {

/// Fills fragments, free_parts and polygons of a complex whose cells are complete. Returns what intent decided.
/// Faces bounded by the same half-spaces match by hash in O(faces); the rest by sweep and clip.
IntentCount find_adjacency(Complex& complex);

}  // namespace rockfold
