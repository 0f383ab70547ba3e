// The outline of a joint on a block: of one face, or of all facets of a surface that are one plane.
#pragma once

#include <vector>

#include "host/keyblock/water/drainage.hpp"
#include "src/base/types.hpp"

namespace rockfold {

/// Of faces cut by planes: the rounding of corners.
constexpr Real straightness_of_planes = 1e-9;

/// The outline of the joint that a face, or several together, lie on.
struct JointOutline {
  DrainedLoop
      corners;  ///< in one plane, counter-clockwise against the normal; without corners that are none
  Vec3 normal{};  ///< unit, outward
};

/// Some faces of one plane, with outlines that they share where they meet along edges.
struct FaceOutlines {
  std::vector<Index> of_face;              ///< [faces] into outlines
  std::vector<std::vector<Vec3>> outline;  ///< counter-clockwise against the normal
};

/// `loops`: of each face, counter-clockwise against the normal. Corners within `slack` (m) are one; faces may meet along parts of edges.
/// Of faces that enclose others' gap the outermost boundary counts. Cost: corners times edges.
FaceOutlines joined_outlines(const std::vector<std::vector<std::vector<Vec3>>>& loops,
                             const Vec3& normal, Real slack);

/// What of an outline drains, its corners brought into the plane through the first along the normal.
JointOutline joint_outline(const Outlets& outlets, const std::vector<Vec3>& outline,
                           const Vec3& normal, Real tolerance);

/// Without corners where water finds no corner: between edges that drain alike, those that lie within `tolerance` times the distance
/// of the ends from the straight line between the corners that are kept (Douglas & Peucker 1973).
DrainedLoop simplified(const DrainedLoop& outline, Real tolerance);

}  // namespace rockfold
