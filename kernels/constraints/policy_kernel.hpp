// Which preconditioner a system is solved with: the one that costs least, by the iterations that it is expected to take and the operations of
// each, and by those of the factors. There is one fallback: where a limit of iterations is passed the solve begins again with a direct
// factorisation, if that is within reach, and the solves after it begin with that (`begins_with_factors`, a part of the state).
#pragma once

#include "kernels/constraints/constrained_system_kernel.hpp"

namespace rockfold::solve {

/// What a solve uses, and after how many iterations the fallback takes over.
struct Policy {
  Preconditioner first;
  Index limit;
};
Policy policy_of(ConstrainedSystem& system);

/// Whether a solve may want multigrid of this many covers, each with so many functions.
bool may_want_multigrid(Preconditioner asked, Index covers, int functions);

/// Whether there is a multigrid to use.
bool has_levels(const ConstrainedSystem& system);

/// The inverse of `kind`, made for the matrix as it is where it is not current.
ApplyInverse make_inverse(ConstrainedSystem& system, Preconditioner kind);

/// Where forces cancel there may be less left than a share of it could be told from rounding.
bool small_enough(const PcgReport& done, const PcgOptions& pcg);

/// (A + NᵀKN) x = load from the x given. `report` learns what it ends with and whether it fell back; where an earlier solve of the
/// same step did, it begins with the factors.
PcgReport solve_by_policy(ConstrainedSystem& system, const Field& load, const Field& x,
                          const PcgOptions& pcg, SolveReport& report);

}  // namespace rockfold::solve
