// Covers and manifold elements as flat arrays: the contract between host/cover (which makes them from exact
// geometry) and kernels/ (which integrate over them and solve).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "src/base/types.hpp"

namespace rockfold {

/// A lattice of parallelepipeds ("lattice cells"), each split into six tetrahedra.
/// Node (i,j,k), 0 ≤ i ≤ cells[0] …, lies at origin + i·edge[0] + j·edge[1] + k·edge[2] and has the linear
/// index i + (cells[0]+1)·(j + (cells[1]+1)·k); cell (i,j,k) has i + cells[0]·(j + cells[1]·k).
/// Corner c of a cell is node (i + (c&1), j + (c>>1 &1), k + (c>>2 &1)).
struct Lattice {
  Vec3 origin{};                 ///< m
  Mat3 edge{};                   ///< m; edge[d] = vector from node to next node in direction d
  std::array<Index, 3> cells{};  ///< how many in each direction

  Index node_index(Index i, Index j, Index k) const {
    return i + (cells[0] + 1) * (j + (cells[1] + 1) * k);
  }
  Index cell_index(Index i, Index j, Index k) const { return i + cells[0] * (j + cells[1] * k); }
  std::array<Index, 3> cell_ijk(Index cell) const {
    return {cell % cells[0], cell / cells[0] % cells[1], cell / cells[0] / cells[1]};
  }
  std::array<Index, 3> node_ijk(Index node) const {
    return {node % (cells[0] + 1), node / (cells[0] + 1) % (cells[1] + 1),
            node / (cells[0] + 1) / (cells[1] + 1)};
  }
  Vec3 node_position(const std::array<Index, 3>& n) const {
    Vec3 x = origin;
    for (int d = 0; d < 3; ++d)
      for (int e = 0; e < 3; ++e) x[e] += n[d] * edge[d][e];
    return x;
  }
  Vec3 cell_centre(Index cell) const {
    const auto c = cell_ijk(cell);
    Vec3 x = origin;
    for (int d = 0; d < 3; ++d)
      for (int e = 0; e < 3; ++e) x[e] += (c[d] + 0.5) * edge[d][e];
    return x;
  }
};

/// The thesis' split of a lattice cell (INTERFACE.md §2): {000,010,011,110} {001,100,101,111} {000,001,100,111}
/// {000,001,011,111} {000,100,110,111} {000,011,110,111}, node "abc" = corner a + 2b + 4c; here with corners
/// ordered so that each tetrahedron has positive volume in a right-handed lattice.
inline constexpr int tet6_corner[6][4] = {{0, 2, 6, 3}, {4, 1, 7, 5}, {0, 4, 1, 7},
                                          {0, 4, 7, 6}, {0, 1, 3, 7}, {0, 6, 7, 3}};

/// P physical covers, R regular lattice cells, E cut elements made of Q convex pieces with T triangles and V vertices.
///
/// A regular lattice cell lies wholly inside one block and no joint enters it: it stands for six whole
/// tetrahedra and is stored as an index. Every other tetrahedron that holds rock is stored as cut elements:
/// an element is a connected part of (tetrahedron ∩ rock) of one material; a piece is a convex part of an element that
/// belongs to one block (the union of an element's pieces is the element).
/// Elements are numbered: 6·r + t for tetrahedron t of regular cell r, then 6·R + e for cut element e.
struct CoverArrays {
  Lattice lattice;

  // physical covers, ordered by lattice node; with order 0 each carries 3 unknowns
  std::vector<Index> cover_node;  ///< [P] linear lattice node index, ascending

  // regular lattice cells, ordered by lattice cell
  std::vector<Index> regular_cell;      ///< [R] linear lattice cell index
  std::vector<Index> regular_cover;     ///< [R][8] physical cover of each corner
  std::vector<Index> regular_material;  ///< [R] into Model::materials
  std::vector<Index> regular_block;     ///< [R]

  // cut elements, ordered by lattice cell, tetrahedron
  std::vector<Index> element_cell;        ///< [E] linear lattice cell index
  std::vector<std::uint8_t> element_tet;  ///< [E] 0 … 5, row of tet6_corner
  std::vector<Index> element_cover;     ///< [E][4] physical cover of each corner of the tetrahedron
  std::vector<Index> element_material;  ///< [E]
  std::vector<Index> piece_begin;       ///< [E+1] pieces of each element

  // pieces
  std::vector<Index> piece_block;      ///< [Q]
  std::vector<Index> triangle_begin;   ///< [Q+1]
  std::vector<Index> triangle_vertex;  ///< [T][3] counter-clockwise seen from outside, 0 ≤ id < V
  std::vector<Index> vertex_begin;     ///< [Q+1] each piece has vertices of its own
  std::vector<Real> vertex_xyz;  ///< [V][3] m, relative to the centre of the piece's lattice cell

  // counts of the thesis (REFERENCES 0.1), whole tetrahedra included
  std::int64_t element_vertices = 0;  ///< vertices summed over all elements
  std::int64_t element_faces = 0;     ///< faces summed over all elements

  Index cover_count() const { return static_cast<Index>(cover_node.size()); }
  Index regular_count() const { return static_cast<Index>(regular_cell.size()); }
  Index cut_count() const { return static_cast<Index>(element_cell.size()); }
  Index element_count() const { return 6 * regular_count() + cut_count(); }
  Index piece_count() const { return static_cast<Index>(piece_block.size()); }
};

/// N points of the material: displacement there = Σ_a weight[n][a] · d[cover[n][a]].
struct MaterialPoints {
  std::vector<Index> element;               ///< [N] element that holds the point
  std::vector<std::array<Index, 4>> cover;  ///< [N]
  std::vector<std::array<Real, 4>> weight;  ///< [N] partition of unity: sums to 1

  std::size_t size() const { return element.size(); }
};

/// Points whose displacement is prescribed, in some components (essential boundary conditions).
struct FixedPoints {
  MaterialPoints points;                               ///< [N]
  std::vector<std::array<std::uint8_t, 3>> component;  ///< [N] 1 = fixed
  std::vector<Vec3> value;                             ///< [N] m
  std::vector<Real> stiffness;  ///< [N] N/m penalty of the point (its share of the area times Pa/m)
  std::vector<std::uint8_t> augmented;  ///< [N] 1 = augmented Lagrangian, 0 = penalty alone
};

}  // namespace rockfold
