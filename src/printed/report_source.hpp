// Reads from a result file what its report tells.
#pragma once

#include "src/printed/sections.hpp"

namespace rockfold {

/// Throws Error(io) where the file is none of ours, damaged, or lacks the command's document.
ReportSource read_report_source(const std::string& path);

}  // namespace rockfold
