#include <algorithm>
#include <cmath>
#include <numeric>

#include "kernels/time/explicit/explicit_kernel.hpp"

namespace rockfold::motion {
namespace {

/// Levels beyond which a sliver is slower than it should be rather than a period of endless ticks.
constexpr int most_levels = 20;

/// Periods of a step that relaxes, at least. With mass added as far as a period allows, a block swings on what touches it in about π of them, and local
/// damping of 0.8 leaves a fifth of each swing: 30 swings reach the last digit of a double.
constexpr int relaxing_periods = 100;

/// Points' lists on the host.
struct PointLists {
  PointLists() = default;
  PointLists(const solve::DevicePoints& points)
      : count(points.count),
        begin(device::to_host(points.begin)),
        unknown(device::to_host(points.unknown)),
        weight(device::to_host(points.weight)) {}
  Index count = 0;
  std::vector<Index> begin, unknown;
  std::vector<Real> weight;
};

/// [P] 1: pulled by springs or dashpots, which are looked at once a period.
std::vector<std::uint8_t> find_pulled(const Motion::Data& m) {
  std::vector<std::uint8_t> pulled(m.covers, 0);
  const auto add = [&](const solve::DevicePoints& points, const auto& pulls) {
    const std::vector<Index> begin = device::to_host(points.begin),
                             unknown = device::to_host(points.unknown);
    for (Index n = 0; n < points.count; ++n)
      if (pulls(n))
        for (Index i = begin[n]; i < begin[n + 1]; ++i) pulled[unknown[i] % m.covers] = 1;
  };
  if (m.dashpots.any()) add(m.dashpots.points.points, [](Index) { return true; });
  const solve::Springs& springs = m.system.springs;
  if (!springs.any()) return pulled;
  const std::vector<Vec3> held = device::copy_to_host(springs.held),
                          stiffness = device::copy_to_host(springs.stiffness);
  add(springs.points, [&](Index n) {
    for (int d = 0; d < 3; ++d)
      if (!(held[n][d] > 0) && stiffness[n][d] > 0) return true;
    return false;
  });
  return pulled;
}

/// kg, of the blocks that are there.
std::vector<Real> find_masses(const Motion::Data& m) {
  const int n = m.explicit_scheme.functions;
  const std::vector<Real> matrix = device::to_host(m.explicit_scheme.mass);
  const std::vector<std::uint8_t> gone = device::to_host(m.gone);
  std::vector<Real> mass;
  for (Index p = 0; p < m.covers; ++p)
    mass.push_back(gone[p] != 0 ? 0 : matrix[static_cast<std::size_t>(p) * n * n]);
  return mass;
}

/// s: to which the shortest steps can be lengthened by at most `more` kg in all. A step grows with the root of its block's mass.
Real lengthened(const std::vector<Real>& step, const std::vector<Real>& mass, Real more) {
  std::vector<Index> order(step.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return step[a] < step[b]; });
  Real least = 0, stiffness = 0, masses = 0;
  for (std::size_t k = 0; k < order.size() && std::isfinite(step[order[k]]); ++k) {
    const Real h = step[order[k]], m = mass[order[k]];
    if (stiffness > 0 && (more + masses) < stiffness * h * h) break;
    stiffness += m / (h * h);
    masses += m;
    least = std::sqrt((more + masses) / stiffness);
  }
  return least;
}

/// s, of blocks as they are, and with mass added to the fastest as far as `mass_scaling` of all mass goes.
std::vector<Real> find_steps(const Motion::Data& m, Real mass_scaling) {
  std::vector<Real> step = device::to_host(m.explicit_scheme.step);
  const std::vector<Real> turning = device::to_host(m.explicit_scheme.turning);
  if (mass_scaling > 0) {
    const std::vector<Real> mass = find_masses(m);
    const Real all = std::accumulate(mass.begin(), mass.end(), Real{0}),
               least = lengthened(step, mass, mass_scaling * all);
    for (Real& h : step) h = std::max(h, least);
  }
  for (std::size_t p = 0; p < step.size(); ++p) step[p] = std::min(step[p], turning[p]);
  return step;
}

/// s: the longest of the blocks' own steps that is no longer than `most`. In a step that relaxes, blocks that nothing touches have no say: they
/// fall by their own mass, whatever the period is, and what the others are given is to be no more than they need.
Real longest_step(const std::vector<Real>& step, Real most, bool relaxes) {
  Real longest = 0;
  for (const Real h : step)
    if (!relaxes || std::isfinite(h)) longest = std::max(longest, std::min(h, most));
  return longest > 0 ? longest : most;
}

/// The period, and the levels of the blocks' own clocks.
std::vector<int> find_own_levels(const Motion::Data& m, const std::vector<Real>& step, Real dt,
                                 Real limit, bool relaxes, Schedule& s) {
  const std::vector<std::uint8_t> pulled = find_pulled(m);
  const Real longest = longest_step(step, relaxes ? dt / relaxing_periods : dt, relaxes);
  Real of_pulled = dt;
  for (std::size_t p = 0; p < step.size(); ++p)
    if (pulled[p] != 0) of_pulled = std::min(of_pulled, step[p]);
  s.period = dt / std::ceil((1 - 1e-12) * dt / std::min({longest, of_pulled, limit}));
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

/// Levels of points, which make the blocks that they touch as fast as they are.
void touch_blocks(const PointLists& lists, const std::vector<int>& level, Index covers,
                  std::vector<int>& touched) {
  for (Index c = 0; c < lists.count; ++c)
    for (Index i = lists.begin[c]; i < lists.begin[c + 1]; ++i) {
      int& of_block = touched[lists.unknown[i] % covers];
      of_block = std::max(of_block, level[c]);
    }
}

/// The fastest of the blocks' own levels that each point touches.
std::vector<int> levels_of(const PointLists& lists, const std::vector<int>& own) {
  const auto covers = static_cast<Index>(own.size());
  std::vector<int> level(lists.count, 0);
  for (Index c = 0; c < lists.count; ++c)
    for (Index i = lists.begin[c]; i < lists.begin[c + 1]; ++i)
      level[c] = std::max(level[c], own[lists.unknown[i] % covers]);
  return level;
}

/// The points of each block, in this order, with the weights of its functions times `sign`.
PullingPoints make_points(const PointLists& lists, const std::vector<int>& level,
                          const std::vector<Index>& order, Index covers, int n, Real sign) {
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
          weight[static_cast<std::size_t>(e) * n + lists.unknown[i] / covers] +=
              sign * lists.weight[i];
    });
  return {device::to_device("motion::point_level", level),
          device::to_device("motion::entry_begin", begin),
          device::to_device("motion::entry_point", point),
          device::to_device("motion::entry_weight", weight)};
}

