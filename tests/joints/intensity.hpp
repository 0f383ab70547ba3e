// How densely joints lie in a region: P10, P20, P21, P30, P32 (Dershowitz and Herda, 1992; docs/random_joints.md),
// measured in double precision on the placed polygons, whole: the oracle of the tests of random sets. CGAL's numbers: include in
// .cpp only.
#pragma once

#include <array>
#include <vector>

#include "host/joints/disc.hpp"
#include "host/joints/place_joints_exact.hpp"
#include "src/base/types.hpp"

namespace rockfold::test {

/// A placed joint in double precision.
struct FlatJoint {
  Vec3 normal;                ///< unit
  Real offset = 0;            ///< m; the plane is normal·x = offset
  std::vector<Vec3> polygon;  ///< m; simple, may be concave, either sense; empty = through-going
};

/// In the order of placing.
std::vector<FlatJoint> flat_joints(const PlacedJoints& placed);

/// A rectangle: corner + s·u + t·v for s and t from 0 to 1; u and v at right angles.
struct SamplingRectangle {
  Vec3 corner, u, v;  ///< m
};

struct Intensities {
  Real p10 = 0;  ///< 1/m, crossings along the line over its length
  Real p20 =
      0;  ///< 1/m², traces with their midpoint on the rectangle (of a through-going joint, any trace) over its area
  Real p21 = 0;  ///< m/m², length of traces on the rectangle over its area
  Real p30 =
      0;  ///< 1/m³, joints with their centre of area in the box (of a through-going one, any area) over its volume
  Real p32 = 0;  ///< m²/m³, area of joints in the box over its volume
};

/// box: with volume; line: from, to, apart; rectangle: with area. Empty polygons' planes are cut at the box.
Intensities measure_intensities(const std::vector<FlatJoint>& joints, const Extent& box,
                                const std::array<Vec3, 2>& line,
                                const SamplingRectangle& rectangle);

/// Joints that the line from `from` to `to` crosses. A joint that it touches counts on one of its two sides, so that
/// the crossings of two lines end to end are those of the whole.
Index crossings(const std::vector<FlatJoint>& joints, const Vec3& from, const Vec3& to);

}  // namespace rockfold::test
