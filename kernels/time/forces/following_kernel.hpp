// Pressures that follow their faces under large kinematics: the force on a point's share of the face is −p cof(F) A, A its area
// vector before the deformation (Nanson's formula), cof F = det(F) F⁻ᵀ. Tractions that follow, and water in joints, which presses on what of
// a side of a joint has the other one before it.
#pragma once

#include "kernels/operator/elements/sampled_elements_kernel.hpp"
#include "kernels/time/forces/loads_kernel.hpp"

namespace rockfold::motion {

/// Points of faces under pressure.
struct PressedPoints {
  solve::PointRows points;
  Array<Index> element;
  Field local;                ///< m, from the centre of the element's lattice cell
  Field area;                 ///< m²
  Array<Real> pressure;       ///< Pa, times the table's x component where there is a table
  Array<Index> table;         ///< or none
  Array<Index> side;          ///< LoadPoints::side
  Field force;                ///< work space
  solve::PointSlopes slopes;  ///< where elements differ in their functions
};

struct FollowingPressures {
  PressedPoints tractions, water;
  PressedPoints water_at_end;  ///< of the step that begins
  bool in_joints = false;      ///< whether there may be water
  Array<Real> share;           ///< [sides of joints] of the water's pressure that acts
  DeviceTables tables;
  solve::ElementTable elements;
  bool any() const { return tractions.points.any() || in_joints; }
};
FollowingPressures make_following_pressures(const MotionSetup& setup);

/// The water that is in joints at the end of the step that begins.
void set_water(FollowingPressures& loads, const CoverArrays& covers, const LoadPoints& water);

/// f += scale · the forces at time t of the rock displaced by d.
void add_following_pressures(const FollowingPressures& loads, Real t, const Field& d, Real scale,
                             const Field& f);

}  // namespace rockfold::motion
