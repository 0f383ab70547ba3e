// A sweep as one printable HTML document: what came out, how it scatters, and what it depends on.
#pragma once

#include <string>

#include "src/sweep/sweep_table.hpp"

namespace rockfold::sweep {

std::string page_path(const std::string& folder);
/// Needs no network and no other file. Throws Error(io).
void write_page(const SweepTable& table, const std::string& folder);

/// Runs in so many classes of the same width, as bars; "" where there is no number.
std::string histogram_svg(const std::string& name, const std::vector<Real>& values);

/// How far a parameter moves a result: means of the result over the runs with the lowest and the highest third of the parameter's values.
struct Swing {
  std::string parameter;
  Real low = 0, high = 0;
  Real rank_correlation = 0;
};
/// Widest first; of parameters that vary.
std::vector<Swing> swings(const SweepTable& table, const std::string& result);
/// Tornado plot: a bar a parameter, about the mean of all runs.
std::string tornado_svg(const std::string& name, const std::vector<Swing>& swings, Real mean);

}  // namespace rockfold::sweep
