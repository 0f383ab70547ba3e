// The support of a model: which bolt crosses which block, what it can do for it, and whether that is enough.
// docs/support_design.md.
//
// Table of contents:
//   wall.hpp           walls unrolled to sheets            rock_lines.hpp     lines through blocks
//   drill.hpp          where bolts stand                   bolt_capacity.hpp  what a bolt can do
//   shotcrete.hpp      punching shear                      supported_block.hpp  the motions that support leaves
//   held_block.hpp     one motion against support          pattern_search.hpp   the lightest pattern
#pragma once

#include <optional>
#include <vector>

#include "host/bolting/bolt_capacity.hpp"
#include "host/bolting/drill.hpp"
#include "host/bolting/held_block.hpp"
#include "host/bolting/shotcrete.hpp"
#include "host/keyblock/keyblock.hpp"

namespace rockfold {

/// A bolt where it leaves a key block.
struct BoltCrossing {
  Index bolt = none;
  Embedment embedment;
  Real axial_capacity =
      0;  ///< N along the bolt, less what blocks of the same batch nearer to the collar take
  BoltForce force;                     ///< at capacity
  Real capacity = 0;                   ///< N = |force|
  Real load = 0;                       ///< N, service load
  Real force_mobilisation = 0;         ///< load / capacity
  Real displacement_mobilisation = 0;  ///< displacement of the block / displacement capacity
};

/// The support of one block. Active bolts are at full load whatever the block does: their load is their capacity.
struct BlockSupport {
  Index block = none;
  std::vector<Index> members;               ///< of a group that fails together: all of them
  SlidingMode mode = SlidingMode::lifting;  ///< of the motion that governs with the support
  std::vector<BoltCrossing> crossings;
  ShotcreteHold shotcrete;
  HeldBlock held;
  /// Service load over capacity, summed over bolts, and the largest displacement over its capacity; 0 without bolts. Of a
  /// block that is not held 1 (0 without bolts) and infinite.
  Real force_mobilisation = 0, displacement_mobilisation = 0;
};

struct BoltingReport {
  std::vector<BoltGroup> groups;
  std::vector<Bolt> bolts;
  std::vector<BlockSupport> keyblocks;  ///< [KeyblockReport::keyblocks]
  std::vector<BlockSupport> stable;     ///< [KeyblockReport::stable]
  /// Blocks at rest that active bolts cross: they may drive them.
  std::vector<BlockSupport> at_rest;
  std::vector<Index> key_at_rest;  ///< [at_rest] into KeyblockReport::at_rest
  std::vector<Index> disturbed;    ///< blocks that stay and miss the target because of active bolts
  Real length = 0;                 ///< m of all bolts
  Index adequate = 0;              ///< key blocks that reach the target
  /// Of the first batch: if all are held, by bolts that end in rock that stays, nothing moves.
  Index first_batch = 0, first_batch_adequate = 0;
};

/// What the support is judged against.
struct SupportedRock {
  const BlockArrays& blocks;
  const KeyblockReport& keyblocks;
  Real target = 1.5;
  std::vector<ShotcreteHold> shotcrete;  ///< [B], or empty: none
};

/// Whether the model asks for bolts or shotcrete.
bool wants_bolting(const Model& model);

/// Drills the model's bolts and judges every key block, and every block that stays, with its support.
/// Throws Error(model) for a wall that is not there and a bolt that meets no rock.
BoltingReport support_blocks(const BlockArrays& blocks, const KeyblockReport& keyblocks,
                             const Model& model);

/// The same for bolts that have been drilled: fills all but groups, bolts and length.
void judge_support(const SupportedRock& rock, BoltingReport& report);

/// A block that stays.
struct StayingBlock {
  const Keyblock& key;
  const BlockSupport* support;  ///< nullptr without bolting
};
/// The stable ones, then those at rest that active bolts cross.
std::vector<StayingBlock> staying_blocks(const KeyblockReport& keyblocks,
                                         const BoltingReport* bolting);

/// Takes blocks of excavation stages out of what bolts cross: they are air.
void leave_out_excavated(const BlockArrays& blocks, std::vector<Bolt>& bolts);

/// What the model's shotcrete does for each key block and each block that stays, [B]; empty without shotcrete.
std::vector<ShotcreteHold> shotcrete_on(const BlockArrays& blocks, const KeyblockReport& keyblocks,
                                        const Model& model);

}  // namespace rockfold
