#include "src/sweep/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "src/base/sum.hpp"

namespace rockfold::sweep {

namespace {

Real mean_of(const std::vector<Real>& values) {
  Sum sum;
  for (const Real v : values) sum += v;
  return sum.value() / static_cast<Real>(values.size());
}

std::vector<Real> ranks(const std::vector<Real>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return values[a] < values[b]; });
  std::vector<Real> rank(values.size());
  for (std::size_t i = 0; i < order.size();) {
    std::size_t j = i;
    while (j < order.size() && values[order[j]] == values[order[i]]) ++j;
    for (std::size_t k = i; k < j; ++k) rank[order[k]] = 0.5 * static_cast<Real>(i + j - 1);
    i = j;
  }
  return rank;
}

/// 1 + d₁/(1 + d₂/(1 + …)) of I_x(a, b): DLMF 8.17.22, by Lentz's method (Thompson & Barnett, J. Comput. Phys. 64, 1986). Converges in
/// some √max(a, b) terms for x < (a + 1)/(a + b + 2).
Real beta_fraction(Real a, Real b, Real x) {
  constexpr Real tiny = 1e-300, rounding = 1e-15;
  constexpr int most_terms = 100'000;
  const auto kept_off_zero = [](Real v) { return std::abs(v) < tiny ? tiny : v; };
  Real value = 1, above = 1, below = 0;
  for (int n = 1; n <= most_terms; ++n) {
    const int pair = n / 2;  // terms come in pairs
    const Real m = pair;
    const Real d = n % 2 == 0 ? m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m))
                              : -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
    below = 1 / kept_off_zero(1 + d * below);
    above = kept_off_zero(1 + d / above);
    value *= above * below;
    if (std::abs(above * below - 1) < rounding) break;
  }
  return value;
}

constexpr Real beyond = 0.025;  // on each side of 95 % bounds

Bounds wilson_bounds(Real met, Real n) {
  constexpr Real z = 1.959963984540054;  // of the normal distribution, 2.5 % above
  const Real p = met / n, half = z * std::sqrt(p * (1 - p) / n + z * z / (4 * n * n)),
             scale = 1 + z * z / n, middle = p + z * z / (2 * n);
  return {met == 0 ? 0 : (middle - half) / scale, met == n ? 1 : (middle + half) / scale};
}

/// Of the binomial distribution: P(as many or more | low) = P(as many or fewer | high) = 2.5 %.
Bounds exact_bounds(Real met, Real n) {
  return {met == 0 ? 0 : beta_quantile(met, n - met + 1, beyond),
          met == n ? 1 : beta_quantile(met + 1, n - met, 1 - beyond)};
}

}  // namespace

Spread spread_of(std::vector<Real> values) {
  std::erase_if(values, [](Real v) { return std::isnan(v); });
  Spread s;
  s.count = static_cast<Index>(values.size());
  if (values.empty()) return s;
  std::sort(values.begin(), values.end());
  s.mean = mean_of(values);
  Sum squares;
  for (const Real v : values) squares += (v - s.mean) * (v - s.mean);
  if (s.count > 1) s.deviation = std::sqrt(squares.value() / (s.count - 1));
  s.min = values.front();
  s.max = values.back();
  const auto at = [&](Real share) {
    const Real place = share * static_cast<Real>(values.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const auto above = std::min(below + 1, values.size() - 1);
    return values[below] + (place - static_cast<Real>(below)) * (values[above] - values[below]);
  };
  s.p5 = at(0.05);
  s.p25 = at(0.25);
  s.p50 = at(0.5);
  s.p75 = at(0.75);
  s.p95 = at(0.95);
  return s;
}

Real incomplete_beta(Real a, Real b, Real x) {
  if (x <= 0 || x >= 1) return x <= 0 ? 0 : 1;
  if (x > (a + 1) / (a + b + 2)) return 1 - incomplete_beta(b, a, 1 - x);
  const Real front = std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) +
                              a * std::log(x) + b * std::log1p(-x));
  return front / (a * beta_fraction(a, b, x));
}

Chance chance_of(Index met, Index count) {
  Chance c{count, met, 0, {}, {}};
  if (count == 0) return c;
  c.probability = static_cast<Real>(met) / count;
  c.wilson = wilson_bounds(met, count);
  c.exact = exact_bounds(met, count);
  return c;
}

/// By halving: 60 halvings of [0, 1] are below rounding.
Real beta_quantile(Real a, Real b, Real share) {
  Real low = 0, high = 1;
  for (int i = 0; i < 60; ++i) {
    const Real middle = (low + high) / 2;
    (incomplete_beta(a, b, middle) < share ? low : high) = middle;
  }
  return (low + high) / 2;
}

Real rank_correlation(const std::vector<Real>& x, const std::vector<Real>& y) {
  std::vector<Real> a, b;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (std::isnan(x[i]) || std::isnan(y[i])) continue;
    a.push_back(x[i]);
    b.push_back(y[i]);
  }
  if (a.empty()) return std::numeric_limits<Real>::quiet_NaN();
  a = ranks(a);
  b = ranks(b);
  const Real of_a = mean_of(a), of_b = mean_of(b);
  Sum ab, aa, bb;
  for (std::size_t i = 0; i < a.size(); ++i) {
    ab += (a[i] - of_a) * (b[i] - of_b);
    aa += (a[i] - of_a) * (a[i] - of_a);
    bb += (b[i] - of_b) * (b[i] - of_b);
  }
  return ab.value() / std::sqrt(aa.value() * bb.value());
}

}  // namespace rockfold::sweep
