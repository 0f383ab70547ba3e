// How many cells planes in general position cut a box into, counted without cutting anything.
#pragma once

#include <vector>

#include "src/base/types.hpp"

namespace rockfold::test {

struct PointAndNormal {
  Vec3 point, normal;
};

/// 1 + planes that hit the open box + pairs whose line hits it + triples that meet in it: the number of cells of a simple
/// arrangement (each plane adds as many cells as its section has regions). Long double; `clearance` is the least distance,
/// over the box' diagonal, by which any of these questions was decided, and by which any four planes (with those of the
/// box) miss a common point in it: below 1e-10 the answer means nothing, since the planes are concurrent by intent.
/// O(n³) for the count and O(n⁴) for the clearance.
struct ArrangementCount {
  long planes = 0, lines = 0, points = 0;
  long double clearance = 1;
  long cells() const { return 1 + planes + lines + points; }
};
ArrangementCount count_cells(const Vec3& low, const Vec3& high,
                             const std::vector<PointAndNormal>& planes);

}  // namespace rockfold::test
