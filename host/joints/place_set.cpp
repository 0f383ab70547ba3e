#include <algorithm>
#include <cmath>
#include <limits>

#include "host/exact/orientation.hpp"
#include "host/joints/place_set_exact.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

PlacingRegion placing_region(const RockBounds& rock, Index within) {
  PlacingRegion region;
  // A solid without bounds has no corners.
  const bool bounded = within != none && !rock.solid_corners[within].empty();
  region.corners = bounded ? rock.solid_corners[within] : rock.corners;
  region.box = bounding_box(region.corners);
  region.margin = 1e-9 * diagonal(region.box);
  return region;
}

std::pair<Real, Real> set_range(const JointSet& set, const PlacingRegion& region) {
  if (set.count) return {-std::floor((*set.count - 1) / 2.0), std::floor(*set.count / 2.0)};
  const Vec3 normal = normalized(normal_of(set.orientation));
  Real low = std::numeric_limits<Real>::infinity(), high = -low;
  for (const Vec3& p : region.corners) {
    const Real t = dot(normal, p - set.origin) / set.spacing;
    low = std::min(low, t);
    high = std::max(high, t);
  }
  // One that just touches is identified with a face or adds nothing.
  return {std::ceil(low - 1e-9), std::floor(high + 1e-9)};
}

void place_disc(const ExactPlane& plane, const PlaneFrame& frame, const Vec3& centre,
                const Vec3& shift, Real radius, const DiscOutline& outline,
                const PlacingRegion& region, PlacedJoint joint, std::vector<PlacedJoint>& joints) {
  joint.polygon = disc_corners(frame, centre, shift, radius, outline);
  if (!boxes_meet(bounding_box(joint.polygon), region.box, region.margin)) return;
  joint.plane = plane;
  joints.push_back(std::move(joint));
}

void place_regular_set(const JointSet& set, const PlacingRegion& region, Index origin,
                       std::vector<PlacedJoint>& joints) {
  const Vec3 normal = normal_of(set.orientation);
  const PlaneFrame frame = plane_frame(set.orientation);
  const Vec3 along = dot(frame.normal, normal) < 0 ? -frame.normal : frame.normal;
  // A normal computed from angles is a unit one but for rounding, which must not enter the offsets.
  const Real length = std::holds_alternative<Vec3>(set.orientation) ? norm(normal) : 1;
  const auto [first, last] = set_range(set, region);
  const PlacedJoint joint{{}, {}, origin, set.within};
  const DiscOutline outline = disc_outline(set.sides);
  for (Real k = first; k <= last; ++k) {
    const ExactPlane plane =
        plane_through(normal, set.origin, exact(k) * exact(set.spacing) * exact(length));
    if (set.radius)
      place_disc(plane, frame, set.origin, (k * set.spacing) * along, *set.radius, outline, region,
                 joint, joints);
    else
      joints.push_back({plane, {}, origin, set.within});
  }
}

void place_random_set(const JointSet& set, const std::vector<DrawnJoint>& drawn,
                      const PlacingRegion& region, Index origin, std::vector<PlacedJoint>& joints) {
  const Real least_radius = least_radius_share * diagonal(region.box);
  const DiscOutline outline = disc_outline(set.sides);
  joints.reserve(joints.size() + drawn.size());
  for (const DrawnJoint& one : drawn) {
    if (one.radius < least_radius) continue;
    const ExactPlane plane = plane_through(normal_of(one.orientation), one.point);
    if (std::isinf(one.radius))
      joints.push_back({plane, {}, origin, set.within});
    else
      place_disc(plane, plane_frame(one.orientation), one.point, {}, one.radius, outline, region,
                 {{}, {}, origin, set.within}, joints);
  }
}

}  // namespace rockfold
