// The joints between blocks as polygons that viewers draw.
#pragma once

#include <vector>

#include "src/arrays/polygon_mesh.hpp"

namespace rockfold {

/// The polygons of the joints: of two faces that touch in a joint only the lower one's, whose
/// outward normal is the plane's own. So each area of a joint stands once, however many blocks meet
/// there.
PolygonMesh joint_polygons(const BlockArrays& blocks, const PolygonMesh& faces);

/// [F] block of each face.
std::vector<Index> block_of_face(const BlockArrays& blocks);

}  // namespace rockfold
