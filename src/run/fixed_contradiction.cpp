#include "src/run/fixed_contradiction.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace rockfold {
namespace {

using Weights = std::vector<std::pair<Index, long long>>;

Weights rounded_weights(const MaterialPoints& points, std::size_t n) {
  Weights weights;
  for (Index i = points.begin[n]; i < points.begin[n + 1]; ++i)
    weights.emplace_back(points.unknown[i], std::llround(points.weight[i] * 1e9));
  std::sort(weights.begin(), weights.end());
  return weights;
}

Real value_at(const FixedPoints& fixed, std::size_t n, int d, Real t) {
  const Index table = fixed.table.empty() ? none : fixed.table[n];
  return table == none ? fixed.value[n][d] : fixed.tables[table].at(t)[d];
}

std::vector<Real> times_of(const FixedPoints& fixed, std::size_t n) {
  const Index table = fixed.table.empty() ? none : fixed.table[n];
  return table == none ? std::vector<Real>{0} : fixed.tables[table].time;
}

bool differ(const FixedPoints& fixed, std::size_t a, std::size_t b, int d) {
  std::vector<Real> times = times_of(fixed, a);
  for (const Real t : times_of(fixed, b)) times.push_back(t);
  return std::any_of(times.begin(), times.end(), [&](Real t) {
    const Real of_a = value_at(fixed, a, d, t), of_b = value_at(fixed, b, d, t);
    return std::abs(of_a - of_b) > 1e-9 * std::max(std::abs(of_a), std::abs(of_b));
  });
}

/// A condition other than that of row n that holds one of its unknowns; else none.
Index other_holder(const FixedPoints& fixed, std::size_t n) {
  const MaterialPoints& points = fixed.points;
  const std::set<Index> own(points.unknown.begin() + points.begin[n],
                            points.unknown.begin() + points.begin[n + 1]);
  for (std::size_t m = 0; m < points.size(); ++m)
    if (fixed.condition[m] != fixed.condition[n])
      for (Index i = points.begin[m]; i < points.begin[m + 1]; ++i)
        if (own.count(points.unknown[i]) > 0) return fixed.condition[m];
  return none;
}

}  // namespace

OffPlace find_farthest_off_place(const FixedPoints& fixed, const std::vector<Fixed>& conditions,
                                 const std::vector<Vec3>& displacement, Real t) {
  OffPlace farthest;
  if (fixed.condition.empty()) return farthest;
  std::size_t row = 0;
  const MaterialPoints& points = fixed.points;
  for (std::size_t n = 0; n < points.size(); ++n) {
    if (conditions[fixed.condition[n]].stiffness) continue;
    for (int d = 0; d < 3; ++d) {
      if (!fixed.component[n][d]) continue;
      const Real place = value_at(fixed, n, d, t);
      farthest.prescribed = std::max(farthest.prescribed, std::abs(place));
      Real off = -place;
      for (Index i = points.begin[n]; i < points.begin[n + 1]; ++i)
        off += points.weight[i] * displacement[points.unknown[i]][d];
      off = std::abs(off) * (fixed.motion_ratio.empty() ? 1 : fixed.motion_ratio[n]);
      if (off > farthest.distance) farthest.distance = off, row = n;
    }
  }
  if (farthest.distance > 0) {
    farthest.condition = fixed.condition[row];
    farthest.other = other_holder(fixed, row);
  }
  return farthest;
}

std::optional<std::array<Index, 2>> find_contradiction(const FixedPoints& fixed) {
  if (fixed.condition.empty()) return {};
  std::map<Weights, std::array<std::size_t, 3>>
      first;  // point that holds each component, or all points
  const std::size_t count = fixed.points.size();
  for (std::size_t n = 0; n < count; ++n) {
    auto& known =
        first.try_emplace(rounded_weights(fixed.points, n), std::array{count, count, count})
            .first->second;
    for (int d = 0; d < 3; ++d) {
      if (!fixed.component[n][d]) continue;
      if (known[d] == count)
        known[d] = n;
      else if (fixed.condition[known[d]] != fixed.condition[n] && differ(fixed, known[d], n, d))
        return std::array{fixed.condition[known[d]], fixed.condition[n]};
    }
  }
  return {};
}

}  // namespace rockfold
