#include "host/flatten/face_polygons.hpp"

#include "host/flatten/triangulate.hpp"
#include "host/parallel.hpp"

namespace rockfold {
namespace {

Index loop_count(const BlockArrays& blocks, Index face) {
  return blocks.loop_begin[face + 1] - blocks.loop_begin[face];
}

/// [F] whether a face is one convex loop.
std::vector<std::uint8_t> convex_faces(const BlockArrays& blocks) {
  const auto faces = static_cast<Index>(blocks.face_area.size());
  std::vector<std::uint8_t> convex(faces);
  parallel_for(faces, 10000, [&](std::int64_t f) {
    const auto face = static_cast<Index>(f);
    convex[f] = loop_count(blocks, face) == 1 && is_convex(face_loop(blocks, blocks.loop_begin[f]),
                                                           blocks.vertex, blocks.face_normal[f]);
  });
  return convex;
}

std::vector<std::array<Index, 3>> triangles_of(const BlockArrays& blocks, Index face) {
  std::vector<Loop> loops;
  for (Index l = blocks.loop_begin[face]; l < blocks.loop_begin[face + 1]; ++l)
    loops.push_back(face_loop(blocks, l));
  return triangulate(loops, blocks.vertex, blocks.face_normal[face]);
}

/// Faces that are marked as they are, the others as triangles.
PolygonMesh mesh_of(const BlockArrays& blocks, const std::vector<std::uint8_t>& as_it_is) {
  const auto faces = static_cast<Index>(as_it_is.size());
  std::vector<Index> others;
  for (Index f = 0; f < faces; ++f)
    if (!as_it_is[f]) others.push_back(f);
  std::vector<std::vector<std::array<Index, 3>>> triangles(others.size());
  parallel_for(static_cast<std::int64_t>(others.size()), 16,
               [&](std::int64_t k) { triangles[k] = triangles_of(blocks, others[k]); });

  PolygonMesh mesh;
  mesh.polygon_begin.reserve(faces + 1);
  mesh.polygon_face.reserve(faces);
  mesh.polygon_vertex.reserve(blocks.corner_vertex.size());
  auto next = triangles.begin();
  for (Index f = 0; f < faces; ++f) {
    if (as_it_is[f]) {
      mesh.add(face_loop(blocks, blocks.loop_begin[f]), f);
    } else {
      for (const auto& triangle : *next++) mesh.add(triangle, f);
    }
  }
  return mesh;
}

}  // namespace

PolygonMesh face_polygons(const BlockArrays& blocks) {
  return mesh_of(blocks, convex_faces(blocks));
}

PolygonMesh face_triangles(const BlockArrays& blocks) {
  return mesh_of(blocks, std::vector<std::uint8_t>(blocks.face_area.size(), 0));
}

}  // namespace rockfold
