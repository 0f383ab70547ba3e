// A vector that changes over time.
#pragma once

#include <vector>

#include "src/base/types.hpp"

namespace rockfold {

/// Linear between its rows; before the first and after the last it is as there.
struct TimeTable {
  std::vector<Real> time;   ///< s, ascending
  std::vector<Vec3> value;  ///< in the unit of what it stands for

  bool empty() const { return time.empty(); }
  /// {0, 0, 0} of an empty table.
  Vec3 at(Real t) const;
  /// A second, just after t.
  Vec3 slope_after(Real t) const;
};

}  // namespace rockfold
