// The factors L Lᵀ of a matrix of covers by the multifrontal method (Duff & Reid 1983): dense fronts in the order of a tree, each by
// Cholesky's method with pivots among its own unknowns, so that functions that depend on each other come out as pivots of nothing.
#pragma once

#include <memory>

#include "src/arrays/direct_solver.hpp"

namespace rockfold::host {

/// What factors may take: about a minute of one core.
struct DirectLimits {
  double bytes = 3e9;
  double operations = 3e11;  ///< multiplications with additions
};

std::unique_ptr<DirectSolver> make_direct_solver(const DirectLimits& limits = {});

}  // namespace rockfold::host
