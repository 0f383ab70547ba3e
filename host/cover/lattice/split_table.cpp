#include "host/cover/lattice/split_table.hpp"

#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <stdexcept>

namespace rockfold {

namespace {

using Steps = std::array<int, 3>;  // half steps

Steps steps_of(const CellSplit& split, int node) {
  const HalfSteps& at = split.node[node];
  return {at[0], at[1], at[2]};
}

Steps difference(const Steps& a, const Steps& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

int dot(const std::array<int, 3>& a, const Steps& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// Normal of the plane through three points without a common divisor, its first component that is not 0 positive.
std::array<int, 3> primitive_normal(const Steps& p, const Steps& q, const Steps& r) {
  const Steps u = difference(q, p), v = difference(r, p);
  std::array<int, 3> c{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                       u[0] * v[1] - u[1] * v[0]};
  const int divisor = std::gcd(std::gcd(c[0], c[1]), c[2]);
  const int first = c[0] != 0 ? c[0] : c[1] != 0 ? c[1] : c[2];
  for (int& x : c) x /= first < 0 ? -divisor : divisor;
  return c;
}

// The nodes of each facet, and one off it.
struct Corners {
  std::vector<std::int8_t> on;
  std::int8_t off;
};
std::vector<Corners> facet_corners(const CellPart& part) {
  if (part.nodes == 1) return {};
  if (part.nodes == 8)
    return {{{0, 2, 4, 6}, 1}, {{1, 3, 5, 7}, 0}, {{0, 1, 4, 5}, 2},
            {{2, 3, 6, 7}, 0}, {{0, 1, 2, 3}, 4}, {{4, 5, 6, 7}, 0}};
  return {{{1, 2, 3}, 0}, {{0, 2, 3}, 1}, {{0, 1, 3}, 2}, {{0, 1, 2}, 3}};
}

}  // namespace

Real part_share(const CellSplit& split, const CellPart& part) {
  if (part.nodes != 4) return 1;
  const Steps o = steps_of(split, part.node[0]);
  const auto edge = [&](int a) { return difference(steps_of(split, part.node[a]), o); };
  const Steps a = edge(1), b = edge(2), c = edge(3);
  const int volume48 = a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                       a[2] * (b[0] * c[1] - b[1] * c[0]);
  return volume48 / 48.0;
}

SplitTable::SplitTable(LatticeKind kind) : family{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}} {
  for (const int odd : {0, 1}) {
    form[odd].split = &cell_split(kind, odd == 1);
    find_facets(form[odd]);
  }
  const bool alternate = kind == LatticeKind::tet5;
  for (const int odd : {0, 1}) {
    find_across(form[odd], form[alternate ? 1 - odd : odd]);
    find_trees(form[odd]);
  }
  every_other.assign(family.size(), alternate);
  for (int d = 0; d < 3; ++d) every_other[d] = false;
}

int SplitTable::family_of(const std::array<int, 3>& c) {
  const auto found = std::find(family.begin(), family.end(), c);
  if (found != family.end()) return static_cast<int>(found - family.begin());
  family.push_back(c);
  return static_cast<int>(family.size()) - 1;
}

void SplitTable::find_facets(Form& f) {
  for (const CellPart& part : f.split->part) {
    auto& facets = f.facet.emplace_back();
    const auto at = [&](int a) { return steps_of(*f.split, part.node[a]); };
    for (const auto& [on, off] : facet_corners(part)) {
      PartFacet facet;
      const auto c = primitive_normal(at(on[0]), at(on[1]), at(on[2]));
      facet.plane = {family_of(c), dot(c, at(on[0])) / 2};
      facet.above = dot(c, at(off)) > dot(c, at(on[0]));
      facet.nodes = static_cast<int>(on.size());
      std::copy(on.begin(), on.end(), facet.node.begin());
      if (facet.plane.family < 3) {
        facet.axis = facet.plane.family;
        facet.step = facet.above ? -1 : 1;
      }
      facets.push_back(facet);
    }
  }
}

// The part across a facet is the other one that has all of its nodes; lattices are conforming.
void SplitTable::find_across(Form& f, const Form& next) const {
  for (std::size_t p = 0; p < f.facet.size(); ++p)
    for (PartFacet& facet : f.facet[p]) {
      const Form& there = facet.axis < 0 ? f : next;
      bool found = false;
      for (std::size_t o = 0; o < there.facet.size() && !found; ++o) {
        if (&there == &f && facet.axis < 0 && o == p) continue;
        int shared = 0;
        for (int k = 0; k < facet.nodes; ++k) {
          Steps x = steps_of(*f.split, f.split->part[p].node[facet.node[k]]);
          if (facet.axis >= 0) x[facet.axis] -= 2 * facet.step;
          for (int a = 0; a < there.split->part[o].nodes; ++a)
            if (steps_of(*there.split, there.split->part[o].node[a]) == x) {
              facet.across[k] = static_cast<std::int8_t>(a);
              ++shared;
            }
        }
        found = shared == facet.nodes;
        facet.other = static_cast<int>(o);
      }
      if (!found) throw std::logic_error("the split of a lattice cell does not conform");
    }
}

void SplitTable::find_trees(Form& f) {
  const int parts = f.split->part_count(), overlaid = f.split->share < 1 ? 2 : 1;
  for (int layer = 0; layer < overlaid; ++layer) {
    std::vector<int> own(parts / overlaid);
    std::iota(own.begin(), own.end(), layer * parts / overlaid);
    PartTree tree;
    tree.root = grow(f, tree, own);
    f.tree.push_back(std::move(tree));
  }
}

// Of the planes that cut no part, the one that halves their number best.
int SplitTable::grow(const Form& f, PartTree& tree, const std::vector<int>& parts) const {
  if (parts.size() == 1) return ~parts[0];
  std::size_t best = parts.size();
  SplitPlane plane;
  std::vector<int> below, above;
  for (const int p : parts)
    for (const PartFacet& facet : f.facet[p]) {
      std::vector<int> side[2];
      bool cuts = false;
      for (const int o : parts) {
        bool has[2] = {false, false};
        const CellPart& part = f.split->part[o];
        for (int a = 0; a < part.nodes; ++a) {
          const int at = dot(family[facet.plane.family], steps_of(*f.split, part.node[a])) -
                         2 * facet.plane.offset;
          if (at != 0) has[at > 0 ? 1 : 0] = true;
        }
        cuts = cuts || (has[0] && has[1]);
        side[has[1] ? 1 : 0].push_back(o);
      }
      const std::size_t larger = std::max(side[0].size(), side[1].size());
      if (cuts || larger >= best) continue;
      best = larger;
      plane = facet.plane;
      below = side[0], above = side[1];
    }
  if (best == parts.size()) throw std::logic_error("no plane parts the parts of a lattice cell");
  const int low = grow(f, tree, below), high = grow(f, tree, above);
  tree.branch.push_back({plane, low, high});
  return static_cast<int>(tree.branch.size()) - 1;
}

}  // namespace rockfold
