// Boxes that a line or another box meets, or that hold a point, found without looking at all of them.
#pragma once

#include <vector>

#include "src/base/types.hpp"

namespace rockfold {

struct Bounds {
  Vec3 min{}, max{};
};

/// A binary tree of boxes, split at the median of their middles along the longest side.
/// Example: 3 boxes are one leaf; along() tries them all.
class BoxTree {
 public:
  BoxTree() = default;
  explicit BoxTree(std::vector<Bounds> boxes);

  /// The boxes that from + t·direction meets for some t in [low, high], ascending. O(log n + hits)
  std::vector<Index> along(const Vec3& from, const Vec3& direction, Real low, Real high) const;
  /// The boxes that hold x, ascending. O(log n + hits)
  std::vector<Index> at(const Vec3& x) const { return along(x, {}, 0, 0); }
  /// The boxes that share a point with `box`, ascending. O(log n + hits)
  void near(const Bounds& box, std::vector<Index>& found) const;

 private:
  struct Node {
    Bounds bounds;
    Index first = 0, count = 0;  ///< leaves: into order_; inner nodes: count = 0
    Index left = none, right = none;
  };
  Index build(Index first, Index count);

  std::vector<Bounds> boxes_;
  std::vector<Index> order_;
  std::vector<Node> nodes_;
};

}  // namespace rockfold
