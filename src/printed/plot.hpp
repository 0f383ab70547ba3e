// Curves over time, or over another axis, as SVG.
#pragma once

#include <string>
#include <vector>

#include "src/base/types.hpp"

namespace rockfold {

struct PlotCurve {
  std::string name;
  std::vector<Real> values;  ///< [P]; what is not finite interrupts the curve
};

/// Curves of one quantity over common times or places.
struct Plot {
  std::string title, unit;
  std::vector<Real> at;  ///< [P], ascending
  std::vector<PlotCurve> curves;
  std::string axis = "time, s";  ///< what `at` is
};

/// Nothing where there is no curve, or fewer than two times or places.
std::string plot_svg(const Plot& plot);

/// Multiples of 1, 2 or 5 times a power of ten from `low` to `high`, `most` at most.
std::vector<Real> axis_ticks(Real low, Real high, int most);

}  // namespace rockfold
