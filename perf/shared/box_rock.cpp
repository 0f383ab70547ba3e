#include "perf/shared/box_rock.hpp"

namespace rockfold {
namespace {

void add_regular(CoverArrays& a, Index cell, const Index (&node)[8]) {
  a.regular_cell.push_back(cell);
  a.regular_cover.insert(a.regular_cover.end(), node, node + 8);
  a.regular_material.push_back(0);
  a.regular_block.push_back(0);
}

void add_whole_tetrahedra(CoverArrays& a, Index cell, const Index (&node)[8], Real side) {
  for (int t = 0; t < 6; ++t) {
    const CellPart& part = cell_split(LatticeKind::tet6).part[t];
    a.element_cell.push_back(cell);
    a.element_part.push_back(static_cast<std::uint8_t>(t));
    a.element_material.push_back(0);
    const Index first = static_cast<Index>(a.vertex_xyz.size() / 3);
    for (int n = 0; n < part.nodes; ++n) {
      const int c = static_cast<unsigned char>(part.node[n]);
      a.element_cover.push_back(node[c]);
      for (int d = 0; d < 3; ++d) a.vertex_xyz.push_back(((c >> d & 1) - 0.5) * side);
    }
    for (Index i : {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3}) a.triangle_vertex.push_back(first + i);
    a.piece_block.push_back(0);
    a.triangle_begin.push_back(static_cast<Index>(a.triangle_vertex.size() / 3));
    a.vertex_begin.push_back(static_cast<Index>(a.vertex_xyz.size() / 3));
    a.piece_begin.push_back(a.piece_count());
  }
}

/// Whether node (i, j) of the plane above layer k, k % 3 = 2, lies inside an open joint: every third square, shifted from plane
/// to plane.
bool in_open_joint(Index n, Index square, Index i, Index j, Index k) {
  if (square == 0 || k % 3 != 2 || k + 1 >= n) return false;
  const Index a = i / square, b = j / square;
  const bool inside = i % square != 0 && j % square != 0;
  return inside && i < n && j < n && (a + b + k / 3) % 3 == 0;
}

CoverArrays make_rock(Index n, int cut_layers, Index square) {
  CoverArrays a;
  const Real side = 1.0 / n;
  a.lattice.edge = {{{side, 0, 0}, {0, side, 0}, {0, 0, side}}};
  a.lattice.cells = {n, n, n};
  std::vector<Index>
      first;  // cover of each node; where a joint is open the one below it, the next is above
  for (Index k = 0; k <= n; ++k)
    for (Index j = 0; j <= n; ++j)
      for (Index i = 0; i <= n; ++i) {
        first.push_back(a.cover_count());
        a.cover_node.push_back(a.lattice.node_index(i, j, k));
        if (in_open_joint(n, square, i, j, k - 1)) a.cover_node.push_back(a.cover_node.back());
      }
  a.piece_begin = a.triangle_begin = a.vertex_begin = {0};
  for (Index k = 0; k < n; ++k)
    for (Index j = 0; j < n; ++j)
      for (Index i = 0; i < n; ++i) {
        Index node[8];
        for (int c = 0; c < 8; ++c) {
          const Index x = i + (c & 1), y = j + (c >> 1 & 1), z = k + (c >> 2);
          node[c] = first[a.lattice.node_index(x, y, z)];
          if (c < 4 && in_open_joint(n, square, x, y, z - 1)) ++node[c];
        }
        if (k % 3 >= 3 - cut_layers)
          add_whole_tetrahedra(a, a.lattice.cell_index(i, j, k), node, side);
        else
          add_regular(a, a.lattice.cell_index(i, j, k), node);
      }
  return a;
}

}  // namespace

CoverArrays box_rock(Index n, int cut_layers) {
  return make_rock(n, cut_layers, 0);
}

CoverArrays jointed_rock(Index n, int cut_layers, Index square) {
  return make_rock(n, cut_layers, square);
}

}  // namespace rockfold
