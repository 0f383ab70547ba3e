// Drawings of a sweep's results, as SVG.
#pragma once

#include <string>
#include <vector>

#include "src/base/types.hpp"

namespace rockfold::sweep {

/// A result over the runs. What is not finite is left out.
struct ResultPlot {
  std::string name;
  std::string unit = {};  ///< "" where it is not known; N, Pa, J and m are scaled to their size
  std::vector<Real> values;
  /// A number with which an event compares the result ("fails", "<", 1): a line across the plot where it lies in it.
  struct Mark {
    std::string event, sign;
    Real at = 0;
  };
  std::vector<Mark> marks = {};
};

/// Runs in classes of the same width, as bars, with the mean, the median, 5 and 95 %. Whole numbers that span little have a class each. ""
/// where there is no number.
std::string histogram_svg(const ResultPlot& plot);
/// The empirical distribution function: the share of the runs whose result is no larger; with the median, 5 and 95 %. Its axis is that of
/// the histogram. "" where there is no number.
std::string cumulated_svg(const ResultPlot& plot);

/// How far a parameter moves a result: means of the result over the runs with the lowest and the highest third of the parameter's values.
struct Swing {
  std::string parameter;
  Real low = 0, high = 0;
  Real rank_correlation = 0;
};
/// Tornado plot: a bar a parameter, about the mean of all runs.
std::string tornado_svg(const std::string& name, const std::string& unit,
                        const std::vector<Swing>& swings, Real mean);

/// Of a result by its path in a document: "N" of "totals.support_force"; "" where the path does not tell.
std::string unit_at(const std::string& path);

}  // namespace rockfold::sweep
