#include "src/io/viewers/block_mesh.hpp"

namespace rockfold {

PolygonMesh joint_polygons(const BlockArrays& blocks, const PolygonMesh& faces) {
  std::vector<std::uint8_t> touches(blocks.face_area.size(), 0);
  for (const auto& interface : blocks.interfaces)
    for (const Index f : interface.face) touches[f] = 1;
  PolygonMesh mesh;
  for (Index p = 0; p < faces.size(); ++p) {
    const Index f = faces.polygon_face[p];
    const Index origin = blocks.face_origin[f];
    const bool joint = origin != none && blocks.origins[origin].kind == FaceOrigin::Kind::joint;
    if (joint && touches[f] && blocks.face_up[f]) mesh.add(faces.polygon(p), f);
  }
  return mesh;
}

std::vector<Index> block_of_face(const BlockArrays& blocks) {
  std::vector<Index> block(blocks.face_area.size());
  for (Index b = 0; b < blocks.block_count(); ++b)
    for (Index f = blocks.face_begin[b]; f < blocks.face_begin[b + 1]; ++f) block[f] = b;
  return block;
}

}  // namespace rockfold
