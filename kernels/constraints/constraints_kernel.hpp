// Essential boundary conditions in the solution of A x = b: N x = ū at points that are held, springs of stiffness k at others.
//
// With N the weights of the points, W⁻¹ what resists at the unknowns that they touch and K the stiffness by which points are tied to their
// places, whole of springs, and of points held 10⁶ of what resists there,
//   T = W⁻¹ + NᵀKN
// is positive whether points depend on each other or not. By it
//   x ← x + T⁻¹NᵀK (ū − N x)   brings points to their places (but for 10⁻⁶ of the way),
//   r ← r − NᵀK N T⁻¹ r         takes off the forces what the points take, which is their multiplier.
// What is then left is balanced by A + NᵀKN, the matrix of the augmented Lagrangian (Fortin & Glowinski 1983). A preconditioner B, which knows
// but little of K, learns of the rest by
//   B' = T⁻¹W⁻¹ B W⁻¹T⁻¹ + T⁻¹NᵀKN T⁻¹,
// with B = W the inverse of T (Woodbury): neither stiff springs nor conditions that tie many covers together cost iterations. One T serves
// both: its K is what B does not know, its W⁻¹ has what B does.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "kernels/krylov/krylov_work_kernel.hpp"
#include "kernels/operator/springs_kernel.hpp"
#include "src/system/sparse_cholesky.hpp"

namespace rockfold::solve {

/// T of components that points tie alike.
struct TiedUnknowns {
  std::vector<int> components;       ///< none: another one has this one's
  std::vector<Index> begin, column;  ///< its pattern
  std::vector<Real> value;
  SparseCholesky factors;
};

/// N, W and T.
struct Constraints {
  Springs springs;
  Array<Index> entry_row;  ///< of each entry of springs.points, into springs.row
  bool any_held = false, any_tied = false;
  Real spring_factor = 1;
  // On the host: the entries of the points, and the points of each unknown's row.
  std::vector<Index> begin, entry_row_host, row_begin, row_point;
  std::vector<Real> entry_weight, row_weight;
  std::array<std::vector<std::uint8_t>, 3> acts;  ///< [d][n] whether a point holds or pulls
  Field known;    ///< (n, d) N/m: what preconditioners know of what ties the points …
  Field unknown;  ///< … and the rest, which T knows
  Field resists;  ///< (t, d) N/m: W⁻¹ of unknown springs.row(t), with what is known
  std::array<TiedUnknowns, 3> matrix;  ///< [d] of component d, and of those after it that are alike
  bool current = false;                ///< whether T has been factorised
  Field value;                         ///< (n, d) work space
  Field part, kept;                    ///< (t, d) work space
  Field left;                          ///< (u, d) work space
};
Constraints make_constraints(Springs springs, Index unknowns);

/// W from the diagonal blocks of A without springs, and how the points are tied.
void set_ties(Constraints& c, const Blocks& diagonal, Real spring_factor);

/// Takes the multipliers off r, and adds to them what more of r tied points take.
void take_off_multipliers(Constraints& c, const Field& r);

/// Brings x to where tied points are prescribed, those of springs by what their multiplier stretches them.
void close_gaps(Constraints& c, const Field& prescribed, const Field& x);

/// Points held that are one unknown each: to the last digit, so that nothing of rounding moves them.
void place_exactly(const Constraints& c, const Field& prescribed, const Field& x);

/// λ += K N x of points tied: what they take once A + NᵀKN has been solved for x.
void add_multipliers_of(Constraints& c, const Field& x);

/// x ← T⁻¹W⁻¹ x, of points tied: motions that they allow.
void hold_points(Constraints& c, const Field& x);

/// B' of B, which knows `known`; it is good until ties are set anew.
ApplyInverse with_constraints(Constraints& c, ApplyInverse b, const KrylovWork& work);

}  // namespace rockfold::solve
