// Which parts may touch: pairs of boxes that overlap, from grids whose spacing doubles from level to level. A box stands in the level
// whose cells are as large as it is, in the cell of its lower corner, so that it meets only boxes of at most three cells a
// direction there and in each coarser level. O(n log n) for boxes of any sizes.
#pragma once

#include <cstdint>

#include "kernels/contact/detection/point_set_kernel.hpp"
#include "kernels/contact/detection/sort_kernel.hpp"

namespace rockfold::contact {

/// Work space of find_pairs; grows, never shrinks.
struct BroadPhase {
  Field low, high;           ///< [P] m, the boxes
  Array<std::uint8_t> gone;  ///< [P] 1: the part touches nothing any more
  Array<Index> level, pair_begin;
  SortedKeys cells, found;
};

BroadPhase make_broad_phase(const Surfaces& surfaces);

/// The pairs of parts of different blocks whose boxes, over both places and grown by `margin` (m) on each side, overlap.
/// In new arrays: others may still use the old ones.
Pairs find_pairs(const Surfaces& surfaces, const Field& from, const Field& to, Real margin,
                 BroadPhase& work);

}  // namespace rockfold::contact
