// What lies between cells that touch: a joint, the boundary of an excavation, or nothing (glue); and which face of which
// solid bounds a cell where nothing is behind it.
#pragma once

#include "host/cut/complex.hpp"

namespace rockfold {

/// Fills fragments, free_parts and polygons of a complex whose cells are complete. Returns what intent decided.
IntentCount find_adjacency(Complex& complex);

}  // namespace rockfold
