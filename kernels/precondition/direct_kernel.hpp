// Factors of the whole matrix, αK + βM and the terms, as the preconditioner of conjugate gradients. The operator alone says what residuals are.
#pragma once

#include <array>
#include <memory>

#include "kernels/krylov/krylov_work_kernel.hpp"
#include "kernels/operator/point_terms_kernel.hpp"
#include "src/arrays/direct_solver.hpp"

namespace rockfold::solve {

struct Factors {
  MakeDirectSolver make;                 ///< empty: there are no factors
  std::unique_ptr<DirectSolver> solver;  ///< null until first needed
  BlockMatrix pattern;                   ///< without values
  int functions = 1;                     ///< of a cover
  Field diagonal;                        ///< of the matrix that was factorised
  bool of_this_step = false;             ///< it is one of this time step …
  bool current = false;                  ///< … or the present one …
  Real pivot = 0;                        ///< … of which pivots up to this count as none …
  bool analysed = false;                 ///< the pattern is that of the present terms …
  bool too_large = false;                ///< … and too large
};

/// Lists of terms that the matrix has.
using TermLists = std::array<const PointTerms*, 2>;

/// Looks at the pattern of the matrix, if that is not done (`analysed`). False where it is too large.
bool analyse(Factors& factors, const Operator& op, const TermLists& terms);

/// Factorises the matrix of the operator and the terms, as analysed. Pivots up to `no_pivot` count as none, see DirectSolver. False where it is too large,
/// or a signal came.
bool factorise(Factors& factors, const Operator& op, const Combination& c, const TermLists& terms,
               Real no_pivot);

/// What rounding may leave of A x, N.
Real rounding_of_product(const Factors& factors, const KrylovWork& work, const Field& x);

/// z = B r.
void precondition(const Factors& factors, const Field& r, const Field& z);

}  // namespace rockfold::solve
