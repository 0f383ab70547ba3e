// The surfaces of the blocks as contact sees them: convex polygons of real faces (joints and free faces) on convex parts.
// Written by host/contact, read by kernels/contact.
#pragma once

#include <array>
#include <cstdint>
#include <tuple>
#include <vector>

#include "src/base/types.hpp"

namespace rockfold {

/// B blocks, P convex parts, V vertices, F faces with C corners, E edges.
///
/// A convex block is one part; any other is the cells that the cutting left of it, joined through virtual faces. A part is the
/// convex hull of its vertices. Its faces are convex polygons of the block's shown surface; virtual faces have none. A plane of a
/// part may carry several faces. Vertices are points of the material: a part moves as they do.
/// What lies beside a part may be apart from it along its virtual faces alone, or where these meet. So hull faces follow after the faces
/// of all parts, whole and with nothing shown on them: the faces of each cell; of what a part is a patch of.
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
  std::vector<Index> part_hull_begin;  ///< [P+1] hull faces of a cell; empty where no part is one
  /// What is not on a part's surface, but what it cannot touch lies beyond one of them: its virtual faces; of a patch of a convex part's surface,
  /// one for each face of that which looks another way than those of the patch. Both are empty where no part has any.
  std::vector<Index> part_far_begin;  ///< [P+1]
  std::vector<Index> part_far_face;

  // faces, those of a part together; then hull faces
  std::vector<Index> corner_begin{0};  ///< [F+1] counter-clockwise seen from outside, three or more
  std::vector<Index> corner_vertex;    ///< [C] < V
  /// [C] the side of the polygon from this corner to the next as a name that the polygon on its other side, if there is one in
  /// this block, has too: the lower of both corners' numbers
  std::vector<Index> corner_side;
  std::vector<Index>
      face_joint;  ///< [F] which joint it is a side of, equal on both sides; none = a free face
  std::vector<Index>
      face_material;  ///< [F] joint material, or what surface_of_solid() says; none = a face without
  /// [F] a vertex in a triangle's middle, or none; empty where none has one. It carries what lies inside with the corners.
  std::vector<Index> face_centre;

  // edges at which a part's surface is convex, those of a part together
  std::vector<Index> edge_vertex;      ///< [E][2]
  std::vector<Index> edge_face;        ///< [E][2] the faces on its two sides
  std::vector<std::uint8_t> edge_far;  ///< [E] 1: on both sides of it are far faces

  Real tolerance = 0;  ///< m, below which lengths are no lengths: 1e-9 of the model's size

  Index block_count() const { return static_cast<Index>(block_mass.size()); }
  Index vertex_count() const { return static_cast<Index>(vertex.size()); }
  Index part_count() const { return static_cast<Index>(part_block.size()); }
  Index face_count() const { return static_cast<Index>(corner_begin.size()) - 1; }
  bool has_hull(Index part) const {
    return !part_hull_begin.empty() && part_hull_begin[part] < part_hull_begin[part + 1];
  }
  Index edge_count() const { return static_cast<Index>(edge_vertex.size()) / 2; }
};

/// An edge of a part.
struct PartEdge {
  Index part;
  std::array<Index, 2> vertex, face;
  std::uint8_t far = 0;
  bool operator<(const PartEdge& other) const {
    return std::tie(part, vertex, face, far) <
           std::tie(other.part, other.vertex, other.face, other.far);
  }
};

/// Adds a face on which nothing is shown.
void add_hull_face(const std::vector<Index>& corners, SurfaceArrays& surfaces);

/// Fills corner_side and the edges: those of a cell's hull faces, of any other part where its faces meet each other or those of another part,
/// and `more`.
void find_edges(SurfaceArrays& surfaces, const std::vector<PartEdge>& more = {});

/// Surfaces (SurfaceArrays::face_material) of faces that no joint made.
struct FaceMaterials {
  Index intact =
      none;  ///< between rock that is excavated on the way and other rock, which no joint parts
  std::vector<Index> of_solid = {};  ///< [Model::solids] of their free faces; none: they have none
  std::vector<Index> of_interface =
      {};  ///< [Model::solids] on their side of the joint round a solid; none: the joint's own
};

}  // namespace rockfold
