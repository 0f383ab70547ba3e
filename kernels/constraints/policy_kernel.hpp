// Which preconditioner a system is solved with. One table decides, by what the matrix is and how large, and one fallback: where its
// limit of iterations is passed the solve begins again with a direct factorisation, if that is within reach. Nothing is remembered.
#pragma once

#include "kernels/constraints/held_kernel.hpp"

namespace rockfold::solve {

/// What a solve uses, and after how many iterations the fallback takes over.
struct Policy {
  Preconditioner first;
  Index limit;
};
Policy policy_of(HeldSystem& system);

/// Whether the table may want multigrid of this many covers, each with so many functions.
bool may_want_multigrid(Preconditioner asked, Index covers, int functions);

/// Whether there is a multigrid to use.
bool has_levels(const HeldSystem& system);

/// The inverse of `kind`, made for the matrix as it is where it is not current. `a` applies the matrix.
ApplyInverse make_inverse(HeldSystem& system, Preconditioner kind, const Apply& a);

/// Where forces cancel there may be less left than a share of it could be told from rounding.
bool small_enough(const PcgReport& done, const PcgOptions& pcg);

/// A x = load from the x given, `a` applying A. `report` learns what it ends with and whether it fell back; where an earlier solve of the
/// same step did, it begins with the factors.
PcgReport solve_by_policy(HeldSystem& system, const Apply& a, const Field& load, const Field& x,
                          const PcgOptions& pcg, SolveReport& report);

/// The same from x = 0, with the first choice of pivots alone: for what need not be found.
PcgReport solve_if_easy(HeldSystem& system, const Apply& a, const Field& load, const Field& x,
                        const PcgOptions& pcg, Preconditioner& used);

}  // namespace rockfold::solve
