#pragma once

#include <algorithm>
#include <cstdint>

#include "src/arrays/element_arrays.hpp"

namespace rockfold {

/// How a solve went. Whoever solves looks at `converged`: nothing is accepted silently.
struct SolveReport {
  Index iterations = 0;       ///< of conjugate gradients
  Index newton = 0;           ///< iterations of Newton's method
  std::int64_t substeps = 0;  ///< of an explicit step
  std::int64_t visits = 0;    ///< of contact points in them
  Real shortest = 0;          ///< s, of the substeps; 0: none
  Real added_mass = 0;        ///< of all mass, at most, to blocks with the shortest substeps
  Real residual =
      0;  ///< true ‖b − A x‖ / ‖b‖ of the last solve; NaN where numbers left their range
  Real gap = 0;  ///< largest distance of a held point from its place / largest displacement
  Index inverted =
      none;  ///< an element that the solution turns inside out: then it is not accepted
  Preconditioner preconditioner = Preconditioner::block_jacobi;  ///< the one used last
  Index fallbacks = 0;  ///< times that its iteration limit was passed and factors took over
  bool converged =
      true;  ///< the residual is within the tolerance; the gap may be as large as it says. A signal ends a solve as it stands

  /// What the next solve of the same step came to, with all that was counted before.
  void add(SolveReport next) {
    if (next.iterations == 0) next.preconditioner = preconditioner;
    next.iterations += iterations;
    next.newton += newton;
    next.substeps += substeps;
    next.visits += visits;
    next.fallbacks += fallbacks;
    next.shortest = next.shortest > 0 && shortest > 0 ? std::min(next.shortest, shortest)
                                                      : std::max(next.shortest, shortest);
    next.added_mass = std::max(next.added_mass, added_mass);
    *this = next;
  }
};

}  // namespace rockfold
