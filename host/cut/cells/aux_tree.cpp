#include "host/cut/cells/aux_tree.hpp"

#include <algorithm>
#include <numeric>

#include "host/exact/plane_exact.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {

// So few polygons cut better than boxes around them. No more than so many planes that nearly coincide can lie on each other.
constexpr std::size_t leaf_size = 8;
// Models with no more polygons are not divided at all: planes through corners nearly coincide with other polygons' planes.
constexpr std::size_t least_polygons = 64;
constexpr int max_depth = 64;
// An empty end of a box that is this share of it is cut off.
constexpr Real empty_share = 0.3;

struct Split {
  int axis = -1;
  Real at = 0;
};

}  // namespace

struct AuxTree::Builder {
  PlaneTable& planes;
  const std::vector<const Patch*>& patches;
  std::vector<Node>& nodes;

  const Box& box(Index i) const { return patches[i]->corners; }

  // The half-space above the split, whose plane may be one of the model's own in either sense.
  HalfSpaceId above_split(const Split& split) const {
    Vec3 normal{};
    normal[split.axis] = 1;
    return planes.find_or_add({exact(normal), exact(split.at)});
  }

  bool is_below(Index i, const Split& s) const { return box(i).low[s.axis] < s.at; }
  bool is_above_plane(Index i, const Split& s) const { return box(i).high[s.axis] > s.at; }

  Split cut_off_empty(const Box& space, const Box& used) const {
    Split best;
    Real most = empty_share;
    for (int d = 0; d < 3; ++d) {
      const Real extent = space.high[d] - space.low[d];
      const Real under = (used.low[d] - space.low[d]) / extent;
      const Real over = (space.high[d] - used.high[d]) / extent;
      if (under > most) best = {d, used.low[d]}, most = under;
      if (over > most) best = {d, used.high[d]}, most = over;
    }
    return best;
  }

  // The middle polygon's lower end where it is another one's too, as on a grid; else the middle to the next lower one, so
  // that the plane passes through nobody's corner.
  Real between(const std::vector<Index>& list, std::vector<Index>::const_iterator middle,
               int d) const {
    const Real low = box(*middle).low[d];
    Real before = -Box::infinity;
    for (auto it = list.begin(); it != list.end(); ++it) {
      const Real other = box(*it).low[d];
      if (it != middle && other == low) return low;
      if (other < low) before = std::max(before, other);
    }
    return before > -Box::infinity ? 0.5 * (before + low) : low;
  }

  // The median of the polygons' lower ends along the longest axis on which that divides them.
  Split divide(std::vector<Index>& list, const Box& used) const {
    int axes[3] = {0, 1, 2};
    std::sort(axes, axes + 3, [&](int a, int b) {
      const Real x = used.high[a] - used.low[a], y = used.high[b] - used.low[b];
      return x != y ? x > y : a < b;
    });
    for (const int d : axes) {
      const auto middle = list.begin() + static_cast<std::ptrdiff_t>(list.size() / 2);
      std::nth_element(list.begin(), middle, list.end(), [&](Index i, Index j) {
        return box(i).low[d] != box(j).low[d] ? box(i).low[d] < box(j).low[d] : i < j;
      });
      const Split split{d, between(list, middle, d)};
      std::size_t below = 0, above = 0;
      for (const Index i : list) below += is_below(i, split), above += is_above_plane(i, split);
      if (5 * std::max(below, above) <= 4 * list.size()) return split;
    }
    return {};
  }

  void build(Index node, std::vector<Index> list, Box space, int depth) {
    if (list.size() <= leaf_size || depth == max_depth) return;
    Box used;
    for (const Index i : list) used.add(box(i));
    for (int d = 0; d < 3; ++d) {
      used.low[d] = std::max(used.low[d], space.low[d]);
      used.high[d] = std::min(used.high[d], space.high[d]);
    }
    Split split = cut_off_empty(space, used);
    if (split.axis < 0) split = divide(list, used);
    if (split.axis < 0) return;

    const HalfSpaceId up = above_split(split);
    nodes[node].plane = plane_of(up);
    std::vector<Index> part[2];
    for (const Index i : list) {
      if (is_below(i, split)) part[0].push_back(i);
      if (is_above_plane(i, split)) part[1].push_back(i);
    }
    list = {};
    for (int s = 0; s < 2; ++s) {
      const auto child = static_cast<Index>(nodes.size());
      nodes[node].child[is_above(up) ? s : 1 - s] = child;
      nodes.emplace_back();
      Box half = space;
      (s == 0 ? half.high : half.low)[split.axis] = split.at;
      build(child, std::move(part[s]), half, depth + 1);
    }
  }
};

AuxTree::AuxTree(PlaneTable& planes, const std::vector<const Patch*>& patches, const Box& space)
    : nodes_(1) {
  std::vector<Index> list;
  for (std::size_t i = 0; i < patches.size(); ++i)
    if (patches[i]->bounded() && patches[i]->box.meets(space, 0))
      list.push_back(static_cast<Index>(i));
  if (list.size() < least_polygons) return;
  const Box given{space.low + planes.centre(), space.high + planes.centre()};
  Builder{planes, patches, nodes_}.build(root, std::move(list), given, 0);
}

}  // namespace rockfold
