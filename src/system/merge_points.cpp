#include "src/system/merge_points.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

namespace rockfold::solve {
namespace {

using RoundedWeights = std::vector<std::pair<Index, long long>>;
using Key = std::tuple<RoundedWeights, std::array<std::uint8_t, 3>, Vec3, Enforce, Index>;

Key key_of(const FixedPoints& given, std::size_t n) {
  RoundedWeights weights;
  for (Index i = given.points.begin[n]; i < given.points.begin[n + 1]; ++i) {
    const long long rounded = std::llround(given.points.weight[i] * 1e9);
    if (rounded != 0) weights.emplace_back(given.points.unknown[i], rounded);
  }
  std::sort(weights.begin(), weights.end());
  return {weights, given.component[n], given.value[n], given.enforce[n],
          given.table.empty() ? none : given.table[n]};
}

void append(FixedPoints& to, const FixedPoints& from, std::size_t n) {
  to.points.element.push_back(from.points.element[n]);
  to.points.local.push_back(from.points.local[n]);
  for (Index i = from.points.begin[n]; i < from.points.begin[n + 1]; ++i) {
    to.points.unknown.push_back(from.points.unknown[i]);
    to.points.weight.push_back(from.points.weight[i]);
  }
  to.points.begin.push_back(static_cast<Index>(to.points.unknown.size()));
  to.component.push_back(from.component[n]);
  to.value.push_back(from.value[n]);
  to.stiffness.push_back(0);
  to.enforce.push_back(from.enforce[n]);
  to.motion_ratio.push_back(0);
}

}  // namespace

std::vector<Vec3> PointShares::share_out(const std::vector<Vec3>& of_merged) const {
  std::vector<Vec3> shares(merged.size());
  for (std::size_t n = 0; n < shares.size(); ++n)
    for (int d = 0; d < 3; ++d) shares[n][d] = share[n] * of_merged[merged[n]][d];
  return shares;
}

MergedPoints merge_points(const FixedPoints& given) {
  MergedPoints result;
  std::map<Key, Index> known;
  for (std::size_t n = 0; n < given.points.size(); ++n) {
    const auto [at, is_new] =
        known.emplace(key_of(given, n), static_cast<Index>(result.fixed.points.size()));
    if (is_new) append(result.fixed, given, n);
    result.shares.merged.push_back(at->second);
    result.fixed.stiffness[at->second] += given.stiffness[n];
    Real& reach = result.fixed.motion_ratio[at->second];
    reach = std::max(reach, given.motion_ratio.empty() ? 1 : given.motion_ratio[n]);
  }
  for (std::size_t n = 0; n < given.points.size(); ++n) {
    const Real sum = result.fixed.stiffness[result.shares.merged[n]];
    result.shares.share.push_back(sum > 0 ? given.stiffness[n] / sum : 0);
  }
  return result;
}

}  // namespace rockfold::solve
