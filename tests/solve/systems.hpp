// Small systems that the solver's tests share: cut by bodies whose faces no lattice plane meets, several materials.
#pragma once

#include "kernels/integrate/moments.hpp"
#include "kernels/solve/cover_system.hpp"
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
inline SmallSystem cut_system() {
  SmallSystem s;
  const Lattice lattice =
      reference::turned_lattice({0.11, -0.23, 0.37}, 0.55, 0.3, 0.2, {1, 0.6, 0.5}, 1.45);
  s.covered = reference::cover_regions(
      lattice, {reference::box({0.05, 0.02, 0.03}, {1.1, 1.3, 1.2}, 0, 0, 0),
                reference::box({1.1, 0.02, 0.03}, {2.0, 1.3, 1.2}, 1, 0, 0),
                reference::box({0.05, 0.02, -0.4}, {2.0, 1.3, 0.03}, 0, 1, 1)});
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
inline SmallSystem uncut_system(Index nx = 7, Index ny = 6, Index nz = 5) {
  SmallSystem s;
  Lattice lattice;
  lattice.origin = {3, -2, 11};
  lattice.edge = {{{0.5, 0.03, 0.0}, {-0.1, 0.6, 0.05}, {0.04, 0.02, 0.4}}};
  lattice.cells = {nx, ny, nz};
  s.covered = reference::cover_regions(lattice, {{{}, 0, 0, 0}});
  s.materials = {{2000, 1e3, 0.25}};
  return s;
}

/// The same rock with every regular cell stored as six cut elements: no stencil rows.
inline SmallSystem with_block_rows_alone(const SmallSystem& s) {
  SmallSystem t = s;
  CoverArrays& a = t.covered.arrays;
  const CoverArrays& from = s.covers();
  a.regular_cell.clear();
  a.regular_cover.clear();
  a.regular_material.clear();
  a.regular_block.clear();
  for (Index r = 0; r < from.regular_count(); ++r)
    for (int tet = 0; tet < 6; ++tet) {
      a.element_cell.push_back(from.regular_cell[r]);
      a.element_part.push_back(static_cast<std::uint8_t>(tet));
      a.element_material.push_back(from.regular_material[r]);
      const Index first = static_cast<Index>(a.vertex_xyz.size() / 3);
      for (int k = 0; k < 4; ++k) {
        const int c = tet6_corner[tet][k];
        a.element_cover.push_back(from.regular_cover[8 * r + c]);
        for (int d = 0; d < 3; ++d)
          a.vertex_xyz.push_back(((c & 1) - 0.5) * a.lattice.edge[0][d] +
                                 ((c >> 1 & 1) - 0.5) * a.lattice.edge[1][d] +
                                 ((c >> 2) - 0.5) * a.lattice.edge[2][d]);
      }
      for (Index i : {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3}) a.triangle_vertex.push_back(first + i);
      a.piece_block.push_back(0);
      a.triangle_begin.push_back(a.triangle_begin.back() + 4);
      a.vertex_begin.push_back(a.vertex_begin.back() + 4);
      a.piece_begin.push_back(a.piece_begin.back() + 1);
    }
  return t;
}

}  // namespace rockfold
