// Numbers over time, as the result file and tables hold them: what a monitor saw, energies and contacts of each step.
#pragma once

#include <string>
#include <vector>

#include "src/base/types.hpp"

namespace rockfold {

/// Columns of equal length over common times.
/// Example: two times and one column {"displacement", "m", 3} with 6 values.
struct History {
  struct Column {
    std::string name;          ///< a data set's name: "normal_stress"
    std::string unit;          ///< "Pa"; empty for a number without one
    int width = 1;             ///< numbers at each time
    std::vector<Real> values;  ///< [T][width]
  };
  std::string name;        ///< of a monitor; empty for what belongs to the whole model
  std::string joint;       ///< of a monitor of a joint
  std::vector<Real> time;  ///< [T] s
  std::vector<Column> columns;
};

}  // namespace rockfold
