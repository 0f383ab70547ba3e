// What of the model the command at hand does not use: told, and an error where it is a load.
#pragma once

#include <string>
#include <vector>

#include "src/app/command_line.hpp"
#include "src/model/model.hpp"
#include "src/report/terminal.hpp"

namespace rockfold {

/// Keys of the model that no stage of the command uses, in the order of the file: "material.young_modulus"; "[cover]" or
/// "[[bolt]]" for a section of which none is used.
std::vector<std::string> unused_keys(const Options& options, const Model& model);

/// Throws Error(model) with all loads that no stage of the command takes, but for those of --ignore; warns of what acts in
/// one of its analyses and not in the other.
void require_loads_used(const Options& options, const Model& model, Terminal& terminal);

}  // namespace rockfold
