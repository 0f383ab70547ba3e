// The whole program, in the order in which data flow through it.
#pragma once

#include "src/app/command_line.hpp"
#include "src/report/terminal.hpp"

namespace rockfold {

/// Carries out a command and prints its answer on stdout. Returns the exit status: 0, or 130 or 143
/// for a run that a signal ended early. Throws Error for everything else.
int run_command(const Options& options, Terminal& terminal);

}  // namespace rockfold
