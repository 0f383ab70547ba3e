#include <iterator>

#include <gtest/gtest.h>

#include "host/flatten/face_polygons.hpp"
#include "src/base/vector.hpp"
#include "src/io/viewers/block_mesh.hpp"
#include "src/io/viewers/element_mesh.hpp"
#include "tests/io/sample.hpp"

namespace rockfold::test {
namespace {

Real volume_of(const ElementMesh& mesh, std::size_t t) {
  const auto& corner = mesh.tetrahedron[t];
  const Vec3& x = mesh.point[corner[0]];
  return dot(mesh.point[corner[1]] - x,
             cross(mesh.point[corner[2]] - x, mesh.point[corner[3]] - x)) /
         6;
}

TEST(BlockMesh, HasEachJointOnce) {
  const BlockArrays blocks = box_grid(3, 2, 2);
  const PolygonMesh joints = joint_polygons(blocks, face_polygons(blocks));
  EXPECT_EQ(joints.size(), std::ssize(blocks.interfaces));
  Real area = 0, expected = 0;
  for (const Index f : joints.polygon_face) area += blocks.face_area[f];
  for (const auto& interface : blocks.interfaces) expected += interface.area;
  EXPECT_DOUBLE_EQ(area, expected);
}

TEST(BlockMesh, TakesFacesOfUnknownOriginForNoJoint) {
  BlockArrays blocks = box_grid(2, 1, 1);
  blocks.face_origin[1] = none;
  EXPECT_EQ(joint_polygons(blocks, face_polygons(blocks)).size(), 0);
}

TEST(ElementMesh, FillsTheElements) {
  const CoverArrays covers = lattice_with_cut(2);
  const ElementMesh mesh = make_element_mesh(covers);
  // Seven cells of six; a tetrahedron; the rest of one as three.
  ASSERT_EQ(mesh.tetrahedron.size(), 7 * 6 + 1 + 3u);
  // The 27 nodes, of which the cut cell alone has the last, and the middles of three edges; where the two blocks meet, these and the
  // two nodes that the second one shares with whole cells stand once for each.
  EXPECT_EQ(mesh.point.size(), 27 + 3 + 3 + 2u);
  Real volume = 0;
  for (std::size_t t = 0; t < mesh.tetrahedron.size(); ++t) {
    EXPECT_GT(volume_of(mesh, t), 1e-3);
    volume += volume_of(mesh, t);
  }
  EXPECT_NEAR(volume, (7 + 1.0 / 6) * cell_volume(covers.lattice), 1e-13);
  EXPECT_NEAR(volume_of(mesh, 42), cell_volume(covers.lattice) / 48, 1e-14);
  EXPECT_EQ(mesh.element[41], 41);
  EXPECT_EQ(mesh.element[42], 42);
  EXPECT_EQ(mesh.element[45], 42);
  EXPECT_EQ(mesh.block[42], 0);
  EXPECT_EQ(mesh.block[43], 1);
}

TEST(ElementMesh, InterpolatesALinearFieldExactly) {
  const CoverArrays covers = lattice_with_cut(2);
  const ElementMesh mesh = make_element_mesh(covers);
  const auto values = interpolate(mesh, linear_state(covers, 0.25).displacement);
  for (std::size_t k = 0; k < values.size(); ++k) {
    const Vec3 expected = linear_motion(mesh.point[k], 0.25);
    for (int d = 0; d < 3; ++d)
      EXPECT_NEAR(values[k][d], expected[d], 2e-7);  // of numbers up to 1, as float
  }
}

}  // namespace
}  // namespace rockfold::test
