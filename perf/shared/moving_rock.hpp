// Rock in motion, from a model as text, as the program runs it.
#pragma once

#include <string>

#include "src/run/run_analysis.hpp"

namespace rockfold {

struct MovingRock {
  RunResult result;
  double seconds = 0;    ///< of the steps after `from` …
  double processor = 0;  ///< … and of all threads for them
  Index blocks = 0;
};

/// Times are of the steps alone, without cutting and covers.
MovingRock run_moving_rock(const std::string& text, Index from);

/// 819 blocks of three joint sets with `friction`, degrees; the faces behind and below held. It settles in `steps`, and goes on by `then`, the keys
/// of a step and what else the model is to have.
std::string jointed_slope(Real friction, Index steps, const std::string& then);

}  // namespace rockfold
