// Discs: regular polygons inscribed in a circle on a plane.
#pragma once

#include <vector>

#include "host/exact/orientation.hpp"
#include "src/model/model.hpp"

namespace rockfold {

/// Right-handed unit vectors (to rounding) on and off a plane. Symmetric orientations have symmetric frames.
struct PlaneFrame {
  Vec3 normal;  ///< upward; for a vertical plane as given
  Vec3
      down;  ///< down the dip; of a horizontal plane the dip direction as given, north for a given normal
  Vec3 strike;  ///< normal × down, horizontal
};
PlaneFrame plane_frame(const Orientation& orientation);

/// The regular polygon of `sides` ≥ 3 corners in the unit circle: the angles of its corners from the first, which is at 0.
/// Mirror-image corners have mirror-image values.
using DiscOutline = std::vector<SineCosine>;
DiscOutline disc_outline(Index sides);

/// Corners of the regular polygon on the circle about `centre` + `shift`, the first one down the
/// dip, counter-clockwise about the frame's normal. Mirror-image corners are mirror images to the last digit where
/// centre and shift are zero. `shift` apart, so that large coordinates are rounded once only.
std::vector<Vec3> disc_corners(const PlaneFrame& frame, const Vec3& centre, const Vec3& shift,
                               Real radius, const DiscOutline& outline);

struct Extent {
  Vec3 min, max;
};
/// Of at least one point.
Extent bounding_box(const std::vector<Vec3>& points);
Real diagonal(const Extent& box);
/// Whether the boxes come closer than `margin` (m).
bool boxes_meet(const Extent& a, const Extent& b, Real margin);

}  // namespace rockfold
