// Pressures that follow their faces under large kinematics: the force on a point's share of the face is −p cof(F) A, A its area
// vector before the deformation (Nanson's formula), cof F = det(F) F⁻ᵀ.
#pragma once

#include "kernels/operator/elements/sampled_elements_kernel.hpp"
#include "kernels/time/forces/loads_kernel.hpp"

namespace rockfold::motion {

struct FollowingPressures {
  solve::PointRows points;
  Array<Index> element;
  Field local;           ///< m, from the centre of the element's lattice cell
  Field area;            ///< m²
  Array<Real> pressure;  ///< Pa, times the table's x component where there is a table
  Array<Index> table;    ///< or none
  Field force;           ///< work space
  DeviceTables tables;
  solve::ElementTable elements;
  solve::PointSlopes slopes;  ///< where elements differ in their functions
  bool any() const { return points.any(); }
};
FollowingPressures make_following_pressures(const MotionSetup& setup);

/// f += scale · the forces at time t of the rock displaced by d.
void add_following_pressures(const FollowingPressures& loads, Real t, const Field& d, Real scale,
                             const Field& f);

}  // namespace rockfold::motion