/// Bolts, and their links, which tick with them.
struct BoltClocks {
  PointLists links;
  std::vector<int> level, of_link;  ///< [B], [L]
};

BoltClocks find_bolt_clocks(const bolts::DeviceBolts& bolts, const std::vector<int>& own) {
  BoltClocks clocks;
  if (!bolts.any()) return clocks;
  clocks.links = bolts.rows.points;
  clocks.of_link = levels_of(clocks.links, own);
  const std::vector<Index> begin = device::to_host(bolts.link_begin);
  for (Index b = 0; b < bolts.bolts; ++b) {
    const auto from = clocks.of_link.begin() + begin[b], to = clocks.of_link.begin() + begin[b + 1];
    clocks.level.push_back(from == to ? 0 : *std::max_element(from, to));
    std::fill(from, to, clocks.level.back());
  }
  return clocks;
}

/// ExplicitScheme::factor and added_mass: what is stable with the blocks' own levels.
void scale_masses(Motion::Data& m, const std::vector<int>& own) {
  ExplicitScheme& s = m.explicit_scheme;
  const std::vector<Real> step = device::to_host(s.step), mass = find_masses(m);
  std::vector<Real> factor;
  Real all = 0, more = 0;
  for (std::size_t p = 0; p < own.size(); ++p) {
    factor.push_back(std::pow(std::max(1.0, s.schedule.interval(own[p]) / step[p]), 2));
    all += mass[p];
    more += mass[p] * (factor[p] - 1);
  }
  s.factor = device::to_device("motion::mass_factor", factor);
  s.added_mass = all > 0 ? more / all : 0;
}

}  // namespace

void make_schedule(Motion::Data& m, Real dt, Real longest, const StepCourse& course) {
  ExplicitScheme& scheme = m.explicit_scheme;
  Schedule& s = scheme.schedule;
  std::vector<int> own =
      find_own_levels(m, find_steps(m, course.mass_scaling), dt, longest, course.relaxes(), s);
  if (course.relaxes()) {
    std::fill(own.begin(), own.end(), 0);
    s.deepest = 0;
  }
  scale_masses(m, own);
  const bool touches = m.contact && m.system.contacts.any();
  const PointLists lists = touches ? PointLists(m.system.contacts.points) : PointLists();
  const std::vector<int> level = levels_of(lists, own);
  const BoltClocks bolts = find_bolt_clocks(m.bolts, own);
  std::vector<int> touched = own;
  touch_blocks(lists, level, m.covers, touched);
  touch_blocks(bolts.links, bolts.of_link, m.covers, touched);
  const std::vector<Index> points = sort_by_level(level, s.deepest, scheme.points);
  s.block =
      device::to_device("motion::block_order", sort_by_level(touched, s.deepest, scheme.blocks));
  s.point = device::to_device("motion::point_order", points);
  s.bolt =
      device::to_device("motion::bolt_order", sort_by_level(bolts.level, s.deepest, scheme.bolts));
  s.block_level = device::to_device("motion::block_level", touched);
  s.contacts = make_points(lists, level, points, m.covers, scheme.functions, 1);
  std::vector<Index> as_fast;
  s.links =
      make_points(bolts.links, bolts.of_link, sort_by_level(bolts.of_link, s.deepest, as_fast),
                  m.covers, scheme.functions, -1);
  slow_strain(m);
  scheme.held = find_held_rows(m);
}

}  // namespace rockfold::motion
