// The lattice of the mathematical cover: its nodes, its cells and how a cell is split into parts (thesis 2.3, 4.1).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "src/base/types.hpp"

namespace rockfold {

/// Named as in the model's `cover.lattice`; `tet5_mixed` is "tet5" with mixed = true.
enum class LatticeKind : std::uint8_t {
  tet5,        ///< five tetrahedra, two mirrored forms that alternate
  tet5_mixed,  ///< both forms overlaid, each with half of the rock: mixed discretisation
  tet6,        ///< the thesis' split
  tet6_kuhn,   ///< six tetrahedra about the diagonal 000–111
  tet24,  ///< twenty-four about the cell's centre, with nodes at the centres of the cell and its faces
  hex8,  ///< one part, trilinear weights
  block  ///< one cell, one part and one node for each block (the limit that is DDA)
};

/// "tet5", "tet5 mixed", "tet6", …
const char* lattice_name(LatticeKind kind);

/// A node of a lattice cell: its place in half edges (0, 1, 2) from the cell's lower corner.
using HalfSteps = std::array<std::int8_t, 3>;

/// A part of a lattice cell with weights of its own: N_a(η) = Σ_m weight[a][m] · η^m over the monomials
/// η^m = η_0^(m&1) η_1^(m>>1 &1) η_2^(m>>2), where η is the place in units of the cell's edges from its centre (−1/2 … 1/2).
struct CellPart {
  int nodes = 4;                                ///< 4 (tetrahedron), 8 (hexahedron) or 1 (block)
  std::array<std::int8_t, 8> node{};            ///< into CellSplit::node
  std::array<std::array<Real, 8>, 8> weight{};  ///< [node of the part][monomial]
};

/// How a lattice cell is split. Tetrahedra have corners ordered to positive volume in a right-handed lattice.
struct CellSplit {
  std::vector<HalfSteps>
      node;  ///< 8 corners first (corner c at 2·(c&1, c>>1 &1, c>>2)), then the other nodes
  std::vector<CellPart> part;
  Real share = 1;  ///< of the rock that each part stands for: 1/2 where two splits are overlaid

  int node_count() const { return static_cast<int>(node.size()); }
  int part_count() const { return static_cast<int>(part.size()); }
  int nodes_per_part() const { return part.front().nodes; }
  /// Parts of the first of the overlaid splits; all, if there is one.
  int first_split_parts() const { return share < 1 ? part_count() / 2 : part_count(); }
};

/// The split of a lattice cell. `odd`: which of the two forms of tet5; others have one.
const CellSplit& cell_split(LatticeKind kind, bool odd = false);

/// A lattice of parallelepipeds ("lattice cells") with nodes at their corners, for tet24 also at the centres of faces and cells.
///
/// Corner node (i,j,k), 0 ≤ i ≤ cells[0] …, lies at origin + i·edge[0] + j·edge[1] + k·edge[2] and has the linear
/// index i + (cells[0]+1)·(j + (cells[1]+1)·k) < grid(); cell (i,j,k) has i + cells[0]·(j + cells[1]·k).
/// Corner c of a cell is node (i + (c&1), j + (c>>1 &1), k + (c>>2 &1)).
/// The node at the centre of the face of cell (i,j,k) towards lower i, j or k is grid() · (1, 2 or 3) + the index of its lower corner,
/// that at the cell's centre grid() · 4 + the index of its lower corner.
///
/// Kind `block`: cell, node and block have the same index; the node and the cell's centre are block_origin, the edges
/// (all alike, along x, y, z) are no more than a unit of length.
struct Lattice {
  LatticeKind kind = LatticeKind::tet6;
  Vec3 origin{};                   ///< m
  Mat3 edge{};                     ///< m; edge[d] = vector from node to next node in direction d
  std::array<Index, 3> cells{};    ///< how many in each direction
  bool odd_origin = false;         ///< tet5: cell (0,0,0) has the odd form
  std::vector<Vec3> block_origin;  ///< m; kind `block` only

  Index grid() const { return (cells[0] + 1) * (cells[1] + 1) * (cells[2] + 1); }
  Index node_index(Index i, Index j, Index k) const {
    return i + (cells[0] + 1) * (j + (cells[1] + 1) * k);
  }
  Index cell_index(Index i, Index j, Index k) const { return i + cells[0] * (j + cells[1] * k); }
  std::array<Index, 3> cell_ijk(Index cell) const {
    return {cell % cells[0], cell / cells[0] % cells[1], cell / cells[0] / cells[1]};
  }
  /// Of a corner node.
  std::array<Index, 3> node_ijk(Index node) const {
    return {node % (cells[0] + 1), node / (cells[0] + 1) % (cells[1] + 1),
            node / (cells[0] + 1) / (cells[1] + 1)};
  }
  const CellSplit& split(Index cell) const;
  /// The linear index of a cell's node (into CellSplit::node).
  Index cell_node(Index cell, int node) const;

  /// m, of the point at (i, j, k) in units of the edges.
  Vec3 position(const Vec3& ijk) const {
    Vec3 x = origin;
    for (int d = 0; d < 3; ++d)
      for (int e = 0; e < 3; ++e) x[e] += ijk[d] * edge[d][e];
    return x;
  }
  Vec3 node_position(const std::array<Index, 3>& n) const {
    return position({Real(n[0]), Real(n[1]), Real(n[2])});
  }
  Vec3 node_position(Index node) const;
  Vec3 cell_centre(Index cell) const;
  /// η of a point that lies at x m from a cell's centre.
  Vec3 to_local(const Vec3& x) const;
  /// Gradients of η: row d is that of η_d, 1/m.
  Mat3 reciprocal() const;
};

}  // namespace rockfold
