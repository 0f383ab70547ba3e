// Drawings and tables that a model asks for, beside the result file.
#pragma once

#include <string>
#include <vector>

#include "src/app/support_design.hpp"
#include "src/model/model.hpp"
#include "src/run/run_result.hpp"

namespace rockfold {

/// What of it a command makes: tables of histories come with an analysis, all others with block theory.
struct Made {
  bool support = false, run = false;
};

/// One [[drawing]] or [[table]] that is written: the other one is null.
struct DesignFile {
  const Drawing* drawing = nullptr;
  const TableFile* table = nullptr;
  std::string path;  ///< in the result's folder
  Place place;       ///< where the model names it; no file: the command line did
};

/// Those of the model that are written, drawings first.
std::vector<DesignFile> design_files(const Model& model, const std::string& result, Made made);

/// Writes drawings and tables of block theory; each takes its name when it is whole. Throws Error(io).
void write_design_files(const BlockArrays& blocks, const KeyblockReport& keyblocks,
                        const SupportDesign& design, const Model& model, const std::string& result);
/// Likewise, of histories.
void write_history_files(const RunResult& run, const Model& model, const std::string& result);

}  // namespace rockfold
