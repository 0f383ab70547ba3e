// The sets of a model, one at a time. CGAL's numbers: include in .cpp only.
#pragma once

#include <utility>
#include <vector>

#include "host/joints/disc.hpp"
#include "host/joints/place_joints_exact.hpp"
#include "host/joints/random_set.hpp"

namespace rockfold {

/// What joints are placed for: the rock, or the solid that they stay within.
struct PlacingRegion {
  std::vector<Vec3> corners;  ///< m; at least one
  Extent box;
  Real margin = 0;  ///< m: what is nearer counts as touching
};
PlacingRegion placing_region(const RockBounds& rock, Index within);

/// Discs smaller than this share of the region's diagonal are below what the cutter tells apart from a point.
constexpr Real least_radius_share = 1e-9;

/// First and last multiple of a regular set's spacing that meets the region, or `count` of them about the origin.
std::pair<Real, Real> set_range(const JointSet& set, const PlacingRegion& region);

/// Appends the joints of a set without `random`, all of `origin`.
void place_regular_set(const JointSet& set, const PlacingRegion& region, Index origin,
                       std::vector<PlacedJoint>& joints);

/// Appends what draw_joints() drew for a set with `random`; specks below least_radius_share are left out.
void place_random_set(const JointSet& set, const std::vector<DrawnJoint>& drawn,
                      const PlacingRegion& region, Index origin, std::vector<PlacedJoint>& joints);

/// Appends a disc on `plane` about centre + shift, unless it lies off the region.
void place_disc(const ExactPlane& plane, const PlaneFrame& frame, const Vec3& centre,
                const Vec3& shift, Real radius, const DiscOutline& outline,
                const PlacingRegion& region, PlacedJoint joint, std::vector<PlacedJoint>& joints);

}  // namespace rockfold
