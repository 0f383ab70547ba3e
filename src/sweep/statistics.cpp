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

Chance chance_of(Index met, Index count) {
  Chance c{count, met, 0, 0, 1};
  if (count == 0) return c;
  constexpr Real z = 1.959963984540054;  // of the normal distribution, 2.5 % above
  const Real n = count, p = met / n, half = z * std::sqrt(p * (1 - p) / n + z * z / (4 * n * n)),
             scale = 1 + z * z / n, middle = p + z * z / (2 * n);
  c.probability = p;
  c.low = met == 0 ? 0 : (middle - half) / scale;
  c.high = met == count ? 1 : (middle + half) / scale;
  return c;
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
