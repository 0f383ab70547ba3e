// What contact makes out of nothing, beside all that a run turns over.
//
// Points found anew have other areas and planes than those whose forces worked: blocks that overlap far and turn, or slide onto larger areas,
// then store more than they were given. Energy.impact falls by it. A run in which that is much shows another motion.
#pragma once

#include <string>

#include "kernels/time/motion.hpp"
#include "src/run/run_analysis.hpp"
#include "src/run/run_result.hpp"

namespace rockfold {

/// Counts a step. What it turns over is half of what kinetic, strain, potential and contact energy change by, with what it dissipates: a
/// block that falls turns over what it falls by. Step 0 (`before` null) has turned over what it stores.
void count_made_energy(const Energy* before, const Energy& now, MadeEnergy& made);

/// Where most was made: of the step, or part of one, that the motion has just taken.
void note_gain(const RunInput& input, const Motion& motion, MadeEnergy& made);

/// "12.3 J out of nothing in 4 steps, 2.1 % of …, most between blocks 3 and 7 near (…)"
std::string made_energy_text(const MadeEnergy& made);

/// Throws Error(analysis) where contact has made more than a tenth.
void require_little_made(const MadeEnergy& made, Index step, Real time);

}  // namespace rockfold
