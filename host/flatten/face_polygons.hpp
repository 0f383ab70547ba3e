// The faces of blocks as polygons without holes: what results, drawings and exports show.
#pragma once

#include "src/arrays/polygon_mesh.hpp"

namespace rockfold {

/// Convex polygons in the order of the faces: a face that is convex and has no hole is one polygon,
/// any other its triangles (see triangulate.hpp). Faces without area have none.
PolygonMesh face_polygons(const BlockArrays& blocks);

/// The same with every face as triangles.
PolygonMesh face_triangles(const BlockArrays& blocks);

}  // namespace rockfold
