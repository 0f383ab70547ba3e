#include "host/box_tree.hpp"

#include <algorithm>
#include <array>
#include <numeric>

namespace rockfold {
namespace {

constexpr Index leaf = 8;  // boxes

void grow(Bounds& bounds, const Bounds& other) {
  for (int d = 0; d < 3; ++d) {
    bounds.min[d] = std::min(bounds.min[d], other.min[d]);
    bounds.max[d] = std::max(bounds.max[d], other.max[d]);
  }
}

bool meets(const Bounds& a, const Bounds& b) {
  for (int d = 0; d < 3; ++d)
    if (a.min[d] > b.max[d] || b.min[d] > a.max[d]) return false;
  return true;
}

bool meets(const Bounds& box, const Vec3& from, const Vec3& direction, Real low, Real high) {
  for (int d = 0; d < 3; ++d) {
    if (direction[d] == 0) {
      if (from[d] < box.min[d] || from[d] > box.max[d]) return false;
      continue;
    }
    const Real a = (box.min[d] - from[d]) / direction[d], b = (box.max[d] - from[d]) / direction[d];
    low = std::max(low, std::min(a, b));
    high = std::min(high, std::max(a, b));
  }
  return low <= high;
}

}  // namespace

BoxTree::BoxTree(std::vector<Bounds> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
  std::iota(order_.begin(), order_.end(), 0);
  if (!boxes_.empty()) build(0, static_cast<Index>(boxes_.size()));
}

Index BoxTree::build(Index first, Index count) {
  const auto id = static_cast<Index>(nodes_.size());
  Node node{boxes_[order_[first]], first, count, none, none};
  for (Index i = first; i < first + count; ++i) grow(node.bounds, boxes_[order_[i]]);
  nodes_.push_back(node);
  if (count <= leaf) return id;
  int axis = 0;
  const auto side = [&](int d) { return node.bounds.max[d] - node.bounds.min[d]; };
  for (int d = 1; d < 3; ++d)
    if (side(d) > side(axis)) axis = d;
  const auto before = [&](Index a, Index b) {
    const Real x = boxes_[a].min[axis] + boxes_[a].max[axis];
    const Real y = boxes_[b].min[axis] + boxes_[b].max[axis];
    return x != y ? x < y : a < b;
  };
  const Index half = count / 2;
  std::nth_element(order_.begin() + first, order_.begin() + first + half,
                   order_.begin() + first + count, before);
  const Index left = build(first, half), right = build(first + half, count - half);
  nodes_[id].left = left, nodes_[id].right = right, nodes_[id].count = 0;
  return id;
}

std::vector<Index> BoxTree::along(const Vec3& from, const Vec3& direction, Real low,
                                  Real high) const {
  std::vector<Index> found, open;
  if (!nodes_.empty()) open.push_back(0);
  while (!open.empty()) {
    const Node& node = nodes_[open.back()];
    open.pop_back();
    if (!meets(node.bounds, from, direction, low, high)) continue;
    if (node.left != none) {
      open.push_back(node.left);
      open.push_back(node.right);
      continue;
    }
    for (Index i = node.first; i < node.first + node.count; ++i)
      if (meets(boxes_[order_[i]], from, direction, low, high)) found.push_back(order_[i]);
  }
  std::sort(found.begin(), found.end());
  return found;
}

void BoxTree::near(const Bounds& box, std::vector<Index>& found) const {
  found.clear();
  std::array<Index, 64> open;  // nodes to visit: at most one a level, and 2^31 boxes are 29 levels
  int count = 0;
  if (!nodes_.empty()) open[count++] = 0;
  while (count > 0) {
    const Node& node = nodes_[open[--count]];
    if (!meets(node.bounds, box)) continue;
    if (node.left != none) {
      open[count++] = node.right;
      open[count++] = node.left;
      continue;
    }
    for (Index i = node.first; i < node.first + node.count; ++i)
      if (meets(boxes_[order_[i]], box)) found.push_back(order_[i]);
  }
  std::sort(found.begin(), found.end());
}

}  // namespace rockfold
