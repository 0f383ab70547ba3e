// `rockfold sweep`: many runs of one model, each a process of its own.
#pragma once

#include "src/app/command_line.hpp"
#include "src/report/terminal.hpp"

namespace rockfold {

/// Runs what SWEEP.toml asks for and has not been run yet in its folder; writes DIR/sweep.csv and DIR/sweep.h5, prints the summary or
/// the document. Returns 0 where all runs are done, 1 where some failed or met a limit, 130 or 143 after a signal; what has ended
/// by then stays. Throws Error as read_sweep and SweepRecord do.
int run_sweep(const Options& options, Terminal& terminal);

}  // namespace rockfold
