// The convex parts of the blocks, for programs that know convex blocks only. Written by host/measure.
#pragma once

#include <vector>

#include "src/base/types.hpp"

namespace rockfold {

/// P convex parts with F faces, C corners and V vertices; parts of one block stand together, ordered by block.
/// Example: one tetrahedron is P = 1, F = 4, C = 12, V = 4, face_begin = {0, 4}, corner_begin = {0, 3, 6, 9, 12}.
struct PartArrays {
  std::vector<Index> block;          ///< [P] the block that each is part of, ascending
  std::vector<Index> face_begin;     ///< [P+1]
  std::vector<Index> corner_begin;   ///< [F+1] counter-clockwise seen from outside the part
  std::vector<Index> corner_vertex;  ///< [C] < V
  std::vector<Vec3> vertex;          ///< [V] m; parts have vertices of their own

  Index part_count() const { return static_cast<Index>(block.size()); }
};

}  // namespace rockfold
