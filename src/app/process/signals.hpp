// What SIGINT and SIGTERM do in each part of the program.
#pragma once

#include <optional>
#include <string>

#include "src/base/error.hpp"

namespace rockfold {

/// Nothing worth keeping is there yet: a signal ends the program at once, with status 130 or 143.
/// With `json` the error document of an interruption goes to stdout first.
void exit_at_once_when_interrupted(bool json);

/// From here on a signal is remembered (src/base/interrupt.hpp); the analysis stops after its step.
/// After a second one (`timeout` sends two at once) the analysis has another second; a third, or the end of that second, ends the program
/// as soon as no state is being written: a result that holds states takes its name, other files that are being written are removed, and
/// with `json` an error document goes to stdout. Call it in the thread that writes them.
void remember_interrupts();

/// What is left is to store and to print what there is, which ends by itself: a second signal that came before limits it no more, another
/// one gives it a second again.
void analysis_is_over();
/// From here on stdout holds an answer, beside which no error document may stand.
void answer_begins();

/// As a signal, for a reason of our own: an option that limits the program (`key`), and what is beyond it. The program ends with
/// status 1 then and says why. Asked again it ends at once.
void request_stop(const std::string& key, const std::string& why);
/// What request_stop() was told, or nothing. `state` goes on with the sentence: "stopped after 3 of 10 steps".
std::optional<Error> stop_error(const std::string& state);

/// 128 + the first signal that was remembered, 1 where it was request_stop(), or 0.
int interrupted_status();

}  // namespace rockfold
