// The stability of the whole rock mass: limit analysis of all blocks at once (docs/stability.md).
//
// Table of contents:
//   rigid_mass.hpp       bodies, areas of contact, their points      rock_mass.hpp   those of a cut model
//   mass_scale.hpp       the same in numbers near 1                  contact_columns.hpp  forces that contacts may pass on
//   linear_program.hpp   CLP                                         bound.hpp       the factor that no mass without dilation exceeds
//   spring_mass.hpp      springs in the contacts: how a mass without dilation creeps
//   certificate.hpp      what proves a factor                        verify.hpp      its check in rational arithmetic
#pragma once

#include <vector>

#include "host/cut/cut.hpp"
#include "host/stability/bound.hpp"
#include "host/stability/certificate.hpp"
#include "src/arrays/block_arrays.hpp"
#include "src/base/progress.hpp"
#include "src/base/stage_keys.hpp"
#include "src/model/model.hpp"

namespace rockfold {

/// More blocks that may move than this are refused: the time grows with some n² to n³.
constexpr Index most_moving_blocks = 2000;

/// How one block moves in the mechanism of the bound.
struct MovingBlock {
  Index body = none;  ///< into RigidMass::bodies
  Vec3 velocity{};    ///< of its centre; the fastest point of the mass moves with 1 m/s
  Vec3 spin{};        ///< rad/s
  /// Joints that press on it and on which it slips, and those that it leaves; sorted.
  std::vector<std::string> slides_on, parts_from;
};

struct StabilityReport {
  RigidMass mass;
  std::vector<Index>
      partly_held;  ///< blocks that a [[fixed]] holds in some directions alone: they count as free
  Bound bound;
  std::vector<MovingBlock> moving;  ///< by mass times speed, the largest first

  Certificate certificate() const { return {mass, bound.below, bound.above, {}, {}}; }
};

StageKeys keys_of_stability();

/// Throws Error(model) for more than most_moving_blocks.
StabilityReport find_stability(const Cutting& cutting, const BlockArrays& blocks,
                               const Model& model, Progress& progress);

}  // namespace rockfold
