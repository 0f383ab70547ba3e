// About how many blocks joints make, before they cut the rock.
#pragma once

#include <cstddef>
#include <vector>

#include "host/cut/cells/patch.hpp"
#include "src/base/types.hpp"

namespace rockfold {

/// A joint for an estimate: a plane, or a disc about a point.
struct ForecastJoint {
  Vec3 normal{};                ///< unit
  Real offset = 0;              ///< m: normal · x on the plane
  Vec3 middle{};                ///< m, of a disc
  Real radius = Box::infinity;  ///< m; infinite: through-going
  std::size_t region = 0;       ///< into the regions: it cuts there only
};

/// Rock in a box.
struct ForecastRegion {
  Box box;
  Real volume = 0;  ///< m³, of the rock in it
};

/// An arrangement of planes in a convex body has 1 + planes + lines + points cells: the lines in which two planes meet inside and the
/// points where three do. Lines and points are counted where they are few, else among 200,000 pairs and triples that are
/// drawn at random, always the same, less twice the scatter of such a count; points by the share of their box that rock fills.
/// O(joints) beside the draws.
Real forecast_blocks(const std::vector<ForecastJoint>& joints,
                     const std::vector<ForecastRegion>& regions);

}  // namespace rockfold
