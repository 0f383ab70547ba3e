// The values of each run's parameters.
#pragma once

#include "src/sweep/sweep_spec.hpp"

namespace rockfold::sweep {

/// [runs][parameters] TOML texts. They follow from the specification and its seed alone. All combinations: the last parameter
/// changes first. Latin hypercube: each parameter has one value in each of `runs` slices of equal probability (McKay, Beckman
/// & Conover 1979). Throws Error(model) where there are more than ten million combinations.
std::vector<std::vector<std::string>> sample(const SweepSpec& spec);

/// The value that the variable is below with probability u, 0 < u < 1, of those in [min, max].
Real quantile(const Variable& variable, Real u);

}  // namespace rockfold::sweep
