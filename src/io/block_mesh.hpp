// The faces of blocks, and the joints between them, as polygons that viewers draw.
#pragma once

#include <vector>

#include "src/arrays/block_arrays.hpp"

namespace rockfold {

/// N convex polygons over points of BlockArrays: a face that is convex and has no hole is one
/// polygon, any other its triangles.
struct PolygonMesh {
  std::vector<Index> polygon_begin;   ///< [N+1] into polygon_vertex
  std::vector<Index> polygon_vertex;  ///< into BlockArrays::vertex
  std::vector<Index> polygon_face;    ///< [N] face of each polygon, global face index, ascending

  std::size_t size() const { return polygon_face.size(); }
};

/// The polygons of all faces, in the order of the faces.
PolygonMesh face_polygons(const BlockArrays& blocks);

/// The polygons of the joints: of two faces that touch in a joint only the lower one's, whose
/// outward normal is the plane's own. So each area of a joint stands once, however many blocks meet
/// there.
PolygonMesh joint_polygons(const BlockArrays& blocks, const PolygonMesh& faces);

/// [F] block of each face.
std::vector<Index> block_of_face(const BlockArrays& blocks);

}  // namespace rockfold
