// What has become of the blocks at the end of a run with contact.
#pragma once

#include "src/run/run_analysis.hpp"

namespace rockfold {

/// m: the cube root of the blocks' mean volume.
Real mean_block_size(const RunInput& input);

/// m: where forces depend on places, a shorter way than this may be rounding, and is none.
Real way_of_rounding(const RunInput& input);

/// m/s: a thousandth of √(g h), h the blocks' mean size; blocks that are slower are at rest.
Real resting_speed(const RunInput& input);

/// Of the fastest block.
Real largest_speed(const std::vector<BlockMotion>& velocity);

/// [B] `gone`: 1 of blocks that are no more (empty: none); what they touched does not count. `counted` displacements say what moved, `whole` ones how the blocks have turned; `velocity`: averages of the velocity likewise, m/s. `start`: the contact points of step 0; those of joints say how far
/// what lay opposite each other has gone apart (opening) and along the joint (slip), under `covers` m of the unknowns.
/// `acceleration`: of a quasi-static step, each of which begins at rest; empty: another one. A block with more than a hundredth of gravity moves, however slow it still is.
Rest find_rest(const RunInput& input, const std::vector<BlockMotion>& counted,
               const std::vector<BlockMotion>& whole, const std::vector<BlockMotion>& velocity,
               const std::vector<BlockMotion>& acceleration, const std::vector<ContactPoint>& start,
               const std::vector<Vec3>& covers, const std::vector<std::uint8_t>& gone);

/// Of a quasi-static step, which each time begins at rest: mass times the mean `acceleration` of each block in it, m/s². `conditions`: what
/// each of them carries.
Unbalanced find_unbalanced(const RunInput& input, const std::vector<BlockMotion>& acceleration,
                           const std::vector<Reaction>& conditions,
                           const std::vector<std::uint8_t>& gone);

}  // namespace rockfold
