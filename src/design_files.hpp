// Drawings and tables that a model asks for, beside the result file.
#pragma once

#include <string>
#include <vector>

#include "src/model/model.hpp"
#include "src/support_design.hpp"

namespace rockfold {

/// Where the drawings and then the tables go: their names in the model are those of files in the result's folder.
std::vector<std::string> design_paths(const Model& model, const std::string& result);
/// Where the model names each of them.
std::vector<Place> design_places(const Model& model);

/// Writes them all; each takes its name when it is whole. Throws Error(io).
void write_design_files(const BlockArrays& blocks, const KeyblockReport& keyblocks,
                        const SupportDesign& design, const Model& model, const std::string& result);

}  // namespace rockfold
