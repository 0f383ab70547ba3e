// Where cells touch: the faces on the two sides of a plane tile the same region, and their overlaps are the areas that
// cells share.
#pragma once

#include <functional>
#include <vector>

#include "host/cut/cells/complex.hpp"

namespace rockfold {

/// A convex area shared by two cells.
struct SharedArea {
  Index cell[2], face[2];  ///< below and above the plane; local faces
  Polygon polygon;         ///< empty = the whole face of both
};

/// A convex part of a cell's face with no cell behind it.
struct OpenArea {
  Index cell, face;
  Polygon polygon;  ///< empty = the whole face
};

struct PlaneAreas {
  std::vector<SharedArea> shared;
  std::vector<OpenArea> open;
};

/// Calls use(plane, areas) once for each plane that carries a face, on all threads, in any order. Faces bounded by the
/// same half-spaces match by hash in O(faces); the rest by sweep and clip. Open areas are looked for on planes for which
/// may_be_open(plane): on others the two sides cover each other, and half of the clipping is saved.
void for_each_plane(const PlaneTable& planes, const CellStore& cells,
                    const std::function<bool(Index)>& may_be_open,
                    const std::function<void(Index, PlaneAreas&)>& use);

}  // namespace rockfold
