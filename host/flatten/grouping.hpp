// Which items belong to which group, as one flat list: a counting sort on all threads.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <omp.h>

#include "host/parallel.hpp"
#include "src/base/types.hpp"

namespace rockfold {

/// Example: items 0 … 3 with groups 1, 0, none, 1: begin = {0, 1, 3}, item = {1, 0, 3}.
struct Grouping {
  std::vector<Index> begin;  ///< [groups + 1]
  std::vector<Index> item;   ///< ascending in each group

  std::span<const Index> operator[](std::int64_t group) const {
    return std::span(item).subspan(begin[group], begin[group + 1] - begin[group]);
  }
};

/// Groups the items i with group_of(i) ≠ none. O(items + groups), 4 bytes a group for each thread up to eight.
/// Each thread counts and places a share of the items in its own sequence, so that the order is the items' own.
template <class GroupOf>
Grouping group_items(Index items, Index groups, const GroupOf& group_of) {
  const int shares = std::clamp(omp_get_max_threads(), 1, items > 1000 ? 8 : 1);
  const auto first = [&](std::int64_t s) { return static_cast<Index>(s * items / shares); };
  std::vector<std::vector<Index>> place(shares);
  parallel_for(shares, 1, [&](std::int64_t s) {
    place[s].assign(groups, 0);
    for (Index i = first(s); i < first(s + 1); ++i)
      if (const Index g = group_of(i); g != none) ++place[s][g];
  });
  Grouping result;
  result.begin.resize(groups + 1);
  Index placed = 0;
  for (Index g = 0; g < groups; ++g) {
    for (auto& of_share : place) placed += std::exchange(of_share[g], placed);
    result.begin[g + 1] = placed;
  }
  result.item.resize(placed);
  parallel_for(shares, 1, [&](std::int64_t s) {
    for (Index i = first(s); i < first(s + 1); ++i)
      if (const Index g = group_of(i); g != none) result.item[place[s][g]++] = i;
  });
  return result;
}

}  // namespace rockfold
