// What SIGINT and SIGTERM do in each part of the program.
#pragma once

namespace rockfold {

/// Nothing worth keeping is there yet: a signal ends the program at once, with status 130 or 143.
/// With `json` the error document of an interruption goes to stdout first.
void exit_at_once_when_interrupted(bool json);

/// From here on a signal is remembered (src/base/interrupt.hpp); the analysis stops after its step.
/// A second one ends the program as soon as no state is being written: a result that holds states takes its name, other files
/// that are being written are removed. Call it in the thread that writes them.
void remember_interrupts();

/// 128 + the signal that was remembered, or 0.
int interrupted_status();

}  // namespace rockfold
