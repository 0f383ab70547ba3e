// Results as comma-separated values: a head line with units, then one line for each entry; texts in quotes.
#pragma once

#include <string>

#include "src/app/support_design.hpp"
#include "src/arrays/block_arrays.hpp"
#include "src/model/model.hpp"

namespace rockfold {

/// A table of block theory or support design (those of histories: history_tables.hpp). Numbers are written with as many digits as
/// read back the same; what is not defined is left empty.
std::string csv_table(TableFile::Kind kind, const BlockArrays& blocks,
                      const KeyblockReport& keyblocks, const SupportDesign& design,
                      const Model& model);

}  // namespace rockfold
