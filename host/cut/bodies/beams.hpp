// What faces of wide cells meet through slivers (decision 5, rule 5). A sliver neither joins nor parts what lies sideways of it:
// an area looks straight through it, along the sliver's normal, at what is on the other side.
#pragma once

#include <vector>

#include "host/cut/cells/complex.hpp"

namespace rockfold {

/// The beams between the wide cells of a complex, both ways, each over an area wider than the tolerance. `gaps` are the areas
/// of void slivers, cells that follow the rock's (find_adjacency). O(areas of slivers · areas opposite), on all threads.
std::vector<Beam> find_beams(const Complex& complex, Index rock_count,
                             const std::vector<Fragment>& gaps);

}  // namespace rockfold
