// Connected components by union-find with path halving; the smaller id is the root, so that the result does not depend
// on the order of joins.
#pragma once

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "src/base/types.hpp"

namespace rockfold {

class UnionFind {
 public:
  explicit UnionFind(Index n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }

  Index find(Index i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  void join(Index a, Index b) {
    a = find(a);
    b = find(b);
    if (a != b) parent_[std::max(a, b)] = std::min(a, b);
  }

  /// The component of each element, numbered by smallest element.
  std::vector<Index> components() {
    std::vector<Index> number(parent_.size());
    Index count = 0;
    for (Index i = 0; i < static_cast<Index>(parent_.size()); ++i)
      number[i] = find(i) == i ? count++ : number[find(i)];
    return number;
  }

 private:
  std::vector<Index> parent_;
};

}  // namespace rockfold
