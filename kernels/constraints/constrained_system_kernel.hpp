// A system with essential boundary conditions: (αK + βM + γ NᵀkN + other terms) x = b + Nᵀ (γ k prescribed − λ), and for augmented points
// multipliers λ such that N x = prescribed: Uzawa's iteration λ ← λ + γ k (N x − prescribed) on the augmented Lagrangian (Glowinski & Le
// Tallec 1989, ch. 3), accelerated, with inexact inner solves. Plain, it creeps where points lie close together.
#pragma once

#include "kernels/constraints/anderson.hpp"
#include "kernels/constraints/elimination_kernel.hpp"
#include "kernels/constraints/merge_points.hpp"
#include "kernels/constraints/solve_report.hpp"
#include "kernels/krylov/bicgstab_kernel.hpp"
#include "kernels/operator/springs_kernel.hpp"
#include "kernels/precondition/cover_grid_kernel.hpp"
#include "kernels/precondition/direct_kernel.hpp"
#include "kernels/precondition/multigrid_kernel.hpp"

namespace rockfold::solve {

/// αK + βM and the terms, with its preconditioner.
struct ConstrainedSystem {
  Operator op;
  PointTerms terms;       ///< those of the springs first
  PointTerms contacts;    ///< written by their owner before set_combination
  bool symmetric = true;  ///< whether their tangents are: conjugate gradients or BiCGStab
  bool has_contacts =
      false;  ///< there may be contacts; who changes their points resets factors.analysed
  BicgstabWork bicgstab;  ///< then
  Springs springs;        ///< of the merged points
  PointShares shares;     ///< of the points given in them
  Elimination eliminated;
  KrylovWork work;
  Array<Real> masses;  ///< of covers, once largest_motion has been asked for
  Combination combination;
  Real spring_factor = 1;
  Blocks inverse;             ///< see inverse_of; empty while nothing needs them
  CoverBlocks cover_blocks;   ///< of covers with more functions than one: see cover_blocks_of
  Real largest_diagonal = 0;  ///< before their inversion
  Preconditioner preconditioner = Preconditioner::automatic;
  Multigrid grid;        ///< of one function; without levels where it is not wanted
  CoverGrid cover_grid;  ///< of several, likewise
  Factors factors;
  bool steady = false;  ///< the matrix stays the same from solve to solve
  bool begins_with_factors =
      false;  ///< an earlier solve of this matrix, or of one like it, fell back on them
  bool blocks_current = false;      ///< the blocks of covers are those of the present combination
  bool grid_current = false;        ///< its values are those of the present combination
  Real stiffness_over_inertia = 0;  ///< Σ diag αK / Σ diag βM over functions 0
  Real mass_trace = 0;              ///< Σ diag M over functions 0
  Field start, best;  ///< work space: where a solve started, and the best that factors made of it
  Field load;         ///< work space: right-hand side with the springs' part
  Field prescribed_part;  ///< work space: of x, what is prescribed
  Field best_multiplier;  ///< work space: of the least gap in a search
};
/// `others`: points of further terms, whose owners write their tangents before set_combination.
ConstrainedSystem make_constrained_system(const CoverArrays& covers, Operator op,
                                          const FixedPoints& fixed,
                                          Preconditioner preconditioner = Preconditioner::automatic,
                                          const MakeDirectSolver& direct = {},
                                          const MaterialPoints& others = {});

/// y = (αK + βM) x, without the terms, and with all of them.
void apply_rock(const ConstrainedSystem& system, const Field& x, const Field& y);
void apply_matrix(const ConstrainedSystem& system, const Field& x, const Field& y);

/// Chooses α, β, γ; with `choose_stiffness`, also how springs are solved with (choose_spring_stiffness; they yield where β is 0).
void set_combination(ConstrainedSystem& system, const Combination& c, Real spring_factor,
                     bool choose_stiffness);

/// The inverted diagonal blocks of the matrix as it is, [U]: found where they are not there.
const Blocks& inverse_of(ConstrainedSystem& system);

/// Likewise those of covers with several functions.
const CoverBlocks& cover_blocks_of(ConstrainedSystem& system);

/// How far rock moves at most under x + base (may be empty), m: see rock_motion_kernel.hpp. Uses the work space of conjugate gradients.
Real largest_motion(ConstrainedSystem& system, const Field& x, const Field& base);

/// As deep as pays: each outer iteration costs some ten applications, a pair costs two vectors of the fixed points.
inline constexpr std::size_t most_pairs = 40;

struct ConstraintOptions {
  PcgOptions pcg;
  Anderson* acceleration =
      nullptr;  ///< what earlier solves with the same matrix have learned of its multipliers; null: nothing
  Real gap_tolerance =
      1e-10;  ///< largest gap / max(largest displacement, largest prescribed value)
  Index max_outer = 50;
  int max_stalled =
      5;  ///< outer iterations in which the gap must have halved, or it is left as it is
  bool finish_unaccelerated =
      false;  ///< then go on without acceleration, each solve to the tolerance, before it is left
  /// N: what rounding leaves of the forces of A x, springs aside. Where it is given, residuals count against the forces at the solution
  /// found; else also against what the springs would pull with if nothing gave way, which may be many times that.
  std::function<Real(const Field& x)> rounding;
  /// With `rounding`: whether already the first solve stops there. Where only the stiffness resists, to go on moves x along what that does
  /// not resist.
  bool stop_at_rounding = false;
};

/// x: start and result. `base`: what x is an increment to, for the size of displacements (empty: none). The multipliers
/// start from what they are and stay for the next solve.
SolveReport solve_constrained(ConstrainedSystem& system, const Field& b, const Field& prescribed,
                              const Field& x, const Field& base, const ConstraintOptions& options);

/// y: of all fields that move the rock as x does the one without null-space motion (null_space_motion.cpp), which conjugate gradients find for
/// A y = A x from nothing. It has converged with a residual of pcg.tolerance, with factors of `enough`: what blocks leave is idle
/// motion too.
SolveReport find_same_motion(ConstrainedSystem& system, const Field& x, const Field& y,
                             const PcgOptions& pcg, Real enough);

}  // namespace rockfold::solve
