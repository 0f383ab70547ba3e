// Blocks for other programs: one file of a format that the file's name tells.
#pragma once

#include <string>

#include "src/arrays/block_arrays.hpp"
#include "src/arrays/part_arrays.hpp"

namespace rockfold {

enum class ExportFormat { vtp, obj, stl, three_dec, json };

/// The format of ".vtp", ".obj", ".stl", ".3ddat" or ".json" (in either case). Throws Error(usage), which names these, for
/// any other name.
ExportFormat export_format(const std::string& path);

/// What is exported; all coordinates in m, ids from 1.
struct ExportData {
  const BlockArrays& blocks;
  const PartArrays& parts;  ///< read for .3ddat alone; may be empty for the others
  std::string title;        ///< of the model
};

/// Writes aside and renames, so that the file is whole under its name. Throws Error(io) with the file and the reason.
void export_blocks(const ExportData& data, const std::string& path);

}  // namespace rockfold
