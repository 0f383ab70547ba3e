#include "src/io/block_mesh.hpp"

#include "src/io/triangulate.hpp"

namespace rockfold {
namespace {

void add_polygon(PolygonMesh& mesh, Loop corners, Index face) {
  mesh.polygon_vertex.insert(mesh.polygon_vertex.end(), corners.begin(), corners.end());
  mesh.polygon_begin.push_back(static_cast<Index>(mesh.polygon_vertex.size()));
  mesh.polygon_face.push_back(face);
}

Loop loop(const BlockArrays& blocks, Index l) {
  return Loop(blocks.corner_vertex)
      .subspan(blocks.corner_begin[l], blocks.corner_begin[l + 1] - blocks.corner_begin[l]);
}

std::vector<Loop> loops_of_face(const BlockArrays& blocks, Index face) {
  std::vector<Loop> loops;
  for (Index l = blocks.loop_begin[face]; l < blocks.loop_begin[face + 1]; ++l)
    loops.push_back(loop(blocks, l));
  return loops;
}

}  // namespace

PolygonMesh face_polygons(const BlockArrays& blocks) {
  const auto faces = static_cast<Index>(blocks.face_area.size());
  std::vector<std::uint8_t> as_it_is(faces);  // one convex loop
#pragma omp parallel for schedule(static) if (faces > 10000)
  for (Index f = 0; f < faces; ++f)
    as_it_is[f] =
        blocks.loop_begin[f + 1] - blocks.loop_begin[f] == 1 &&
        is_convex(loop(blocks, blocks.loop_begin[f]), blocks.vertex, blocks.face_normal[f]);
  PolygonMesh mesh;
  mesh.polygon_begin.reserve(faces + 1);
  mesh.polygon_face.reserve(faces);
  mesh.polygon_vertex.reserve(blocks.corner_vertex.size());
  mesh.polygon_begin.push_back(0);
  for (Index f = 0; f < faces; ++f) {
    if (as_it_is[f]) {
      add_polygon(mesh, loop(blocks, blocks.loop_begin[f]), f);
    } else {
      for (const auto& triangle :
           triangulate(loops_of_face(blocks, f), blocks.vertex, blocks.face_normal[f]))
        add_polygon(mesh, triangle, f);
    }
  }
  return mesh;
}

PolygonMesh joint_polygons(const BlockArrays& blocks, const PolygonMesh& faces) {
  std::vector<std::uint8_t> touches(blocks.face_area.size(), 0);
  for (const auto& interface : blocks.interfaces)
    for (const Index f : interface.face) touches[f] = 1;
  PolygonMesh mesh;
  mesh.polygon_begin.push_back(0);
  for (std::size_t p = 0; p < faces.size(); ++p) {
    const Index f = faces.polygon_face[p];
    const Index origin = blocks.face_origin[f];
    const bool joint = origin != none && blocks.origins[origin].kind == FaceOrigin::Kind::joint;
    if (!joint || !touches[f] || !blocks.face_up[f]) continue;
    add_polygon(
        mesh,
        Loop(faces.polygon_vertex)
            .subspan(faces.polygon_begin[p], faces.polygon_begin[p + 1] - faces.polygon_begin[p]),
        f);
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
