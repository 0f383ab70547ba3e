// Specks: blocks far smaller than the others, such as nearly concurrent joints leave. Each may go to a neighbour.
#pragma once

#include "host/cut/bodies/numbering.hpp"
#include "host/cut/cells/complex.hpp"
#include "host/cut/cut.hpp"

namespace rockfold {

/// Joins each block below the limit to the neighbour with which it shares the largest area of joints; of equal areas (to 1e-9) to
/// the larger block, of equal blocks to the lower centroid. What is still below the limit goes on to the next. Only areas wider than the
/// tolerance count, between rock of one solid and one stage of excavation; and blocks that touch a face beyond which the rock
/// continues go to such blocks alone, so that no other becomes immovable. No two blocks above the limit become one.
/// Joints between what is one block then become virtual, and `blocks` are numbered anew. Everything is settled by geometry: the same
/// whatever the order of cells. O(cells + areas of specks · log specks).
SpeckReport merge_specks(Complex& complex, const CutSpec& spec, NumberedBlocks& blocks);

}  // namespace rockfold
