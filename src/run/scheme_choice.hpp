// Which steps scheme = "auto" takes.
//
// Implicit steps, which may be long where rock is at rest or nearly, and explicit ones for the rest of a [[step]] once iterations have cost it far
// more than substeps would have, or do not come to balance however short the step. Work is counted in visits of contact points, so that every machine
// decides alike.
#pragma once

#include "src/model/model.hpp"

namespace rockfold {

/// Of a stage so far, in visits of contact points by explicit substeps.
struct SchemeWork {
  Real iterated = 0;  ///< what its implicit steps were worth
  Real instead = 0;   ///< what substeps would have taken, when that was last asked
};

/// An iteration of Newton's method, with what it solves, costs as much as ten substeps of the same points: measured, 4 (819 blocks that begin to
/// slide) to 36 (when they slide by metres a second); 14 for a row of dominoes.
inline constexpr Real visits_of_iteration = 10;

/// Some seconds of one core: less is not worth another scheme.
inline constexpr Real worth_a_change = 1e7;

/// Whether "auto" may take explicit steps: where blocks touch, and where nothing of the model asks for the implicit scheme's own numbers.
bool may_choose(const Model& model, const AnalysisStage& stage);

/// Whether it is time to ask what substeps would have taken.
inline bool is_dear(const SchemeWork& work) {
  return work.iterated > work.instead + worth_a_change;
}

}  // namespace rockfold
