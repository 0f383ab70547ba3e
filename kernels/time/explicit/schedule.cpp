#include <algorithm>
#include <cmath>
#include <numeric>

#include "kernels/time/explicit/explicit_kernel.hpp"

namespace rockfold::motion {
namespace {

/// Levels beyond which a sliver is slower than it should be rather than a period of endless ticks.
constexpr int most_levels = 20;

/// What is there of the points' lists, on the host.
struct PointLists {
  explicit PointLists(const Motion::Data& m) {
    if (!m.contact || !m.system.contacts.any()) return;
    count = m.system.contacts.points.count;
    begin = device::to_host(m.system.contacts.points.begin);
    unknown = device::to_host(m.system.contacts.points.unknown);
    weight = device::to_host(m.system.contacts.points.weight);
  }
  Index count = 0;
  std::vector<Index> begin, unknown;
  std::vector<Real> weight;
};

/// Whether springs or dashpots act, which are looked at once a period.
bool has_stiff_loads(const Motion::Data& m) {
  if (m.dashpots.any()) return true;
  if (!m.system.springs.any()) return false;
  for (const Vec3& k : device::copy_to_host(m.system.springs.stiffness))
    if (k[0] > 0 || k[1] > 0 || k[2] > 0) return true;
  return false;
}

/// The period, and the levels of the blocks' own clocks.
std::vector<int> find_own_levels(const Motion::Data& m, Real dt, Schedule& s) {
  const std::vector<Real> step = device::to_host(m.explicit_scheme.step);
  Real longest = 0, shortest = dt;
  for (const Real h : step) {
    longest = std::max(longest, std::min(h, dt));
    shortest = std::min(shortest, h);
  }
  const Real wanted = has_stiff_loads(m) ? shortest : longest;
  s.period = dt / std::ceil((1 - 1e-12) * dt / wanted);
  std::vector<int> own;
  s.deepest = 0;
  for (const Real h : step) {
    int level = 0;
    while (level < most_levels && s.interval(level) > h) ++level;
    own.push_back(level);
    s.deepest = std::max(s.deepest, level);
  }
  return own;
}

/// The indices of levels, the fastest first, and how many are as fast as each level.
std::vector<Index> sort_by_level(const std::vector<int>& level, int deepest,
                                 std::vector<Index>& as_fast) {
  std::vector<Index> order(level.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](Index a, Index b) { return level[a] > level[b]; });
  as_fast.assign(deepest + 1, 0);
  for (const int l : level)
    for (int slower = 0; slower <= l; ++slower) ++as_fast[slower];
  return order;
}

/// The points of each block with the weights of its functions.
void store_entries(const PointLists& lists, const std::vector<Index>& order, Index covers, int n,
                   Schedule& s) {
  std::vector<Index> begin(covers + 1, 0);
  const auto for_each_side = [&](Index c, const auto& f) {
    Index blocks[2] = {none, none};
    for (Index i = lists.begin[c]; i < lists.begin[c + 1]; ++i) {
      const Index p = lists.unknown[i] % covers;
      if (p != blocks[0] && p != blocks[1]) blocks[blocks[0] == none ? 0 : 1] = p;
    }
    for (const Index p : blocks)
      if (p != none) f(p);
  };
  for (Index c = 0; c < lists.count; ++c) for_each_side(c, [&](Index p) { ++begin[p + 1]; });
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<Index> at(begin.begin(), begin.end() - 1), point(begin.back());
  std::vector<Real> weight(static_cast<std::size_t>(begin.back()) * n, 0);
  for (const Index c : order)
    for_each_side(c, [&](Index p) {
      const Index e = at[p]++;
      point[e] = c;
      for (Index i = lists.begin[c]; i < lists.begin[c + 1]; ++i)
        if (lists.unknown[i] % covers == p)
          weight[static_cast<std::size_t>(e) * n + lists.unknown[i] / covers] += lists.weight[i];
    });
  s.begin = device::to_device("motion::entry_begin", begin);
  s.entry_point = device::to_device("motion::entry_point", point);
  s.entry_weight = device::to_device("motion::entry_weight", weight);
}

}  // namespace

void make_schedule(Motion::Data& m, Real dt) {
  Schedule& s = m.explicit_scheme.schedule;
  const PointLists lists(m);
  std::vector<int> own = find_own_levels(m, dt, s), touched = own, level(lists.count, 0);
  for (Index c = 0; c < lists.count; ++c) {
    for (Index i = lists.begin[c]; i < lists.begin[c + 1]; ++i)
      level[c] = std::max(level[c], own[lists.unknown[i] % m.covers]);
    for (Index i = lists.begin[c]; i < lists.begin[c + 1]; ++i) {
      int& of_block = touched[lists.unknown[i] % m.covers];
      of_block = std::max(of_block, level[c]);
    }
  }
  const std::vector<Index> points = sort_by_level(level, s.deepest, m.explicit_scheme.points);
  s.block = device::to_device("motion::block_order",
                              sort_by_level(touched, s.deepest, m.explicit_scheme.blocks));
  s.point = device::to_device("motion::point_order", points);
  s.own = device::to_device("motion::own_level", own);
  s.touched = device::to_device("motion::touched_level", touched);
  s.level = device::to_device("motion::point_level", level);
  store_entries(lists, points, m.covers, m.explicit_scheme.functions, s);
  slow_strain(m);
}

}  // namespace rockfold::motion
