// The patches of one plane that may meet an area on it.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "host/cut/cells/patch.hpp"

namespace rockfold {

/// Sorted along the axis in which the plane extends most, so that a plane of very many patches is not searched whole for
/// each area on it.
class PatchFinder {
 public:
  /// `box_of(i)` is the box of item i.
  template <class BoxOf>
  PatchFinder(std::span<const Index> items, const Vec3& normal, BoxOf box_of) {
    for (int d = 1; d < 3; ++d)
      if (std::abs(normal[d]) < std::abs(normal[axis_])) axis_ = d;
    entries_.reserve(items.size());
    for (const Index i : items) entries_.push_back({box_of(i), 0, i});
    std::sort(entries_.begin(), entries_.end(), [this](const Entry& a, const Entry& b) {
      const Real x = a.box.low[axis_], y = b.box.low[axis_];
      return x != y ? x < y : a.item < b.item;
    });
    Real reach = -Box::infinity;
    for (Entry& e : entries_) e.reach = reach = std::max(reach, e.box.high[axis_]);
  }

  /// Items whose boxes meet `box`, ascending.
  void near(const Box& box, Real slack, std::vector<Index>& found) const {
    found.clear();
    auto it = std::partition_point(entries_.begin(), entries_.end(), [&](const Entry& e) {
      return e.box.low[axis_] <= box.high[axis_] + slack;
    });
    while (it != entries_.begin() && (--it)->reach >= box.low[axis_] - slack)
      if (it->box.meets(box, slack)) found.push_back(it->item);
    std::sort(found.begin(), found.end());
  }

 private:
  struct Entry {
    Box box;
    Real reach;  // the farthest end of this entry and those before it
    Index item;
  };
  int axis_ = 0;
  std::vector<Entry> entries_;
};

}  // namespace rockfold
