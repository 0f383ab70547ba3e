#include "src/run/farthest_off_place.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace rockfold {
namespace {

Real value_at(const FixedPoints& fixed, std::size_t n, int d, Real t) {
  const Index table = fixed.table.empty() ? none : fixed.table[n];
  return table == none ? fixed.value[n][d] : fixed.tables[table].at(t)[d];
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

}  // namespace rockfold
