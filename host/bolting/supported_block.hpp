// A block with its support, in each motion that it may start: the limit equilibrium of block and bolts.
// docs/support_design.md, "A block with its support".
#pragma once

#include <span>
#include <vector>

#include "host/bolting/bolt_capacity.hpp"
#include "host/bolting/held_block.hpp"
#include "host/bolting/shotcrete.hpp"
#include "host/keyblock/keyblock.hpp"

namespace rockfold {

/// A bolt where it leaves a block.
struct BoltAtBlock {
  const BoltType* type = nullptr;
  Vec3 axis{};     ///< unit, from the block into the rock that stays
  Real axial = 0;  ///< N, capacity along it
  Vec3 point{};    ///< m, where it leaves
};

/// A block in the motion that governs with its support.
struct SupportedMotion {
  SlidingMode mode = SlidingMode::at_rest;
  std::vector<BoltForce> forces;  ///< [bolts]
  HeldBlock held;                 ///< [elements]: the bolts, then shotcrete if there is any
};

/// The pull of active bolts, at full load from the start, joins the block's resultant as water does: the motions are those of r +
/// P_a, about hinges too. Passive bolts and shotcrete then add to the resistance against each of them. The least safe motion
/// is told, adequate and missing_force are those of all. Where no motion is left, F is infinite.
///
/// A block that falls without its anchors has no resistance to compare the rest of its load with. Its F is the factor on r
/// at which block and support are in limit equilibrium: for support along the fall −(P_a + P_p)·s / T, ≥ 1 where r + P_a is
/// held.
SupportedMotion supported_motion(const Keyblock& key, std::span<const BoltAtBlock> bolts,
                                 const ShotcreteHold& shotcrete, Real target_factor_of_safety);

}  // namespace rockfold
