// Polygons of block faces: the water that presses on them, where they touch, what their blocks weigh.
#pragma once

#include <vector>

#include "src/arrays/block_arrays.hpp"
#include "src/base/types.hpp"
#include "src/model/model.hpp"

namespace rockfold {

/// Whether the arrays hold loops and vertices.
bool has_polygons(const BlockArrays& blocks);

/// A pressure that changes linearly: max(0, at_origin + gradient·x), Pa.
struct LinearPressure {
  Real at_origin = 0;
  Vec3 gradient{};  ///< Pa/m

  Real unclipped(const Vec3& x) const;
};

/// ∫ p dA (N) and ∫ p x dA (N m) over a face; exact.
struct PressureForce {
  Real force = 0;
  Vec3 first_moment{};
};
PressureForce pressure_force(const BlockArrays& blocks, Index face, const LinearPressure& pressure);
/// Likewise over the part in a box, if one is given; corners within `slack` (m) of its sides lie in it.
PressureForce pressure_force(const BlockArrays& blocks, Index face, const LinearPressure& pressure,
                             const BoxRegion* box, Real slack);

/// Likewise over a convex polygon, counter-clockwise against its normal.
PressureForce pressure_on_polygon(const std::vector<Vec3>& corners, const Vec3& normal,
                                  const LinearPressure& pressure);

/// The area-weighted centre of a face, m.
Vec3 face_centre(const BlockArrays& blocks, Index face);

/// ∫ (y·y δ − y yᵀ) ρ dV about the centroid of a block of uniform density, kg m².
Mat3 inertia_tensor(const BlockArrays& blocks, Index block);

/// How much of the sphere about a point the block fills: 1 inside, 0 outside, between on its boundary
/// (1/2 on a face).
Real winding_number(const BlockArrays& blocks, Index block, const Vec3& point);

/// The corners of each of a face's loops, the outer one first.
std::vector<std::vector<Vec3>> face_loops(const BlockArrays& blocks, Index face);

/// The corners of a face's outer loop.
std::vector<Vec3> outer_loop(const BlockArrays& blocks, Index face);

/// What two faces of one plane share, as the points that its convex hull is made of (`normal`: of
/// the first). Holes count as filled.
std::vector<Vec3> overlap_points(const BlockArrays& blocks, Index face, Index other);

/// The convex hull of points of a plane, counter-clockwise against its normal; corners between
/// straight edges (to 1e-9 of the size) are left out. Fewer than 3 where the hull has no area.
std::vector<Vec3> hull_in_plane(const Vec3& normal, const std::vector<Vec3>& points);

}  // namespace rockfold
