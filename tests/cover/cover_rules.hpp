// Rules that the covers of every model keep, whatever the lattice. Each broken rule is one line that starts with the rule's name.
#pragma once

#include "tests/cover/covers.hpp"
#include "tests/cut/oracles/cutting_rules.hpp"

namespace rockfold::test {

/// "volume": elements have positive volumes; those of the pieces of a block sum to its volume to 1e-9, all to the rock's to 1e-12.
/// "cover": each block's elements hang together by their covers, and none is shared by two blocks (by two bodies, if welded).
/// "surface": the parts of each free area sum to it, each in an element of its block.
/// "points": the vertices of the blocks are found in their blocks.
Faults faults_of_covers(const Covered& c);

/// m³ of each element.
std::vector<Real> element_volumes(const CoverArrays& a);

}  // namespace rockfold::test
