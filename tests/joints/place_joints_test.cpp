// Discs, polygons, triangles and tables as placed joints.
#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "host/exact/orientation.hpp"
#include "tests/joints/placing.hpp"

namespace rockfold::test {
namespace {

const RockBounds cube = box_rock({0, 0, 0}, {10, 10, 10});

JointSet level_discs(Real radius) {
  JointSet set;
  set.name = "S";
  set.orientation = DipOrientation{0, 0};
  set.spacing = 2;
  set.origin = {5, 5, 1};
  set.radius = radius;
  return set;
}

bool lies_on(const ExactPlane& plane, const Vec3& p) {
  return dot(plane.n, exact(p)) == plane.d;
}

// |n·p − d| / |n|
Real distance(const ExactPlane& plane, const Vec3& p) {
  const Exact miss = dot(plane.n, exact(p)) - plane.d;
  return std::abs(CGAL::to_double(miss)) / std::sqrt(CGAL::to_double(dot(plane.n, plane.n)));
}

TEST(DiscSets, CarryOneDiscAPlaneAlongTheNormalThroughTheOrigin) {
  Model model;
  model.joint_sets = {level_discs(1.5)};
  const PlacedJoints placed = place_joints(model, cube);
  ASSERT_EQ(placed.joints.size(), 5u);  // z = 1, 3, 5, 7, 9
  for (std::size_t i = 0; i < 5; ++i) {
    const auto& polygon = placed.joints[i].polygon;
    ASSERT_EQ(polygon.size(), 16u);
    EXPECT_EQ(polygon[0], (Vec3{5, 6.5, 1 + 2.0 * i})) << "the dip direction as given: north";
    for (const Vec3& p : polygon) {
      EXPECT_TRUE(lies_on(placed.joints[i].plane, p));
      EXPECT_NEAR(norm(p - Vec3{5, 5, 1 + 2.0 * i}), 1.5, 4e-15);
    }
    EXPECT_NEAR(area(polygon), 8 * std::sin(std::numbers::pi / 8) * 2.25, 1e-14);
  }
}

TEST(DiscSets, LeaveOutDiscsOffTheRock) {
  Model model;
  model.joint_sets = {level_discs(1)};
  model.joint_sets[0].orientation = DipOrientation{45, 90};
  model.joint_sets[0].origin = {9, 5, 5};
  // Planes −4 … 2 meet the rock; along (1, 0, 1)/√2 disc 2 lies at x = 11.8 and reaches back by 0.71 only.
  const PlacedJoints placed = place_joints(model, cube);
  ASSERT_EQ(placed.joints.size(), 6u);
  EXPECT_GT(placed.joints.back().polygon[0][0], 11);
}

TEST(DiscSets, HaveTheirFirstCornerDownTheDip) {
  Model model;
  model.joint_sets = {level_discs(2)};
  model.joint_sets[0].orientation = DipOrientation{30, 90};
  model.joint_sets[0].count = 1;
  model.joint_sets[0].sides = 6;
  const Vec3 corner = place_joints(model, cube).joints.at(0).polygon[0];
  EXPECT_NEAR(corner[0], 5 + 2 * std::cos(std::numbers::pi / 6), 2e-15);
  EXPECT_EQ(corner[1], 5);
  EXPECT_NEAR(corner[2], 1 - 2 * 0.5, 1e-15);
  // The same plane by a normal that points down.
  model.joint_sets[0].orientation = -3.0 * upward_normal({30, 90});
  const Vec3 same = place_joints(model, cube).joints.at(0).polygon[0];
  EXPECT_LT(norm(same - corner), 4e-15);
}

TEST(Discs, OfSymmetricOrientationsAreMirrorImagesToTheLastDigit) {
  for (const Index sides : {3, 4, 5, 6, 7, 8, 12, 16, 31}) {
    for (const Real dip : {0.0, 30.0, 45.0, 71.0, 90.0}) {
      Model model;
      Joint joint;
      joint.radius = 1.7;
      joint.sides = sides;
      for (const Real dip_direction : {20.0, 340.0}) {
        joint.plane = {DipOrientation{dip, dip_direction}, {}};
        model.joints.push_back(joint);
      }
      const PlacedJoints placed = place_joints(model, box_rock({-5, -5, -5}, {5, 5, 5}));
      const auto &a = placed.joints.at(0).polygon, &b = placed.joints.at(1).polygon;
      for (Index k = 0; k < sides; ++k) {
        const Vec3 mirror = b[(sides - k) % sides];  // in x
        EXPECT_EQ(a[k], (Vec3{-mirror[0], mirror[1], mirror[2]}))
            << sides << " sides, corner " << k;
      }
    }
  }
}

TEST(Joints, WithAPolygonHaveItProjectedAlongTheNormalOnThePlaneThroughTheirPoint) {
  Model model;
  Joint joint;
  joint.name = "F";
  joint.plane = {Vec3{1, 2, 2}, {1, 1, 1}};
  // An L that lies off the plane by multiples of its normal.
  joint.polygon = {{2, 2, 3}, {6, 2, 1}, {6, 4, -1}, {3, 4, 0.5}, {3, 5, 1}, {2, 5, 1}};
  model.joints = {joint};
  const PlacedJoints placed = place_joints(model, cube);
  const PlacedJoint& one = placed.joints.at(0);
  EXPECT_TRUE(lies_on(one.plane, {1, 1, 1}));
  ASSERT_EQ(one.polygon.size(), joint.polygon.size());
  for (std::size_t i = 0; i < one.polygon.size(); ++i) {
    EXPECT_LT(distance(one.plane, one.polygon[i]), 4e-16 * 10);
    EXPECT_LT(norm(cross(one.polygon[i] - joint.polygon[i], {1, 2, 2})), 1e-14);
  }
}

TEST(Joints, WithPolygonCornersOnThePlaneKeepThemToTheLastDigit) {
  Model model;
  Joint joint;
  joint.plane = {Vec3{0, 0, 3}, {0, 0, 0.1}};
  joint.polygon = {{1.1, 2.3, 0.1}, {1.1, 4.7, 0.1}, {5.3, 0.7, 0.1}};
  model.joints = {joint};
  EXPECT_EQ(place_joints(model, cube).joints.at(0).polygon, joint.polygon);
}

TEST(Joints, AreRefusedWithAPolygonThatTheProjectionFlattensOrThatCrossesItself) {
  Model model;
  Joint joint;
  joint.name = "F";
  joint.plane = {Vec3{0, 0, 1}, {5, 5, 5}};
  joint.polygon = {{1, 1, 1}, {3, 1, 2}, {5, 1, 9}};
  model.joints = {Joint{}, joint};
  model.joints[0].plane = joint.plane;
  expect_refusal(model, cube, "has no area", "joint[2].polygon");
  model.joints[1].polygon = {{1, 1, 5}, {3, 3, 5}, {3, 1, 5}, {1, 3, 5}};
  expect_refusal(model, cube, "crosses or touches itself", "joint[2].polygon");
  model.joints[1].polygon = {};
  model.joints[1].radius = 1e-9;
  expect_refusal(model, cube, "too small", "joint[2].radius");
}

TEST(Joints, CarryTheirSolidAndMaterial) {
  Model model;
  Joint joint;
  joint.plane = {DipOrientation{60, 10}, {5, 5, 5}};
  joint.within = 0;
  joint.material = 3;
  model.joints = {joint};
  const PlacedJoints placed = place_joints(model, cube);
  EXPECT_EQ(placed.joints.at(0).within, 0);
  EXPECT_TRUE(placed.joints[0].polygon.empty());
  EXPECT_EQ(placed.origins.at(0).material, 3);
}

TEST(JointSets, WithinASolidLieWhereThatSolidIs) {
  Model model;
  JointSet set;
  set.orientation = DipOrientation{0, 0};
  set.spacing = 1;
  set.within = 1;
  model.joint_sets = {set};
  RockBounds rock = cube;
  rock.solid_corners.push_back(box_corners({2, 2, 2.5}, {4, 4, 5.5}));
  const PlacedJoints placed = place_joints(model, rock);
  ASSERT_EQ(placed.joints.size(), 3u);  // z = 3, 4, 5
  EXPECT_TRUE(lies_on(placed.joints[0].plane, {0, 0, 3}));
  EXPECT_EQ(placed.joints[0].within, 1);
}

TEST(JointSets, OfDiscsAreNoCellsOfThroughGoingPlanes) {
  Model model;
  for (const DipOrientation& orientation : {DipOrientation{0, 0}, {90, 0}, {90, 90}}) {
    model.joint_sets.push_back(level_discs(0.4));
    model.joint_sets.back().orientation = orientation;
    model.joint_sets.back().spacing = 0.5;
  }
  EXPECT_TRUE(place_joints(model, cube).plane_sets.empty());
  for (JointSet& set : model.joint_sets) set.radius.reset();
  const auto sets = place_joints(model, cube).plane_sets;
  ASSERT_EQ(sets.size(), 3u);
  const CellEstimate cells = estimate_cells(sets, 1000, std::sqrt(300.0));
  EXPECT_NEAR(cells.least, 8000, 1e-6);
  EXPECT_NEAR(cells.about, 8000 + 3 * 21 + 1, 1e-6);  // 21 planes of each meet the cube
  // An eighth of the rock has an eighth of the cells at least.
  EXPECT_NEAR(estimate_cells(sets, 125, std::sqrt(300.0)).least, 1000, 1e-6);
}

TEST(JointSets, ThatDoNotFillTheRockMakeNoLeastNumberOfCells) {
  Model model;
  for (const DipOrientation& orientation : {DipOrientation{0, 0}, {90, 0}, {90, 90}}) {
    model.joint_sets.push_back(level_discs(1));
    model.joint_sets.back().orientation = orientation;
    model.joint_sets.back().spacing = 0.1;
    model.joint_sets.back().radius.reset();
  }
  const auto least = [&] {
    return estimate_cells(place_joints(model, cube).plane_sets, 1000, std::sqrt(300.0)).least;
  };
  EXPECT_GT(least(), 900'000);
  model.joint_sets[0].count = 3;
  // Columns between the planes of two families, none longer than the rock's diagonal.
  EXPECT_NEAR(least(), 1000 / (0.1 * 0.1 * std::sqrt(300.0)), 1e-6);
  model.joint_sets[1].count = 3;
  EXPECT_EQ(least(), 1);
}

TEST(JointSets, OfAbsurdlyManyCellsAreRefusedBeforeTheyArePlaced) {
  Model model;
  for (const DipOrientation& orientation : {DipOrientation{0, 0}, {90, 0}, {90, 90}}) {
    model.joint_sets.push_back(level_discs(1));
    model.joint_sets.back().orientation = orientation;
    model.joint_sets.back().spacing = 1e-4;
    model.joint_sets.back().radius.reset();
  }
  expect_refusal(model, cube, "about 1e+15 cells", "cut.max_cells");
}

TEST(JointMeshes, BecomeTrianglesOnPlanesExactlyThroughTheirCorners) {
  Model model;
  JointMesh mesh;
  mesh.name = "fault";
  auto surface = std::make_shared<TriangleSurface>();
  surface->vertices = {{0.1, 0.2, 0.3}, {4.7, 0.9, 1.1}, {3.3, 5.1, 2.9}, {50, 50, 50}};
  surface->triangles = {{0, 1, 2}, {2, 1, 0}, {3, 3, 3}};
  mesh.surface = surface;
  model.joint_meshes = {mesh};
  const PlacedJoints placed = place_joints(model, cube);
  ASSERT_EQ(placed.joints.size(), 2u) << "the third triangle is off the rock";
  for (const PlacedJoint& joint : placed.joints) {
    EXPECT_EQ(joint.origin, 0);
    for (const Vec3& p : joint.polygon) EXPECT_TRUE(lies_on(joint.plane, p));
  }
  surface->triangles.push_back({0, 1, 1});
  EXPECT_EQ(place_joints(model, cube).joints.size(), 2u) << "a triangle without area cuts nothing";
}

TEST(JointTables, HaveAnOriginForEachMaterialAndRowsWithoutRadiusGoThrough) {
  Model model;
  for (const char* name : {"clean", "clay"}) {
    model.joint_materials.emplace_back();
    model.joint_materials.back().name = name;
  }
  JointTable table;
  table.name = "T";
  table.sides = 5;
  const Real infinite = std::numeric_limits<Real>::infinity();
  table.rows = {{{45, 90}, {5, 5, 5}, 2, 1},
                {{45, 90}, {5, 5, 6}, infinite, 0},
                {{10, 30}, {5, 5, 6}, 1, 1},
                {{10, 30}, {50, 5, 6}, 1, 1}};
  model.joint_tables = {table, table};
  model.joint_tables[1].rows = {table.rows[0]};
  const PlacedJoints placed = place_joints(model, cube);
  ASSERT_EQ(placed.origins.size(), 3u);
  EXPECT_EQ(placed.origins[0].name, "T.clay");
  EXPECT_EQ(placed.origins[1].name, "T.clean");
  EXPECT_EQ(placed.origins[2].name, "T");
  ASSERT_EQ(placed.joints.size(), 4u) << "the fourth row is off the rock";
  EXPECT_EQ(placed.joints[0].polygon.size(), 5u);
  EXPECT_TRUE(placed.joints[1].polygon.empty());
  EXPECT_EQ(placed.joints[1].origin, 1);
  EXPECT_EQ(placed.joints[2].origin, 0);
  EXPECT_EQ(placed.joints[3].origin, 2);
  model.joint_tables[0].rows[2].radius = 1e-12;
  expect_refusal(model, cube, "too small", "joint_table[1].file row 3");
}

TEST(JointTables, HaveAnOriginForEachNameOfTheirRows) {
  Model model;
  for (const char* name : {"clean", "clay"}) {
    model.joint_materials.emplace_back();
    model.joint_materials.back().name = name;
  }
  JointTable table;
  table.name = "T";
  table.rows = {{{45, 90}, {5, 5, 5}, 2, 0, "J2"},
                {{45, 90}, {5, 5, 6}, 2, 0, "J1"},
                {{10, 30}, {5, 5, 6}, 1, 1, "J2"},
                {{10, 30}, {5, 5, 7}, 1, 0, "J1"},
                {{10, 30}, {5, 5, 8}, 1, 0, ""}};
  model.joint_tables = {table};
  const PlacedJoints placed = place_joints(model, cube);
  std::string names;
  for (const JointOrigin& origin : placed.origins) names += origin.name + " ";
  EXPECT_EQ(names, "T.J2.clean T.J1 T.J2.clay T ");
  std::vector<Index> origins;
  for (const PlacedJoint& joint : placed.joints) origins.push_back(joint.origin);
  EXPECT_EQ(origins, (std::vector<Index>{0, 1, 2, 1, 3}));
}

TEST(PlacedJoints, ListSetsThenJointsThenMeshesThenTables) {
  Model model;
  model.joint_sets = {level_discs(1)};
  model.joints.emplace_back();
  model.joints[0].name = "J";
  model.joints[0].plane = {DipOrientation{1, 2}, {5, 5, 5}};
  model.joint_meshes.emplace_back();
  model.joint_meshes[0].name = "M";
  model.joint_meshes[0].surface = std::make_shared<TriangleSurface>();
  model.joint_tables.emplace_back();
  model.joint_tables[0].name = "T";
  std::string names;
  for (const JointOrigin& origin : place_joints(model, cube).origins) names += origin.name;
  EXPECT_EQ(names, "SJMT");
}

}  // namespace
}  // namespace rockfold::test
