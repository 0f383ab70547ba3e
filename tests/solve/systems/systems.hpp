// Small systems that the solver's tests share: cut by bodies whose faces no lattice plane meets, several materials.
#pragma once

#include "kernels/constraints/cover_system.hpp"
#include "kernels/integrate/moments.hpp"
#include "tests/reference/box_covers.hpp"
#include "tests/reference/dense_system.hpp"

namespace rockfold {

struct SmallSystem {
  reference::CoveredRegions covered;
  std::vector<ElasticMaterial> materials;
  FixedPoints fixed;

  const CoverArrays& covers() const { return covered.arrays; }
  CoverSystem make() const {
    return CoverSystem(covers(), piece_moments(covers()), materials, fixed);
  }
};

/// Two welded materials beside a body of its own, a lattice turned about two axes, springs at one end.
inline SmallSystem cut_system(LatticeKind kind = LatticeKind::tet6, int order = 0,
                              Real spacing = 0.55) {
  SmallSystem s;
  Lattice lattice =
      reference::turned_lattice({0.11, -0.23, 0.37}, spacing, 0.3, 0.2, {1, 0.6, 0.5}, 1.45);
  lattice.kind = kind;
  if (kind == LatticeKind::block) {
    lattice.cells = {0, 0, 0};
    lattice.block_origin = {{1, 0.7, 0.6}, {1, 0.7, -0.2}};
  }
  s.covered = reference::cover_regions(
      lattice, {reference::box({0.05, 0.02, 0.03}, {1.1, 1.3, 1.2}, 0, 0, 0),
                reference::box({1.1, 0.02, 0.03}, {2.0, 1.3, 1.2}, 1, 0, 0),
                reference::box({0.05, 0.02, -0.4}, {2.0, 1.3, 0.03}, 0, 1, 1)});
  s.covered.arrays.order = order;
  s.materials = {{2000, 1e3, 0.25}, {3100, 4e3, 0.1}};
  const auto points = reference::corner_points(
      s.covered, [](const Vec3& x) { return x[0] < 0.05 + 1e-9 && x[2] > 0.1; });
  s.fixed = reference::fix(
      s.covered, points,
      [](const Vec3& x) {
        return Vec3{0.01 * x[1], 0.02, -0.01 * x[2]};
      },
      300, false);
  s.fixed.component[0] = {1, 0, 1};
  return s;
}

/// Whole lattice cells alone, as many stencil rows as possible. Edges neither equal nor at right angles.
inline SmallSystem uncut_system(Index nx = 7, Index ny = 6, Index nz = 5,
                                LatticeKind kind = LatticeKind::tet6, int order = 0) {
  SmallSystem s;
  Lattice lattice;
  lattice.origin = {3, -2, 11};
  lattice.edge = {{{0.5, 0.03, 0.0}, {-0.1, 0.6, 0.05}, {0.04, 0.02, 0.4}}};
  lattice.cells = {nx, ny, nz};
  lattice.kind = kind;
  s.covered = reference::cover_regions(lattice, {{{}, 0, 0, 0}});
  s.covered.arrays.order = order;
  s.materials = {{2000, 1e3, 0.25}};
  return s;
}

/// The same rock with every part of every regular cell stored as a cut element: no stencil rows.
inline SmallSystem with_block_rows_alone(const SmallSystem& s) {
  SmallSystem t = s;
  CoverArrays& a = t.covered.arrays;
  const CoverArrays& from = s.covers();
  a.regular_cell.clear();
  a.regular_cover.clear();
  a.regular_material.clear();
  a.regular_block.clear();
  const std::vector<Index> tetrahedron{0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
  const std::vector<Index> hexahedron{0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4,
                                      2, 6, 7, 2, 7, 3, 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6};
  for (Index r = 0; r < from.regular_count(); ++r)
    for (int p = 0; p < from.parts_per_cell(); ++p) {
      const Index cell = from.regular_cell[r];
      const CellPart& part = from.lattice.split(cell).part[p];
      a.element_cell.push_back(cell);
      a.element_part.push_back(static_cast<std::uint8_t>(p));
      a.element_material.push_back(from.regular_material[r]);
      const Index first = static_cast<Index>(a.vertex_xyz.size() / 3);
      for (int k = 0; k < part.nodes; ++k) {
        const auto c = static_cast<unsigned char>(part.node[k]);
        a.element_cover.push_back(from.regular_cover[from.nodes_per_cell() * r + c]);
        const HalfSteps& at = from.lattice.split(cell).node[c];
        for (int d = 0; d < 3; ++d)
          a.vertex_xyz.push_back((0.5 * at[0] - 0.5) * a.lattice.edge[0][d] +
                                 (0.5 * at[1] - 0.5) * a.lattice.edge[1][d] +
                                 (0.5 * at[2] - 0.5) * a.lattice.edge[2][d]);
      }
      for (const Index i : part.nodes == 4 ? tetrahedron : hexahedron)
        a.triangle_vertex.push_back(first + i);
      a.piece_block.push_back(0);
      a.triangle_begin.push_back(static_cast<Index>(a.triangle_vertex.size() / 3));
      a.vertex_begin.push_back(static_cast<Index>(a.vertex_xyz.size() / 3));
      a.piece_begin.push_back(a.piece_count());
    }
  return t;
}

}  // namespace rockfold
