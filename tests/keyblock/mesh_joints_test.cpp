// Joints from meshes that are flat but for noise move blocks as planes do; what is bent stays several planes.
#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "host/flatten/lost_contact.hpp"
#include "host/keyblock/first_look.hpp"
#include "host/keyblock/keyblock.hpp"
#include "src/base/vector.hpp"
#include "tests/cut/models/sample_models.hpp"
#include "tests/keyblock/models/half_space_block.hpp"
#include "tests/keyblock/models/rough_square.hpp"

namespace rockfold {
namespace {

using test::add_joint;
using test::add_mesh;
using test::box_solid;
using test::convex_solid;
using test::model_with_joints;
using test::radians;
using test::rough_square;
using test::upward;

/// The one block, or group, that moves or might.
Keyblock only_block(const Model& model) {
  const BlockArrays blocks = test::cut(model).arrays;
  const KeyblockReport report = find_keyblocks(blocks, model);
  EXPECT_EQ(report.keyblocks.size() + report.stable.size(), 1u);
  if (!report.keyblocks.empty()) return report.keyblocks[0];
  return report.stable.empty() ? Keyblock{} : report.stable[0];
}

/// Shares of 1 by which a factor of safety may differ on a mesh with so much noise.
struct NoiseCase {
  Real noise, tolerance;
};
constexpr NoiseCase noise_cases[] = {{0, 1e-3},    {1e-9, 1e-3}, {1e-6, 1e-3},
                                     {1e-4, 1e-3}, {1e-3, 2e-3}, {1e-2, 2e-2}};

const Vec3 fault = upward(35, 310);
constexpr Vec3 middle{5, 5, 5};

/// A cube of 10 m that a fault 35/310 cuts in two; the upper half slides.
Model cube(Real cohesion) {
  Model model = model_with_joints(30, cohesion);
  Solid rock = box_solid("rock", {0, 0, 0}, {10, 10, 10});
  rock.continues[4] = true;
  model.solids.push_back(rock);
  return model;
}

Model cube_on_plane(Real cohesion) {
  Model model = cube(cohesion);
  add_joint(model, fault, middle);
  return model;
}

Model cube_on_mesh(Real cohesion, Real noise, int cells = 2, unsigned seed = 1) {
  Model model = cube(cohesion);
  add_mesh(model, rough_square(fault, middle, 24, cells, noise, seed));
  return model;
}

void expect_slides_as(const Keyblock& key, const Keyblock& plane, Real tolerance) {
  EXPECT_EQ(key.mode, plane.mode);
  EXPECT_EQ(key.batch, plane.batch);
  EXPECT_EQ(key.planes.size(), plane.planes.size());
  EXPECT_NEAR(key.factor_of_safety / plane.factor_of_safety, 1, tolerance);
}

TEST(MeshJoints, FlatButForNoiseCarryBlocksAsThePlaneDoes) {
  for (const Real cohesion : {0.0, 50e3}) {
    const Keyblock plane = only_block(cube_on_plane(cohesion));
    for (const NoiseCase& c : noise_cases)
      for (const unsigned seed : {1u, 2u, 3u}) {
        SCOPED_TRACE(testing::Message() << "noise " << c.noise << ", seed " << seed);
        const Keyblock key = only_block(cube_on_mesh(cohesion, c.noise, 2, seed));
        expect_slides_as(key, plane, c.tolerance);
        EXPECT_EQ(key.planes, std::vector<std::string>{"M1"});
        ASSERT_EQ(key.mesh_planes.size(), 1u);
        EXPECT_EQ(key.mesh_planes[0].mesh, "M1");
        EXPECT_EQ(key.mesh_planes[0].planes, 1);
        EXPECT_NEAR(key.contact[0].area, plane.contact[0].area,
                    2 * c.noise * plane.contact[0].area + 1e-6);
        EXPECT_NEAR(key.free_area, plane.free_area, c.tolerance * plane.free_area);
      }
  }
}

// In millimetres: triangles differ by 1e-4 rad.
TEST(MeshJoints, WrittenInMillimetresCarryBlocksAsThePlaneDoes) {
  const Keyblock plane = only_block(cube_on_plane(50e3));
  Model model = cube(50e3);
  TriangleSurface surface = rough_square(fault, middle, 24, 4, 0);
  for (Vec3& x : surface.vertices)
    for (Real& c : x) c = std::round(1e3 * c) / 1e3;
  add_mesh(model, std::move(surface));
  expect_slides_as(only_block(model), plane, 1e-3);
  // As planes of their own only the triangles that the block slides on would resist.
  model.joint_meshes[0].flatness = 0;
  EXPECT_LT(only_block(model).factor_of_safety, 0.8 * plane.factor_of_safety);
}

// As binary STL has them: triangles differ by 1e-8 rad, and cells between their planes are slivers that both sides show differently.
TEST(MeshJoints, InSinglePrecisionLeanOnAllOfTheirArea) {
  const Vec3 point{5.1, 4.7, 5.3};
  for (unsigned seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    const Vec3 normal = upward(7 + seed * 37 % 60, seed * 131 % 360);
    Model plane = cube(50e3), mesh = cube(50e3);
    add_joint(plane, normal, point);
    TriangleSurface surface = rough_square(normal, point, 31, 1 + static_cast<int>(seed % 5), 0);
    for (Vec3& x : surface.vertices)
      for (Real& c : x) c = static_cast<float>(c);
    add_mesh(mesh, std::move(surface));
    const BlockArrays blocks = test::cut(mesh).arrays;
    EXPECT_TRUE(lost_contact(blocks).empty());
    const KeyblockReport expected = find_keyblocks(test::cut(plane).arrays, plane),
                         found = find_keyblocks(blocks, mesh);
    ASSERT_EQ(found.stable.size(), expected.stable.size());
    for (std::size_t i = 0; i < expected.stable.size(); ++i) {
      expect_slides_as(found.stable[i], expected.stable[i], 1e-5);
      EXPECT_NEAR(found.stable[i].free_area, expected.stable[i].free_area,
                  1e-5 * expected.stable[i].free_area);
    }
  }
}

TEST(MeshJoints, DoNotDependOnTheOrderOfTheirTriangles) {
  const Keyblock key = only_block(cube_on_mesh(50e3, 1e-2));
  Model model = cube_on_mesh(50e3, 1e-2);
  TriangleSurface shuffled = *model.joint_meshes[0].surface;
  std::reverse(shuffled.triangles.begin(), shuffled.triangles.end());
  for (auto& t : shuffled.triangles) std::swap(t[0], t[1]);
  model.joint_meshes[0].surface = std::make_shared<TriangleSurface>(shuffled);
  EXPECT_NEAR(only_block(model).factor_of_safety, key.factor_of_safety, 1e-12);
}

/// 3DEC's wedge: it slides on 40/130 and 60/220; the face dips 70 to 160, the top is at 10 m.
Model wedge_slope() {
  Model model = model_with_joints(20);
  Solid rock = convex_solid("rock", {{upward(70, 160), {}},
                                     {{0, 0, 1}, {0, 0, 10}},
                                     {{1, 0, 0}, {40, 0, 0}},
                                     {{-1, 0, 0}, {-40, 0, 0}},
                                     {{0, 1, 0}, {0, 60, 0}},
                                     {{0, 0, -1}, {0, 0, -20}}});
  rock.continues = {false, false, true, true, true, true};
  model.solids.push_back(rock);
  return model;
}

Keyblock wedge_of(const Model& model) {
  const BlockArrays blocks = test::cut(model).arrays;
  for (const Keyblock& key : find_keyblocks(blocks, model).keyblocks)
    if (key.mode == SlidingMode::two_planes) return key;
  ADD_FAILURE() << "no wedge";
  return {};
}

TEST(MeshJoints, OfTwoMeshesCarryAWedgeAsTwoPlanesDo) {
  Model planes = wedge_slope();
  add_joint(planes, upward(40, 130), {});
  add_joint(planes, upward(60, 220), {});
  const Keyblock plane = wedge_of(planes);
  for (const NoiseCase& c : noise_cases) {
    SCOPED_TRACE(c.noise);
    Model model = wedge_slope();
    add_mesh(model, rough_square(upward(40, 130), {}, 100, 2, c.noise));
    add_mesh(model, rough_square(upward(60, 220), {}, 100, 2, c.noise, 2));
    const Keyblock key = wedge_of(model);
    expect_slides_as(key, plane, c.tolerance);
    EXPECT_EQ(key.planes, (std::vector<std::string>{"M1", "M2"}));
    for (const MeshPlaneCount& mesh : key.mesh_planes) EXPECT_EQ(mesh.planes, 1) << mesh.mesh;
  }
}

TEST(MeshJoints, OfOneMeshThatIsBentCarryAWedgeAsTwoPlanesDo) {
  Model planes = wedge_slope();
  add_joint(planes, upward(40, 130), {});
  add_joint(planes, upward(60, 220), {});
  const Keyblock plane = wedge_of(planes);
  Model model = wedge_slope();
  // Two wings from the line of both, up along each plane.
  const Vec3 n1 = upward(40, 130), n2 = upward(60, 220), line = normalized(cross(n1, n2));
  const Vec3 up1 = cross(line, n1)[2] > 0 ? cross(line, n1) : cross(n1, line),
             up2 = cross(line, n2)[2] > 0 ? cross(line, n2) : cross(n2, line);
  TriangleSurface wings;
  for (const Real t : {-60.0, 60.0})
    for (const Vec3& x : {60.0 * up1, Vec3{}, 60.0 * up2}) wings.vertices.push_back(t * line + x);
  wings.triangles = {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}};
  std::mt19937 random(3);
  for (Vec3& x : wings.vertices)
    for (Real& c : x) c += 1e-4 * (static_cast<Real>(random()) / 4294967296.0 - 0.5);
  add_mesh(model, std::move(wings));
  const Keyblock key = wedge_of(model);
  expect_slides_as(key, plane, 1e-3);
  EXPECT_EQ(key.planes, (std::vector<std::string>{"M1", "M1"}));
  ASSERT_EQ(key.mesh_planes.size(), 1u);
  EXPECT_EQ(key.mesh_planes[0].planes, 2);
}

// Three joints that dip 60 meet 2 m above a roof.
TEST(MeshJoints, LetATetrahedronFallFromARoof) {
  for (const Real noise : {0.0, 1e-6, 1e-4, 1e-3}) {
    SCOPED_TRACE(noise);
    Model model = model_with_joints(20);
    Solid rock = box_solid("rock", {0, 0, 0}, {20, 20, 10});
    rock.continues = {true, true, true, true, false, true};
    model.solids.push_back(rock);
    const Vec3 apex{10.1, 9.7, 2};
    for (int j = 0; j < 3; ++j)
      add_mesh(model, rough_square(upward(60, 30 + 120 * j), apex, 40, 3, noise, 1 + j));
    const Keyblock key = [&] {
      const BlockArrays blocks = test::cut(model).arrays;
      const KeyblockReport report = find_keyblocks(blocks, model);
      EXPECT_EQ(report.keyblocks.size(), 1u);
      return report.keyblocks.empty() ? Keyblock{} : report.keyblocks[0];
    }();
    EXPECT_EQ(key.mode, SlidingMode::lifting);
    EXPECT_TRUE(std::isnan(key.factor_of_safety));
    // Height 2 m: the base is a triangle of side 4 m.
    EXPECT_NEAR(key.volume, 2 * 4 * std::sqrt(3.0) / 3, 40 * noise * 7 + 1e-6);
    EXPECT_EQ(key.contact.size(), 3u);
  }
}

/// A slope of 70 with a fault of straight strips behind it, from its toe on up to the ground.
Model listric(const std::vector<Real>& dips, bool reversed) {
  Model model = model_with_joints(15);
  Solid rock = convex_solid("rock", {{upward(70, 90), {}},
                                     {{0, 0, 1}, {0, 0, 20}},
                                     {{0, 1, 0}, {0, 1, 0}},
                                     {{0, -1, 0}, {}},
                                     {{-1, 0, 0}, {-60, 0, 0}},
                                     {{0, 0, -1}, {0, 0, -20}}});
  rock.continues = {false, false, false, false, true, true};
  model.solids.push_back(rock);
  TriangleSurface surface;
  const auto add_line = [&](const Vec3& x) {
    surface.vertices.push_back({x[0], -1, x[2]});
    surface.vertices.push_back({x[0], 2, x[2]});
  };
  const auto up = [](Real dip) { return Vec3{-std::cos(radians(dip)), 0, std::sin(radians(dip))}; };
  Vec3 x{0, 0, 0.5};
  add_line(x - 5.0 * up(dips.front()));
  for (std::size_t i = 0; i < dips.size(); ++i)
    add_line(x += (i + 1 < dips.size() ? 5.0 : 40.0) * up(dips[i]));
  for (Index i = 0; i + 3 < static_cast<Index>(surface.vertices.size()); i += 2) {
    surface.triangles.push_back({i, i + 1, i + 2});
    surface.triangles.push_back({i + 2, i + 1, i + 3});
  }
  if (reversed) std::reverse(surface.triangles.begin(), surface.triangles.end());
  add_mesh(model, std::move(surface));
  return model;
}

TEST(MeshJoints, ThatAreListricStaySeveralPlanes) {
  for (const bool reversed : {false, true}) {
    const Keyblock key = only_block(listric({20, 25, 30, 35, 40, 45, 50}, reversed));
    ASSERT_EQ(key.mesh_planes.size(), 1u);
    EXPECT_EQ(key.mesh_planes[0].planes, 3) << reversed;
    // It slides on the lowest of them and leaves the others: 20 and 25 in their share of the area.
    EXPECT_EQ(key.mode, SlidingMode::single_plane);
    EXPECT_GT(key.factor_of_safety, std::tan(radians(15)) / std::tan(radians(25)));
    EXPECT_LT(key.factor_of_safety, std::tan(radians(15)) / std::tan(radians(20)));
  }
}

TEST(MeshJoints, ThatAreGentlyBentAreOnePlane) {
  const Keyblock key = only_block(listric({32, 34, 36, 38}, false));
  ASSERT_EQ(key.mesh_planes.size(), 1u);
  EXPECT_EQ(key.mesh_planes[0].planes, 1);
}

Model with_head(Model model, Real head) {
  Water water;
  water.level = WaterHead{head};
  water.joints = {};
  model.waters.push_back(water);
  return model;
}

TEST(MeshJoints, HoldWaterAsThePlaneDoes) {
  const Keyblock plane = only_block(with_head(cube_on_plane(50e3), 6));
  for (const NoiseCase& c : noise_cases) {
    SCOPED_TRACE(c.noise);
    expect_slides_as(only_block(with_head(cube_on_mesh(50e3, c.noise), 6)), plane, c.tolerance);
  }
}

// The pressure p on the facets, whatever their normals, is what closes the block's surface: −Σ p A n of its other faces.
TEST(MeshJoints, TakeTheWaterOfEachFacetAlongItsOwnNormal) {
  Model model = cube_on_mesh(0, 1e-2);
  model.support->water_pressure = 2e4;
  const BlockArrays blocks = test::cut(model).arrays;
  const Keyblock key = only_block(model);
  Vec3 others{};
  for (Index f = blocks.face_begin[key.block]; f < blocks.face_begin[key.block + 1]; ++f)
    if (blocks.origins[blocks.face_origin[f]].kind != FaceOrigin::Kind::joint)
      others += blocks.face_area[f] * blocks.face_normal[f];
  const Vec3 expected = blocks.mass[key.block] * model.gravity + 2e4 * others;
  EXPECT_LT(norm(key.resultant - expected), 1e-9 * norm(expected));
}

// A slab whose thin toe stays by its cohesion and whose heavy top does not: they go together.
Model toe_and_driver(Real noise) {
  Model model = model_with_joints(20, 13e3);
  Solid rock = convex_solid("rock", {{upward(70, 90), {}},
                                     {{0, 0, 1}, {0, 0, 15}},
                                     {{0, 1, 0}, {0, 1, 0}},
                                     {{0, -1, 0}, {}},
                                     {{-1, 0, 0}, {-40, 0, 0}},
                                     {{0, 0, -1}, {0, 0, -20}}});
  rock.continues = {false, false, false, false, true, true};
  model.solids.push_back(rock);
  const Vec3 bed = upward(44, 90), toe{-0.2, 0, 0.55};
  const Vec3 up{-std::cos(radians(44)), 0, std::sin(radians(44))};
  if (noise == 0)
    add_joint(model, bed, toe);
  else
    add_mesh(model, rough_square(bed, toe + 10.0 * up + Vec3{0, 0.5, 0}, 44, 2, noise));
  Joint across;
  across.name = "across";
  across.plane = {up, toe + 4.0 * up};
  const Vec3 at = across.plane.point - 1.0 * bed, side{0, 9, 0}, high = 30.0 * bed;
  across.polygon = {at - side, at + side, at + side + high, at - side + high};
  model.joints.push_back(across);
  return model;
}

TEST(MeshJoints, CarryGroupsAsThePlaneDoes) {
  const Keyblock plane = only_block(toe_and_driver(0));
  ASSERT_EQ(plane.members.size(), 2u);
  for (const Real noise : {1e-6, 1e-4, 1e-3}) {
    SCOPED_TRACE(noise);
    const Keyblock key = only_block(toe_and_driver(noise));
    EXPECT_EQ(key.members, plane.members);
    expect_slides_as(key, plane, noise < 1e-3 ? 1e-3 : 2e-3);
    ASSERT_EQ(key.mesh_planes.size(), 1u);
    EXPECT_EQ(key.mesh_planes[0].planes, 1);
  }
}

TEST(MeshJoints, TurnBlocksAsThePlaneDoes) {
  // A column of 1 m × 1 m × 4 m on a plane that dips 30 to the east: it topples.
  const auto column = [](Real noise) {
    Model model = model_with_joints(60);
    Solid rock = box_solid("rock", {0, 0, -6}, {1, 1, 4});
    rock.continues[4] = true;
    model.solids.push_back(rock);
    const Vec3 n = upward(30, 90), at{0.5, 0.5, 0};
    if (noise == 0)
      add_joint(model, n, at);
    else
      add_mesh(model, rough_square(n, at, 4, 3, noise));
    return model;
  };
  const Keyblock plane = only_block(column(0));
  ASSERT_EQ(plane.mode, SlidingMode::rotation);
  for (const Real noise : {1e-6, 1e-4, 1e-3}) {
    SCOPED_TRACE(noise);
    expect_slides_as(only_block(column(noise)), plane, 10 * noise + 1e-3);
  }
}

TEST(MeshJoints, AreWholePlanesForThePageToo) {
  const Model model = cube_on_mesh(50e3, 1e-3);
  const FirstLookArrays looks = find_first_looks(test::cut(model).arrays, model);
  ASSERT_EQ(looks.block.size(), 1u);
  ASSERT_GT(looks.normal.size(), 1u);
  for (std::size_t f = 0; f < looks.normal.size(); ++f) {
    EXPECT_EQ(looks.plane_normal[f], looks.plane_normal[0]);
    EXPECT_NE(looks.normal[f], looks.plane_normal[f]);
    EXPECT_LT(norm(looks.normal[f] - looks.plane_normal[f]), 1e-2);
  }
  EXPECT_EQ(looks.patch_face.size(), 1u);
}

// Two windows: a trench through the sliding block lays the fault's middle bare, and what is left of it is still one plane.
TEST(MeshJoints, AreOnePlaneThoughABlockShowsThemInTwoPieces) {
  const auto bridge = [](Real noise) {
    Model model = cube(50e3);
    if (noise == 0)
      add_joint(model, fault, middle);
    else
      add_mesh(model, rough_square(fault, middle, 24, 4, noise));
    model.solids.push_back(box_solid("trench", {4, -1, -1}, {6, 11, 9}, false));
    return model;
  };
  const Keyblock plane = only_block(bridge(0));
  const Keyblock key = only_block(bridge(1e-4));
  expect_slides_as(key, plane, 1e-3);
  ASSERT_EQ(key.mesh_planes.size(), 1u);
  EXPECT_EQ(key.mesh_planes[0].planes, 1);
}

}  // namespace
}  // namespace rockfold
