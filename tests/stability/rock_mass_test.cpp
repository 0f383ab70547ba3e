// Blocks as rigid bodies: which of them are held, what areas they share, what loads them.
#include "host/stability/rock_mass.hpp"

#include <cmath>
#include <map>
#include <tuple>

#include <gtest/gtest.h>

#include "host/keyblock/bodies.hpp"
#include "host/keyblock/face_shape.hpp"
#include "src/base/vector.hpp"
#include "tests/cut/models/draw.hpp"
#include "tests/cut/models/sample_models.hpp"
#include "tests/keyblock/models/half_space_block.hpp"

namespace rockfold {
namespace {

using test::add_joint;
using test::box_solid;
using test::model_with_joints;

constexpr Real g = 9.81;
constexpr Index zmin = 4, zmax = 5;  // of a box's faces
constexpr Vec3 up{0, 0, 1};

void expect_near(const Vec3& a, const Vec3& b, Real tolerance) {
  for (std::size_t d = 0; d < 3; ++d) EXPECT_NEAR(a[d], b[d], tolerance) << "component " << d;
}

Model rock_box(const Vec3& min, const Vec3& max, Real cohesion = 0) {
  Model model = model_with_joints(30, cohesion);
  model.solids.push_back(box_solid("rock", min, max));
  return model;
}

using Components = std::array<bool, 3>;
constexpr Components all_three{true, true, true};

Fixed fixed_at(const Region& where, const Components& components = all_three) {
  Fixed fixed;
  fixed.where = where;
  fixed.components = components;
  return fixed;
}
Fixed fixed_face(Index face, const Components& components = all_three) {
  return fixed_at(FaceRegion{0, {face}, false}, components);
}

Traction pressure_on(const Region& where, Real value) {
  Traction traction;
  traction.where = where;
  traction.pressure = true;
  traction.value = {value, 0, 0};
  return traction;
}

/// Water in all joints up to an elevation.
Water water_to(Real elevation, WaterLaw law) {
  Water water;
  water.level = WaterHead{elevation};
  water.law = law;
  return water;
}

Excavation excavated_box(const Vec3& min, const Vec3& max) {
  Excavation excavation;
  excavation.name = "pit";
  excavation.shape = BoxShape{min, max};
  return excavation;
}

void add_square(Model& model, const Vec3& normal, const std::vector<Vec3>& polygon) {
  add_joint(model, normal, polygon[0]);
  model.joints.back().polygon = polygon;
}

struct Mass {
  test::Blocks blocks;
  RigidMass rigid;
};
Mass mass_of(const Model& model) {
  Mass mass;
  mass.blocks = test::cut(model);
  mass.rigid = rigid_mass(mass.blocks.cutting, mass.blocks.arrays, model);
  return mass;
}

Real area_of(const ContactArea& contact) {
  Real area = 0;
  const auto& x = contact.corner;
  for (std::size_t k = 2; k < x.size(); ++k)
    area += 0.5 * dot(contact.normal, cross(x[k - 1] - x[0], x[k] - x[0]));
  return area;
}

Real total_area(const RigidMass& mass) {
  Real area = 0;
  for (const ContactArea& contact : mass.contacts) area += area_of(contact);
  return area;
}

/// Blocks [0, 1]² × [0, 1] and [0, 1]² × [1, 2] on a joint F1.
Model cube_on_base(Real cohesion = 0) {
  Model model = rock_box({0, 0, 0}, {1, 1, 2}, cohesion);
  add_joint(model, up, {0, 0, 1});
  model.fixed.push_back(fixed_face(zmin));
  return model;
}

constexpr Real weight = 2000 * g;  // N, of a cubic metre

TEST(RockMass, OfACubeOnAHeldBaseIsOneBodyOnOneArea) {
  Model model = cube_on_base(3e4);
  model.joint_materials[0].tensile_strength = 1e4;
  const RigidMass mass = mass_of(model).rigid;
  ASSERT_EQ(mass.bodies.size(), 1);
  EXPECT_EQ(mass.bodies[0].block, 1);
  expect_near(mass.bodies[0].centre, {0.5, 0.5, 1.5}, 1e-12);
  expect_near(mass.bodies[0].force, {0, 0, -weight}, 1e-9);
  expect_near(mass.bodies[0].moment, {}, 1e-9);
  ASSERT_EQ(mass.contacts.size(), 1);
  const ContactArea& contact = mass.contacts[0];
  EXPECT_EQ(contact.body, (std::array<Index, 2>{0, none}));
  EXPECT_EQ(contact.corner.size(), 4);
  EXPECT_NEAR(area_of(contact), 1, 1e-12);
  expect_near(contact.normal, up, 0);
  EXPECT_NEAR(contact.friction, std::tan(test::radians(30)), 1e-15);
  EXPECT_EQ(contact.cohesion, 3e4);
  EXPECT_EQ(contact.tension, 1e4);
  EXPECT_EQ(contact.joint, "F1");
}

TEST(RockMass, ACubeInANotchLeansOnThreeAreas) {
  Model model = rock_box({0, 0, 0}, {2, 2, 2});
  add_square(model, {1, 0, 0}, {{1, 1, 1}, {1, 2, 1}, {1, 2, 2}, {1, 1, 2}});
  add_square(model, {0, 1, 0}, {{1, 1, 1}, {2, 1, 1}, {2, 1, 2}, {1, 1, 2}});
  add_square(model, {0, 0, 1}, {{1, 1, 1}, {2, 1, 1}, {2, 2, 1}, {1, 2, 1}});
  model.fixed.push_back(fixed_face(zmin));
  const RigidMass mass = mass_of(model).rigid;
  ASSERT_EQ(mass.bodies.size(), 1);
  ASSERT_EQ(mass.contacts.size(), 3);
  Vec3 sum{};
  for (const ContactArea& contact : mass.contacts) {
    EXPECT_EQ(contact.corner.size(), 4);
    EXPECT_NEAR(area_of(contact), 1, 1e-12);
    sum += contact.normal;
  }
  expect_near(sum, {1, 1, 1}, 1e-12);
}

/// On a base two cubes of 1 m, side by side. Joints F1 below them, F2 between them.
Model side_by_side() {
  Model model = rock_box({0, 0, -1}, {2, 1, 1});
  add_joint(model, up, {});
  add_joint(model, Vec3{1, 0, 0}, {1, 0, 0});
  model.fixed.push_back(fixed_face(zmin));
  return model;
}

TEST(RockMass, BlocksSideBySideShareOneAreaAndHeldOnesNone) {
  const RigidMass mass = mass_of(side_by_side()).rigid;
  ASSERT_EQ(mass.bodies.size(), 2);
  EXPECT_LT(mass.bodies[0].centre[0], mass.bodies[1].centre[0]);
  ASSERT_EQ(mass.contacts.size(), 3);
  EXPECT_EQ(mass.contacts[0].body, (std::array<Index, 2>{0, none}));
  EXPECT_EQ(mass.contacts[1].body, (std::array<Index, 2>{0, 1}));
  EXPECT_EQ(mass.contacts[2].body, (std::array<Index, 2>{1, none}));
  expect_near(mass.contacts[1].normal, {-1, 0, 0}, 0);
  EXPECT_NEAR(total_area(mass), 3, 1e-12);
}

TEST(RockMass, AnAreaOfTheShapeOfAnLIsTwoConvexOnes) {
  Model model = rock_box({0, 0, 0}, {2, 2, 2});
  model.solids.push_back(box_solid("corner", {1, 1, 1}, {2, 2, 2}, false));
  add_joint(model, up, {0, 0, 1});
  model.fixed.push_back(fixed_face(zmin));
  const RigidMass mass = mass_of(model).rigid;
  EXPECT_EQ(mass.contacts.size(), 2);
  EXPECT_NEAR(total_area(mass), 3, 1e-12);
}

TEST(RockMass, FragmentsThatAreConvexTogetherAreOneArea) {
  Model model = cube_on_base();
  // Cracks that end in the cube: it is one block of several cells.
  add_square(model, {1, 0, 0}, {{0.5, 0.2, 1}, {0.5, 0.7, 1}, {0.5, 0.7, 1.5}, {0.5, 0.2, 1.5}});
  add_square(model, {0, 1, 0}, {{0.1, 0.4, 1}, {0.8, 0.4, 1}, {0.8, 0.4, 1.5}, {0.1, 0.4, 1.5}});
  const Mass mass = mass_of(model);
  Index fragments = 0;
  for (const Fragment& f : mass.blocks.complex().fragments)
    if (f.joint == 0) ++fragments;
  EXPECT_GT(fragments, 2);
  ASSERT_EQ(mass.rigid.contacts.size(), 1);
  EXPECT_EQ(mass.rigid.contacts[0].corner.size(), 4);
  EXPECT_NEAR(total_area(mass.rigid), 1, 1e-12);
}

TEST(RockMass, BlocksThatASliverPartsShareOneArea) {
  Model model = cube_on_base();
  add_joint(model, up, {0, 0, 1 + 1.2e-9});  // narrower than 1e-9 of the size, no plane of its own
  const Mass mass = mass_of(model);
  ASSERT_FALSE(mass.blocks.complex().beams.empty());
  ASSERT_EQ(mass.rigid.bodies.size(), 1);
  ASSERT_EQ(mass.rigid.contacts.size(), 1);
  EXPECT_NEAR(total_area(mass.rigid), 1, 1e-8);
  expect_near(mass.rigid.contacts[0].normal, up, 0);
}

/// Three sets of random planes, the last one of discs; as blocks all free.
Model random_rock(unsigned seed) {
  test::Draw draw(seed);
  Model model = rock_box({10, -3, 5}, {14, 0, 8});
  for (int k = 0; k < 3; ++k) {
    test::add_set(model, draw.direction(), draw.uniform(0.8, 1.6),
                  Vec3{12, -1, 6} + draw.within(-1, 1));
    if (k == 2) model.joint_sets.back().radius = 1.5;
  }
  return model;
}

/// m² of each pair of blocks that are still there, by the plane of the first one's face.
using PairAreas = std::map<std::tuple<Index, Index, Index>, Real>;

PairAreas areas_of_interfaces(const BlockArrays& blocks) {
  PairAreas areas;
  for (const auto& i : blocks.interfaces)
    if (blocks.stage[i.block[0]] == 0 && blocks.stage[i.block[1]] == 0)
      areas[{i.block[0], i.block[1], blocks.face_plane[i.face[0]]}] += i.area;
  return areas;
}

/// m: how far a contact's corners are off the plane of a face that looks along `outward`; infinite where it looks elsewhere.
Real distance_from(const BlockArrays& blocks, Index face, const ContactArea& contact,
                   const Vec3& outward) {
  if (norm(blocks.face_normal[face] - outward) > 1e-9) return INFINITY;
  Real most = 0;
  for (const Vec3& x : contact.corner)
    most = std::max(most, std::abs(dot(outward, x - outer_loop(blocks, face)[0])));
  return most;
}

/// The plane of the block's face that a contact lies on; none: it has no such face.
Index plane_under(const BlockArrays& blocks, Index block, const ContactArea& contact,
                  const Vec3& outward) {
  for (Index f = blocks.face_begin[block]; f < blocks.face_begin[block + 1]; ++f)
    if (distance_from(blocks, f, contact, outward) < 1e-8) return blocks.face_plane[f];
  return none;
}

void expect_interfaces(const Mass& mass) {
  const BlockArrays& blocks = mass.blocks.arrays;
  PairAreas expected = areas_of_interfaces(blocks), found;
  for (const ContactArea& contact : mass.rigid.contacts) {
    const Index first = mass.rigid.bodies[contact.body[0]].block,
                second = mass.rigid.bodies[contact.body[1]].block;
    EXPECT_LT(first, second);
    const Index plane = plane_under(blocks, first, contact, -contact.normal);
    EXPECT_NE(plane, none);
    EXPECT_NE(plane_under(blocks, second, contact, contact.normal), none);
    EXPECT_GT(area_of(contact), 0);
    found[{first, second, plane}] += area_of(contact);
  }
  EXPECT_EQ(found.size(), expected.size());
  for (const auto& [key, area] : expected) EXPECT_NEAR(found[key], area, 1e-9);
}

TEST(RockMass, AreasOfRandomRockAreItsInterfaces) {
  for (unsigned seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE(seed);
    const Mass mass = mass_of(random_rock(seed));
    EXPECT_EQ(mass.rigid.bodies.size(), mass.blocks.arrays.volume.size());
    expect_interfaces(mass);
  }
}

TEST(RockMass, AreasOfRandomRockAboutATunnelAreItsInterfaces) {
  for (unsigned seed = 21; seed <= 24; ++seed) {
    SCOPED_TRACE(seed);
    Model model = random_rock(seed);
    model.excavations.push_back(excavated_box({10, -2, 6}, {14, -1, 7}));
    const Mass mass = mass_of(model);
    EXPECT_LT(mass.rigid.bodies.size(), mass.blocks.arrays.volume.size());
    expect_interfaces(mass);
  }
}

/// Forces and moments about the origin of coordinates, of all bodies together.
struct Resultant {
  Vec3 force{}, moment{};
};
Resultant resultant(const RigidMass& mass) {
  Resultant sum;
  for (const RigidBody6& body : mass.bodies) {
    sum.force += body.force;
    sum.moment += body.moment + cross(body.centre, body.force);
  }
  return sum;
}

TEST(RockMass, WaterPressesRandomRockApartButNotAway) {
  for (const WaterLaw law : {WaterLaw::hydrostatic, WaterLaw::mid_height}) {
    Model model = random_rock(7);
    const RigidMass dry = mass_of(model).rigid;
    model.waters.push_back(water_to(7.5, law));
    const RigidMass wet = mass_of(model).rigid;
    const Resultant a = resultant(dry), b = resultant(wet);
    expect_near(a.force, {0, 0, -36 * weight}, 1e-5);
    expect_near(b.force, a.force, 1e-5);
    expect_near(b.moment, a.moment, 1e-4);
    Real push = 0;
    for (std::size_t i = 0; i < dry.bodies.size(); ++i)
      push = std::max(push, norm(wet.bodies[i].force - dry.bodies[i].force));
    EXPECT_GT(push, 1e4);
  }
}

/// Block theory's force and moment of a block, all others being there.
RigidBody6 block_theory(const BlockArrays& blocks, const Model& model, Index block) {
  const RockBody body =
      Bodies(blocks, model).body({block}, std::vector<Index>(blocks.volume.size(), 0));
  RigidBody6 rigid{block, body.centroid, body.load, body.moment};
  for (const BlockFace& face : body.faces) rigid.force -= face.water;
  return rigid;
}

TEST(RockMass, WaterUnderASingleBlockIsThatOfBlockTheory) {
  for (const WaterLaw law : {WaterLaw::hydrostatic, WaterLaw::drained, WaterLaw::mid_height}) {
    Model model = cube_on_base();
    model.joints.clear();
    add_joint(model, DipOrientation{30, 120}, {0.5, 0.5, 1});
    model.waters.push_back(water_to(1.1, law));
    const Mass mass = mass_of(model);
    ASSERT_EQ(mass.rigid.bodies.size(), 1);
    const RigidBody6 expected = block_theory(mass.blocks.arrays, model, 1);
    EXPECT_GT(norm(expected.force - Vec3{0, 0, -weight}), 100);
    expect_near(mass.rigid.bodies[0].force, expected.force, 1e-8);
    expect_near(mass.rigid.bodies[0].moment, expected.moment, 1e-8);
  }
}

TEST(RockMass, WaterOfAPressureOnAllJointsIsThatOfBlockTheory) {
  Model model = cube_on_base();
  model.support->water_pressure = 5000;
  const Mass mass = mass_of(model);
  expect_near(mass.rigid.bodies[0].force, {0, 0, -weight + 5000}, 1e-8);
  expect_near(mass.rigid.bodies[0].moment, {}, 1e-8);
}

TEST(RockMass, WaterAgainstRockThatGoesOnIsThatOfBlockTheory) {
  Model model = cube_on_base();
  model.fixed.clear();
  model.solids[0].continues[zmin] = true;
  model.waters.push_back(water_to(1.5, WaterLaw::hydrostatic));
  const RigidMass mass = mass_of(model).rigid;
  ASSERT_EQ(mass.bodies.size(), 1);
  expect_near(mass.bodies[0].force, {0, 0, -weight + 500 * g}, 1e-8);
}

/// A block beside two that lie one on the other: its face in the joint F1 is larger than theirs, so that its own water would not
/// be theirs.
TEST(RockMass, WaterBetweenTwoBlocksHasThePressureOfTheSmallerFace) {
  Model model = rock_box({0, 0, 0}, {2, 1, 3});
  add_joint(model, Vec3{1, 0, 0}, {1, 0, 0});
  add_square(model, up, {{1, 0, 1}, {2, 0, 1}, {2, 1, 1}, {1, 1, 1}});
  model.waters.push_back(water_to(2.5, WaterLaw::mid_height));
  model.waters[0].joints = {"F1"};
  const Mass mass = mass_of(model);
  ASSERT_EQ(mass.rigid.bodies.size(), 3);
  Real pushed_right = 0, pushed_left = 0;
  for (const RigidBody6& body : mass.rigid.bodies) {
    const RigidBody6 own = block_theory(mass.blocks.arrays, model, body.block);
    if (body.centre[0] > 1) {
      expect_near(body.force, own.force, 1e-8);
      expect_near(body.moment, own.moment, 1e-8);
      pushed_right += body.force[0];
    } else {
      EXPECT_GT(std::abs(body.force[0] - own.force[0]), 10);
      pushed_left = body.force[0];
    }
  }
  EXPECT_GT(pushed_right, 1000);
  EXPECT_NEAR(pushed_left, -pushed_right, 1e-8);
}

TEST(RockMass, AnEarthquakeIsAShareOfTheWeight) {
  Model model = cube_on_base();
  model.support->seismic_coefficient = {0.2, -0.1, 0.05};
  expect_near(mass_of(model).rigid.bodies[0].force, weight * Vec3{0.2, -0.1, -0.95}, 1e-9);
}

TEST(RockMass, PointLoadsAndTractionsHaveTheirMoments) {
  Model model = cube_on_base();
  PointLoad load;
  load.point = {0.9, 0.5, 1.75};
  load.force = {0, 1000, 0};
  model.point_loads.push_back(load);
  model.tractions.push_back(pressure_on(BoxRegion{{0, 0, 2}, {0.5, 1, 2}}, 4000));
  const RigidBody6 body = mass_of(model).rigid.bodies[0];
  expect_near(body.force, {0, 1000, -weight - 2000}, 1e-9);
  expect_near(body.moment, Vec3{-250, 0, 400} + cross({-0.25, 0, 0.5}, {0, 0, -2000}), 1e-9);
}

TEST(RockMass, ExcavatedBlocksAreGone) {
  Model model = cube_on_base();
  add_joint(model, up, {0, 0, 1.5});
  model.excavations.push_back(excavated_box({0, 0, 1.5}, {1, 1, 2}));
  model.tractions.push_back(pressure_on(FaceRegion{0, {zmin}, true}, 1000));
  const Mass mass = mass_of(model);
  EXPECT_EQ(mass.blocks.arrays.block_count(), 3);
  ASSERT_EQ(mass.rigid.bodies.size(), 1);
  EXPECT_EQ(mass.rigid.bodies[0].block, 1);
  expect_near(mass.rigid.bodies[0].force, {0, 0, -weight / 2 - 1000}, 1e-9);
  EXPECT_EQ(mass.rigid.contacts.size(), 1);
}

std::vector<Index> held(const Model& model) {
  const HeldBlocks found = held_blocks(test::cut(model).arrays, model);
  std::vector<Index> blocks;
  for (std::size_t b = 0; b < found.held.size(); ++b)
    if (found.held[b] != 0) blocks.push_back(static_cast<Index>(b));
  return blocks;
}
std::vector<Index> partly_held(const Model& model) {
  return held_blocks(test::cut(model).arrays, model).partly_held;
}

/// Three blocks, one on the other: z from 0 to 1, 2 and 3.
Model three_blocks(const Region& where, const Components& components = all_three) {
  Model model = rock_box({0, 0, 0}, {1, 1, 3});
  add_joint(model, up, {0, 0, 1});
  add_joint(model, up, {0, 0, 2});
  model.fixed.push_back(fixed_at(where, components));
  return model;
}

TEST(HeldBlocks, AreThoseThatARegionTouches) {
  using Blocks = std::vector<Index>;
  EXPECT_EQ(held(three_blocks(FaceRegion{0, {zmin}, false})), Blocks{0});
  EXPECT_EQ(held(three_blocks(FaceRegion{0, {0}, false})), (Blocks{0, 1, 2}));
  EXPECT_EQ(held(three_blocks(BlockRegion{{0.3, 0.4, 1.5}})), Blocks{1});
  EXPECT_EQ(held(three_blocks(PointRegion{{1, 0.4, 2.5}})), Blocks{2});
  EXPECT_EQ(held(three_blocks(PlaneRegion{{0, 0, 2.5}, up, 0.1})), Blocks{2});
  EXPECT_EQ(held(three_blocks(PlaneRegion{{0, 0, 0}, {1, 0, 0}, 0})), (Blocks{0, 1, 2}));
  EXPECT_EQ(held(three_blocks(BoxRegion{{-1, -1, -1}, {2, 2, 0.5}})), Blocks{0});       // vertices
  EXPECT_EQ(held(three_blocks(BoxRegion{{0.9, 0.2, 1.2}, {2, 0.4, 1.4}})), Blocks{1});  // a face
  EXPECT_EQ(held(three_blocks(BoxRegion{{0.4, 0.4, 1.2}, {0.6, 0.6, 1.4}})), Blocks{1});  // inside
  EXPECT_EQ(held(three_blocks(BoxRegion{{2, 2, 2}, {3, 3, 3}})), Blocks{});
}

TEST(HeldBlocks, ThatAreHeldInPartAreNamedUnlessTheyAreHeldOtherwise) {
  using Blocks = std::vector<Index>;
  Model model = three_blocks(FaceRegion{0, {0}, false}, {true, false, false});
  EXPECT_EQ(held(model), Blocks{});
  EXPECT_EQ(partly_held(model), (Blocks{0, 1, 2}));
  model.fixed.push_back(fixed_face(zmin));
  EXPECT_EQ(held(model), Blocks{0});
  EXPECT_EQ(partly_held(model), (Blocks{1, 2}));
  EXPECT_EQ(mass_of(model).rigid.bodies.size(), 2);
  model.fixed.push_back(fixed_face(zmax, {false, false, false}));
  EXPECT_EQ(partly_held(model), (Blocks{1, 2}));
}

TEST(HeldBlocks, AreThoseBeyondWhichTheRockGoesOn) {
  Model model = three_blocks(PointRegion{{9, 9, 9}});
  model.solids[0].continues[zmax] = true;
  EXPECT_EQ(held(model), std::vector<Index>{2});
}

TEST(HeldBlocks, AreNotExcavated) {
  Model model = three_blocks(FaceRegion{0, {0}, false});
  model.solids[0].continues[zmax] = true;
  model.excavations.push_back(excavated_box({0, 0, 2}, {1, 1, 3}));
  EXPECT_EQ(held(model), (std::vector<Index>{0, 1}));
}

TEST(ContactPoints, OfAnAreaWithoutCohesionAreItsCorners) {
  const RigidMass mass = mass_of(cube_on_base()).rigid;
  const auto points = force_points(mass);
  ASSERT_EQ(points.size(), 4);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(points[i].at, mass.contacts[0].corner[i]);
    EXPECT_EQ(points[i].area, 0);
  }
}

TEST(ContactPoints, OfASquareWithCohesionAreItsCornersAndFourTriangles) {
  const RigidMass mass = mass_of(cube_on_base(1e4)).rigid;
  const auto& corner = mass.contacts[0].corner;
  const auto points = force_points(mass);
  ASSERT_EQ(points.size(), 8);
  Real area = 0;
  Vec3 moment{};
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_EQ(points[i].contact, 0);
    area += points[i].area;
    moment += points[i].area * points[i].at;
    EXPECT_NEAR(points[i].area, i < 4 ? 0 : 0.25, 1e-12);
  }
  EXPECT_NEAR(area, 1, 1e-12);
  expect_near(moment, {0.5, 0.5, 1}, 1e-12);
  expect_near(points[4].at, (1.0 / 3) * (Vec3{0.5, 0.5, 1} + corner[0] + corner[1]), 1e-12);
}

TEST(ContactPoints, AreThoseOfAllContactsInTheirOrder) {
  RigidMass mass = mass_of(side_by_side()).rigid;
  mass.contacts[1].tension = 1;
  const auto points = force_points(mass);
  ASSERT_EQ(points.size(), 4 + 8 + 4);
  EXPECT_EQ(points[3].contact, 0);
  EXPECT_EQ(points[4].contact, 1);
  EXPECT_EQ(points[11].contact, 1);
  EXPECT_EQ(points[12].contact, 2);
}

}  // namespace
}  // namespace rockfold
