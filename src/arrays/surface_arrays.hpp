// The surfaces of the blocks as contact sees them: convex polygons of real faces (joints and free faces) on convex parts.
// Written by host/contact, read by kernels/contact.
#pragma once

#include <cstdint>
#include <vector>

#include "src/base/types.hpp"

namespace rockfold {

/// B blocks, P convex parts, V vertices, F faces with C corners, E edges.
///
/// A convex block is one part; any other is the cells that the cutting left of it, joined through virtual faces. A part is the
/// convex hull of its vertices. Its faces are convex polygons of the block's shown surface; virtual faces have none. A plane of a
/// part may carry several faces. Vertices are points of the material: a part moves as they do.
/// Example: a unit cube is B = P = 1, V = 8, F = 6, C = 24, E = 12, part_vertex_begin = {0, 8}, part_face_begin = {0, 6},
/// corner_begin = {0, 4, …, 24}, part_edge_begin = {0, 12}.
struct SurfaceArrays {
  // blocks
  std::vector<Real> block_mass;  ///< [B] kg

  // vertices, those of a block together
  std::vector<Vec3> vertex;         ///< [V] m, in place
  std::vector<Index> vertex_block;  ///< [V]

  // parts, those of a block together, blocks ascending
  std::vector<Index> part_block;            ///< [P]
  std::vector<Index> part_vertex_begin{0};  ///< [P+1]
  std::vector<Index> part_vertex;           ///< < V, the corners of the hull
  std::vector<Index> part_face_begin{0};    ///< [P+1]
  std::vector<Index> part_edge_begin{0};    ///< [P+1]
  /// Of parts that are patches of a convex part's surface: faces of other patches of it, one for each face that looks another way than those of
  /// the patch: what it cannot touch lies beyond one of them. Both are empty where no part is a patch.
  std::vector<Index> part_far_begin;  ///< [P+1]
  std::vector<Index> part_far_face;

  // faces, those of a part together
  std::vector<Index> corner_begin{0};  ///< [F+1] counter-clockwise seen from outside, three or more
  std::vector<Index> corner_vertex;    ///< [C] < V
  /// [C] the side of the polygon from this corner to the next as a name that the polygon on its other side, if there is one in
  /// this block, has too: the lower of both corners' numbers
  std::vector<Index> corner_side;
  std::vector<Index>
      face_joint;  ///< [F] which joint it is a side of, equal on both sides; none = a free face
  std::vector<Index>
      face_material;  ///< [F] into Model::joint_materials; none = a free face, or a joint without one
  /// [F] a vertex in a triangle's middle, or none; empty where none has one. It carries what lies inside with the corners.
  std::vector<Index> face_centre;

  // edges at which a part's surface is convex, those of a part together
  std::vector<Index> edge_vertex;  ///< [E][2]
  std::vector<Index> edge_face;    ///< [E][2] the faces on its two sides

  Real tolerance = 0;  ///< m, below which lengths are no lengths: 1e-9 of the model's size

  Index block_count() const { return static_cast<Index>(block_mass.size()); }
  Index vertex_count() const { return static_cast<Index>(vertex.size()); }
  Index part_count() const { return static_cast<Index>(part_block.size()); }
  Index face_count() const { return static_cast<Index>(corner_begin.size()) - 1; }
  Index edge_count() const { return static_cast<Index>(edge_vertex.size()) / 2; }
};

/// Fills corner_side, part_edge_begin, edge_vertex and edge_face from the faces.
void find_edges(SurfaceArrays& surfaces);

}  // namespace rockfold
