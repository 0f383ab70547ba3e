// The faces of blocks as polygons without holes.
#pragma once

#include <array>
#include <vector>

#include "src/arrays/block_arrays.hpp"

namespace rockfold {

/// N simple polygons over points of BlockArrays, ordered by face; corners counter-clockwise seen from outside the block.
struct SimplePolygons {
  std::vector<Index> polygon_begin;   ///< [N+1] into polygon_vertex
  std::vector<Index> polygon_vertex;  ///< into BlockArrays::vertex
  std::vector<Index> polygon_face;    ///< [N] global face index, ascending

  Index size() const { return static_cast<Index>(polygon_face.size()); }
};

/// A face without holes is one polygon, be it concave; a face with holes is cut into convex polygons: its triangles, joined
/// wherever two make a convex polygon (Hertel & Mehlhorn 1983). No point is added and no edge is split, so that each block's
/// surface stays closed edge by edge.
SimplePolygons simple_polygons(const BlockArrays& blocks);

/// Triangles of face f, corners as above.
std::vector<std::array<Index, 3>> face_triangles(const BlockArrays& blocks, Index f);

}  // namespace rockfold
