// The surface of one block as it is shown: the outer areas of its wide cells merged into faces with holes, vertices nearer than
// the tolerance made one, faces narrower than it left out; with counts of vertices and edges, shells and genus of that.
#pragma once

#include <vector>

#include "host/cut/cells/complex.hpp"

namespace rockfold {

/// A convex area of a block's boundary: of a fragment, a free part or a beam.
struct BoundaryArea {
  Index cell = none, face = none;                        ///< of the complex
  Index origin = none;                                   ///< into Complex::origins
  Real area = 0;                                         ///< m²
  Index fragment = none, free_part = none, beam = none;  ///< into the complex; one of them
};

/// Faces, loops, corners and vertices as in BlockArrays, numbered from 0 within the block.
struct BlockSurface {
  struct Face {
    HalfSpaceId inside = none;  ///< the half-space that holds the block's side of the face
    Index origin = none;
    Real area = 0;  ///< m²
  };
  std::vector<Face> faces;
  std::vector<Index> loop_begin{0};    ///< [faces + 1]
  std::vector<Index> corner_begin{0};  ///< [loops + 1]
  std::vector<Index> corner_vertex;
  std::vector<Vec3> vertices;  ///< m, about the table's centre
  std::vector<Index>
      face_of_area;  ///< [areas given] the face that each became part of; none = narrower than the tolerance
  Index edge_count = 0;
  Index shell_count = 0;
  Index genus = 0;
  bool convex = true;
  Index open_edges =
      0;  ///< what is missing for as many uses in one sense as in the other, in all edges
  Index vertices_identified =
      0;  ///< that differ by more than rounding from the one that they became
};

/// Merges the areas of one block. O(n^5/3) at worst in the number of vertices, n log n where they are spread.
BlockSurface make_block_surface(const Complex& complex, const std::vector<BoundaryArea>& areas);

}  // namespace rockfold
