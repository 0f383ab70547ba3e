// What regions do to blocks: solids of several materials, interfaces, `within`, merges, excavations in stages; and shapes
// of every kind against closed forms.
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "src/base/error.hpp"
#include "tests/cut/models/sample_models.hpp"
#include "tests/cut/oracles/complex_check.hpp"

namespace rockfold::test {
namespace {

const std::vector<std::string> no_faults;

Solid solid_of(std::string name, Shape shape, bool add = true) {
  Solid solid;
  solid.name = std::move(name);
  solid.add = add;
  solid.continues.assign(face_names(shape).size(), false);
  solid.shape = std::move(shape);
  return solid;
}

Excavation excavation_of(std::string name, Index stage, Shape shape) {
  Excavation excavation;
  excavation.name = std::move(name);
  excavation.stage = stage;
  excavation.shape = std::move(shape);
  return excavation;
}

void add_merge(Model& model, const Vec3& min, const Vec3& max) {
  Merge merge;
  merge.region = Merge::Box{min, max};
  model.merges.push_back(merge);
}

Blocks checked_cut(const Model& model) {
  Blocks blocks = cut(model);
  EXPECT_EQ(faults_of(blocks.complex()), no_faults);
  EXPECT_NEAR(sum(blocks.arrays.volume) / blocks.cutting.totals.solid_volume, 1, 1e-12);
  return blocks;
}

// A lining beside rock: another material, one block.
TEST(MaterialBoundary, IsWelded) {
  Model model = box_model({0, 0, 0}, {4, 4, 4});
  model.solids.push_back(box_solid("lining", {1, 1, 0}, {3, 3, 4}));
  const Blocks blocks = checked_cut(model);
  ASSERT_EQ(blocks.arrays.block_count(), 1);
  EXPECT_EQ(blocks.cutting.totals.joint_area, 0);
}

TEST(MaterialBoundary, WithAnInterfaceSeparatesBlocks) {
  Model model = box_model({0, 0, 0}, {4, 4, 4});
  model.joint_materials.resize(2);
  model.solids.push_back(box_solid("lining", {1, 1, 0}, {3, 3, 4}));
  model.solids[1].interface = 1;
  const Blocks blocks = checked_cut(model);
  ASSERT_EQ(blocks.arrays.block_count(), 2);
  EXPECT_DOUBLE_EQ(blocks.cutting.totals.joint_area, 4 * 2 * 4);
  std::map<std::string, Real> area;
  for (const auto& shared : blocks.arrays.interfaces) {
    const FaceOrigin& origin = blocks.arrays.origins[blocks.arrays.face_origin[shared.face[0]]];
    EXPECT_EQ(origin.joint_material, 1);
    area[origin.name] += shared.area;
  }
  EXPECT_EQ(area.size(), 1u);
  EXPECT_DOUBLE_EQ(area["lining.interface"], 32);
}

TEST(Within, CutsInsideThatSolidAlone) {
  Model model = box_model({0, 0, 0}, {4, 4, 4});
  model.solids.push_back(box_solid("ore", {0, 0, 0}, {2, 4, 4}));
  add_joint(model, Vec3{0, 0, 1}, {0, 0, 2});
  model.joints[0].within = 1;
  Blocks blocks = checked_cut(model);
  ASSERT_EQ(blocks.arrays.block_count(), 1);  // held together by the rock beside the ore
  EXPECT_DOUBLE_EQ(blocks.cutting.totals.dangling_joint_area, 8);
  EXPECT_DOUBLE_EQ(blocks.arrays.dead_end_area[0], 8);
  model.joint_materials.resize(1);
  model.solids[1].interface = 0;
  EXPECT_EQ(checked_cut(model).arrays.block_count(), 3);
}

// A cube on a larger one, far from the origin: its foot is turned from the other's roof by 3e-10, by rounding alone.
TEST(Solids, ThatShareAFaceAtMapCoordinatesAreOneBlock) {
  std::mt19937 random(4);
  std::normal_distribution<Real> gauss;
  for (int i = 0; i < 20; ++i) {
    const Vec3 u = normalized({gauss(random), gauss(random), gauss(random)});
    const Vec3 v = normalized(cross(u, {gauss(random), gauss(random), gauss(random)}));
    const Vec3 w = cross(u, v);
    const auto cube = [&](const char* name, Real from, Real foot, Real edge) {
      const Vec3 o = Vec3{512345, 5412345, 321} + from * u + from * v + foot * w;
      Solid solid = box_solid(name, {}, {});
      PrismShape prism;
      prism.base = {o, o + edge * u, o + edge * u + edge * v, o + edge * v};
      prism.extrude = edge * w;
      solid.continues.assign(6, false);
      solid.shape = prism;
      return solid;
    };
    Model model;
    model.solids.push_back(cube("large", 0, 0, 40));
    model.solids.push_back(cube("small", 17.3, 40, 3));
    const Blocks blocks = cut(model);
    ASSERT_EQ(blocks.arrays.block_count(), 1) << i;
    EXPECT_NEAR(sum(blocks.arrays.face_area), 6 * 40 * 40 + 4 * 3 * 3, 1e-4) << i;
  }
}

TEST(Merge, MakesJointsInsideABoxIntact) {
  Model model = box_model({0, 0, 0}, {4, 4, 4});
  for (const Real at : {1.0, 2.0, 3.0}) add_joint(model, Vec3{1, 0, 0}, {at, 0, 0});
  add_merge(model, {1, 0, 0}, {3, 4, 4});  // the joints on its boundary stay
  Blocks blocks = checked_cut(model);
  ASSERT_EQ(blocks.arrays.block_count(), 3);
  EXPECT_DOUBLE_EQ(blocks.cutting.totals.joint_area, 32);
  // Half the height: the joint's lower half stays, as a dead end of what is joined above.
  model.merges.clear();
  add_merge(model, {1, 0, 2}, {3, 4, 4});
  blocks = checked_cut(model);
  ASSERT_EQ(blocks.arrays.block_count(), 3);
  EXPECT_DOUBLE_EQ(blocks.cutting.totals.dangling_joint_area, 8);
}

TEST(Merge, JoinsTheBlocksThatHoldGivenPoints) {
  Model model = box_model({0, 0, 0}, {4, 4, 4});
  for (const Real at : {1.0, 2.0, 3.0}) add_joint(model, Vec3{1, 0, 0}, {at, 0, 0});
  model.merges.emplace_back();
  model.merges[0].region = Merge::Blocks{{{0.5, 1, 1}, {1.5, 2, 2}}};
  const Blocks blocks = checked_cut(model);
  ASSERT_EQ(blocks.arrays.block_count(), 3);
  EXPECT_DOUBLE_EQ(blocks.cutting.totals.joint_area, 32);
  // Outside the rock; not touching the others.
  for (const Vec3& third : {Vec3{9, 2, 2}, Vec3{3.5, 1, 1}}) {
    model.merges[0].region = Merge::Blocks{{{0.5, 1, 1}, {1.5, 2, 2}, third}};
    EXPECT_THROW(cut(model), Error);
  }
}

// Before joints cut anything: a wall belongs to the rock that stays behind it.
TEST(Excavation, IsToldFromRockThatStays) {
  Model model = box_model({0, 0, 0}, {10, 10, 10});
  model.excavations.push_back(excavation_of("drift", 1, BoxShape{{4, 0, 4}, {6, 10, 6}}));
  using At = UncutRock::At;
  const UncutRock rock = check_cutting(
      model, {{1, 2, 3}, {5, 5, 5}, {4, 5, 5}, {10, 3, 7}, {10 + 1e-6, 3, 7}, {5, 11, 5}});
  EXPECT_NEAR(rock.volume, 960, 1e-9);
  EXPECT_EQ(rock.of_point, (std::vector<At>{At::stays, At::excavated, At::stays, At::stays,
                                            At::outside, At::outside}));
}

TEST(Merge, LeavesTheWallsOfExcavations) {
  Model model = box_model({0, 0, 0}, {10, 10, 10});
  add_joint(model, Vec3{0, 0, 1}, {0, 0, 8});
  model.excavations.push_back(excavation_of("drift", 1, BoxShape{{4, 0, 4}, {6, 10, 6}}));
  add_merge(model, {0, 0, 0}, {10, 10, 9});
  Blocks blocks = checked_cut(model);
  ASSERT_EQ(blocks.arrays.block_count(), 2);
  EXPECT_EQ(blocks.cutting.totals.joint_area, 0);
  const Index drift = blocks.arrays.stage[0] == 1 ? 0 : 1;
  EXPECT_DOUBLE_EQ(blocks.arrays.volume[drift], 40);
  EXPECT_EQ(blocks.arrays.stage[1 - drift], 0);
  model.merges[0].region = Merge::Blocks{{{1, 1, 1}, {5, 5, 5}}};
  EXPECT_THROW(cut(model), Error);
}

// Four bricks and two halves in two courses, bond by half a brick.
TEST(Merge, BuildsABondedWall) {
  Model model = box_model({0, 0, 0}, {6, 1, 2});
  add_set(model, Vec3{1, 0, 0}, 1, {0, 0, 0});
  add_joint(model, Vec3{0, 0, 1}, {0, 0, 1});
  for (const Real x : {0.0, 2.0, 4.0}) add_merge(model, {x, 0, 0}, {x + 2, 1, 1});
  for (const Real x : {1.0, 3.0}) add_merge(model, {x, 0, 1}, {x + 2, 1, 2});
  const Blocks blocks = checked_cut(model);
  ASSERT_EQ(blocks.arrays.block_count(), 7);
  Index halves = 0;
  for (Index b = 0; b < 7; ++b) {
    halves += blocks.arrays.volume[b] < 1.5;
    EXPECT_EQ(face_count(blocks.arrays, b), 6);
  }
  EXPECT_EQ(halves, 2);
}

// Two stages side by side: the earliest counts where they overlap, and blocks end at the boundary of each.
TEST(Excavation, SplitsBlocksByStage) {
  Model model = box_model({0, 0, 0}, {6, 6, 6});
  model.excavations.push_back(excavation_of("late", 2, BoxShape{{1, -1, 1}, {5, 7, 3}}));
  model.excavations.push_back(excavation_of("early", 1, BoxShape{{1, -1, 1}, {3, 7, 3}}));
  const Blocks blocks = checked_cut(model);
  const BlockArrays& a = blocks.arrays;
  ASSERT_EQ(a.block_count(), 3);
  std::map<Index, Real> volume;
  for (Index b = 0; b < 3; ++b) volume[a.stage[b]] += a.volume[b];
  EXPECT_DOUBLE_EQ(volume[1], 24);
  EXPECT_DOUBLE_EQ(volume[2], 24);
  EXPECT_DOUBLE_EQ(volume[0], 216 - 48);
  EXPECT_EQ(blocks.cutting.totals.joint_area, 0);
  std::map<std::string, Real> wall;
  for (const auto& shared : a.interfaces) {
    const FaceOrigin& origin = a.origins[a.face_origin[shared.face[0]]];
    EXPECT_EQ(origin.kind, FaceOrigin::Kind::excavation);
    EXPECT_NE(a.stage[shared.block[0]], a.stage[shared.block[1]]);
    wall[origin.name.substr(0, origin.name.find('.'))] += shared.area;
  }
  EXPECT_DOUBLE_EQ(wall["early"] + wall["late"], 6 * (2 + 4 + 2 + 4) + 6 * 2);
}

// A joint that an excavation's wall lies on is laid bare, not kept.
TEST(Excavation, OnAJointTakesTheWallsName) {
  Model model = box_model({0, 0, 0}, {4, 4, 4});
  add_joint(model, Vec3{1, 0, 0}, {2, 0, 0});
  model.excavations.push_back(excavation_of("adit", 1, BoxShape{{2, 1, 1}, {5, 3, 3}}));
  const Blocks blocks = checked_cut(model);
  ASSERT_EQ(blocks.arrays.block_count(), 3);
  EXPECT_DOUBLE_EQ(blocks.cutting.totals.joint_area, 16 - 4);
}

TEST(Shapes, AreCutToTheirVolumes) {
  const Real pi = std::numbers::pi;
  struct Case {
    const char* what;
    Shape shape;
    Real volume;
    Index faces;
  };
  TunnelShape bent;
  bent.path = {{0, 0, 0}, {10, 0, 0}, {10, 10, 0}};
  bent.section = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  const std::vector<Vec3> l_base{{0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}};
  const Case cases[] = {
      {"concave prism", PrismShape{l_base, {0.5, 0, 2}}, 10, 8},
      {"concave pyramid", PyramidShape{l_base, {1, 1, 3}}, 5, 7},
      {"frustum",
       FrustumShape{{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}},
                    {{1, 1, 3}, {3, 1, 3}, {3, 3, 3}, {1, 3, 3}}},
       28, 6},
      {"cylinder", CylinderShape{{{{0, 0, 0}, {1, 2, 5}}}, 2, 12}, 12 * std::sqrt(30.0), 14},
      {"tunnel", bent, 4 * 20.0, 8},  // floor and roof go round the bend
  };
  for (const auto& [what, shape, volume, faces] : cases) {
    SCOPED_TRACE(what);
    Model model;
    model.solids.push_back(solid_of("rock", shape));
    const Blocks blocks = checked_cut(model);
    ASSERT_EQ(blocks.arrays.block_count(), 1);
    EXPECT_NEAR(blocks.arrays.volume[0] / volume, 1, 1e-12);
    EXPECT_EQ(face_count(blocks.arrays, 0), faces);
    EXPECT_EQ(blocks.arrays.genus[0], 0);
  }
  Model ball;
  ball.solids.push_back(solid_of("ball", SphereShape{{1, 2, 3}, 2, 3}));
  const Blocks blocks = checked_cut(ball);
  ASSERT_EQ(blocks.arrays.block_count(), 1);
  EXPECT_EQ(counts_of(blocks.arrays, 0), (Counts{642, 1920, 1280}));
  EXPECT_TRUE(blocks.arrays.convex[0]);
  EXPECT_NEAR(blocks.arrays.volume[0], 4 * pi / 3 * 8, 0.4);
}

TEST(Shapes, MayBeTakenAwayInsideAndAcross) {
  Model model = box_model({-5, -5, -5}, {5, 5, 5});
  model.solids.push_back(solid_of("cavity", SphereShape{{0, 0, 0}, 2, 2}, false));
  Blocks blocks = checked_cut(model);
  ASSERT_EQ(blocks.arrays.block_count(), 1);
  EXPECT_EQ(blocks.arrays.shell_count[0], 2);
  // Four joints round the cavity to two sides of the box, and a tunnel through all.
  model.solids.push_back(solid_of("bore", CylinderShape{{{{-6, 0, 0}, {6, 0, 0}}}, 1, 16}, false));
  blocks = checked_cut(model);
  ASSERT_EQ(blocks.arrays.block_count(), 1);
  EXPECT_EQ(blocks.arrays.shell_count[0], 1);
  EXPECT_EQ(blocks.arrays.genus[0], 1);
}

// A surface from a file as rock and as void, around all rock and inside of it.
TEST(ClosedSurfaces, HoldTheCellsInsideThem) {
  auto octahedron = std::make_shared<TriangleSurface>();
  octahedron->vertices = {{3, 0, 0}, {-3, 0, 0}, {0, 3, 0}, {0, -3, 0}, {0, 0, 3}, {0, 0, -3}};
  octahedron->triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                           {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  Model model;
  model.solids.push_back(solid_of("ore", MeshShape{"ore.off", octahedron}));
  add_joint(model, Vec3{0, 0, 1}, {0, 0, 1});
  Blocks blocks = checked_cut(model);
  ASSERT_EQ(blocks.arrays.block_count(), 2);
  EXPECT_NEAR(blocks.cutting.totals.solid_volume, 36, 1e-12);
  model.solids[0].name = "void";
  model.solids[0].add = false;
  model.solids.insert(model.solids.begin(), box_solid("rock", {-4, -4, -4}, {4, 4, 4}));
  blocks = checked_cut(model);
  EXPECT_NEAR(blocks.cutting.totals.solid_volume, 512 - 36, 1e-10);
  // All rock inside the void.
  model.solids[0].shape = BoxShape{{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}};
  EXPECT_THROW(cut(model), Error);
}

// An octahedron of 36 m³ about a corner of the rock: an eighth of it is taken away.
TEST(ClosedSurfaces, MayReachFarBeyondTheRock) {
  auto octahedron = std::make_shared<TriangleSurface>();
  octahedron->vertices = {{3, 0, 0}, {-3, 0, 0}, {0, 3, 0}, {0, -3, 0}, {0, 0, 3}, {0, 0, -3}};
  octahedron->triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                           {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  const Solid hole = solid_of("void", MeshShape{"void.off", octahedron}, false);
  for (const Real x : {-1, 1})
    for (const Real y : {-1, 1})
      for (const Real z : {-1, 1}) {
        SCOPED_TRACE(testing::Message() << x << y << z);
        const Vec3 far{4 * x, 4 * y, 4 * z};
        Model model =
            box_model({std::min(0.0, far[0]), std::min(0.0, far[1]), std::min(0.0, far[2])},
                      {std::max(0.0, far[0]), std::max(0.0, far[1]), std::max(0.0, far[2])});
        model.solids.push_back(hole);
        EXPECT_NEAR(checked_cut(model).cutting.totals.solid_volume, 64 - 4.5, 1e-12);
      }
}

}  // namespace
}  // namespace rockfold::test
