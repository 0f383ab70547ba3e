// Solids by block operations: what their blocks look like, with exact counts of vertices, edges, faces, shells and genus.
#include <algorithm>
#include <array>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "src/base/vector.hpp"
#include "tests/cut/models/sample_models.hpp"
#include "tests/cut/oracles/complex_check.hpp"
#include "tests/flatten/block_check.hpp"

namespace rockfold::test {
namespace {

const std::vector<std::string> no_faults;

struct Expected {
  Counts counts;
  Index shells = 1, genus = 0;
  Real volume = 0;
  bool convex = false;
};

void expect_block(const BlockArrays& a, Index block, const Expected& e) {
  SCOPED_TRACE(testing::Message() << "block " << block);
  EXPECT_EQ(counts_of(a, block), e.counts);
  EXPECT_EQ(a.shell_count[block], e.shells);
  EXPECT_EQ(a.genus[block], e.genus);
  EXPECT_NEAR(a.volume[block], e.volume, 1e-12 * e.volume);
  EXPECT_EQ(a.convex[block] != 0, e.convex);
}

Blocks checked_cut(const Model& model) {
  Blocks blocks = cut(model);
  EXPECT_EQ(faults_of(blocks.complex()), no_faults);
  EXPECT_EQ(faults_of(blocks.arrays, blocks.complex().planes.model_size()), no_faults);
  return blocks;
}

void expect_one_block(const Model& model, const Expected& e) {
  const Blocks blocks = checked_cut(model);
  ASSERT_EQ(blocks.arrays.block_count(), 1);
  expect_block(blocks.arrays, 0, e);
  EXPECT_NEAR(blocks.cutting.totals.solid_volume, e.volume, 1e-12 * e.volume);
}

Model without(Model model, const Vec3& min, const Vec3& max, const std::string& name = "hole") {
  model.solids.push_back(box_solid(name, min, max, false));
  return model;
}
Model with(Model model, const Vec3& min, const Vec3& max, const std::string& name = "more") {
  model.solids.push_back(box_solid(name, min, max));
  return model;
}

// m² of all faces that lie on a face of a solid.
Real area_on(const BlockArrays& a, Index solid, Index solid_face) {
  Real area = 0;
  for (std::size_t f = 0; f < a.face_area.size(); ++f)
    if (a.origins[a.face_origin[f]].face_of(FaceOrigin::Kind::solid_face, solid) == solid_face)
      area += a.face_area[f];
  return area;
}

// Names of the faces' origins of a block, with their areas summed.
std::map<std::string, Real> areas_by_origin(const BlockArrays& a, Index block) {
  std::map<std::string, Real> areas;
  for (Index f = a.face_begin[block]; f < a.face_begin[block + 1]; ++f)
    areas[a.origins[a.face_origin[f]].name] += a.face_area[f];
  return areas;
}

const Model cube = box_model({0, 0, 0}, {4, 4, 4});

TEST(Solids, ABox) {
  expect_one_block(cube, {{8, 12, 6}, 1, 0, 64, true});
}

TEST(Solids, AnLShape) {
  expect_one_block(without(cube, {2, -1, 2}, {5, 5, 5}), {{12, 18, 8}, 1, 0, 48});
}

// The same L by two boxes that share a face: of two origins where they lie in one plane, so the two sides keep an edge.
TEST(Solids, AnLShapeOfTwoBoxes) {
  expect_one_block(with(box_model({0, 0, 0}, {4, 4, 2}), {0, 0, 2}, {2, 4, 4}),
                   {{14, 23, 11}, 1, 0, 48});
}

TEST(Solids, ABoxWithACavity) {
  expect_one_block(without(cube, {1, 1, 1}, {3, 3, 3}), {{16, 24, 12}, 2, 0, 56});
}

TEST(Solids, ABoxWithTwoCavities) {
  expect_one_block(without(without(box_model({0, 0, 0}, {7, 3, 3}), {1, 1, 1}, {2, 2, 2}),
                           {5, 1, 1}, {6, 2, 2}, "second"),
                   {{24, 36, 18}, 3, 0, 61});
}

// A block afloat in a cavity: two blocks, the outer one of two shells. Both have the same centroid.
TEST(Solids, ABlockInACavity) {
  const Blocks blocks = checked_cut(
      with(without(box_model({0, 0, 0}, {5, 5, 5}), {1, 1, 1}, {4, 4, 4}), {2, 2, 2}, {3, 3, 3}));
  ASSERT_EQ(blocks.arrays.block_count(), 2);
  const Index inner = blocks.arrays.volume[0] < blocks.arrays.volume[1] ? 0 : 1;
  expect_block(blocks.arrays, inner, {{8, 12, 6}, 1, 0, 1, true});
  expect_block(blocks.arrays, 1 - inner, {{16, 24, 12}, 2, 0, 98});
}

TEST(Solids, ABoxWithABlindHole) {
  expect_one_block(without(cube, {1, 1, 2}, {3, 3, 5}), {{16, 24, 11}, 1, 0, 56});
}

TEST(Solids, ABoxWithAThroughTunnel) {
  expect_one_block(without(cube, {1, -1, 1}, {3, 5, 3}), {{16, 24, 10}, 1, 1, 48});
}

TEST(Solids, ABoxWithTwoTunnelsSideBySide) {
  expect_one_block(without(without(box_model({0, 0, 0}, {5, 4, 3}), {1, -1, 1}, {2, 5, 2}),
                           {3, -1, 1}, {4, 5, 2}, "second"),
                   {{24, 36, 14}, 1, 2, 52});
}

// Floor and roof of the crossing belong to both tunnels: five faces each, four edges more than if they were one.
TEST(Solids, ABoxWithTwoCrossingTunnels) {
  expect_one_block(without(without(box_model({0, 0, 0}, {3, 3, 3}), {-1, 1, 1}, {4, 2, 2}),
                           {1, -1, 1}, {2, 4, 2}, "second"),
                   {{32, 52, 20}, 1, 3, 22});
}

TEST(Solids, ABoxWithThreeCrossingTunnels) {
  const Model two = without(without(box_model({0, 0, 0}, {3, 3, 3}), {-1, 1, 1}, {4, 2, 2}),
                            {1, -1, 1}, {2, 4, 2}, "second");
  expect_one_block(without(two, {1, 1, -1}, {2, 2, 4}, "third"), {{40, 72, 30}, 1, 5, 20});
}

// Two upright pillars on a slab that touch along a vertical edge: four faces meet there, two of each pillar. The edge and
// its upper end count once for each pillar; its foot is one vertex.
TEST(Solids, PillarsThatTouchAlongAnEdge) {
  expect_one_block(without(without(cube, {2, 2, 2}, {5, 5, 5}), {-1, -1, 2}, {2, 2, 5}, "second"),
                   {{19, 30, 13}, 1, 0, 48});
}

TEST(Solids, BoxesThatTouchAlongAnEdgeAreTwoBlocks) {
  const Blocks blocks = checked_cut(with(cube, {4, 4, 0}, {8, 8, 4}));
  ASSERT_EQ(blocks.arrays.block_count(), 2);
  for (Index b = 0; b < 2; ++b) expect_block(blocks.arrays, b, {{8, 12, 6}, 1, 0, 64, true});
}

TEST(Solids, BoxesThatTouchAtACornerAreTwoBlocks) {
  const Blocks blocks = checked_cut(with(cube, {4, 4, 4}, {8, 8, 8}));
  ASSERT_EQ(blocks.arrays.block_count(), 2);
  for (Index b = 0; b < 2; ++b) expect_block(blocks.arrays, b, {{8, 12, 6}, 1, 0, 64, true});
}

TEST(Solids, BoxesApartAreTwoBlocks) {
  const Blocks blocks = checked_cut(with(cube, {5, 0, 0}, {8, 4, 4}));
  ASSERT_EQ(blocks.arrays.block_count(), 2);
  expect_block(blocks.arrays, 0, {{8, 12, 6}, 1, 0, 64, true});
  expect_block(blocks.arrays, 1, {{8, 12, 6}, 1, 0, 48, true});
}

// In plan, [0,4]×[0,4] and [4,8]×[2,6]: glued over 2 × 4 m. Top and bottom are of two origins each and keep an edge.
const Model side_by_side = with(cube, {4, 2, 0}, {8, 6, 4});

TEST(Solids, BoxesSideBySideAreOneBlock) {
  expect_one_block(side_by_side, {{16, 26, 12}, 1, 0, 128});
}

TEST(Solids, BoxesSideBySideWithAJointBetweenAreTwoBlocks) {
  Model model = side_by_side;
  add_joint(model, Vec3{1, 0, 0}, {4, 0, 0});
  const Blocks blocks = checked_cut(model);
  ASSERT_EQ(blocks.arrays.block_count(), 2);
  // Each has its side in the joint's plane divided into a joint face and a free one: two vertices, three edges, one face more.
  for (Index b = 0; b < 2; ++b) expect_block(blocks.arrays, b, {{10, 15, 7}, 1, 0, 64, true});
  ASSERT_EQ(blocks.arrays.interfaces.size(), 1u);
  EXPECT_NEAR(blocks.arrays.interfaces[0].area, 8, 1e-12);
  EXPECT_NEAR(blocks.cutting.totals.joint_area, 8, 1e-12);
  EXPECT_NEAR(areas_by_origin(blocks.arrays, 0).at("F1"), 8, 1e-12);
  EXPECT_NEAR(areas_by_origin(blocks.arrays, 0).at("rock.xmax"), 8, 1e-12);
  EXPECT_NEAR(areas_by_origin(blocks.arrays, 1).at("more.xmin"), 8, 1e-12);
}

TEST(Solids, OverlappingBoxesAreOneBlock) {
  const Blocks blocks = checked_cut(with(cube, {2, 2, 2}, {6, 6, 6}));
  ASSERT_EQ(blocks.arrays.block_count(), 1);
  expect_block(blocks.arrays, 0, {{20, 30, 12}, 1, 0, 120});
}

TEST(Solids, ABoxAddedInsideAnotherChangesNoSurface) {
  expect_one_block(with(cube, {1, 1, 1}, {3, 3, 3}), {{8, 12, 6}, 1, 0, 64, true});
}

// What is taken away and added again, by halves.
TEST(Solids, AHoleFilledAgain) {
  const Model filled = with(with(without(cube, {1, 1, 1}, {3, 3, 3}), {1, 1, 1}, {2, 3, 3}, "left"),
                            {2, 1, 1}, {3, 3, 3}, "right");
  expect_one_block(filled, {{8, 12, 6}, 1, 0, 64, true});
}

TEST(Solids, OperationsActInTheirOrder) {
  Model added_last = without(cube, {2, -1, -1}, {5, 5, 5});
  added_last = with(added_last, {2, 0, 0}, {3, 4, 4});
  EXPECT_NEAR(sum(cut(added_last).arrays.volume), 48, 1e-11);
  Model taken_last = with(cube, {2, 0, 0}, {3, 4, 4});
  taken_last = without(taken_last, {2, -1, -1}, {5, 5, 5});
  EXPECT_NEAR(sum(cut(taken_last).arrays.volume), 32, 1e-11);
}

TEST(Solids, APrism) {
  Model model;
  Solid solid;
  solid.name = "wedge";
  solid.shape = PrismShape{{{0, 0, 0}, {3, 0, 0}, {0, 2, 0}}, {1, 0.5, 4}};  // leaning
  solid.continues.assign(5, false);
  model.solids.push_back(solid);
  expect_one_block(model, {{6, 9, 5}, 1, 0, 12, true});
  const BlockArrays a = cut(model).arrays;
  const auto areas = areas_by_origin(a, 0);
  EXPECT_NEAR(areas.at("wedge.3"), 3, 1e-12);  // the base
  EXPECT_NEAR(areas.at("wedge.4"), 3, 1e-12);  // the far end
  EXPECT_NEAR(areas.at("wedge.0"), 3 * norm(Vec3{0, 0.5, 4}), 1e-12);
}

TEST(Solids, APrismOfEitherSense) {
  for (const bool reversed : {false, true})
    for (const Real up : {-2.0, 2.0}) {
      std::vector<Vec3> base{{0, 0, 1}, {2, 0, 1}, {3, 1, 1}, {2, 2, 1}, {0, 2, 1}};
      if (reversed) std::reverse(base.begin(), base.end());
      Model model;
      Solid solid;
      solid.name = "house";
      solid.shape = PrismShape{base, {0, 0, up}};
      solid.continues.assign(7, false);
      model.solids.push_back(solid);
      expect_one_block(model, {{10, 15, 7}, 1, 0, 10, true});
    }
}

// A square pyramid: four planes meet in the apex.
TEST(Solids, APyramidOfHalfSpaces) {
  Model model;
  model.solids.push_back(convex_solid("pyramid", {{{0, 0, -1}, {0, 0, 0}},
                                                  {{3, 0, 1}, {1, 0, 0}},
                                                  {{-3, 0, 1}, {-1, 0, 0}},
                                                  {{0, 3, 1}, {0, 1, 0}},
                                                  {{0, -3, 1}, {0, -1, 0}}}));
  expect_one_block(model, {{5, 8, 5}, 1, 0, 4, true});
  EXPECT_NEAR(areas_by_origin(cut(model).arrays, 0).at("pyramid.0"), 4, 1e-12);
}

// A half-space that touches the solid, and one far outside: neither adds a face.
TEST(Solids, HalfSpacesThatBoundNothing) {
  Model model;
  model.solids.push_back(convex_solid("tetrahedron", {{{-1, 0, 0}, {}},
                                                      {{0, -1, 0}, {}},
                                                      {{0, 0, -1}, {}},
                                                      {{1, 1, 1}, {1, 0, 0}},
                                                      {{1, 1, 0}, {1, 0, 0}},     // along an edge
                                                      {{1, 0, 0}, {7, 0, 0}},     // far away
                                                      {{1, 1, 1}, {1, 0, 0}}}));  // given twice
  expect_one_block(model, {{4, 6, 4}, 1, 0, 1.0 / 6, true});
}

// ---- joints in solids

TEST(JointsInSolids, CoplanarWithAStepDivideAnL) {
  Model model = without(cube, {2, -1, 2}, {5, 5, 5}, "step");
  add_joint(model, Vec3{0, 0, 1}, {0, 0, 2});
  const Blocks blocks = checked_cut(model);
  ASSERT_EQ(blocks.arrays.block_count(), 2);
  expect_block(blocks.arrays, 0, {{10, 15, 7}, 1, 0, 32, true});  // its top: half joint, half tread
  expect_block(blocks.arrays, 1, {{8, 12, 6}, 1, 0, 16, true});
  EXPECT_NEAR(blocks.cutting.totals.joint_area, 8, 1e-12);
  const auto areas = areas_by_origin(blocks.arrays, 0);
  EXPECT_NEAR(areas.at("F1"), 8, 1e-12);
  EXPECT_NEAR(areas.at("step.zmin"), 8, 1e-12);
  EXPECT_EQ(areas.count("rock.zmax"), 0u);
}

// Treads at z = 2, 4 and 6, risers at x = 0, 2 and 4.
const Model stairs =
    without(without(box_model({0, 0, 0}, {6, 2, 6}), {-1, -1, 2}, {2, 3, 7}, "low"), {-1, -1, 4},
            {4, 3, 7}, "high");

TEST(JointsInSolids, Stairs) {
  expect_one_block(stairs, {{16, 24, 10}, 1, 0, 48});
}

TEST(JointsInSolids, CoplanarWithTheTreadsOfStairs) {
  Model model = stairs;
  add_set(model, DipOrientation{0, 0}, 2, {0, 0, 0});
  const Blocks blocks = checked_cut(model);
  ASSERT_EQ(blocks.arrays.block_count(), 3);
  expect_block(blocks.arrays, 0, {{10, 15, 7}, 1, 0, 24, true});
  expect_block(blocks.arrays, 1, {{10, 15, 7}, 1, 0, 16, true});
  expect_block(blocks.arrays, 2, {{8, 12, 6}, 1, 0, 8, true});
}

TEST(JointsInSolids, CoplanarWithTreadsAndRisersOfStairs) {
  Model model = stairs;
  add_set(model, DipOrientation{0, 0}, 2, {0, 0, 0});
  add_set(model, DipOrientation{90, 90}, 2, {0, 0, 0});
  const Blocks blocks = checked_cut(model);
  ASSERT_EQ(blocks.arrays.block_count(), 6);
  for (Index b = 0; b < 6; ++b) expect_block(blocks.arrays, b, {{8, 12, 6}, 1, 0, 8, true});
  EXPECT_EQ(blocks.arrays.interfaces.size(), 6u);
}

// z = x passes through the inner corners of the stairs: three wedges above that touch along lines, one block below.
TEST(JointsInSolids, ThroughTheInnerCornersOfStairs) {
  Model model = stairs;
  add_joint(model, Vec3{-1, 0, 1}, {0, 0, 0});
  const Blocks blocks = checked_cut(model);
  ASSERT_EQ(blocks.arrays.block_count(), 4);
  std::vector<Real> volumes = blocks.arrays.volume;
  std::sort(volumes.begin(), volumes.end());
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(volumes[i], 4, 1e-11);
  EXPECT_NEAR(volumes[3], 36, 1e-11);
  for (Index b = 0; b < 4; ++b)
    EXPECT_EQ(counts_of(blocks.arrays, b), (Counts{6, 9, 5})) << "block " << b;
}

TEST(JointsInSolids, ThroughACavity) {
  Model model = without(cube, {1, 1, 1}, {3, 3, 3});
  add_joint(model, Vec3{0, 0, 1}, {0, 0, 2});
  const Blocks blocks = checked_cut(model);
  ASSERT_EQ(blocks.arrays.block_count(), 2);
  for (Index b = 0; b < 2; ++b) expect_block(blocks.arrays, b, {{16, 24, 11}, 1, 0, 28});
  ASSERT_EQ(blocks.arrays.interfaces.size(), 1u);
  EXPECT_NEAR(blocks.arrays.interfaces[0].area, 12, 1e-12);
}

TEST(JointsInSolids, OnTheWallsOfATunnel) {
  Model model = without(cube, {1, -1, 1}, {3, 5, 3});
  for (const Real at : {1.0, 3.0}) {
    add_joint(model, Vec3{1, 0, 0}, {at, 0, 0});
    add_joint(model, Vec3{0, 0, 1}, {0, 0, at});
  }
  const Blocks blocks = checked_cut(model);
  ASSERT_EQ(blocks.arrays.block_count(), 8);
  for (Index b = 0; b < 8; ++b) EXPECT_EQ(counts_of(blocks.arrays, b), (Counts{8, 12, 6}));
  EXPECT_EQ(blocks.arrays.interfaces.size(), 8u);
}

// The joints of a tunnel's roof and floor alone: the tunnel divides the layer between them in two, which the joints bound.
TEST(JointsInSolids, OnTheRoofAndFloorOfATunnel) {
  Model model = without(cube, {1, -1, 1}, {3, 5, 3});
  for (const Real at : {1.0, 3.0}) add_joint(model, Vec3{0, 0, 1}, {0, 0, at});
  const Blocks blocks = checked_cut(model);
  ASSERT_EQ(blocks.arrays.block_count(), 4);
  // Floor slab: its top has two joint faces and the tunnel's floor between them.
  expect_block(blocks.arrays, 0, {{12, 18, 8}, 1, 0, 16, true});
  expect_block(blocks.arrays, 1, {{8, 12, 6}, 1, 0, 8, true});
  expect_block(blocks.arrays, 2, {{8, 12, 6}, 1, 0, 8, true});
  expect_block(blocks.arrays, 3, {{12, 18, 8}, 1, 0, 16, true});
}

// A joint that ends nowhere but crosses a C-shaped solid, and leaves it in one piece: no block's face.
TEST(JointsInSolids, ThatDivideNothingAreDangling) {
  Model model = without(box_model({0, 0, 0}, {6, 2, 6}), {2, -1, 2}, {7, 3, 4},
                        "slot");                        // a C open to the east
  model = with(model, {6, 0, 0}, {8, 2, 6}, "bridge");  // closed to a ring
  add_joint(model, Vec3{1, 0, 0}, {6, 0, 0});
  const Blocks cut_twice = checked_cut(model);
  ASSERT_EQ(cut_twice.arrays.block_count(), 2);
  EXPECT_EQ(cut_twice.cutting.totals.dangling_joint_area, 0);
}

// ---- names, materials, rock that goes on

TEST(FaceOrigins, AreTheSolidsFacesAndTheJoints) {
  Model model = without(cube, {1, 1, 2}, {3, 3, 5}, "shaft");
  add_set(model, DipOrientation{90, 90}, 4, {2, 0, 0});
  add_joint(model, DipOrientation{90, 0}, {2, 2, 2});
  const BlockArrays a = checked_cut(model).arrays;
  ASSERT_EQ(a.block_count(), 4);
  for (Index b = 0; b < 4; ++b) {
    const bool east = a.centroid[b][0] > 2, north = a.centroid[b][1] > 2;
    std::map<std::string, Real> expected{
        {"rock.zmin", 4}, {"rock.zmax", 3}, {"J1", 6}, {"F1", 6}, {"shaft.zmin", 1}};
    expected[east ? "rock.xmax" : "rock.xmin"] = 8;
    expected[north ? "rock.ymax" : "rock.ymin"] = 8;
    expected[east ? "shaft.xmax" : "shaft.xmin"] = 2;
    expected[north ? "shaft.ymax" : "shaft.ymin"] = 2;
    const auto found = areas_by_origin(a, b);
    ASSERT_EQ(found.size(), expected.size());
    for (const auto& [name, area] : expected) {
      ASSERT_EQ(found.count(name), 1u) << name;
      EXPECT_NEAR(found.at(name), area, 1e-12) << name;
    }
  }
}

// Two shafts of one depth whose floors cut first, so that both floors are part of one cell's face: each has its own name.
TEST(FaceOrigins, OfTwoFloorsInOneFaceOfACellAreEachItsOwn) {
  Model model = box_model({0, 0, 0}, {10, 4, 4});
  for (const auto& [name, west] : {std::pair{"A", 1.0}, {"B", 7.0}}) {
    model.solids.push_back(convex_solid(name, {{{0, 0, -1}, {0, 0, 1}},
                                               {{-1, 0, 0}, {west, 0, 0}},
                                               {{1, 0, 0}, {west + 2, 0, 0}},
                                               {{0, -1, 0}, {0, 1, 0}},
                                               {{0, 1, 0}, {0, 3, 0}},
                                               {{0, 0, 1}, {0, 0, 9}}}));
    model.solids.back().add = false;
  }
  const BlockArrays a = checked_cut(model).arrays;
  ASSERT_EQ(a.block_count(), 1);
  EXPECT_EQ(counts_of(a, 0), (Counts{24, 36, 16}));
  const auto areas = areas_by_origin(a, 0);
  EXPECT_NEAR(areas.at("A.0"), 4, 1e-12);
  EXPECT_NEAR(areas.at("B.0"), 4, 1e-12);
}

// A trench dug along a shaft's floor level: one face of the trench, with both names as a part of it is both's, and what the shaft alone has.
TEST(FaceOrigins, OfAFloorDugTwiceAreBoth) {
  const Model model =
      without(without(box_model({0, 0, 0}, {9, 4, 4}), {1, 1, 2}, {6, 3, 5}, "first"), {4, 1, 2},
              {8, 3, 5}, "last");
  const BlockArrays a = checked_cut(model).arrays;
  const auto areas = areas_by_origin(a, 0);
  EXPECT_NEAR(areas.at("first.zmin"), 6, 1e-12);
  EXPECT_NEAR(areas.at("last.zmin, first.zmin"), 8, 1e-12);
  EXPECT_EQ(areas.count("last.zmin"), 0u);
  EXPECT_NEAR(area_on(a, 1, 4), 14, 1e-12);
  EXPECT_NEAR(area_on(a, 2, 4), 8, 1e-12);
}

// A layer of the rock reaches its sides: they stay the rock's, and where the rock continues, so does the layer.
TEST(FaceOrigins, OfALayerWithinTheRockAreThoseOfTheRockToo) {
  Model model = with(box_model({0, 0, 0}, {4, 1, 2}), {0, 0, 0.5}, {4, 1, 1.5}, "layer");
  model.solids[0].continues = {true, false, false, false, false, false};
  const Blocks blocks = checked_cut(model);
  const std::array of_rock{2, 2, 8, 8, 4, 4};
  const std::array of_layer{1, 1, 4, 4};
  for (int face = 0; face < 6; ++face)
    EXPECT_NEAR(area_on(blocks.arrays, 0, face), of_rock[face], 1e-12);
  for (int face = 0; face < 4; ++face)
    EXPECT_NEAR(area_on(blocks.arrays, 1, face), of_layer[face], 1e-12);
  for (const FaceOrigin& origin : blocks.arrays.origins)
    if (origin.name == "layer.xmin, rock.xmin") {
      EXPECT_TRUE(origin.continues);
    }
  EXPECT_EQ(blocks.arrays.finite[0], 0);
}

// Of two boxes beside each other one is taken away: the other's side does not become a face of what was behind it.
TEST(FaceOrigins, AreThoseOfSurfacesThatTheRockIsInside) {
  const Model model = without(with(box_model({0, 0, 0}, {1, 1, 1}), {1, 0, 0}, {2, 1, 1}, "gone"),
                              {1, 0, 0}, {2, 1, 1}, "cut");
  const BlockArrays a = checked_cut(model).arrays;
  EXPECT_NEAR(area_on(a, 0, 1), 1, 1e-12);
  EXPECT_NEAR(area_on(a, 2, 0), 1, 1e-12);
  EXPECT_EQ(area_on(a, 1, 0), 0);
}

TEST(FaceOrigins, KeepTheirJointMaterial) {
  Model model = cube;
  add_set(model, DipOrientation{0, 0}, 10, {0, 0, 2});
  model.joint_sets[0].material = 3;
  const BlockArrays a = cut(model).arrays;
  const auto joint = std::find_if(a.origins.begin(), a.origins.end(),
                                  [](const FaceOrigin& o) { return o.name == "J1"; });
  ASSERT_NE(joint, a.origins.end());
  EXPECT_EQ(joint->kind, FaceOrigin::Kind::joint);
  EXPECT_EQ(joint->joint_material, 3);
  const auto face = std::find_if(a.origins.begin(), a.origins.end(),
                                 [](const FaceOrigin& o) { return o.name == "rock.ymax"; });
  ASSERT_NE(face, a.origins.end());
  EXPECT_EQ(face->kind, FaceOrigin::Kind::solid_face);
  EXPECT_EQ(face->joint_material, none);
  EXPECT_EQ(face->solid, 0);
  EXPECT_EQ(face->solid_face, 3);
}

// The joint listed first gives its name to a plane given twice.
TEST(FaceOrigins, OfJointsInOnePlaneAreTheFirstListed) {
  for (const bool swapped : {false, true}) {
    Model model = cube;
    add_joint(model, Vec3{0, 0, 1}, {0, 0, 2});
    add_joint(model, Vec3{0, 0, -2}, {1, 1, 2 + 1e-11});
    if (swapped) std::swap(model.joints[0], model.joints[1]);
    const auto areas = areas_by_origin(cut(model).arrays, 0);
    EXPECT_EQ(areas.count(swapped ? "F2" : "F1"), 1u);
    EXPECT_EQ(areas.count(swapped ? "F1" : "F2"), 0u);
  }
}

TEST(Materials, AreOfTheLastSolidAdded) {
  Model model = cube;  // 64 m³ of material 0, of which the last metre is replaced
  model.solids.push_back(box_solid("concrete", {3, 0, 0}, {4, 4, 4}));
  model.solids[1].material = 1;
  EXPECT_EQ(cut(model).arrays.material,
            std::vector<Index>{0});  // one block: that of its largest part
  add_joint(model, Vec3{1, 0, 0}, {3, 0, 0});
  EXPECT_EQ(cut(model).arrays.material, (std::vector<Index>{0, 1}));
  std::swap(model.solids[0], model.solids[1]);  // now the cube comes last and fills all
  EXPECT_EQ(cut(model).arrays.material, (std::vector<Index>{0, 0}));
}

TEST(Materials, OfABlockOfTwoAreThoseOfTheLargerPart) {
  Model model = cube;
  model.solids.push_back(box_solid("concrete", {0, 0, 1}, {4, 4, 4}));
  model.solids[1].material = 1;
  EXPECT_EQ(cut(model).arrays.material, std::vector<Index>{1});
}

TEST(Materials, OfABlockOfTwoBothWeigh) {
  Model model = box_model({0, 0, 0}, {1, 1, 1});
  model.solids.push_back(box_solid("top", {0, 0, 1}, {1, 1, 1.5}));
  model.solids[1].material = 1;
  model.materials = {{"rock", 2500, 0, 0, {}}, {"heavy", 10000, 0, 0, {}}};
  const BlockArrays a = cut(model).arrays;
  ASSERT_EQ(a.block_count(), 1);
  EXPECT_NEAR(a.mass[0], 7500, 1e-9);
}

TEST(FiniteBlocks, TouchNoFaceBeyondWhichTheRockGoesOn) {
  Model model = box_model({0, 0, 0}, {3, 3, 3});
  for (const DipOrientation& o : {DipOrientation{0, 0}, {90, 0}, {90, 90}})
    add_set(model, o, 1, {});
  model.solids[0].continues = {true, true, true, true, true, false};  // all but the top
  const BlockArrays a = cut(model).arrays;
  ASSERT_EQ(a.block_count(), 27);
  for (Index b = 0; b < 27; ++b) {
    const Vec3& c = a.centroid[b];
    const bool inner = c[0] > 1 && c[0] < 2 && c[1] > 1 && c[1] < 2 && c[2] > 1;
    EXPECT_EQ(a.finite[b] != 0, inner) << "block " << b;
  }
}

TEST(FiniteBlocks, MayTouchAFaceThatGoesOnAlongAnEdgeOnly) {
  Model model = cube;
  model.solids[0].continues = {true, false, false, false, false, false};
  add_joint(model, Vec3{-1, 0, 1},
            {0, 0, 0});  // from the lower edge of xmin: the wedge below meets xmin in a line
  const BlockArrays a = cut(model).arrays;
  ASSERT_EQ(a.block_count(), 2);
  EXPECT_TRUE(a.finite[0]);
  EXPECT_FALSE(a.finite[1]);
}

}  // namespace
}  // namespace rockfold::test
