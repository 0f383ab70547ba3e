// What the user meant: planes and points that coincide but for rounding or measuring noise (decision 5, rules 1, 2, 5).
#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "src/base/vector.hpp"
#include "tests/cut/models/sample_models.hpp"
#include "tests/cut/oracles/complex_check.hpp"
#include "tests/cut/oracles/cutting_rules.hpp"

namespace rockfold::test {
namespace {

// L = √3 m: what is narrower than 1e-9·L is no block, given planes nearer than 1e-10·L are one.
const Real size = std::sqrt(3.0);
constexpr Real tolerance = 1e-9;  // of the size

// x = y = z = 1/2 and a fourth plane that misses their point by `miss` times L: it closes a tetrahedron as wide as that.
Model four_planes(Real miss) {
  Model model = box_model({0, 0, 0}, {1, 1, 1});
  for (const Vec3& n : {Vec3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}) add_joint(model, n, {0.5, 0.5, 0.5});
  add_joint(model, Vec3{1, 1, 1}, {0.5, 0.5, 0.5 + miss * size * std::sqrt(3.0)});
  return model;
}

Real smallest(const Blocks& blocks) {
  return *std::min_element(blocks.arrays.volume.begin(), blocks.arrays.volume.end());
}

// Only slivers leave a doubt: the names of the planes, the least width and where it is.
void expect_doubt(const Blocks& blocks, Index doubts, const std::vector<std::string>& names,
                  Real width) {
  const IntentReport& intent = blocks.cutting.totals.intent;
  EXPECT_EQ(intent.doubts, doubts);
  EXPECT_EQ(intent.near_planes, names);
  EXPECT_NEAR(intent.least_doubt, width, 1e-6 * width + 3e-16);
}
void expect_no_doubt(const Blocks& blocks) {
  expect_doubt(blocks, 0, {}, 0);
}

TEST(Doubts, DecideWhereBlocksWouldBeOthersIfTheyWereClear) {
  // A gap of `width` times L between two joints: a block of its own, or a sliver of one beside it.
  const auto decide = [](Real width) {
    Model model = box_model({0, 0, 0}, {1, 1, 1});
    for (const Real z : {0.5, 0.5 + width * size}) add_joint(model, Vec3{0, 0, 1}, {0.5, 0.5, z});
    return cut(model).cutting.totals.intent;
  };
  for (const Real width : {5e-10, 2e-9, 5e-8}) {
    SCOPED_TRACE(width);
    EXPECT_EQ(decide(width).doubts, 1);
    EXPECT_TRUE(decide(width).doubts_decide);
  }
  EXPECT_FALSE(decide(2e-7).doubts_decide);
}

// A wedge beside the one face of a joint that ends in the rock is glued to the rock around it, however wide.
TEST(Doubts, DecideNothingWhereRockIsGluedAround) {
  Model model = box_model({0, 0, 0}, {1, 1, 1});
  add_joint(model, Vec3{0, 0, 1}, {0.5, 0.5, 0.5});
  model.joints.back().polygon = {
      {0.25, 0.25, 0.5}, {0.75, 0.25, 0.5}, {0.75, 0.75, 0.5}, {0.25, 0.75, 0.5}};
  add_joint(model, Vec3{0, 0, 1}, {0.5, 0.5, 0.5 + 5e-9 * size});
  model.joints.back().polygon = {{0.25, 0.25, 0.5 + 5e-9 * size},
                                 {0.75, 0.25, 0.5 + 5e-9 * size},
                                 {0.75, 0.75, 0.5 + 5e-9 * size},
                                 {0.25, 0.75, 0.5 + 5e-9 * size}};
  const IntentReport intent = cut(model).cutting.totals.intent;
  EXPECT_GT(intent.doubts, 0);
  EXPECT_FALSE(intent.doubts_decide);
}

TEST(FourPlanesThatNearlyMeet, MeetWhereTheyMissByLess) {
  for (const Real miss : {0.0, 1e-12, -1e-12, 1e-11, -1e-11, 1.1e-10, -1.1e-10, 4e-10, -4e-10}) {
    SCOPED_TRACE(miss);
    const Blocks blocks = cut(four_planes(miss));
    EXPECT_EQ(blocks.arrays.block_count(), 14);
    EXPECT_EQ(sum_of_counts(blocks.arrays), (Counts{82, 132, 78}));
    EXPECT_GT(smallest(blocks), 0.02);  // 1/48 and no sliver
    EXPECT_NEAR(sum(blocks.arrays.volume), 1, 1e-12);
    EXPECT_EQ(blocks.cutting.totals.intent.slivers, miss != 0 ? 1 : 0);
    EXPECT_EQ(blocks.arrays.vertices_identified > 0, miss != 0);
    EXPECT_EQ(faults_of(blocks.complex(), {.whole_faces = true}), std::vector<std::string>{});
  }
}

// The sliver's corners are 3·√2·miss apart: farther than the tolerance already, so that the faces beside it keep them.
TEST(FourPlanesThatNearlyMeet, CloseNoBlockNarrowerThanTheTolerance) {
  for (const Real miss : {5e-10, -5e-10, 0.99e-9, -0.99e-9}) {
    SCOPED_TRACE(miss);
    const Blocks blocks = cut(four_planes(miss));
    EXPECT_EQ(blocks.arrays.block_count(), 14);
    EXPECT_GT(smallest(blocks), 0.02);
    EXPECT_NEAR(sum(blocks.arrays.volume), 1, 1e-12);
    EXPECT_EQ(blocks.cutting.totals.intent.slivers, 1);
  }
}

// Some of the sliver's corners are nearer than the tolerance, others not.
TEST(FourPlanesThatNearlyMeet, LeaveShownSurfacesClosed) {
  for (const Real miss : {3e-10, 4.1e-10, 4.5e-10, 5e-10, 5.7e-10, 6e-10, 0.8e-9, 0.99e-9})
    for (const Real side : {-1.0, 1.0}) {
      SCOPED_TRACE(side * miss);
      Faults faults;
      check_surfaces(cut(four_planes(side * miss)).arrays, faults);
      EXPECT_EQ(faults, Faults{});
    }
}

TEST(FourPlanesThatNearlyMeet, CloseATetrahedronWhereTheyMissByMore) {
  for (const Real miss : {1.01e-9, -1.01e-9, 1e-8, -1e-8, 1e-7}) {
    SCOPED_TRACE(miss);
    const Blocks blocks = cut(four_planes(miss));
    EXPECT_EQ(blocks.arrays.block_count(), 15);
    EXPECT_EQ(sum_of_counts(blocks.arrays), (Counts{124, 186, 92}));
    // The tetrahedron's edges along the axes are 3·miss: it is cut off by x + y + z = 3/2 + √3·L·miss.
    const Real edge = std::abs(miss) * size * std::sqrt(3.0);
    EXPECT_NEAR(smallest(blocks) / (edge * edge * edge / 6), 1, 4 * 1.2e-16 / edge);
    EXPECT_NEAR(sum(blocks.arrays.volume), 1, 1e-12);
    EXPECT_EQ(blocks.cutting.totals.intent.slivers, 0);
    EXPECT_EQ(blocks.arrays.vertices_identified, 0);
    EXPECT_EQ(faults_of(blocks.complex(), {.whole_faces = true}), std::vector<std::string>{});
  }
}

// Within a factor 100 of the tolerance on either side: reported with the names of the planes.
TEST(FourPlanesThatNearlyMeet, AreReportedWithinAFactor100OfTheTolerance) {
  for (const Real miss : {1.01e-11, -1.01e-11, 1e-10, 0.99e-9, 1.01e-9, 1e-8, -0.99e-7}) {
    SCOPED_TRACE(miss);
    expect_doubt(cut(four_planes(miss)), 1, {"F1", "F2", "F3", "F4"}, std::abs(miss) * size);
  }
  for (const Real miss : {0.0, 1e-13, 0.99e-11, -0.99e-11, 1.01e-7, 1e-6}) {
    SCOPED_TRACE(miss);
    expect_no_doubt(cut(four_planes(miss)));
  }
}

// Any number of planes through one point, each off by noise of up to 1.7e-11·L: the blocks are those of the planes without
// the noise. (Up to a quarter of the tolerance, the least of four distances is within it for every four planes.)
TEST(ManyPlanesThatNearlyMeet, MeetWhereEachIsOffByNoise) {
  std::mt19937 random(5);
  std::normal_distribution<Real> gauss;
  const auto any = [&] { return Vec3{gauss(random), gauss(random), gauss(random)}; };
  for (int i = 0; i < 200; ++i) {
    const Vec3 common = 0.5 * any();
    std::vector<Vec3> normals(4 + i % 7);
    for (Vec3& n : normals) n = normalized(any());
    const Real noise = i % 2 ? 0.7e-11 : 1e-12;
    Model model = box_model({-5, -5, -5}, {5, 5, 5});
    for (const Vec3& n : normals) {
      const Real off = std::min(2.4, std::abs(gauss(random))) * noise * (10 * size);  // L = 10·√3 m
      add_joint(model, n, common + off * n);
    }
    const Blocks blocks = cut(model);
    // Planes in general position through one point make n(n − 1) + 2 blocks.
    const auto n = static_cast<Index>(normals.size());
    EXPECT_EQ(blocks.arrays.block_count(), n * (n - 1) + 2) << i;
    EXPECT_NEAR(sum(blocks.arrays.volume), 1000, 1e-5) << i;
  }
}

TEST(TwoPlanesNearlyTheSame, AreOneWithinATenthOfTheTolerance) {
  Model model = box_model({0, 0, 0}, {1, 1, 1});
  add_joint(model, Vec3{1, 0, 0}, {0.5, 0, 0});
  add_joint(model, Vec3{1, 0.5e-10, 0}, {0.5 + 0.5e-10, 0, 0});
  const Blocks blocks = cut(model);
  EXPECT_EQ(blocks.arrays.block_count(), 2);
  EXPECT_EQ(blocks.cutting.totals.intent.planes_identified, 1);
  EXPECT_EQ(blocks.cutting.totals.intent.slivers, 0);
  EXPECT_EQ(blocks.cutting.totals.joint_area, 1);
}

// The plate between x = 1/2 and x = 1/2 + distance.
Blocks cut_plate(Real distance) {
  Model model = box_model({0, 0, 0}, {1, 1, 1});
  add_joint(model, Vec3{1, 0, 0}, {0.5, 0, 0});
  add_joint(model, Vec3{1, 0, 0}, {0.5 + distance, 0, 0});
  Blocks blocks = cut(model);
  EXPECT_NEAR(sum(blocks.arrays.volume), 1, 1e-12);
  EXPECT_EQ(blocks.cutting.totals.intent.planes_identified, 0);
  EXPECT_EQ(faults_of(blocks.complex(), {.whole_faces = true}), std::vector<std::string>{});
  return blocks;
}

// The plate touches both blocks alike: the one that lies lower has it.
TEST(TwoPlanesNearlyTheSame, EncloseNoBlockWithinTheTolerance) {
  for (const Real distance : {1.01e-10 * size, 5e-10 * size, 1e-9, 0.99 * tolerance * size}) {
    SCOPED_TRACE(distance);
    const Blocks blocks = cut_plate(distance);
    ASSERT_EQ(blocks.arrays.block_count(), 2);
    EXPECT_EQ(sum_of_counts(blocks.arrays), (Counts{16, 24, 12}));
    const Index lower = blocks.arrays.centroid[0][0] < 0.5 ? 0 : 1;
    EXPECT_NEAR(blocks.arrays.volume[lower], 0.5 + distance, 3e-16);
    EXPECT_NEAR(blocks.arrays.volume[1 - lower], 0.5 - distance, 3e-16);
    EXPECT_EQ(blocks.cutting.totals.intent.slivers, 1);
    expect_doubt(blocks, 1, {"F1", "F2"}, distance);
  }
}

TEST(TwoPlanesNearlyTheSame, EnclosePlatesBeyondIt) {
  for (const Real distance : {1.01 * tolerance * size, 1e-8, 1e-7, 1.01e-7 * size, 1e-6}) {
    SCOPED_TRACE(distance);
    const Blocks blocks = cut_plate(distance);
    EXPECT_EQ(blocks.arrays.block_count(), 3);
    EXPECT_EQ(sum_of_counts(blocks.arrays), (Counts{24, 36, 18}));
    EXPECT_NEAR(smallest(blocks) / distance, 1, 1.2e-16 / distance);
    EXPECT_EQ(blocks.cutting.totals.intent.slivers, 0);
    if (distance < 100 * tolerance * size)
      expect_doubt(blocks, 1, {"F1", "F2"}, distance);
    else
      expect_no_doubt(blocks);
  }
}

// Two wedges of this angle, slope/2 wide at the box' faces.
Blocks cut_wedges(Real slope) {
  Model model = box_model({0, 0, 0}, {1, 1, 1});
  add_joint(model, Vec3{0, 0, 1}, {0.5, 0, 0.5});
  add_joint(model, Vec3{-slope, 0, 1}, {0.5, 0, 0.5});
  Blocks blocks = cut(model);
  EXPECT_NEAR(sum(blocks.arrays.volume), 1, 1e-12);
  EXPECT_EQ(faults_of(blocks.complex(), {.whole_faces = true}), std::vector<std::string>{});
  return blocks;
}

// A shallow dihedral: the line where the two planes meet is where the numbers say, however flat the wedges are.
TEST(TwoPlanesNearlyTheSame, MakeWedgesOfAnyAngleThatAreWideEnough) {
  for (const Real slope : {2.02 * tolerance * size, 3e-8, 3.4e-7, 3.5e-7, 1e-6, 1e-3, 2e-3}) {
    SCOPED_TRACE(slope);
    const Blocks blocks = cut_wedges(slope);
    EXPECT_EQ(blocks.arrays.block_count(), 4);
    EXPECT_EQ(sum_of_counts(blocks.arrays), (Counts{32, 48, 24}));
    EXPECT_NEAR(smallest(blocks) / (slope / 8), 1, 1e-9);
    EXPECT_EQ(blocks.cutting.totals.intent.slivers, 0);
    if (slope / 2 < 100 * tolerance * size)
      expect_doubt(blocks, 2, {"F1", "F2"}, slope / 2);
    else
      expect_no_doubt(blocks);
  }
}

// Then the joint between the two blocks is F1 on one side of the line and F2 on the other.
TEST(TwoPlanesNearlyTheSame, MakeNoWedgesNarrowerThanTheTolerance) {
  for (const Real slope : {1.01e-10, 3e-10, 3e-9, 1.98 * tolerance * size}) {
    SCOPED_TRACE(slope);
    const Blocks blocks = cut_wedges(slope);
    ASSERT_EQ(blocks.arrays.block_count(), 2);
    for (Index b = 0; b < 2; ++b) {
      EXPECT_EQ(counts_of(blocks.arrays, b), (Counts{10, 15, 7}));
      EXPECT_NEAR(blocks.arrays.volume[b], 0.5, slope / 4 + 3e-16);
    }
    Real shared = 0;
    for (const auto& i : blocks.arrays.interfaces) shared += i.area;
    EXPECT_NEAR(shared, 1, 1e-12);
    EXPECT_EQ(blocks.cutting.totals.intent.slivers, 2);
    expect_doubt(blocks, 2, {"F1", "F2"}, slope / 2);
  }
}

// Joints "through" the box' corners and edges, with coordinates off by 1e-11 of the size.
TEST(JointsThroughCorners, MayBeOffByNoise) {
  std::mt19937 random(7);
  std::uniform_real_distribution<Real> noise(-1e-11, 1e-11);
  const auto off = [&](Vec3 x) {
    for (Real& c : x) c += 10 * noise(random);
    return x;
  };
  for (int i = 0; i < 20; ++i) {
    Model model = box_model({0, 0, 0}, {10, 10, 10});
    add_joint(model, Vec3{1, 1, 1}, off({10, 0, 0}));   // cuts off the corner tetrahedron 10³/6
    add_joint(model, Vec3{1, -1, 0}, off({5, 5, 5}));   // through two edges
    add_joint(model, Vec3{1, 1, 1}, off({0, 0, 0}));    // touches a corner
    add_joint(model, Vec3{0, 1, 1}, off({5, 10, 10}));  // touches an edge
    const Blocks blocks = cut(model);
    EXPECT_EQ(blocks.arrays.block_count(), 4);
    EXPECT_EQ(sum_of_counts(blocks.arrays), (Counts{2 * 4 + 2 * 6, 2 * 6 + 2 * 10, 2 * 4 + 2 * 6}));
    EXPECT_NEAR(smallest(blocks), 1000.0 / 12, 1e-6);
    EXPECT_EQ(faults_of(blocks.complex(), {.whole_faces = true, .area_tolerance = 1e-9}),
              std::vector<std::string>{});
  }
}

struct Rotation {
  Vec3 x, y, z;
  Vec3 operator()(const Vec3& p) const { return p[0] * x + p[1] * y + p[2] * z; }
};
Rotation random_rotation(std::mt19937& random) {
  std::normal_distribution<Real> gauss;
  const Vec3 z = normalized({gauss(random), gauss(random), gauss(random)});
  const Vec3 x = normalized(cross({gauss(random), gauss(random), gauss(random)}, z));
  return {x, cross(z, x), z};
}
DipOrientation dip_of(Vec3 n) {
  if (n[2] < 0) n = -n;
  Real dip_direction = std::atan2(n[0], n[1]) * 180 / 3.141592653589793;
  if (dip_direction < 0) dip_direction += 360;
  return {std::atan2(std::hypot(n[0], n[1]), n[2]) * 180 / 3.141592653589793, dip_direction};
}

// A cube and its joints turned by any rotation, all of them given by rounded dips and dip directions: the outermost planes
// of the sets are the cube's faces, and eight bricks meet in each inner corner.
TEST(RotatedGrid, IsAThousandUnitCubes) {
  std::mt19937 random(11);
  for (int i = 0; i < 6; ++i) {
    const Rotation turn = random_rotation(random);
    const Vec3 corner = i % 2 ? Vec3{1e4, -2e4, 500} : Vec3{};
    Model model;
    Solid solid = convex_solid("rock", {});
    HalfspacesShape shape;
    for (const Vec3& axis : {turn.x, turn.y, turn.z}) {
      const DipOrientation orientation = dip_of(axis);
      const bool up = axis[2] >= 0;
      shape.planes.push_back({{orientation, corner}, up});
      shape.planes.push_back({{orientation, corner + turn({10, 10, 10})}, !up});
      add_set(model, orientation, 1, corner);
    }
    solid.shape = shape;
    solid.continues.assign(6, false);
    model.solids.push_back(solid);
    const Blocks blocks = cut(model);
    ASSERT_EQ(blocks.arrays.block_count(), 1000);
    EXPECT_EQ(sum_of_counts(blocks.arrays), (Counts{8000, 12000, 6000}));
    for (const Real v : blocks.arrays.volume) EXPECT_NEAR(v, 1, 1e-9);
    EXPECT_EQ(faults_of(blocks.complex(), {.whole_faces = true, .area_tolerance = 1e-9}),
              std::vector<std::string>{});
  }
}

// The mirror planes of a turned cube: six planes through one point, none of them exactly.
TEST(RotatedMirrorPlanes, AreTwentyFourTetrahedraOrFortyEight) {
  std::mt19937 random(12);
  for (int i = 0; i < 40; ++i) {
    const Rotation turn = random_rotation(random);
    const Vec3 centre = i % 2 ? Vec3{1000.1, -2000.2, 300.3} : Vec3{};
    Model model;
    std::vector<std::pair<Vec3, Vec3>> faces;
    for (const Real s : {-1.0, 1.0})
      for (const Vec3& axis : {turn.x, turn.y, turn.z})
        faces.emplace_back(s * axis, centre + s * axis);
    model.solids.push_back(convex_solid("rock", faces));
    for (const Vec3& n : {Vec3{1, 1, 0}, {1, -1, 0}, {0, 1, 1}, {0, 1, -1}, {1, 0, 1}, {1, 0, -1}})
      add_joint(model, turn(n), centre);
    const Blocks six = cut(model);
    EXPECT_EQ(six.arrays.block_count(), 24);
    EXPECT_EQ(sum_of_counts(six.arrays), (Counts{96, 144, 96}));
    for (const Vec3& n : {Vec3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}) add_joint(model, turn(n), centre);
    const Blocks nine = cut(model);
    EXPECT_EQ(nine.arrays.block_count(), 48);
    EXPECT_EQ(sum_of_counts(nine.arrays), (Counts{192, 288, 192}));
    EXPECT_EQ(faults_of(nine.complex(), {.whole_faces = true, .area_tolerance = 1e-9}),
              std::vector<std::string>{});
  }
}

// Two joints nearly in one plane cut a plate, or none; whether it is meant only the user can say.
TEST(NearPlanes, AreReportedWhereTheirPlateIsAboutAsWideAsTheTolerance) {
  struct Case {
    Real apart;  // of the size
    Index blocks, planes_identified, slivers, doubts;
  };
  for (const Case& c : {Case{1e-12, 2, 1, 0, 0},
                        {0.99e-10, 2, 1, 0, 0},
                        {1.01e-10, 2, 0, 1, 1},
                        {3e-10, 2, 0, 1, 1},
                        {0.99e-9, 2, 0, 1, 1},
                        {1.01e-9, 3, 0, 0, 1},
                        {0.99e-7, 3, 0, 0, 1},
                        {1.01e-7, 3, 0, 0, 0}}) {
    SCOPED_TRACE(c.apart);
    Model model = box_model({0, 0, 0}, {10, 10, 10});
    add_joint(model, Vec3{1, 0, 0}, {5, 0, 0});
    add_joint(model, Vec3{1, 0, 0}, {5 + c.apart * 10 * size, 0, 0});
    const Blocks blocks = cut(model);
    const IntentReport& intent = blocks.cutting.totals.intent;
    EXPECT_EQ(blocks.arrays.block_count(), c.blocks);
    EXPECT_EQ(intent.planes_identified, c.planes_identified);
    EXPECT_EQ(intent.slivers, c.slivers);
    EXPECT_EQ(intent.doubts, c.doubts);
    EXPECT_EQ(intent.near_planes,
              c.doubts ? (std::vector<std::string>{"F1", "F2"}) : std::vector<std::string>{});
    EXPECT_NEAR(sum(blocks.arrays.volume), 1000, 1e-9);
  }
}

}  // namespace
}  // namespace rockfold::test
