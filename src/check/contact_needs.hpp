// What blocks that touch each other need of the model, and what the user should know about their motion.
#pragma once

#include "src/arrays/block_arrays.hpp"
#include "src/arrays/cover_arrays.hpp"
#include "src/model/model.hpp"
#include "src/report/terminal.hpp"
#include "src/run/run_result.hpp"

namespace rockfold {

/// How many blocks lean on another one as the analysis begins.
Index blocks_in_touch(const Model& model, const BlockArrays& blocks);
/// Several blocks that come apart: warns where they have no contact, and throws Error(model) where they have it with a scheme that makes
/// energy in impacts.
void check_contact(const Model& model, const BlockArrays& blocks, Terminal& terminal);
/// Contact is between blocks: joints that end in one, of which `joint_area` (m²) is what all joints have, and parts of a block that may fold
/// onto each other.
void warn_of_contact_within_blocks(const Model& model, const BlockArrays& blocks, Real joint_area,
                                   const CoverArrays& covers, const FixedPoints& fixed,
                                   Terminal& terminal);
/// Joints between blocks that are so stiff that they cost many iterations.
void warn_of_contact_stiffness(const Model& model, const BlockArrays& blocks, Terminal& terminal);
/// Blocks that `meet` at joints and whose weight a dynamic analysis puts on at once, though the joints do not bear it yet.
void warn_of_unbalanced_start(const Model& model, bool meet, Terminal& terminal);
/// Blocks that moved so far in a step that contact gave them energy.
void warn_of_made_energy(const RunResult& run, Terminal& terminal);
/// Of blocks that lie in each other by more than a joint gives way, at the end.
void warn_of_deep_overlap(const RunResult& run, const BlockArrays& blocks, Terminal& terminal);

}  // namespace rockfold
