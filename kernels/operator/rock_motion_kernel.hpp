// How far the rock moves. Unknowns do not say it: covers of which a sliver alone is rock, and functions that depend on each other, may take any
// value without moving rock by much. What supports leave open is measured against this.
#pragma once

#include "kernels/operator/operator_kernel.hpp"

namespace rockfold::solve {

/// kg, ∫ρ N over the rock of each cover. [P]
Array<Real> cover_masses(const Operator& op);

/// The largest component of the mean of Σ φ (x + base) over the rock of a cover, which its N weighs (∫ρ N u / ∫ρ N). Covers of less
/// than a thousandth of the largest mass do not count. `base` may be empty; `sum` and `momentum`: work space, [U].
Real largest_mean(const Operator& op, const Array<Real>& masses, const Field& x, const Field& base,
                  const Field& sum, const Field& momentum);

}  // namespace rockfold::solve
