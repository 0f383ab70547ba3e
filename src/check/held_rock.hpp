// Rock that its supports leave no motion, and rock that none of them holds.
#pragma once

#include "src/arrays/block_arrays.hpp"
#include "src/arrays/cover_arrays.hpp"
#include "src/model/model.hpp"
#include "src/report/terminal.hpp"

namespace rockfold {

/// Whether a model may have such: block covers, and faces, boxes or planes that are held.
bool may_hold_all(const Model& model);

/// With block covers: a block that is more than half of the rock there is as the analysis begins, all unknowns of whose cover are
/// held. Whatever acts on it, it neither moves nor strains. Not where [[fixed]] names the block itself: that is meant, unless all
/// blocks are held so, and nothing can move.
void warn_of_held_rock(const Model& model, const BlockArrays& blocks, const CoverArrays& covers,
                       const FixedPoints& fixed, Terminal& terminal);

/// Whether a model may have rock that goes on beyond it and that no [[fixed]] holds.
bool may_leave_rock_unheld(const Model& model);

/// With contact: blocks that go on beyond the model, whose underside does or is the model's, and that no [[fixed]] holds. Nothing stops
/// their fall.
void warn_of_unheld_rock(const Model& model, const BlockArrays& blocks, const CoverArrays& covers,
                         const FixedPoints& fixed, Terminal& terminal);

}  // namespace rockfold
