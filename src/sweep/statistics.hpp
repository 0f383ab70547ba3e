// What many runs say together.
#pragma once

#include <vector>

#include "src/base/types.hpp"

namespace rockfold::sweep {

struct Spread {
  Index count = 0;
  Real mean = 0, deviation = 0;  ///< of a sample: divided by count − 1
  Real min = 0, max = 0;
  Real p5 = 0, p25 = 0, p50 = 0, p75 = 0, p95 = 0;  ///< percentiles, linear between ranks
};
/// Of the values that are numbers; not NaN.
Spread spread_of(std::vector<Real> values);

struct Bounds {
  Real low = 0, high = 1;
};
/// How likely it is what `met` of `count` independent runs did, with bounds that hold in 95 of 100 such samples: on average
/// (Wilson, J. Am. Stat. Assoc. 22, 1927), and at the least (Clopper & Pearson, Biometrika 26, 1934: wider). Of no run nothing is known.
struct Chance {
  Index count = 0, met = 0;
  Real probability = 0;
  Bounds wilson, exact;
};
Chance chance_of(Index met, Index count);

/// I_x(a, b), the regularised incomplete beta function; a, b > 0, 0 ≤ x ≤ 1. Good to some 1e-12.
Real incomplete_beta(Real a, Real b, Real x);

/// The x with I_x(a, b) = share.
Real beta_quantile(Real a, Real b, Real share);

/// Spearman's: Pearson's correlation of ranks, ties sharing theirs; pairs with a NaN are left out. NaN where one does not vary.
Real rank_correlation(const std::vector<Real>& x, const std::vector<Real>& y);

}  // namespace rockfold::sweep
