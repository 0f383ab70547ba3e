// The complex of convex cells that a model is cut into: the one data structure behind blocks, covers and contacts.
#pragma once

#include <vector>

#include "host/cut/convex_cell.hpp"
#include "host/cut/polygon.hpp"
#include "host/exact/plane_table.hpp"
#include "src/arrays/block_arrays.hpp"

namespace rockfold {

/// Convex cells in flat arrays; face and vertex numbers are local to their cell.
class CellStore {
 public:
  Index size() const { return static_cast<Index>(face_begin_.size()) - 1; }
  CellView operator[](Index cell) const;
  void append(const CellView& cell);
  void append(const CellStore& other);
  /// Faces of all cells before this one: cell c's face f has the global number face_begin(c) + f.
  std::int64_t face_begin(Index cell) const { return face_begin_[cell]; }

 private:
  std::vector<Vertex> vertices_;
  std::vector<ConvexCell::Face> faces_;
  std::vector<ConvexCell::Corner> corners_;
  std::vector<std::int64_t> vertex_begin_{0}, face_begin_{0}, corner_begin_{0};
};

/// A convex area shared by two cells on one plane. Real where a joint lies there, virtual (glue) where none does.
struct Fragment {
  Index cell[2] = {none, none};  ///< below and above the plane
  Index face[2] = {none, none};  ///< local face of each
  Index joint = none;            ///< into Complex::origins; none = virtual: the cells are one body
  Index instance = none;         ///< of joints: the plane or disc of the set, counted over all placed joints
  Index polygon = none;          ///< into Complex::polygons; none = the whole face of both cells
  Real area = 0;                 ///< m²
};

/// A convex part of a cell's face with no rock on the other side.
struct FreePart {
  Index cell = none;
  Index face = none;     ///< local
  Index origin = none;   ///< into Complex::origins
  Index polygon = none;  ///< into Complex::polygons; none = the whole face
  Real area = 0;
};

/// A convex solid as half-spaces, one a face in the order of face_names().
struct ConvexBody {
  std::vector<HalfSpaceId> inside;
  Index first_origin = none;  ///< into Complex::origins, of face 0
};

struct Complex {
  explicit Complex(PlaneTable table) : planes(std::move(table)) {}

  PlaneTable planes;
  std::vector<Index>
      joint_of_plane;  ///< [planes] origin of the through-going joint on it (the first listed), or none
  std::vector<ConvexBody> bodies;   ///< [solids]
  std::vector<FaceOrigin> origins;  ///< joint sets, joints, then the faces of the solids

  CellStore cells;                   ///< rock only
  std::vector<Index> cell_body;      ///< [cells] the solid whose rock it is
  std::vector<Index> cell_block;     ///< [cells] blocks ordered by centroid
  std::vector<CellMoments> moments;  ///< [cells]
  Index block_count = 0;

  std::vector<Fragment> fragments;   ///< ordered by plane
  std::vector<FreePart> free_parts;  ///< ordered by plane
  std::vector<Polygon> polygons;     ///< of the fragments and free parts that are no whole face

  Polygon polygon_of(const Fragment& f) const;
  Polygon polygon_of(const FreePart& f) const;
};

}  // namespace rockfold
