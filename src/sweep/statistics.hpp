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

struct Chance {
  Index count = 0, met = 0;
  Real probability = 0, low = 0, high = 0;  ///< with 95 % bounds (Wilson 1927)
};
Chance chance_of(Index met, Index count);

/// Spearman's: Pearson's correlation of ranks, ties sharing theirs; pairs with a NaN are left out. NaN where one does not vary.
Real rank_correlation(const std::vector<Real>& x, const std::vector<Real>& y);

}  // namespace rockfold::sweep
