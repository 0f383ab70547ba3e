// The regions of the stereonet that joint pyramids are, as polygons with their codes.
#pragma once

#include <string>
#include <vector>

#include "src/base/types.hpp"

namespace rockfold {

/// A joint pyramid that is not empty.
struct PyramidRegion {
  std::string code;  ///< Goodman & Shi: 0 above, 1 below, in the order of the planes
  std::vector<Vec3>
      boundary;   ///< unit directions around it, close together; empty: half-spaces without corners
  Vec3 middle{};  ///< unit, as far from all planes as can be
  bool removable = false;
};

/// All of them for 1 … 8 planes given by upward unit normals, in the order of their codes. `free` are outward normals of
/// free faces, from the rock into the opening: a pyramid is removable if it lies in the opening's half-space of one of them
/// (Shi's theorem); `axis` (unit, or zero for none) is that of a tunnel instead: removable is what does not hold its direction.
/// Without either none is.
std::vector<PyramidRegion> joint_pyramid_regions(const std::vector<Vec3>& upward,
                                                 const std::vector<Vec3>& free, const Vec3& axis);

}  // namespace rockfold
