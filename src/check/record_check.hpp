// A record of the ground beside the analysis that it acts in.
#pragma once

#include "src/model/model.hpp"
#include "src/report/terminal.hpp"

namespace rockfold {

/// A record of the ground that lies beside its step, is cut by the ends of the analysis, or leaves an acceleration for ever: before its first
/// and after its last row it is as there.
void warn_of_record(const Model& model, Terminal& terminal);

}  // namespace rockfold
