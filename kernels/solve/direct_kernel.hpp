// Factors of the whole matrix, αK + βM + γ NᵀkN, as the preconditioner of conjugate gradients: the third way, for matrices on which blocks
// and multigrid break down or take long. The operator alone says what residuals are, so that factors may be of an earlier matrix.
#pragma once

#include "kernels/solve/pcg_work_kernel.hpp"
#include "kernels/solve/springs_kernel.hpp"
#include "src/arrays/direct_solver.hpp"

namespace rockfold::solve {

struct Factors {
  MakeDirectSolver make;                 ///< empty: there is no third way
  std::unique_ptr<DirectSolver> solver;  ///< null until first needed
  BlockMatrix pattern;                   ///< without values
  int functions = 1;                     ///< of a cover
  Combination combination;               ///< of the matrix that was factorised …
  Real spring_factor = 0;
  Field diagonal;
  bool any = false;        ///< … if one was
  bool current = false;    ///< it is the present one
  bool too_large = false;  ///< there will be none of this system
  bool failed = false;     ///< no help with the present matrix
  bool helped = false;     ///< with an earlier solve: later ones begin with them
  int pivot = 0;           ///< which of the least pivots was tried last
  Field start;             ///< work space: where a solve started

  bool possible() const { return make && !too_large && !failed; }
};

/// Looks at the pattern of the matrix, once. False where it is too large.
bool analyse(Factors& factors, const Operator& op, const Springs& springs);

/// Factorises the matrix of the operator and the springs. Dashpots, which a system may have beside it, are left out: conjugate gradients
/// make up for them. Pivots up to
/// `no_pivot` count as none, see DirectSolver. False where it is too large, or a signal came.
bool factorise(Factors& factors, const Operator& op, const Combination& c, const Springs& springs,
               Real spring_factor, Real no_pivot);

/// What rounding may leave of A x, N.
Real rounding_of_product(const Factors& factors, const PcgWork& work, const Field& x);

/// z = B r.
void precondition(const Factors& factors, const Field& r, const Field& z);

}  // namespace rockfold::solve
