// Essential boundary conditions as springs between points of the material and where they ought to be (thesis 4.3):
// penalty alone, or with a multiplier for each point and component (augmented Lagrangian).
//
// With N the weights of a point, k its stiffness, u = N x and u* its target, a point pulls with k (u − u*) + λ. Springs are
// applied beside the rows of the operator, not written into them: values may change without re-assembly.
#pragma once

#include "kernels/device/device_kernel.hpp"
#include "kernels/device/sums_kernel.hpp"
#include "kernels/solve/operator_kernel.hpp"
#include "kernels/solve/point_rows_kernel.hpp"

namespace rockfold::solve {

struct Springs : PointRows {
  Field given_stiffness;  ///< (n, d) N/m as the model asks, 0 where a component is free
  Field
      stiffness;  ///< (n, d) N/m in use: raised for augmented points in stiff or heavy surroundings
  Field augmented;    ///< (n, d) 1 where a multiplier works
  Field multiplier;   ///< (n, d) N
  Field target;       ///< (n, d) m, prescribed displacement
  Array<Real> reach;  ///< (n) how far rock moves with one metre of the point, at most
  Field force;        ///< (n, d) work space
  Array<Real> share;  ///< work space, one for each entry of `points`
};

Springs build_springs(const FixedPoints& fixed, Index unknowns);

/// y += factor · Nᵀ k N x.
void apply_springs(const Springs& springs, Real factor, const Field& x, const Field& y);

/// b += Nᵀ (factor · k u* − λ), u* = goal(n, d).
void add_spring_load(const Springs& springs, Real factor, const Field& goal, const Field& b);

/// The diagonal blocks of factor · Nᵀ k N, added to d.
void add_spring_diagonal(const Springs& springs, Real factor, const Blocks& d);

/// Raises the stiffness of augmented points to ten times the diagonal that the point has to hold, or ten thousand times where one
/// cover moves it alone: d are the diagonal blocks of the operator without springs, `covers` their number. Below that (short time steps: heavy; stiff rock) the multipliers would
/// converge slowly. What they converge to does not depend on it.
void stiffen_springs(const Springs& springs, Real factor, Index covers, const Blocks& d);

/// change(n, d) = √(factor · k) (N x − goal) at augmented points, 0 elsewhere: the next change of the multipliers in the scale
/// in which their iteration is symmetric. Returns how far off rock
/// is at most: the largest reach · |N x − goal|, m.
Real multiplier_change(const Springs& springs, Real factor, const Field& x, const Field& goal,
                       const Field& change);

/// values *= (factor · k)^power at augmented points.
void scale_by_stiffness(const Springs& springs, Real factor, Real power, const Field& values);

/// reaction(n, d): the force of each point on the rock, −λ − factor · k (N x − goal), N.
void spring_reactions(const Springs& springs, Real factor, const Field& x, const Field& goal,
                      const Field& reaction);

/// max |x|.
Real largest_entry(const Field& x);

}  // namespace rockfold::solve
