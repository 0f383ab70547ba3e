// Bolts, patterns, shotcrete and the search for a pattern in cut models.
#include "host/bolting/bolting.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "host/bolting/pattern_search.hpp"
#include "host/keyblock/face_shape.hpp"
#include "src/base/vector.hpp"
#include "tests/bolting/bolted_models.hpp"

namespace rockfold {
namespace {

using test::cut_rock;
using test::CutRock;
using test::roof_wedge;

constexpr const char* bolt_of_100_kn =
    "force_capacity = 100e3\ndisplacement_capacity = 0.02\ncoupling = 'CMC'\n";

BoltingReport supported(const CutRock& rock) {
  return support_blocks(rock.blocks, rock.keyblocks, rock.model);
}

std::string pattern_on(const std::string& wall, const std::string& more) {
  return "[[bolt_pattern]]\nname = 'p'\non = '" + wall + "'\n" + more + bolt_of_100_kn;
}

/// How high the roof wedge is over a point of the roof.
Real wedge_height(Real x, Real y) {
  Real height = 1;
  for (const Real direction : {30.0, 150.0, 270.0}) {
    const Real a = direction * M_PI / 180;
    height = std::min(height, 1 - std::sqrt(3.0) * (x * std::sin(a) + y * std::cos(a)));
  }
  return height;
}

// Case G-2.
TEST(Bolting, OfAFallingRoofWedgeByOneSpotBolt) {
  const CutRock rock = cut_rock(roof_wedge +
                                "[[bolt]]\nname = 'spot'\ncollar = [0.2, 0.1, 0]\n"
                                "direction = [0, 0, 2]\nlength = 3\nbond_strength = 60e3\n"
                                "plate_capacity = 30e3\n" +
                                bolt_of_100_kn);
  ASSERT_EQ(rock.keyblocks.keyblocks.size(), 1u);
  const Keyblock& key = rock.keyblocks.keyblocks[0];
  EXPECT_NEAR(key.weight, 15588.46, 0.01);
  EXPECT_NEAR(key.support_force, 2 * 15588.46, 0.02);
  EXPECT_NEAR(key.support_pressure, 2 * 9e3, 1e-3);
  ASSERT_NE(key.free_face, none);  // the triangle in the roof
  EXPECT_EQ(rock.blocks.face_normal[key.free_face], (Vec3{0, 0, -1}));
  EXPECT_NEAR(norm(face_centre(rock.blocks, key.free_face)), 0, 1e-9);
  EXPECT_EQ(bolts_needed(key.support_force, 100e3), 1);
  EXPECT_NEAR(square_spacing(100e3, key.support_pressure), 2.357, 5e-4);

  const BoltingReport report = supported(rock);
  ASSERT_EQ(report.keyblocks.size(), 1u);
  const BlockSupport& support = report.keyblocks[0];
  ASSERT_EQ(support.crossings.size(), 1u);
  const BoltCrossing& crossing = support.crossings[0];
  const Real within = wedge_height(0.2, 0.1);
  EXPECT_NEAR(crossing.embedment.within, within, 1e-5);
  EXPECT_NEAR(crossing.embedment.anchored, 3 - within, 1e-5);
  EXPECT_NEAR(crossing.capacity, 30e3 + 60e3 * within, 1);
  EXPECT_NEAR(support.held.factor_of_safety, crossing.capacity / 15588.46, 1e-4);
  EXPECT_NEAR(support.force_mobilisation, 15588.46 / crossing.capacity, 1e-4);
  // Stiffness 100 kN / 20 mm.
  EXPECT_NEAR(support.displacement_mobilisation, 15588.46 / 100e3, 1e-5);
  EXPECT_TRUE(support.held.adequate);
  EXPECT_EQ(report.adequate, 1);
}

// The one that ends in the block holds nothing: it is no less at its end than one that holds too little.
TEST(Bolting, CountsNoBoltThatEndsInTheBlockOrStartsBeyondIt) {
  const CutRock rock =
      cut_rock(roof_wedge + "[[bolt]]\ncollar = [0.1, 0, 0]\ntoe = [0.1, 0, 0.5]\n" +
               bolt_of_100_kn + "[[bolt]]\ncollar = [2, 2, 0]\ntoe = [2, 2, 2]\n" + bolt_of_100_kn);
  const BoltingReport report = supported(rock);
  ASSERT_EQ(report.keyblocks[0].crossings.size(), 1u);
  EXPECT_EQ(report.keyblocks[0].crossings[0].capacity, 0);
  EXPECT_FALSE(report.keyblocks[0].held.adequate);
  EXPECT_EQ(report.keyblocks[0].force_mobilisation, 1);
  EXPECT_TRUE(std::isinf(report.keyblocks[0].displacement_mobilisation));
  EXPECT_EQ(report.keyblocks[0].crossings[0].force_mobilisation, 1);
  EXPECT_TRUE(std::isinf(report.keyblocks[0].crossings[0].displacement_mobilisation));
  EXPECT_EQ(report.keyblocks[0].crossings[0].load, 0);
}

// The last 2 m before the toe: of 6.4 m from z = 0 up through a wedge of 0.49 m, with an adit from z = 4 to 6 above it.
TEST(Bolting, HoldsByThePartOfItsAnchorThatLiesInRock) {
  const std::string adit =
      "[[excavation]]\nname = 'adit'\nshape = 'box'\nmin = [-1, -9, 4]\nmax = [1, 9, 5.5]\n";
  const auto capacity = [&](const std::string& length, const std::string& more = "") {
    const CutRock rock =
        cut_rock(roof_wedge + more +
                 "[[bolt]]\ncollar = [0.2, 0.1, 0]\ndirection = [0, 0, 1]\nlength = " + length +
                 "\ncoupling = 'DMFC'\nanchor_length = 2\nforce_capacity = 1e6\n"
                 "bond_strength = 50e3\ndisplacement_capacity = 0.02\n");
    return supported(rock).keyblocks.at(0).crossings.at(0).axial_capacity;
  };
  EXPECT_NEAR(capacity("3.4"), 100e3, 1e-3);             // all of it in rock
  EXPECT_NEAR(capacity("3.4", adit), 100e3, 1e-3);       // before the adit
  EXPECT_NEAR(capacity("5", adit), 50e3, 1e-3);          // 1 m before it, 1 m in the air
  EXPECT_NEAR(capacity("5.8", adit), 0.5 * 50e3, 1e-3);  // 0.2 m before it and 0.3 m behind
  EXPECT_NEAR(capacity("2.2"), 50e3 * (2.2 - wedge_height(0.2, 0.1)), 1e-3);  // partly in the block
  EXPECT_NEAR(capacity("7.8"), 100e3, 1e-3);  // beyond the model, where the rock goes on
}

TEST(Bolting, AnchorsInTheRockBeyondTheModelWhereItGoesOn) {
  const CutRock rock = cut_rock(roof_wedge +
                                "[[bolt]]\ncollar = [0.2, 0.1, 0]\ndirection = [0, 0, 1]\n"
                                "length = 9\n" +
                                bolt_of_100_kn);
  EXPECT_NEAR(supported(rock).keyblocks[0].crossings[0].embedment.anchored,
              9 - wedge_height(0.2, 0.1), 1e-5);
}

TEST(BoltPattern, OnAPlaneFaceIsCentredAndRectangularOrStaggered) {
  const CutRock rock = cut_rock(
      roof_wedge + pattern_on("room.zmax", "spacing = [2, 1]\nlength = 2\nlayout = 'staggered'\n"));
  const BoltingReport report = supported(rock);
  // 8 m x 8 m: rows of 4 at ±1, ±3 and of 5 at 0, ±2, ±4 in turn; those on the edge may be off the rock.
  EXPECT_EQ(report.groups[0].wall_area, 64);
  Index full = 0;
  for (const Bolt& bolt : report.bolts) {
    EXPECT_NEAR(bolt.collar[2], 0, 1e-9);
    EXPECT_NEAR(norm(bolt.direction - Vec3{0, 0, 1}), 0, 1e-12);
    full += std::abs(std::fmod(std::abs(bolt.collar[0]), 2) - 1) < 1e-9;
  }
  EXPECT_EQ(full, 16);
  EXPECT_GE(report.bolts.size(), 16u + 4 * 3);
}

TEST(BoltPattern, OnAWholeRoomLeavesOutFacesByTheirInclination) {
  const std::string grid = "spacing = 2\nlength = 2\n";
  const auto bolts = [&](const std::string& more) {
    return supported(cut_rock(roof_wedge + pattern_on("room", grid + more))).bolts.size();
  };
  EXPECT_EQ(bolts(""), 16u + 16 + 4 * 4);
  EXPECT_EQ(bolts("inclination = [-10, 90]\n"), 16u + 4 * 4);
  EXPECT_EQ(bolts("inclination = [45, 90]\n"), 16u);
}

TEST(BoltPattern, OnSeveralWallsHasTheBoltsOfEach) {
  const auto bolts_on = [](const std::string& walls) {
    return supported(cut_rock(roof_wedge + "[[bolt_pattern]]\nname = 'p'\non = " + walls +
                              "\nspacing = 2\nlength = 2\n" + bolt_of_100_kn));
  };
  const BoltingReport both = bolts_on("['room.zmax', 'room.xmin']");
  const BoltingReport roof = bolts_on("'room.zmax'"), wall = bolts_on("'room.xmin'");
  ASSERT_EQ(both.groups.size(), 1u);
  EXPECT_EQ(both.groups[0].on, "room.zmax, room.xmin");
  EXPECT_EQ(both.groups[0].wall_area, roof.groups[0].wall_area + wall.groups[0].wall_area);
  ASSERT_EQ(both.bolts.size(), roof.bolts.size() + wall.bolts.size());
  for (std::size_t i = 0; i < both.bolts.size(); ++i) {
    const Bolt& alone = i < roof.bolts.size() ? roof.bolts[i] : wall.bolts[i - roof.bolts.size()];
    EXPECT_EQ(both.bolts[i].collar, alone.collar);
    EXPECT_EQ(both.bolts[i].number, static_cast<Index>(i) + 1);
  }
}

/// A tunnel of 4 m x 3 m along y through rock without key blocks.
const std::string tunnel = R"(
[[material]]
name = "rock"
density = 2700
[[joint_material]]
name = "smooth"
friction_angle = 20
[[solid]]
name = "rock"
shape = "box"
min = [-10, 0, -10]
max = [10, 12, 10]
continues = ["xmin", "xmax", "ymin", "ymax", "zmin", "zmax"]
[[excavation]]
name = "tunnel"
shape = "tunnel"
path = [[0, -1, 0], [0, 13, 0]]
section = "rectangle"
width = 4
height = 3
[[joint]]
name = "level"
dip = 0
dip_direction = 0
point = [0, 0, 2]
[support]
)";

TEST(BoltPattern, RoundATunnelStandsAtTheCrownAndUnrollsToTheRight) {
  const CutRock rock = cut_rock(tunnel + pattern_on("tunnel", "spacing = [1, 2]\nlength = 2\n"));
  const BoltingReport report = supported(rock);
  // Perimeter 14 m: 14 bolts a ring; rings at 0, 2, … 12 m from y = −1 + 1, of which y = 0 … 12 are in the rock.
  EXPECT_NEAR(report.groups[0].wall_area, 14 * 12, 1e-9);
  std::vector<const Bolt*> ring;
  for (const Bolt& bolt : report.bolts)
    if (std::abs(bolt.collar[1] - 4) < 1e-6) ring.push_back(&bolt);
  ASSERT_EQ(ring.size(), 14u);
  for (const Bolt* bolt : ring) {
    const Real u = bolt->sheet[0];
    if (std::abs(u) < 1.99) {
      EXPECT_NEAR(norm(bolt->collar - Vec3{u, 4, 3}), 0, 1e-9)
          << u;  // roof: right is east, north bound
      EXPECT_NEAR(bolt->direction[2], 1, 1e-12);
    } else if (u > 2.01 && u < 4.99) {
      EXPECT_NEAR(norm(bolt->collar - Vec3{2, 4, 3 - (u - 2)}), 0, 1e-9)
          << u;  // east wall, downwards
      EXPECT_NEAR(bolt->direction[0], 1, 1e-12);
    } else if (u < -2.01 && u > -4.99) {
      EXPECT_NEAR(norm(bolt->collar - Vec3{-2, 4, 3 + (u + 2)}), 0, 1e-9) << u;
    }
    EXPECT_NEAR(bolt->sheet[1], 5, 1e-9);  // from the start of the path
  }
}

TEST(BoltPattern, FollowsABendOfTheTunnel) {
  std::string bent = tunnel;
  bent.replace(bent.find("[[0, -1, 0], [0, 13, 0]]"), 24, "[[0, -1, 0], [0, 6, 0], [11, 13, 0]]");
  const CutRock rock = cut_rock(bent + pattern_on("tunnel", "spacing = [1, 1]\nlength = 1\n"));
  const BoltingReport report = supported(rock);
  Index after = 0;
  for (const Bolt& bolt : report.bolts) {
    EXPECT_NEAR(norm(bolt.direction), 1, 1e-12);
    if (bolt.collar[1] > 9) ++after;
    // Each bolt starts on the wall.
    ASSERT_FALSE(bolt.rock.empty());
    EXPECT_NEAR(bolt.rock.front().from, 0, 1e-4);
  }
  EXPECT_GT(after, 50);
  EXPECT_NEAR(static_cast<Real>(report.bolts.size()), report.groups[0].wall_area, 12);
}

TEST(BoltPattern, OfAWallThatTheRockDoesNotShowIsRefused) {
  for (const auto& [wall, part] :
       {std::pair{"rock.xmin", "no free face"}, {"room.zmin", ""}, {"room", ""}}) {
    const CutRock rock = cut_rock(roof_wedge + pattern_on(wall, "spacing = 1\nlength = 2\n"));
    try {
      supported(rock);
      EXPECT_STREQ(part, "");
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
      EXPECT_EQ(error.diagnostics()[0].place.key, "bolt_pattern[1].on");
      EXPECT_GT(error.diagnostics()[0].place.line, 30);
      EXPECT_STRNE(part, "");
    }
  }
}

// A slope that dips 65° to the south: a subtracted half-space, whose face carries the grid.
TEST(BoltPattern, OnASlopeIsNormalToItAndRefusesWhatContinues) {
  const std::string slope =
      roof_wedge.substr(0, roof_wedge.find("[[excavation]]")) +
      "[[solid]]\nname = 'face'\noperation = 'subtract'\nshape = 'halfspaces'\n"
      "planes = [{dip = 65, dip_direction = 180, point = [0, 0, 6], keep = 'above'}]\n"
      "[[joint]]\nname = 'A'\ndip = 40\ndip_direction = 180\npoint = [0, 0, 1]\n[support]\n";
  const BoltingReport report =
      supported(cut_rock(slope + pattern_on("face", "spacing = [1.5, 1.5]\nlength = 2\n")));
  const Real a = 65 * M_PI / 180;
  EXPECT_NEAR(report.groups[0].wall_area, 12 * 9 / std::sin(a), 1e-6);  // 9 m high
  EXPECT_EQ(report.bolts.size(), 8u * 6);
  for (const Bolt& bolt : report.bolts) {
    EXPECT_NEAR(norm(bolt.direction - Vec3{0, std::sin(a), -std::cos(a)}), 0, 1e-9);
    EXPECT_NEAR(std::tan(a) * bolt.collar[1] - (bolt.collar[2] - 6), 0, 1e-6);
  }
  EXPECT_THROW(
      supported(cut_rock(slope +
                         pattern_on("rock", "spacing = 1\nlength = 1\ninclination = [80, 90]\n"))),
      Error);
}

TEST(Bolting, RefusesABoltWithoutRock) {
  const CutRock rock = cut_rock(roof_wedge +
                                "[[bolt]]\ncollar = [0, 0, -1.9]\ndirection = [0, 0, 1]\n"
                                "length = 1\n" +
                                bolt_of_100_kn);
  EXPECT_THROW(supported(rock), Error);
}

/// Through blocks that are convex: the part of a line between the planes of a block's faces.
void expect_clipped(const BlockArrays& blocks, const RockSegment& segment, const Vec3& from,
                    const Vec3& along, Real length) {
  Real low = 0, high = length;
  const Index b = segment.block;
  for (Index f = blocks.face_begin[b]; f < blocks.face_begin[b + 1]; ++f) {
    const Vec3& n = blocks.face_normal[f];
    const Vec3& on = blocks.vertex[blocks.corner_vertex[blocks.corner_begin[blocks.loop_begin[f]]]];
    const Real slope = dot(n, along), t = dot(n, on - from) / slope;
    if (slope > 0) high = std::min(high, t);
    if (slope < 0) low = std::max(low, t);
  }
  EXPECT_NEAR(segment.from, low, 1e-4);
  EXPECT_NEAR(segment.to, high, 1e-4);
}

TEST(RockLines, CrossConvexBlocksWhereTheirPlanesSay) {
  std::string text = tunnel.substr(0, tunnel.find("[[excavation]]")) + "[support]\n";
  for (const char* set : {"dip = 35\ndip_direction = 70", "dip = 80\ndip_direction = 200",
                          "dip = 62\ndip_direction = 320"})
    text += std::string("[[joint_set]]\n") + set + "\nspacing = 1.3\norigin = [0.1, 0.2, 0.3]\n";
  const CutRock rock = cut_rock(text);
  ASSERT_GT(rock.blocks.block_count(), 1000);
  const RockLines lines(rock.blocks, {0, 0, -1});
  std::mt19937 random(5);
  std::uniform_real_distribution<Real> any(-1, 1);
  for (int i = 0; i < 300; ++i) {
    const Vec3 from{9 * any(random), 6 + 5 * any(random), 9 * any(random)};
    const Vec3 along = normalized({any(random), any(random), any(random)});
    const auto segments = lines.along(from, along, 4);
    ASSERT_FALSE(segments.empty());
    Real at = 0;
    for (const RockSegment& segment : segments) {
      EXPECT_NEAR(segment.from, at, 1e-4);  // one block after another
      at = segment.to;
      expect_clipped(rock.blocks, segment, from, along, 4);
    }
    Real end = 4;  // or where the line leaves the box
    for (int d = 0; d < 3; ++d)
      for (const Real wall : {d == 1 ? 0.0 : -10.0, d == 1 ? 12.0 : 10.0})
        if (const Real t = (wall - from[d]) / along[d]; t > 0) end = std::min(end, t);
    EXPECT_NEAR(at, end, 1e-4);
  }
}

TEST(RockLines, AlongAnEdgeOfTheBlocksStillCrossThem) {
  const CutRock rock = cut_rock(roof_wedge);
  const auto segments =
      RockLines(rock.blocks, {0, 0, -1}).along({0, 0, 0}, {0, 0, 1}, 3);  // through the apex
  Real length = 0;
  for (const RockSegment& segment : segments) length += segment.to - segment.from;
  EXPECT_NEAR(length, 3, 1e-4);
}

// Base 2 m x 3, edge 6 m; 50 mm of 2 MPa carry 100 kN/m.
TEST(Shotcrete, HoldsByPunchingShearAlongTheEdgeOfTheBlock) {
  const std::string shotcrete =
      "[shotcrete]\non = 'room'\nthickness = 0.05\nshear_strength = 2e6\n";
  const BoltingReport report = supported(cut_rock(roof_wedge + shotcrete));
  const BlockSupport& support = report.keyblocks[0];
  EXPECT_NEAR(support.shotcrete.edge, 6, 1e-9);
  EXPECT_NEAR(norm(support.shotcrete.force - Vec3{0, 0, 600e3}), 0, 1e-3);
  EXPECT_NEAR(support.held.factor_of_safety, 600 / 15.58846, 1e-4);

  const BoltingReport adhering = supported(
      cut_rock(roof_wedge + shotcrete + "adhesion_strength = 0.5e6\nbond_width = 0.04\n"));
  EXPECT_NEAR(adhering.keyblocks[0].shotcrete.force[2], 6 * 0.04 * 0.5e6, 1e-3);
  EXPECT_THROW(supported(cut_rock(roof_wedge + "[shotcrete]\non = 'rock.xmax'\nthickness = 0.05\n"
                                               "shear_strength = 2e6\n")),
               Error);
}

// Blocks 0 (at the collar) and 1 of batch 1, then 2, which stays; made up.
class SharedBolt : public testing::Test {
 protected:
  SharedBolt() {
    blocks.origins.resize(1);
    keys.batch = {1, 1, 0};
    for (const Index b : {0, 1}) {
      Keyblock key;
      key.block = b, key.batch = 1;
      key.members = {b};
      key.movement = *find_movement({}, {0, 0, -60e3});
      keys.keyblocks.push_back(key);
    }
    report.groups.emplace_back();
    BoltType& type = report.groups[0].type;
    type.force_capacity = 100e3, type.plate_capacity = 40e3, type.bond_strength = 20e3;
    type.displacement_capacity = 1, type.stiffness = 1e6;
    report.bolts.push_back(
        {0, 1, {}, {0, 0, 1}, 9, {}, {{0, 0, 1, 0}, {1, 1, 2.5, 0}, {2, 2.5, 9, none}}});
  }
  BlockArrays blocks;
  KeyblockReport keys;
  BoltingReport report;
};

TEST_F(SharedBolt, GivesTheFrontBlockItsShareAndTheNextOneTheRest) {
  judge_support({blocks, keys, 1, {}}, report);
  const BoltCrossing &front = report.keyblocks[0].crossings[0],
                     &behind = report.keyblocks[1].crossings[0];
  EXPECT_NEAR(front.embedment.anchored, 6.5, 1e-12);  // not in block 1, which moves too
  EXPECT_NEAR(front.axial_capacity, 40e3 + 20e3, 1e-6);
  EXPECT_NEAR(behind.axial_capacity, 40e3 + 1.5 * 20e3 - 60e3, 1e-6);
}

TEST_F(SharedBolt, AnchorsInABlockThatMovesOnlyLater) {
  keys.batch[1] = keys.keyblocks[1].batch = 2;
  judge_support({blocks, keys, 1, {}}, report);
  EXPECT_NEAR(report.keyblocks[0].crossings[0].embedment.anchored, 8, 1e-12);
  const BoltCrossing& behind = report.keyblocks[1].crossings[0];
  EXPECT_FALSE(behind.embedment.plate);  // it is gone with block 0
  EXPECT_NEAR(behind.axial_capacity, 1.5 * 20e3, 1e-6);
}

// Tensioned in blocks that stay, it pulls the one with its plate: what stands between plate and anchor only carries it.
TEST_F(SharedBolt, PullsTheBlockOfItsPlateAloneWhereAllStay) {
  keys.batch = {0, 0, 0};
  std::swap(keys.stable, keys.keyblocks);
  for (Keyblock& key : keys.stable) {
    key.batch = 0;
    key.contact = {{.normal = {0, 0, 1}, .area = 1}};
    key.resultant = {0, 0, -60e3};
  }
  BoltType& type = report.groups[0].type;
  type.action = BoltAction::active;
  type.plate_capacity = 100e3, type.bond_strength.reset();
  judge_support({blocks, keys, 1, {}}, report);
  EXPECT_NEAR(report.stable[0].crossings[0].capacity, 100e3, 1e-6);
  EXPECT_NEAR(report.stable[0].held.factor_of_safety, 100.0 / 60, 1e-9);
  EXPECT_EQ(report.stable[1].crossings[0].capacity, 0);
}

const std::string catalogue = R"(
[[bolt_type]]
name = "light"
force_capacity = 20e3
displacement_capacity = 0.02
mass_per_metre = 1.5
bond_strength = 50e3
[[bolt_type]]
name = "heavy"
force_capacity = 100e3
displacement_capacity = 0.02
mass_per_metre = 3.9
bond_strength = 100e3
)";

