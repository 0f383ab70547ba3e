// The faces of blocks as polygons without holes, as viewers draw them.
#pragma once

#include <span>
#include <vector>

#include "src/arrays/block_arrays.hpp"

namespace rockfold {

/// A loop of points by number: counter-clockwise for an outer boundary seen from the tip of the
/// normal, clockwise for a hole.
using Loop = std::span<const Index>;

/// N polygons over points of BlockArrays; corners counter-clockwise seen from outside the block.
/// Example: a unit cube cut by nothing: N = 6, polygon_begin = {0, 4, …, 24},
/// polygon_face = {0, 1, …, 5}; as triangles N = 12, polygon_begin = {0, 3, …, 36},
/// polygon_face = {0, 0, 1, 1, …}.
struct PolygonMesh {
  std::vector<Index> polygon_begin{0};  ///< [N+1] into polygon_vertex
  std::vector<Index> polygon_vertex;    ///< into BlockArrays::vertex
  std::vector<Index> polygon_face;      ///< [N] face of each polygon, global face index, ascending

  Index size() const { return static_cast<Index>(polygon_face.size()); }
  Loop polygon(Index p) const {
    return Loop(polygon_vertex).subspan(polygon_begin[p], polygon_begin[p + 1] - polygon_begin[p]);
  }
  void add(Loop corners, Index face) {
    polygon_vertex.insert(polygon_vertex.end(), corners.begin(), corners.end());
    polygon_begin.push_back(static_cast<Index>(polygon_vertex.size()));
    polygon_face.push_back(face);
  }
};

/// Loop l of the blocks' faces.
inline Loop face_loop(const BlockArrays& blocks, Index l) {
  return Loop(blocks.corner_vertex)
      .subspan(blocks.corner_begin[l], blocks.corner_begin[l + 1] - blocks.corner_begin[l]);
}

/// Whether a loop of three corners or more turns left or goes straight at each corner (to 1e-9 of
/// the sine) and has no edge of length 0.
bool is_convex(Loop loop, const std::vector<Vec3>& points, const Vec3& normal);

}  // namespace rockfold
