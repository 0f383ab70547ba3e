// Essential boundary conditions as springs between points of the material and where they ought to be (thesis 4.3):
// penalty alone, or with a multiplier for each point and component (augmented Lagrangian).
//
// With N the weights of a point, k its stiffness, u = N x and u* its target, a point pulls with k (u − u*) + λ.
#pragma once

#include "kernels/device/device_kernel.hpp"
#include "kernels/device/sums_kernel.hpp"
#include "kernels/operator/operator_kernel.hpp"
#include "kernels/operator/point_terms_kernel.hpp"

namespace rockfold::solve {

struct Springs : PointRows {
  Field given_stiffness;  ///< (n, d) N/m as the model asks, 0 where a component is free
  Field stiffness;        ///< (n, d) N/m in use, see choose_spring_stiffness
  Field augmented;        ///< (n, d) 1 where a multiplier holds the point in its place
  Field
      eliminated;  ///< (n, d) 1 where the solver keeps an augmented point exactly: its multiplier is the reaction
  Field
      by_multiplier;  ///< (n, d) 1 where a multiplier works: there, and for springs too stiff to be solved with …
  Field compliance;  ///< … (n, d) unknown / N by which these yield to their multipliers, else 0
  Field multiplier;  ///< (n, d) N
  Field target;      ///< (n, d) m, prescribed displacement
  Array<Real> motion_ratio;  ///< (n) how far rock moves with one metre of the point, at most
  Field force;               ///< (n, d) work space
  Array<Real> share;         ///< work space, one for each entry of `points`
};

/// `eliminated`: [N], see there.
Springs build_springs(const FixedPoints& fixed, const std::vector<Vec3>& eliminated,
                      Index unknowns);

/// Their tangents, factor · k, into the points of `terms` from `first` on.
void set_tangents(const Springs& springs, Real factor, const PointTerms& terms, Index first);

/// b += Nᵀ (factor · k u* − λ), u* = prescribed(n, d).
void add_spring_load(const Springs& springs, Real factor, const Field& prescribed, const Field& b);

/// Raises the stiffness of augmented points to ten times the diagonal that the point has to hold, or ten thousand
/// times where one cover moves it alone: d are the diagonal blocks of the operator without springs, `covers` their number. Less, and the multipliers
/// would converge slowly (short time steps: heavy; stiff rock). Preconditioners know a spring between covers by its share of each alone:
/// with `compliant`, those far stiffer than what resists them become a compliance with a multiplier (perturbed Lagrangian): the same forces.
/// What all converge to does not depend on it.
void choose_spring_stiffness(const Springs& springs, Real factor, Index covers, const Blocks& d,
                             bool compliant);

/// change(n, d) = √(factor · k) (N x − prescribed − compliance λ) where multipliers work, 0 elsewhere: the next change of the multipliers in the
/// scale in which their iteration is symmetric. Returns how far off rock is at most: the largest motion_ratio · |N x − prescribed − compliance λ|, m.
Real multiplier_change(const Springs& springs, Real factor, const Field& x, const Field& prescribed,
                       const Field& change);

/// values *= (factor · k)^power where multipliers work.
void scale_by_stiffness(const Springs& springs, Real factor, Real power, const Field& values);

/// reaction(n, d): the force of each point on the rock, −λ − factor · k (N x − prescribed), N.
void spring_reactions(const Springs& springs, Real factor, const Field& x, const Field& prescribed,
                      const Field& reaction);

/// max |x|.
Real largest_entry(const Field& x);

}  // namespace rockfold::solve
