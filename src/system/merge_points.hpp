// Fixed points that say the same thing, as one. Elements that meet at a corner of a fixed face each bring that corner as a
// point: six or so of the same weights. Their springs add up; more rows to solve for would only cost.
#pragma once

#include <vector>

#include "src/arrays/cover_arrays.hpp"

namespace rockfold::solve {

/// What has become of each given point.
struct PointShares {
  std::vector<Index> merged;  ///< [N] the point that it is now part of
  std::vector<Real> share;    ///< [N] its part of that one's stiffness, and so of its reaction

  std::vector<Vec3> share_out(const std::vector<Vec3>& of_merged) const;
};

struct MergedPoints {
  FixedPoints
      fixed;  ///< each place once, with the sum of stiffness; `element` is that of the first
  PointShares shares;
};

/// Merges points of equal covers, weights (to 1e-9), components, values, tables and method; in the order of first
/// occurrence.
MergedPoints merge_points(const FixedPoints& given);

}  // namespace rockfold::solve
