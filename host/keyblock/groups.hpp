// Blocks that fail together where none of them can alone. docs/block_theory.md, "Groups".
#pragma once

#include <functional>
#include <vector>

#include "host/keyblock/bodies.hpp"

namespace rockfold {

/// Some blocks that move as one body.
struct Group {
  RockBody body;
  BlockVerdict verdict;  ///< key
};

/// Groups of 2 to `largest` of these blocks that move although no block of them does: for each block
/// and each direction that its own joints give (its load, projected on each of its planes
/// and lines, and where a turn about an edge of its contacts carries it), the blocks that it pushes
/// on, and those that they push on, are taken with it. No two
/// groups share a block: the smaller one, then the one with the larger sliding force is taken.
/// `may_move`: whether a block may be a member. The result does not depend on threads.
std::vector<Group> find_groups(const Bodies& bodies, const std::vector<Index>& blocks,
                               const std::vector<Index>& batch, Index largest,
                               const std::function<bool(Index)>& may_move);

}  // namespace rockfold
