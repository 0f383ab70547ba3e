// Whether A u = b(t) has a solution: the rows of A by Gaussian elimination, with the conditions that b(t) is made of beside each.
#include "src/run/fixed_contradiction.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "host/cut/bodies/union_find.hpp"

namespace rockfold {
namespace {

/// Of a row's largest weight: less is rounding. Rows that differ by less would strain rock by 10 times and more what they prescribe of its size.
constexpr Real least_weight = 1e-7;
/// Of what is prescribed: less is rounding.
constexpr Real least_difference = 1e-6;
/// Unknowns of a row, above which elimination fills up.
constexpr std::size_t most_unknowns = 64;

using Combination = std::map<Index, Real>;  ///< weights, by unknown or by condition

void subtract(Combination& from, Real factor, const Combination& what) {
  for (const auto& [key, weight] : what) from[key] -= factor * weight;
}

Real largest(const Combination& row) {
  Real most = 0;
  for (const auto& [key, weight] : row) most = std::max(most, std::abs(weight));
  return most;
}

void drop_rounding(Combination& row, Real scale) {
  for (auto it = row.begin(); it != row.end();)
    it = std::abs(it->second) <= least_weight * scale ? row.erase(it) : std::next(it);
}

/// Weights of unknowns, and of conditions whose displacements they prescribe.
struct Row {
  Combination weight, prescribed;
};

Real prescribed_at(const Fixed& condition, int d, Real t) {
  return (condition.table.empty() ? condition.value : condition.table.at(t))[d];
}

bool gives(const Fixed& condition) {
  return condition.method == FixMethod::penalty && condition.stiffness;
}

/// The rows of one direction.
class Axis {
 public:
  Axis(const FixedPoints& fixed, const std::vector<Fixed>& conditions, Real end, int axis)
      : fixed_(fixed), conditions_(conditions), axis_(axis), times_{0, end} {
    for (const Fixed& condition : conditions)
      for (const Real t : condition.table.time)
        if (t > 0 && t < end) times_.push_back(t);
    std::sort(times_.begin(), times_.end());
    times_.erase(std::unique(times_.begin(), times_.end()), times_.end());
  }

  std::optional<Contradiction> find() {
    std::optional<Contradiction> of_covers;
    for (const Index n : rows_in_question()) {
      const auto found = contradiction_of(n);
      if (found && found->same_rock) return found;
      if (!of_covers) of_covers = found;
    }
    return of_covers;
  }

 private:
  /// With a row that is like it, or else with those before it.
  std::optional<Contradiction> contradiction_of(Index n) {
    Row row = row_of(n);
    const auto [like, is_new] = first_like_.try_emplace(rounded(row.weight), row);
    bool same_rock = true;
    if (!is_new)
      subtract(row.prescribed, 1, like->second.prescribed);
    else if (!eliminate(row, same_rock))
      return {};
    auto found = difference(row.prescribed, n);
    if (found) found->same_rock = same_rock;
    return found;
  }

  /// Rows of rock that several conditions hold which differ at some time; those of few unknowns first.
  std::vector<Index> rows_in_question() const {
    const MaterialPoints& points = fixed_.points;
    std::vector<Index> rows;
    for (Index n = 0; n < static_cast<Index>(points.size()); ++n)
      if (fixed_.component[n][axis_] && !gives(conditions_[fixed_.condition[n]])) rows.push_back(n);
    const auto differs_from_first = [&](Index n) {
      return differ(fixed_.condition[rows[0]], fixed_.condition[n]);
    };
    if (std::none_of(rows.begin(), rows.end(), differs_from_first)) return {};
    const Index unknowns = 1 + *std::max_element(points.unknown.begin(), points.unknown.end());
    UnionFind joined(unknowns);
    const auto first_unknown = [&](Index n) { return points.unknown[points.begin[n]]; };
    for (const Index n : rows)
      for (Index i = points.begin[n]; i < points.begin[n + 1]; ++i)
        joined.join(points.unknown[i], first_unknown(n));
    std::map<Index, Index> condition_of;  // of each joined part, the first
    std::map<Index, bool> in_question;
    for (const Index n : rows) {
      const Index part = joined.find(first_unknown(n));
      const Index first = condition_of.try_emplace(part, fixed_.condition[n]).first->second;
      if (!in_question[part]) in_question[part] = differ(first, fixed_.condition[n]);
    }
    rows.erase(std::remove_if(rows.begin(), rows.end(),
                              [&](Index n) { return !in_question[joined.find(first_unknown(n))]; }),
               rows.end());
    std::stable_sort(rows.begin(), rows.end(), [&](Index a, Index b) {
      return points.begin[a + 1] - points.begin[a] < points.begin[b + 1] - points.begin[b];
    });
    return rows;
  }

  bool differ(Index a, Index b) const {
    const Fixed &x = conditions_[a], &y = conditions_[b];
    return a != b &&
           (x.value != y.value || x.table.time != y.table.time || x.table.value != y.table.value);
  }

