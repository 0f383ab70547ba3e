// A system with essential boundary conditions: (αK + βM + γ NᵀkN + other terms) x = b + γ Nᵀ k prescribed for springs, among the x that keep
// N x = prescribed of points that are held (constraints_kernel.hpp).
#pragma once

#include "kernels/constraints/constraints_kernel.hpp"
#include "kernels/constraints/solve_report.hpp"
#include "kernels/krylov/bicgstab_kernel.hpp"
#include "kernels/operator/springs_kernel.hpp"
#include "kernels/precondition/cover_grid_kernel.hpp"
#include "kernels/precondition/direct_kernel.hpp"
#include "kernels/precondition/multigrid_kernel.hpp"
#include "src/system/merge_points.hpp"

namespace rockfold::solve {

/// αK + βM and the terms, with its preconditioner.
struct ConstrainedSystem {
  Operator op;
  PointTerms terms;        ///< those of the springs first
  PointTerms contacts;     ///< written by their owner before set_combination
  bool symmetric = true;   ///< whether their tangents are: conjugate gradients or BiCGStab
  bool of_blocks = false;  ///< each cover is a block of rock by itself
  bool has_contacts =
      false;  ///< there may be contacts; who changes their points says so: contacts_changed
  BicgstabWork bicgstab;    ///< then
  Springs springs;          ///< of the merged points
  Constraints constraints;  ///< of the same
  PointShares shares;       ///< of the points given in them
  KrylovWork work;
  Array<Real> masses;  ///< of covers, once largest_motion has been asked for
  Combination combination;
  Real spring_factor = 1;
  Blocks inverse;  ///< see inverse_of; empty while nothing needs them
  bool inverse_knows_springs = false;
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
  // Work space where points are held:
  Field load;        ///< what is left to balance
  Field increment;   ///< of x, for that
  Field before;      ///< x before it
  Field left_to_go;  ///< of the points
};
/// `others`: points of further terms, whose owners write their tangents before set_combination.
ConstrainedSystem make_constrained_system(const CoverArrays& covers, Operator op,
                                          const FixedPoints& fixed,
                                          Preconditioner preconditioner = Preconditioner::automatic,
                                          const MakeDirectSolver& direct = {},
                                          const MaterialPoints& others = {});

/// y = (αK + βM) x, and with springs and all terms.
void apply_rock(const ConstrainedSystem& system, const Field& x, const Field& y);
void apply_matrix(const ConstrainedSystem& system, const Field& x, const Field& y);
/// With points held and stiff springs as soft as levels and factors know them: regular without conditions.
void apply_known(const ConstrainedSystem& system, const Field& x, const Field& y);

/// Contacts have other points now.
void contacts_changed(ConstrainedSystem& system);

/// Chooses the shares of stiffness, mass and springs.
void set_combination(ConstrainedSystem& system, const Combination& c, Real spring_factor);

/// The inverted diagonal blocks of the matrix as it is, [U], with springs as they are known or without: found where they are not there.
const Blocks& inverse_of(ConstrainedSystem& system, bool with_springs);

/// Those of covers with several functions, with springs as they are known: without, blocks that are one cover would be free to move.
const CoverBlocks& cover_blocks_of(ConstrainedSystem& system);

/// How far rock moves at most under x + base (may be empty), m: see rock_motion_kernel.hpp. Uses the work space of conjugate gradients.
Real largest_motion(ConstrainedSystem& system, const Field& x, const Field& base);

/// Of the motion: gaps of points held that are less are closed.
constexpr Real closed_gap = 1e-10;

struct ConstraintOptions {
  PcgOptions pcg;
  /// N: what rounding leaves of the forces of A x, springs aside. Where it is given, residuals count against the forces at the solution
  /// found; else also against what the springs would pull with if nothing gave way, which may be many times that.
  std::function<Real(const Field& x)> rounding;
  /// With `rounding`: whether already the first solve stops there. Where only the stiffness resists, to go on moves x along what that does
  /// not resist.
  bool stop_at_rounding = false;
  bool go_on = false;  ///< from the multipliers there are
};

/// x: start and result. `base`: what x is an increment to, for the size of displacements (empty: none). springs.multiplier becomes what points
/// that are held take.
SolveReport solve_constrained(ConstrainedSystem& system, const Field& b, const Field& prescribed,
                              const Field& x, const Field& base, const ConstraintOptions& options);

}  // namespace rockfold::solve