TEST(PatternSearch, FindsTheLightestPatternOfAll) {
  const std::string search = R"([pattern_search]
on = "room.zmax"
spacing = [0.5, 0.8, 1.0, 1.6, 2.0]
length = [1.0, 1.5, 2.0, 3.0]
)";
  const CutRock rock = cut_rock(roof_wedge + catalogue + search);
  const PatternSearchReport report = search_pattern(rock.blocks, rock.keyblocks, rock.model);
  EXPECT_EQ(report.patterns, 40);
  EXPECT_TRUE(report.by_mass);
  ASSERT_NE(report.best, none);
  const PatternTrial& best = report.trials[report.best];
  EXPECT_GE(best.least_factor_of_safety, 2);

  // Each pattern as the model's own: none that holds is lighter.
  Real lightest = std::numeric_limits<Real>::infinity();
  for (const char* spacing : {"0.5", "0.8", "1.0", "1.6", "2.0"})
    for (const char* length : {"1.0", "1.5", "2.0", "3.0"})
      for (const auto& [type, mass] : {std::pair{"light", 1.5}, {"heavy", 3.9}}) {
        const CutRock one = cut_rock(roof_wedge + catalogue +
                                     "[[bolt_pattern]]\non = 'room.zmax'\nspacing = " + spacing +
                                     "\nlength = " + length + "\ntype = '" + type + "'\n");
        const BoltingReport bolted = supported(one);
        if (bolted.adequate == 1) lightest = std::min(lightest, bolted.length * mass);
      }
  EXPECT_NEAR(best.weight, lightest, 1e-9 * lightest);
}

