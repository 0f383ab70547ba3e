#include "host/measure/parts.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <tuple>

#include "host/cut/cells/complex.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {

struct Edge {
  Index plane, from, to;
  bool operator<(const Edge& o) const {
    return std::tie(plane, from, to) < std::tie(o.plane, o.from, o.to);
  }
};

/// The edges of a convex block's faces without those between faces in one plane, by plane and first vertex.
std::vector<Edge> outline_edges(const BlockArrays& blocks, Index b) {
  std::vector<Edge> edges, outline;
  for (Index f = blocks.face_begin[b]; f < blocks.face_begin[b + 1]; ++f)
    for (Index l = blocks.loop_begin[f]; l < blocks.loop_begin[f + 1]; ++l) {
      const Index begin = blocks.corner_begin[l], end = blocks.corner_begin[l + 1];
      for (Index c = begin; c < end; ++c)
        edges.push_back({blocks.face_plane[f], blocks.corner_vertex[c],
                         blocks.corner_vertex[c + 1 < end ? c + 1 : begin]});
    }
  std::sort(edges.begin(), edges.end());
  std::copy_if(edges.begin(), edges.end(), std::back_inserter(outline), [&](const Edge& e) {
    return !std::binary_search(edges.begin(), edges.end(), Edge{e.plane, e.to, e.from});
  });
  return outline;
}

/// One face a plane, whatever origins share it, and the vertices where three planes meet.
void add_block(const BlockArrays& blocks, Index b, PartArrays& out) {
  std::vector<Edge> edges = outline_edges(blocks, b);
  const Index first = blocks.vertex_begin[b];
  std::vector<Index> planes_at(blocks.vertex_begin[b + 1] - first, 0),
      number(planes_at.size(), none);
  for (const Edge& e : edges) ++planes_at[e.from - first];  // a plane's outline passes once
  for (auto begin = edges.begin(); begin != edges.end();) {
    const auto end =
        std::find_if(begin, edges.end(), [&](const Edge& e) { return e.plane != begin->plane; });
    auto e = begin;
    do {
      const Index v = e->from - first;
      if (planes_at[v] > 2) {
        if (number[v] == none) {
          number[v] = static_cast<Index>(out.vertex.size());
          out.vertex.push_back(blocks.vertex[e->from]);
        }
        out.corner_vertex.push_back(number[v]);
      }
      e = std::lower_bound(begin, end, Edge{begin->plane, e->to, none});
    } while (e != begin);
    out.corner_begin.push_back(static_cast<Index>(out.corner_vertex.size()));
    begin = end;
  }
}

void add_cell(const CellView& cell, const Vec3& centre, PartArrays& out) {
  const auto shift = static_cast<Index>(out.vertex.size());
  for (const Vertex& v : cell.vertices) out.vertex.push_back(v.x + centre);
  for (const auto& face : cell.faces) {
    for (Index c = 0; c < face.count; ++c)
      out.corner_vertex.push_back(cell.corners[face.begin + c].vertex + shift);
    out.corner_begin.push_back(static_cast<Index>(out.corner_vertex.size()));
  }
}

}  // namespace

PartArrays convex_parts(const Cutting& cutting, const BlockArrays& blocks) {
  const Complex& complex = *cutting.complex;
  std::vector<Index> cell(complex.cells.size());
  std::iota(cell.begin(), cell.end(), 0);
  std::stable_sort(cell.begin(), cell.end(),
                   [&](Index a, Index b) { return complex.cell_block[a] < complex.cell_block[b]; });
  PartArrays out;
  out.face_begin = out.corner_begin = {0};
  const auto end_part = [&](Index b) {
    out.block.push_back(b);
    out.face_begin.push_back(static_cast<Index>(out.corner_begin.size()) - 1);
  };
  for (const Index c : cell) {
    const Index b = complex.cell_block[c];
    if (blocks.convex[b] != 0) {
      if (!out.block.empty() && out.block.back() == b) continue;
      add_block(blocks, b, out);
    } else {
      add_cell(complex.cells[c], complex.planes.centre(), out);
    }
    end_part(b);
  }
  return out;
}

}  // namespace rockfold
