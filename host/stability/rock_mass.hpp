// The blocks of a cutting as the rigid bodies of limit analysis: which of them move, where they touch, what loads them.
#pragma once

#include <cstdint>
#include <vector>

#include "host/cut/cut.hpp"
#include "host/stability/rigid_mass.hpp"
#include "src/arrays/block_arrays.hpp"
#include "src/model/model.hpp"

namespace rockfold {

/// Which blocks [[fixed]] and the rock beyond the model hold, after all stages of excavation.
struct HeldBlocks {
  /// [B] 1: it does not move. It is not finite, or a [[fixed]] of all three components touches it (its region: one of the
  /// block's faces, a point in it, a box or plane that it reaches into).
  std::vector<std::uint8_t> held;
  /// Blocks that a [[fixed]] of one or two components touches, and that are not held; ascending.
  std::vector<Index> partly_held;
};
HeldBlocks held_blocks(const BlockArrays& blocks, const Model& model);

/// The mass after all stages of excavation. Excavated blocks are gone, and what touched them is a free face. Blocks that are
/// partly held count as free.
///
/// Loads as in block theory: weight, earthquake, point loads, tractions, water. The water in a joint has one pressure for both
/// sides, that of the smaller of the two faces, and presses on both blocks with equal and opposite forces. In-situ stress is
/// left out: a rigid mass cannot tell what of it is there.
///
/// A contact area is a convex part of what two blocks share on one plane of one joint; the parts that make up a convex area
/// are one. Its first body is never `none`; of two bodies the first has the lower number. Corners run counter-clockwise
/// against the normal. Ordered by the pair of bodies, by plane, by joint. Throws Error(model) as Bodies does.
RigidMass rigid_mass(const Cutting& cutting, const BlockArrays& blocks, const Model& model);

}  // namespace rockfold
