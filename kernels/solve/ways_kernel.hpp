// The ways to solve a system that springs hold: conjugate gradients with node blocks, with multigrid, with factors. Each of them fails
// somewhere: then the next goes on.
#pragma once

#include "kernels/solve/held_kernel.hpp"

namespace rockfold::solve {

/// With fewer covers multigrid does not pay even in a static analysis: of one function, of several.
inline constexpr Index least_for_multigrid = 2000, least_for_cover_grid = 100;

/// Whether static systems are large enough for multigrid, and have one.
bool has_grid(const HeldSystem& system);

/// A mass matrix of covers with one function needs no multigrid. With several, what is nearly dependent in them is as smooth
/// and as weak in the mass as in the stiffness.
bool worth_a_grid(const HeldSystem& system);

/// Whether the system is small enough to keep what a new start needs: larger ones will hardly have factors.
bool may_have_factors(const HeldSystem& system);

/// Where forces cancel there may be less left than a share of it could be told from rounding.
bool small_enough(const PcgReport& done, const PcgOptions& pcg);

/// A x = load from the x given, `a` applying A. `m`: what it was solved with in the end.
PcgReport solve_any_way(HeldSystem& system, const Apply& a, const Field& load, const Field& x,
                        const PcgOptions& pcg, Preconditioning& m);

/// Likewise from x = 0, the way that the last solve came to its end; where blocks do not, with factors that cost no more than they have taken, for
/// later solves too if these come to `enough`. It fails without a trace.
PcgReport solve_as_before(HeldSystem& system, const Apply& a, const Field& load, const Field& x,
                          const PcgOptions& pcg, Real enough, Preconditioning& m);

}  // namespace rockfold::solve