  Row row_of(Index n) const {
    const MaterialPoints& points = fixed_.points;
    Row row;
    for (Index i = points.begin[n]; i < points.begin[n + 1]; ++i)
      row.weight[points.unknown[i]] += points.weight[i];
    const Index c = fixed_.condition[n];
    const bool has_table = !fixed_.table.empty() && fixed_.table[n] != none;
    // Moments are prescribed to be 0, whatever their condition prescribes.
    if (has_table || (conditions_[c].table.empty() && fixed_.value[n] == conditions_[c].value))
      row.prescribed[c] = 1;
    return row;
  }

  using Rounded = std::vector<std::pair<Index, long long>>;
  static Rounded rounded(const Combination& row) {
    Rounded result;
    for (const auto& [unknown, weight] : row)
      result.emplace_back(unknown, std::llround(weight * 1e9));
    return result;
  }

  /// Subtracts pivot rows until nothing is left of a row, which is told, or what is left is a pivot row itself. A pivot row has no
  /// unknowns of pivots before it: in their order each is eliminated once. `by_single`: whether each pivot row is of one unknown.
  bool eliminate(Row& row, bool& by_single) {
    const Real scale = largest(row.weight);
    for (std::size_t next = 0; next < pivots_.size();) {
      if (row.weight.size() > most_unknowns) return false;
      next = first_pivot(row.weight, next);
      if (next == pivots_.size()) break;
      const auto& [unknown, pivot] = pivots_[next++];
      by_single = by_single && pivot.weight.size() == 1;
      const Real factor = row.weight[unknown] / pivot.weight.at(unknown);
      subtract(row.weight, factor, pivot.weight);
      subtract(row.prescribed, factor, pivot.prescribed);
      row.weight.erase(unknown);
    }
    drop_rounding(row.weight, scale);
    if (row.weight.empty()) return true;
    const auto pivot = std::max_element(
        row.weight.begin(), row.weight.end(),
        [](const auto& a, const auto& b) { return std::abs(a.second) < std::abs(b.second); });
    pivot_of_[pivot->first] = pivots_.size();
    pivots_.emplace_back(pivot->first, std::move(row));
    return false;
  }

  /// Of the pivots from `next` on the first whose unknown a row has, or their number.
  std::size_t first_pivot(const Combination& row, std::size_t next) const {
    std::size_t first = pivots_.size();
    for (const auto& [unknown, weight] : row)
      if (const auto found = pivot_of_.find(unknown); found != pivot_of_.end())
        if (found->second >= next) first = std::min(first, found->second);
    return first;
  }

  /// What a combination of rows that moves nothing is prescribed to move, if it is.
  std::optional<Contradiction> difference(const Combination& prescribed, Index row) const {
    const auto sum_at = [&](Real t) {
      Real sum = 0, size = 0;
      for (const auto& [c, weight] : prescribed) {
        const Real part = weight * prescribed_at(conditions_[c], axis_, t);
        sum += part, size += std::abs(part);
      }
      return std::abs(sum) > least_difference * size ? sum : 0;
    };
    const auto differing =
        std::find_if(times_.begin(), times_.end(), [&](Real t) { return sum_at(t) != 0; });
    if (differing == times_.end()) return {};
    const std::array<Index, 2> pair = heaviest_two(prescribed);
    if (pair[1] == none) return {};
    Contradiction found{pair, axis_, row, 0, *differing, {}};
    if (differing != times_.begin()) found.from = *(differing - 1);
    const Real own = prescribed_at(conditions_[pair[0]], axis_, found.time);
    found.displacement = {own, own - sum_at(found.time) / prescribed.at(pair[0])};
    return found;
  }

  /// The conditions that count most, in ascending order; none where there is but one.
  static std::array<Index, 2> heaviest_two(const Combination& prescribed) {
    std::vector<std::pair<Real, Index>> by_weight;
    for (const auto& [c, weight] : prescribed) by_weight.emplace_back(-std::abs(weight), c);
    std::stable_sort(by_weight.begin(), by_weight.end());
    if (by_weight.size() < 2 || -by_weight[1].first <= least_weight) return {none, none};
    return {std::min(by_weight[0].second, by_weight[1].second),
            std::max(by_weight[0].second, by_weight[1].second)};
  }

  const FixedPoints& fixed_;
  const std::vector<Fixed>& conditions_;
  const int axis_;
  std::vector<Real> times_;  ///< s: between them all that is prescribed is linear
  std::map<Rounded, Row> first_like_;
  std::vector<std::pair<Index, Row>> pivots_;  ///< by the unknown that each is solved for
  std::map<Index, std::size_t> pivot_of_;
};

}  // namespace

std::optional<Contradiction> find_contradiction(const FixedPoints& fixed,
                                                const std::vector<Fixed>& conditions, Real end) {
  if (fixed.condition.empty()) return {};
  std::optional<Contradiction> first;
  for (int d = 0; d < 3; ++d) {
    const auto found = Axis(fixed, conditions, end, d).find();
    if (found && (!first || (found->same_rock && !first->same_rock))) first = found;
  }
  return first;
}

}  // namespace rockfold
