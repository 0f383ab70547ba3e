// Stereographic and Lambert projections of directions.
#pragma once

#include <string>
#include <vector>

#include "src/report/drawings/svg.hpp"

namespace rockfold {

/// Directions of one hemisphere on a disc of radius `radius` about `centre`; north is up, east to the right. With θ the angle
/// from the middle of the hemisphere: equal angle r = R tan(θ/2), equal area r = √2 R sin(θ/2).
struct Projection {
  Point2 centre{};
  Real radius = 1;
  bool upper = false, equal_area = false;

  /// Of a unit direction, also of the other hemisphere (outside of the disc; equal angle: anywhere but opposite the middle).
  Point2 of(const Vec3& direction) const;
  /// Whether a direction is on the hemisphere (to rounding).
  bool shows(const Vec3& direction) const;
  /// The one of ±v on the hemisphere.
  Vec3 shown(const Vec3& v) const { return shows(v) ? v : Vec3{-v[0], -v[1], -v[2]}; }

  /// The half of a plane's great circle that the hemisphere shows, as a line of points; `normal` is unit.
  std::vector<Point2> great_circle(const Vec3& normal) const;
  /// The small circle of directions at `angle` (rad) from `axis`, as far as the hemisphere shows it: runs of points.
  std::vector<std::vector<Point2>> small_circle(const Vec3& axis, Real angle) const;
};

}  // namespace rockfold
