// Joints on lattice planes for the tests of the solver: open where they are told to be, without any geometry.
#pragma once

#include <algorithm>
#include <functional>
#include <numeric>

#include "src/space/shape_functions.hpp"
#include "tests/solve/systems/systems.hpp"

namespace rockfold {

/// Opens joints on the lattice planes k = const of whole cells: a node (i, j, k) that `open` says yes to gets a second cover,
/// which the cells above it take.
inline void open_joints(CoverArrays& a, const std::function<bool(Index, Index, Index)>& open) {
  std::vector<Index> second(a.cover_node.size(), none), node = a.cover_node;
  for (Index p = 0; p < a.cover_count(); ++p) {
    const auto n = a.lattice.node_ijk(a.cover_node[p]);
    if (!open(n[0], n[1], n[2])) continue;
    second[p] = static_cast<Index>(node.size());
    node.push_back(a.cover_node[p]);
  }
  for (std::size_t i = 0; i < a.regular_cover.size(); ++i) {
    Index& p = a.regular_cover[i];
    if (i % 8 < 4 && second[p] != none) p = second[p];
  }
  // Covers are ordered by node.
  std::vector<Index> order(node.size()), place(node.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](Index p, Index q) { return node[p] < node[q]; });
  a.cover_node.clear();
  for (Index p : order) {
    place[p] = static_cast<Index>(a.cover_node.size());
    a.cover_node.push_back(node[p]);
  }
  for (Index& p : a.regular_cover) p = place[p];
}

/// n³ whole cells of side 1/n held by springs at points on the lowest face, most of them at no node.
inline SmallSystem held_cube(Index n, const std::function<bool(Index, Index, Index)>& open = {},
                             LatticeKind kind = LatticeKind::tet6) {
  SmallSystem s;
  Lattice lattice;
  const Real h = 1.0 / n;
  lattice.edge = {{{h, 0, 0}, {0, h, 0}, {0, 0, h}}};
  lattice.cells = {n, n, n};
  lattice.kind = kind;
  s.covered = reference::cover_regions(lattice, {{{}, 0, 0, 0}});
  s.materials = {{2000, 1e6, 0.25}};
  std::vector<Vec3> points;
  for (Index j = 0; j < n; ++j)
    for (Index i = 0; i < n; ++i) points.push_back({(i + 0.3) * h, (j + 0.45) * h, 0.0});
  CoverArrays& a = s.covered.arrays;
  if (open) open_joints(a, open);
  const Index parts = a.parts_per_cell();
  for (std::size_t p = 0; p < points.size(); ++p) {
    add_material_point(a, points[p], parts * static_cast<Index>(p), s.fixed.points);
    const auto& at = s.fixed.points;
    // The first tetrahedron may not hold the point: its weights are then not all positive. Take the one that does.
    for (Index t = 1; t < parts && *std::min_element(at.weight.end() - 4, at.weight.end()) < -1e-9;
         ++t) {
      s.fixed.points.element.pop_back();
      s.fixed.points.local.pop_back();
      s.fixed.points.begin.pop_back();
      s.fixed.points.unknown.resize(s.fixed.points.unknown.size() - 4);
      s.fixed.points.weight.resize(s.fixed.points.weight.size() - 4);
      add_material_point(a, points[p], parts * static_cast<Index>(p) + t, s.fixed.points);
    }
    s.fixed.component.push_back({1, 1, 1});
    s.fixed.value.push_back({});
    s.fixed.stiffness.push_back(1e7 * h);
    s.fixed.enforce.push_back(Enforce::penalty);
  }
  return s;
}

}  // namespace rockfold
