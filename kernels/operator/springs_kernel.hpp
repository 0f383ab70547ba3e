// Essential boundary conditions at points of the material (thesis 4.3): springs between them and where they ought to be, or points that are held there
// exactly. With N the weights of a point, k the stiffness of its spring, u = N x and u* its target, a spring pulls with k (u − u*).
#pragma once

#include "kernels/device/device_kernel.hpp"
#include "kernels/device/sums_kernel.hpp"
#include "kernels/operator/operator_kernel.hpp"
#include "kernels/operator/point_terms_kernel.hpp"

namespace rockfold::solve {

struct Springs : PointRows {
  // (n, d)
  Field stiffness;  ///< N/m of a spring; 0 where a component is free or held
  Field held;       ///< 1 where the point is held
  Field tied;  ///< 1 where a multiplier keeps it: held, or on a spring far stiffer than the matrix
  Field tie;   ///< N/m in the matrix: that of the spring, times its factor, or what ties the point
  Field multiplier;          ///< N, of points tied: minus the force on the rock, of the last solve
  Field target;              ///< m, prescribed displacement
  Array<Real> motion_ratio;  ///< (n) how far rock moves with one metre of the point, at most
  Field force;               ///< work space
};
/// Without ties yet: they are a matter of the matrix.
Springs build_springs(const FixedPoints& fixed, Index unknowns);

/// (n, d) N/m into the first points of `terms`.
void set_tangents(const Springs& springs, const Field& stiffness, const PointTerms& terms);

/// y += Nᵀ factor · k N x, k one of the fields above.
void apply_springs(const Springs& springs, const Field& stiffness, Real factor, const Field& x,
                   const Field& y);

/// b += Nᵀ k u*, u* = prescribed(n, d), of springs that are not tied.
void add_spring_load(const Springs& springs, const Field& prescribed, const Field& b);

/// m: by what its multiplier stretches the spring of a tied point, which has `factor` of its stiffness; a point held has none.
KOKKOS_INLINE_FUNCTION Real stretch_of_tied(const Springs& s, Index n, int d, Real factor) {
  return s.held(n, d) > 0 ? 0 : s.multiplier(n, d) / (factor * s.stiffness(n, d));
}

/// The largest motion_ratio · |prescribed + stretch − N x|, m, of points held, or of those that springs of `factor` of their stiffness tie.
Real largest_gap(const Springs& springs, bool held, Real factor, const Field& x,
                 const Field& prescribed);

/// reaction(n, d): the force of each point on the rock, N: −λ where it is tied, else k (prescribed − N x).
void spring_reactions(const Springs& springs, const Field& x, const Field& prescribed,
                      const Field& reaction);

/// max |x|.
Real largest_entry(const Field& x);

}  // namespace rockfold::solve
