// `rockfold sets`: from measured orientations to joint sets.
#pragma once

#include "src/app/command_line.hpp"
#include "src/report/terminal.hpp"

namespace rockfold {

/// Reads the table, finds its sets, prints them and writes what the options name. Returns the exit status. Throws Error(model) for what is
/// wrong with the table, Error(io) where a file cannot be read or written.
int tell_joint_sets(const Options& options, Terminal& terminal);

}  // namespace rockfold
