// Support beyond the forces that block theory asks for: bolts, shotcrete, the search for a pattern, classification.
#pragma once

#include <optional>

#include "host/bolting/bolting.hpp"
#include "host/bolting/pattern_search.hpp"
#include "host/classification/classification.hpp"
#include "host/keyblock/keyblock.hpp"
#include "host/measure/measure.hpp"
#include "src/app/joint_stress.hpp"
#include "src/report/terminal.hpp"

namespace rockfold {

/// Each where the model asks for it.
struct SupportDesign {
  std::optional<BoltingReport> bolting;
  std::optional<PatternSearchReport> search;
  std::optional<ClassificationReport> classification;
  std::optional<JointStressReport> joint_stress;
};

StageKeys keys_of_support_design(const Model& model);

/// `measures` may be null without [classification].
SupportDesign design_support(const BlockArrays& blocks, const KeyblockReport& keyblocks,
                             const RockMeasures* measures, const Model& model);

/// Warns of bonds whose strength is not given, and of a search without a result.
void warn_of_support_design(const SupportDesign& design, Terminal& terminal);

/// Where a limit of batches ends the search: warns of bolts that hold key blocks and go into blocks that come down with these, and that the same
/// bolts do not hold to the target. Looks for one batch more.
void warn_of_anchors_that_move(const BlockArrays& blocks, const KeyblockReport& keyblocks,
                               const BoltingReport& bolting, const Model& model,
                               const FaceTractions* in_situ, Terminal& terminal);

}  // namespace rockfold
