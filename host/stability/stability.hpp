// The stability of the whole rock mass: limit analysis of all blocks at once (docs/stability.md).
//
// Table of contents:
//   rigid_mass.hpp       bodies, areas of contact, their points      rock_mass.hpp   those of a cut model
//   mass_scale.hpp       the same in numbers near 1                  contact_columns.hpp  forces that contacts may pass on
//   linear_program.hpp   CLP                                         bound.hpp       the factor that no mass without dilation exceeds
//   part_of_mass.hpp     some blocks, all others held               movement.hpp    what a mechanism does, block by block
//   sliding.hpp          the factor of a mass that does not dilate   spring_mass.hpp springs in its contacts: how it creeps
//   collapse_forces.hpp  forces at their strength on its slips
//   certificate.hpp      what proves a factor                        verify.hpp      its check in rational arithmetic
#pragma once

#include <vector>

#include "host/cut/cut.hpp"
#include "host/stability/bound.hpp"
#include "host/stability/certificate.hpp"
#include "host/stability/movement.hpp"
#include "host/stability/sliding.hpp"
#include "src/arrays/block_arrays.hpp"
#include "src/base/progress.hpp"
#include "src/base/stage_keys.hpp"
#include "src/model/model.hpp"

namespace rockfold {

/// More blocks that may move than this are refused: the time grows with some n² to n³.
constexpr Index most_moving_blocks = 2000;

struct StabilityReport {
  RigidMass mass;
  std::vector<Index>
      partly_held;  ///< blocks that a [[fixed]] holds in some directions alone: they count as free
  Bound bound;
  bool bound_proved = false;  ///< in rational arithmetic, from both sides or from below alone
  Sliding sliding;
  std::vector<MovingBlock> at_bound, at_sliding;  ///< how its mechanisms move

  Certificate certificate() const {
    Certificate all{mass, bound.below, bound.above, {}, {}};
    if (sliding.proved()) {
      all.sliding_balance = sliding.balance;
      all.sliding_mechanism = sliding.mechanism;
    }
    return all;
  }
};

StageKeys keys_of_stability();

/// Up to so many take little longer than their key blocks do: `support` asks the whole mass too.
constexpr Index most_blocks_beside_keys = 50;

/// Blocks that may move, after all stages.
Index moving_block_count(const BlockArrays& blocks, const Model& model);

/// Throws Error(model) for more than most_moving_blocks.
StabilityReport find_stability(const Cutting& cutting, const BlockArrays& blocks,
                               const Model& model, Progress& progress);

}  // namespace rockfold
