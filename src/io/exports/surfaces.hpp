// The faces of blocks as polygons without holes.
#pragma once

#include "src/arrays/polygon_mesh.hpp"

namespace rockfold {

/// A face without holes is one polygon, be it concave; a face with holes is cut into convex polygons: those of `faces`,
/// joined wherever two make a convex polygon (Hertel & Mehlhorn 1983). No point is added and no edge is split, so
/// that each block's surface stays closed edge by edge.
PolygonMesh simple_polygons(const BlockArrays& blocks, const PolygonMesh& faces);

}  // namespace rockfold
