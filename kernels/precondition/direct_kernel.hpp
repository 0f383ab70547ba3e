// Factors of the whole matrix, αK + βM + γ NᵀkN, as the preconditioner of conjugate gradients. The operator alone says what residuals are.
#pragma once

#include "kernels/krylov/krylov_work_kernel.hpp"
#include "kernels/operator/springs_kernel.hpp"
#include "src/arrays/direct_solver.hpp"

namespace rockfold::solve {

struct Factors {
  MakeDirectSolver make;                 ///< empty: there are no factors
  std::unique_ptr<DirectSolver> solver;  ///< null until first needed
  BlockMatrix pattern;                   ///< without values
  int functions = 1;                     ///< of a cover
  Field diagonal;                        ///< of the matrix that was factorised
  bool current = false;                  ///< it is the present one …
  Real pivot = 0;                        ///< … of which pivots up to this count as none
  bool too_large = false;                ///< there will be none of this system
};

/// Looks at the pattern of the matrix, once. False where it is too large.
bool analyse(Factors& factors, const Operator& op, const Springs& springs);

/// Factorises the matrix of the operator and the springs. Dashpots, which a system may have beside it, are left out: conjugate gradients
/// make up for them. Pivots up to
/// `no_pivot` count as none, see DirectSolver. False where it is too large, or a signal came.
bool factorise(Factors& factors, const Operator& op, const Combination& c, const Springs& springs,
               Real spring_factor, Real no_pivot);

/// What rounding may leave of A x, N.
Real rounding_of_product(const Factors& factors, const KrylovWork& work, const Field& x);

/// z = B r.
void precondition(const Factors& factors, const Field& r, const Field& z);

}  // namespace rockfold::solve
