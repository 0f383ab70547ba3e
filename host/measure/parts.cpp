#include "host/measure/parts.hpp"

#include <algorithm>
#include <numeric>

#include "host/cut/complex.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {

/// Convex blocks with one face a plane: each face is then convex and has one loop.
std::vector<std::uint8_t> whole_parts(const BlockArrays& blocks) {
  std::vector<std::uint8_t> whole(blocks.convex);
  std::vector<Index> plane;
  for (Index b = 0; b < blocks.block_count(); ++b) {
    plane.assign(blocks.face_plane.begin() + blocks.face_begin[b],
                 blocks.face_plane.begin() + blocks.face_begin[b + 1]);
    std::sort(plane.begin(), plane.end());
    if (std::adjacent_find(plane.begin(), plane.end()) != plane.end()) whole[b] = 0;
  }
  return whole;
}

void add_block(const BlockArrays& blocks, Index b, PartArrays& out) {
  const Index shift = static_cast<Index>(out.vertex.size()) - blocks.vertex_begin[b];
  out.vertex.insert(out.vertex.end(), blocks.vertex.begin() + blocks.vertex_begin[b],
                    blocks.vertex.begin() + blocks.vertex_begin[b + 1]);
  const Index last = blocks.loop_begin[blocks.face_begin[b + 1]];
  for (Index l = blocks.loop_begin[blocks.face_begin[b]]; l < last; ++l) {
    for (Index c = blocks.corner_begin[l]; c < blocks.corner_begin[l + 1]; ++c)
      out.corner_vertex.push_back(blocks.corner_vertex[c] + shift);
    out.corner_begin.push_back(static_cast<Index>(out.corner_vertex.size()));
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
  const std::vector<std::uint8_t> whole = whole_parts(blocks);
  PartArrays out;
  out.face_begin = out.corner_begin = {0};
  const auto end_part = [&](Index b) {
    out.block.push_back(b);
    out.face_begin.push_back(static_cast<Index>(out.corner_begin.size()) - 1);
  };
  for (const Index c : cell) {
    const Index b = complex.cell_block[c];
    if (whole[b] != 0) {
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
