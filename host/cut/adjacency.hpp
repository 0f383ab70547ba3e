// What lies between cells that touch: a joint, the boundary of an excavation, or nothing (glue); and which face of which
// solid bounds a cell where nothing is behind it.
#pragma once

#include "host/cut/cells/complex.hpp"

namespace rockfold {

/// Fills fragments, free_parts and polygons of a complex whose cells are complete. Cells from `rock_count` on are void, so
/// narrow that rock on their two sides may touch: what they share with rock or each other is returned, with the joints that
/// lie there, as fragments that are no part of the complex; their polygons are.
std::vector<Fragment> find_adjacency(Complex& complex, Index rock_count);

/// The joint between two solids at an area that no other joint covers, into Complex::origins; none = glue.
Index interface_between(const Complex& complex, const Zone& one, const Zone& two);

}  // namespace rockfold
