// BiCGStab on the device, for systems that are not symmetric (van der Vorst 1992; Saad, Iterative Methods, algorithm 7.7, preconditioned
// from the right).
#pragma once

#include "kernels/krylov/pcg_kernel.hpp"

namespace rockfold::solve {

/// The vectors beside those of KrylovWork; allocated once.
struct BicgstabWork {
  Field shadow;  ///< r̂
  Field v;       ///< A B p
  Field step;    ///< B p
};
BicgstabWork make_bicgstab_work(Index unknowns);

/// Solves A x = b from the x given. `b_inverse`: of any kind; its energy is not looked at. An iteration applies A and B twice. Begins
/// again with the residual as its shadow where they have become orthogonal.
PcgReport solve_bicgstab(const KrylovWork& work, const BicgstabWork& more, const Apply& a,
                         const ApplyInverse& b_inverse, const Field& b, const Field& x,
                         const PcgOptions& options);

}  // namespace rockfold::solve
