// Which triangles of a body are one plane face.
#pragma once

#include <vector>

#include "src/model/model.hpp"

namespace rockfold {

struct BodyPlanes {
  std::vector<Index> of_triangle;  ///< [triangles] plane, 0 ≤ p < outward.size()
  std::vector<Vec3> outward;       ///< [planes] unit
  bool convex = false;             ///< no edge between two planes is reentrant
};

/// Connected triangles whose corners lie within `reach` (m) of the plane fitted to them are one plane, the largest first. Of a
/// closed, oriented surface. O(n log n)
BodyPlanes find_planes(const TriangleSurface& surface, Real reach);

}  // namespace rockfold
