// A sweep as one printable HTML document: what came out, how it scatters, and what it depends on.
#pragma once

#include <string>

#include "src/sweep/sweep_plots.hpp"
#include "src/sweep/sweep_table.hpp"

namespace rockfold::sweep {

std::string page_path(const std::string& folder);
/// Needs no network and no other file. Throws Error(io).
void write_page(const SweepTable& table, const std::string& folder);

/// Widest first; of parameters that vary and are no seeds.
std::vector<Swing> swings(const SweepTable& table, const std::string& result);

}  // namespace rockfold::sweep