TEST(PatternSearch, SaysSoWhenNoPatternHolds) {
  const CutRock rock =
      cut_rock(roof_wedge + catalogue +
               "[pattern_search]\non = 'room.zmax'\nspacing = [3.9]\nlength = [0.2]\n");
  const PatternSearchReport report = search_pattern(rock.blocks, rock.keyblocks, rock.model);
  EXPECT_EQ(report.best, none);
  EXPECT_EQ(report.trials.size(), 2u);
  EXPECT_EQ(report.nearest, 0);  // the lighter of two that hold nothing
  EXPECT_EQ(report.not_held, std::vector<Index>{rock.keyblocks.keyblocks[0].block});
  EXPECT_TRUE(report.disturbed.empty());
  const CutRock small =
      cut_rock(roof_wedge + catalogue +
               "[pattern_search]\non = 'room.zmax'\nspacing = [3.9]\nlength = [0.2]\n"
               "smallest_block = 1.0\n");
  const PatternSearchReport held = search_pattern(small.blocks, small.keyblocks, small.model);
  EXPECT_EQ(held.best, 0);
  EXPECT_EQ(held.nearest, none);
  EXPECT_TRUE(held.not_held.empty());
}

TEST(Support, AlongAGivenDirectionTakesTheForceOfThatDirection) {
  std::string text = roof_wedge + "support_direction = [0.6, 0, 0.8]\n";
  const Keyblock key = cut_rock(text).keyblocks.keyblocks.at(0);
  EXPECT_NEAR(key.support_force, 2 * 15588.46 / 0.8, 0.02);
  EXPECT_NEAR(norm(key.support_direction - Vec3{0.6, 0, 0.8}), 0, 1e-12);
}

}  // namespace
}  // namespace rockfold
