#include "host/flatten/face_polygons.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include "tests/cut/models/sample_models.hpp"

namespace rockfold::test {
namespace {

/// [F] polygons of each face.
std::vector<int> polygons_of_faces(const PolygonMesh& mesh, const BlockArrays& blocks) {
  std::vector<int> count(blocks.face_area.size(), 0);
  for (const Index f : mesh.polygon_face) ++count[f];
  return count;
}

BlockArrays boxes() {
  Model model = box_model({10, 20, -5}, {14, 21.5, -4});
  add_joint(model, Vec3{1, 0, 0}, {12, 20, -5});
  return cut(model).arrays;
}

/// A box with a square hole through it along z.
BlockArrays tube() {
  Model model = box_model({-1, 0, 1.5}, {3, 4, 4.5});
  model.solids.push_back(box_solid("hole", {0, 1, 1}, {2, 3, 5}, false));
  return cut(model).arrays;
}

TEST(FacePolygons, KeepConvexFacesAsTheyAre) {
  const BlockArrays blocks = boxes();
  const PolygonMesh mesh = face_polygons(blocks);
  EXPECT_EQ(mesh.size(), 12);
  EXPECT_EQ(mesh.polygon_vertex, blocks.corner_vertex);
  EXPECT_EQ(mesh.polygon_begin, blocks.corner_begin);
}

TEST(FacePolygons, TriangulateFacesWithHoles) {
  const BlockArrays blocks = tube();
  const PolygonMesh mesh = face_polygons(blocks);
  EXPECT_EQ(mesh.size(), 2 * 8 + 8);  // two faces with a hole, eight rectangles
  const auto polygons = polygons_of_faces(mesh, blocks);
  for (std::size_t f = 0; f < polygons.size(); ++f)
    EXPECT_EQ(polygons[f], blocks.face_normal[f][2] != 0 ? 8 : 1);
}

TEST(FacePolygons, AsTrianglesOfAllFaces) {
  const BlockArrays blocks = tube();
  const PolygonMesh mesh = face_triangles(blocks);
  const auto triangles = polygons_of_faces(mesh, blocks);
  for (std::size_t f = 0; f < triangles.size(); ++f)
    EXPECT_EQ(triangles[f], blocks.face_normal[f][2] != 0 ? 8 : 2);
  for (Index t = 0; t < mesh.size(); ++t) EXPECT_EQ(mesh.polygon(t).size(), 3u);
}

TEST(FacePolygons, LeaveOutFacesWithoutArea) {
  BlockArrays blocks = boxes();
  const Index l = blocks.loop_begin[3], first = blocks.corner_begin[l];
  blocks.corner_vertex[first + 2] = blocks.corner_vertex[first];  // a, b, a, d
  const auto polygons = polygons_of_faces(face_polygons(blocks), blocks);
  for (std::size_t f = 0; f < polygons.size(); ++f) EXPECT_EQ(polygons[f], f == 3 ? 0 : 1);
  EXPECT_EQ(polygons_of_faces(face_triangles(blocks), blocks)[3], 0);
}

/// As a joint through the corners of a rounded terrain leaves them.
TEST(FacePolygons, LeaveOutFacesWithoutLoops) {
  BlockArrays blocks = boxes();
  blocks.loop_begin.insert(blocks.loop_begin.begin() + 3, blocks.loop_begin[3]);
  blocks.face_normal.insert(blocks.face_normal.begin() + 3, Vec3{0, 0, 1});
  blocks.face_area.insert(blocks.face_area.begin() + 3, 1e-28);
  for (const auto& mesh : {face_polygons(blocks), face_triangles(blocks)}) {
    const auto polygons = polygons_of_faces(mesh, blocks);
    for (std::size_t f = 0; f < polygons.size(); ++f) EXPECT_EQ(polygons[f] == 0, f == 3);
  }
}

TEST(FacePolygons, AreTheSameOnAnyNumberOfThreads) {
  Model model = box_model({0, 0, 0}, {20, 20, 2});
  for (int i = 0; i < 9; ++i)
    for (int j = 0; j < 9; ++j) {
      const Real x = 2 * i + 1.1, y = 2 * j + 1.3;
      model.solids.push_back(
          box_solid("hole" + std::to_string(9 * i + j), {x, y, -1}, {x + 1, y + 0.8, 3}, false));
    }
  for (int k = 1; k < 20; ++k) add_joint(model, Vec3{0.1 * k, 0, 1}, {10, 10, 0.1 * k});
  const BlockArrays blocks = cut(model).arrays;
  const int threads = omp_get_max_threads();
  omp_set_num_threads(1);
  const PolygonMesh one = face_polygons(blocks);
  omp_set_num_threads(4);
  const PolygonMesh four = face_polygons(blocks);
  omp_set_num_threads(threads);
  EXPECT_GT(one.size(), 2 * static_cast<Index>(blocks.face_area.size()));
  EXPECT_EQ(one.polygon_vertex, four.polygon_vertex);
  EXPECT_EQ(one.polygon_begin, four.polygon_begin);
  EXPECT_EQ(one.polygon_face, four.polygon_face);
}

}  // namespace
}  // namespace rockfold::test
