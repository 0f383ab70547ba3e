// Statistics that the tests of random joints share. Seeds are fixed: a test that passes once passes for ever; the bounds
// say how unlikely chance alone would break them.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "src/base/types.hpp"

namespace rockfold::test {

inline Real mean_of(const std::vector<Real>& x) {
  Real sum = 0;
  for (const Real value : x) sum += value;
  return sum / static_cast<Real>(x.size());
}

inline Real variance_of(const std::vector<Real>& x) {
  const Real mean = mean_of(x);
  Real sum = 0;
  for (const Real value : x) sum += (value - mean) * (value - mean);
  return sum / static_cast<Real>(x.size() - 1);
}

/// Within five standard errors: by chance once in 1.7 million.
inline void expect_mean(const std::vector<Real>& x, Real mean, Real variance) {
  EXPECT_NEAR(mean_of(x), mean, 5 * std::sqrt(variance / static_cast<Real>(x.size())));
}

/// The variance of a sample of n has the standard error variance·√((kurtosis − 1)/n), n large.
inline void expect_variance(const std::vector<Real>& x, Real variance, Real kurtosis) {
  EXPECT_NEAR(variance_of(x), variance,
              5 * variance * std::sqrt((kurtosis - 1) / static_cast<Real>(x.size())));
}

/// Kolmogorov and Smirnov: the greatest distance D of the sample's distribution function from the given one has
/// P(D·√n > 2.3) → 2·exp(−2·2.3²) = 5e-5.
template <class Function>
void expect_distribution(std::vector<Real> x, Function distribution_function) {
  std::sort(x.begin(), x.end());
  const auto n = static_cast<Real>(x.size());
  Real distance = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const Real f = distribution_function(x[i]);
    distance = std::max({distance, f - static_cast<Real>(i) / n, static_cast<Real>(i + 1) / n - f});
  }
  EXPECT_LT(distance * std::sqrt(n), 2.3);
}

}  // namespace rockfold::test
