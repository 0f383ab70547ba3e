// NAME.xdmf: what ParaView 5.11 and 5.12 open, which cannot read the VTKHDF of several blocks.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "src/io/viewers/vtkhdf.hpp"

namespace rockfold {

/// The XDMF text that presents the grids of a result file of this name (no folder: both files stand
/// side by side); `times` of the states may be empty.
std::string xdmf_text(const std::string& file_name, std::span<const vtkhdf::Grid> grids,
                      const std::vector<Real>& times);

}  // namespace rockfold
