// Pieces narrower than the tolerance (decision 5, rule 8): their rock counts with a piece beside them, whose functions move it.
#pragma once

#include <vector>

#include "host/cover/lattice/pieces.hpp"

namespace rockfold {

/// The sliver that a cell of the complex has of a part of a lattice cell, or null. O(log n)
const Sliver* find_sliver(const std::vector<Sliver>& slivers, Index lattice_cell, int part,
                          Index rock);

/// Regular lattice cells become pieces. `which`: [regular]
void split_regular(const Complex& complex, const LatticePlanes& lattice, const PlaneTable& planes,
                   const std::vector<bool>& which, Pieces& pieces);

/// Gives each sliver an owner in its block: what is across its largest facet of the same cell of the complex, for rock that is
/// a sliver all through what touches it in the same part, or beyond a facet. Where nothing does, it is a piece of its own. Regular
/// lattice cells that own slivers become pieces. O(n log n), times how many slivers lie behind each other.
void give_slivers_owners(const Complex& complex, const LatticePlanes& lattice,
                         const PlaneTable& planes, Pieces& pieces);

}  // namespace rockfold
