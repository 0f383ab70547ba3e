#include "perf/box_rock.hpp"

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
    a.element_cell.push_back(cell);
    a.element_part.push_back(static_cast<std::uint8_t>(t));
    a.element_material.push_back(0);
    const Index first = static_cast<Index>(a.vertex_xyz.size() / 3);
    for (int c : tet6_corner[t]) {
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

}  // namespace

CoverArrays box_rock(Index n, int cut_layers) {
  CoverArrays a;
  const Real side = 1.0 / n;
  a.lattice.edge = {{{side, 0, 0}, {0, side, 0}, {0, 0, side}}};
  a.lattice.cells = {n, n, n};
  for (Index p = 0; p < (n + 1) * (n + 1) * (n + 1); ++p) a.cover_node.push_back(p);
  a.piece_begin = a.triangle_begin = a.vertex_begin = {0};
  for (Index k = 0; k < n; ++k)
    for (Index j = 0; j < n; ++j)
      for (Index i = 0; i < n; ++i) {
        Index node[8];
        for (int c = 0; c < 8; ++c)
          node[c] = a.lattice.node_index(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2));
        if (k % 3 >= 3 - cut_layers)
          add_whole_tetrahedra(a, a.lattice.cell_index(i, j, k), node, side);
        else
          add_regular(a, a.lattice.cell_index(i, j, k), node);
      }
  return a;
}

}  // namespace rockfold
