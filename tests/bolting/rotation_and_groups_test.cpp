// Bolts and shotcrete on blocks that turn, and on blocks that fail together: moments and forces by hand.
#include <cmath>
#include <fstream>
#include <numbers>
#include <random>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "host/bolting/bolting.hpp"
#include "host/bolting/pattern_search.hpp"
#include "src/base/vector.hpp"
#include "tests/bolting/bolted_models.hpp"
#include "tests/keyblock/models/turned_model.hpp"

namespace rockfold {
namespace {

using test::cut_rock;
using test::CutRock;
using test::roof_wedge;

constexpr Real degree = std::numbers::pi / 180;

std::string text(const char* format, Real value) {
  char buffer[200];
  std::snprintf(buffer, sizeof buffer, format, value);
  return buffer;
}

/// Gravity turned, so that a level bed dips by an angle towards +x.
std::string on_a_bed_of_dip(Real dip) {
  return text("gravity = [%.17g, 0, ", 10 * std::sin(dip * degree)) +
         text("%.17g]\n", -10 * std::cos(dip * degree));
}

constexpr const char* rough_rock = R"(
[[material]]
name = "rock"
density = 2000
[[joint_material]]
name = "rough"
friction_angle = 80
[[joint_material]]
name = "slick"
friction_angle = 10
)";

/// A column of 0.7 × 1.3 × 3.5 m that leans on nothing but its bed (dip 25°), with rock behind it: it topples about x = 0.7.
std::string column(Real friction_angle = 80) {
  return on_a_bed_of_dip(25) + rough_rock + R"(
[[solid]]
name = "base"
shape = "box"
min = [-6, -6, -6]
max = [6, 6, 0]
continues = ["xmin", "xmax", "ymin", "ymax", "zmin"]
[[solid]]
name = "wall"
shape = "box"
min = [-6, -6, 0]
max = [0, 6, 3.5]
continues = ["xmin", "ymin", "ymax"]
[[solid]]
name = "column"
shape = "box"
min = [0, 0, 0]
max = [0.7, 1.3, 3.5]
[[joint]]
name = "bed"
dip = 0
dip_direction = 0
point = [0, 0, 0]
[[joint]]
name = "back"
dip = 90
dip_direction = 90
point = [0, 0, 0]
[support]
target_factor_of_safety = 1.5
)" + text("[[joint_material]]\nname = 'other'\nfriction_angle = %.17g\n", friction_angle);
}

std::string bolt(const std::string& place, const std::string& more) {
  return "[[bolt]]\n" + place +
         "\ndisplacement_capacity = 0.02\ncoupling = 'CMC'\nforce_capacity = 20e3\n" + more + "\n";
}

BoltingReport supported(const CutRock& rock) {
  return support_blocks(rock.blocks, rock.keyblocks, rock.model);
}

constexpr Real column_weight = 2000 * 10 * 0.7 * 1.3 * 3.5;
const Real overturning = column_weight * std::sin(25 * degree) * 3.5 / 2;
const Real righting = column_weight * std::cos(25 * degree) * 0.7 / 2;

// An anchor from the free side into the rock behind: F = (M_r + T a) / M_d, or M_r / (M_d − T a) where it is tensioned.
TEST(BoltsOnRotations, OfATopplingColumnBalanceTheMomentsAboutItsToe) {
  const Vec3 direction = normalized({-1, 0.1, -0.3});
  const std::string place =
      "collar = [0.7, 0.6, 1.5]\ndirection = [-1, 0.1, -0.3]\nlength = 4\nbond_strength = 8e3";
  // Leaves the column at x = 0, 0.7 m behind the toe and 1.5 − 0.21 m above it; level arm of the force about the toe.
  const Vec3 leaves{0, 0.67, 1.5 - 0.21}, arm = leaves - Vec3{0.7, 0, 0};
  const Real within = 0.7 / -direction[0], anchored = 4 - within;
  const Real tension = std::min({20e3, 20e3 + 8e3 * within, 8e3 * anchored});
  EXPECT_LT(tension, 30e3);
  const Real moment = -tension * cross(arm, direction)[1];
  ASSERT_GT(moment, 0);
  for (const bool active : {false, true}) {
    const CutRock rock = cut_rock(column() + bolt(place, active ? "action = 'active'" : ""));
    ASSERT_EQ(rock.keyblocks.keyblocks.size(), 1u);
    const Keyblock& key = rock.keyblocks.keyblocks[0];
    EXPECT_EQ(key.mode, SlidingMode::rotation);
    EXPECT_NEAR(key.factor_of_safety, righting / overturning, 1e-9);
    const BoltingReport report = supported(rock);
    const BlockSupport& support = report.keyblocks.at(0);
    ASSERT_EQ(support.crossings.size(), 1u);
    EXPECT_NEAR(support.crossings[0].embedment.within, within, 1e-5);
    EXPECT_NEAR(support.crossings[0].embedment.anchored, anchored, 1e-5);
    EXPECT_EQ(support.mode, SlidingMode::rotation);
    const Real expected =
        active ? righting / (overturning - moment) : (righting + moment) / overturning;
    EXPECT_NEAR(support.held.factor_of_safety, expected, 1e-5 * expected);
    // Service load: what the moments about the toe leave to be carried; all of it where it is tensioned.
    const Real share = active ? 1 : (overturning - righting) / moment;
    EXPECT_NEAR(support.crossings[0].load, share * tension, 1e-4 * tension);
  }
}

// A force at the middle of the free faces, along a given direction: F (M_d − P a) = M_r.
TEST(BoltsOnRotations, TheSupportForceIsAlongTheGivenDirection) {
  std::string model = column();
  const std::string target = "target_factor_of_safety = 1.5";
  const Keyblock best = cut_rock(model).keyblocks.keyblocks.at(0);
  model.replace(model.find(target), target.size(), target + "\nsupport_direction = [-1, 0, 0]");
  const Keyblock key = cut_rock(model).keyblocks.keyblocks.at(0);
  // Free faces: x = 0.7 and two ends in full height, the top.
  const Real front = 1.3 * 3.5, ends = 2 * 0.7 * 3.5, top = 0.7 * 1.3;
  const Real height = (1.75 * (front + ends) + 3.5 * top) / (front + ends + top);
  EXPECT_NEAR(key.support_force, (1.5 * overturning - righting) / (1.5 * height), 1e-4);
  EXPECT_LT(best.support_force, key.support_force);
  model.replace(model.find("[-1, 0, 0]"), 10, "[1, 0, 0]  ");
  EXPECT_TRUE(std::isinf(cut_rock(model).keyblocks.keyblocks.at(0).support_force));
}

// Friction of 20° lets it slide too (F = 0.78), less than it topples (F = 0.43). An anchor near the top holds the top,
// but not enough the slide: that then governs.
TEST(BoltsOnRotations, DoNotHideThatTheBlockMaySlideInstead) {
  std::string model = column();
  model.replace(model.find("friction_angle = 80"), 19, "friction_angle = 20");
  const CutRock rock =
      cut_rock(model + bolt("collar = [0.7, 0.6, 3.4]\ndirection = [-1, 0, 0]\nlength = 4", ""));
  const Keyblock& key = rock.keyblocks.keyblocks.at(0);
  EXPECT_EQ(key.mode, SlidingMode::rotation);
  const Real driving = column_weight * std::sin(25 * degree),
             friction = column_weight * std::cos(25 * degree) * std::tan(20 * degree);
  const BoltingReport report = supported(rock);
  const BlockSupport& support = report.keyblocks.at(0);
  EXPECT_EQ(support.mode, SlidingMode::single_plane);
  EXPECT_NEAR(support.held.factor_of_safety, (friction + 20e3) / driving, 1e-6);
  EXPECT_GT((righting + 20e3 * 3.4) / overturning, support.held.factor_of_safety);
}

// Sprayed concrete on the free side of a column that topples: its edge of 2 (1.3 + 3.5) m works at half height.
TEST(ShotcreteOnRotations, WorksAtTheMiddleOfItsEdge) {
  const CutRock rock = cut_rock(
      column() + "[shotcrete]\non = 'column.xmax'\nthickness = 0.01\nshear_strength = 2e5\n");
  const BlockSupport support = supported(rock).keyblocks.at(0);
  EXPECT_NEAR(support.shotcrete.edge, 2 * (1.3 + 3.5), 1e-12);
  EXPECT_LT(norm(support.shotcrete.point - Vec3{0.7, 0.65, 1.75}), 1e-12);
  EXPECT_NEAR(support.held.factor_of_safety, (righting + 0.01 * 2e5 * 2 * 4.8 * 1.75) / overturning,
              1e-9);
}

/// Two unit cubes in a row on a bed of dip 40°: the one in front (x from 0 to 1) rough below, the one behind slick.
std::string two_cubes() {
  return on_a_bed_of_dip(40) + rough_rock + R"(
[[solid]]
name = "base"
shape = "box"
min = [-6, -6, -6]
max = [6, 6, 0]
continues = ["xmin", "xmax", "ymin", "ymax", "zmin"]
[[solid]]
name = "row"
shape = "box"
min = [-1, 0, 0]
max = [1, 1, 1]
[[joint]]
name = "toe"
dip = 0
dip_direction = 0
polygon = [[0, -1, 0], [2, -1, 0], [2, 2, 0], [0, 2, 0]]
material = "rough"
[[joint]]
name = "seat"
dip = 0
dip_direction = 0
polygon = [[0, -1, 0], [-2, -1, 0], [-2, 2, 0], [0, 2, 0]]
material = "slick"
[[joint]]
name = "cross"
dip = 90
dip_direction = 90
point = [0, 0, 0]
polygon = [[0, -1, 0], [0, 2, 0], [0, 2, 2], [0, -1, 2]]
material = "slick"
[support]
rotation = false
target_factor_of_safety = 1.5
)";
}

constexpr Real cube_weight = 2000 * 10;
Real mean_friction(Real front) {
  return 0.5 * (std::tan(front * degree) + std::tan(10 * degree));
}

std::string with_rough_angle(std::string model, const char* angle) {
  model.replace(model.find("friction_angle = 80"), 19, std::string("friction_angle = ") + angle);
  return model;
}

// One bolt across both: F = (R + T sin β tan φ + T cos β) / D, β its angle to the bed, T from its lengths in the group and
// beyond it.
TEST(BoltsOnGroups, HoldBothBlocksByOneBalance) {
  const CutRock rock = cut_rock(
      with_rough_angle(two_cubes(), "55") +
      bolt("collar = [0.95, 0.5, 1]\ndirection = [-1, 0, -1]\nlength = 3\nplate_capacity = 4e3",
           "bond_strength = 6e3"));
  ASSERT_EQ(rock.keyblocks.keyblocks.size(), 1u);
  const Keyblock& key = rock.keyblocks.keyblocks[0];
  EXPECT_EQ(key.members.size(), 2u);
  const Real driving = 2 * cube_weight * std::sin(40 * degree), friction = mean_friction(55),
             resisting = 2 * cube_weight * std::cos(40 * degree) * friction;
  EXPECT_NEAR(key.factor_of_safety, resisting / driving, 1e-9);
  const BoltingReport report = supported(rock);
  const BlockSupport& support = report.keyblocks.at(0);
  ASSERT_EQ(support.crossings.size(), 1u);  // once, although it crosses two blocks
  EXPECT_EQ(support.members, key.members);
  const Real within = std::sqrt(2.0), anchored = 3 - within;
  EXPECT_NEAR(support.crossings[0].embedment.within, within, 1e-5);
  EXPECT_NEAR(support.crossings[0].embedment.anchored, anchored, 1e-5);
  const Real tension = std::min({20e3, 4e3 + 6e3 * within, 6e3 * anchored});
  const Real c = std::sqrt(0.5);
  EXPECT_NEAR(support.held.factor_of_safety,
              (resisting + tension * c * friction + tension * c) / driving, 1e-5);
  EXPECT_EQ(report.adequate, support.held.factor_of_safety >= 1.5);
}

TEST(BoltsOnGroups, ThatEndInTheOtherBlockHoldNothing) {
  const CutRock rock =
      cut_rock(with_rough_angle(two_cubes(), "55") +
               bolt("collar = [1, 0.5, 0.5]\ndirection = [-1, 0, 0]\nlength = 1.8", ""));
  ASSERT_EQ(rock.keyblocks.keyblocks.size(), 1u);
  const BlockSupport support = supported(rock).keyblocks.at(0);
  EXPECT_EQ(support.crossings.at(0).capacity, 0);
  EXPECT_NEAR(support.held.factor_of_safety, rock.keyblocks.keyblocks[0].factor_of_safety, 1e-12);
}

// The lining over two blocks that move as one is cut along the edge of both, not along the joint between them.
TEST(ShotcreteOnGroups, IsPunchedAlongTheEdgeOfAll) {
  const CutRock rock =
      cut_rock(with_rough_angle(two_cubes(), "55") +
               "[shotcrete]\non = 'row.zmax'\nthickness = 0.05\nshear_strength = 1e6\n");
  ASSERT_EQ(rock.keyblocks.keyblocks.size(), 1u);
  const BlockSupport support = supported(rock).keyblocks.at(0);
  EXPECT_NEAR(support.shotcrete.edge, 2 * (2 + 1), 1e-12);
  EXPECT_NEAR(support.shotcrete.force[2], -0.05e6 * 6, 1e-6);
}

/// A slab of 10 × 12 × 2 m on a bed that dips 40°, φ = 32°, with 30 anchors of 200 kN normal to it: W = 6239.16 kN.
std::string bolted_slab(const std::string& action) {
  return on_a_bed_of_dip(40) + R"(
[[material]]
density = 2650
[[joint_material]]
name = "bed"
friction_angle = 32
[[solid]]
name = "base"
shape = "box"
min = [-20, -20, -20]
max = [30, 30, 0]
continues = ["xmin", "xmax", "ymin", "ymax", "zmin"]
[[solid]]
name = "slab"
shape = "box"
min = [0, 0, 0]
max = [10, 12, 2]
interface = "bed"
[support]
rotation = false
[[bolt_pattern]]
on = "slab.zmax"
spacing = 2
length = 5
force_capacity = 200e3
displacement_capacity = 0.03
action = )" +
         ('"' + action + "\"\n");
}

// Hoek: F = (W cos ψ + n T) tan φ / (W sin ψ), active or passive.
TEST(BoltsNormalToTheMotion, PressTheBlockOnItsPlane) {
  const Real weight = 2650 * 10 * 240.0;
  for (const char* action : {"active", "passive"}) {
    const CutRock rock = cut_rock(bolted_slab(action));
    const BlockSupport support = supported(rock).keyblocks.at(0);
    const auto bolts = static_cast<Real>(support.crossings.size());
    EXPECT_GE(bolts, 30);
    EXPECT_NEAR(support.held.factor_of_safety,
                (weight * std::cos(40 * degree) + bolts * 200e3) * std::tan(32 * degree) /
                    (weight * std::sin(40 * degree)),
                1e-9);
    EXPECT_EQ(support.mode, SlidingMode::single_plane);
    EXPECT_NEAR(support.crossings[0].force.angle, 90 * degree, 1e-9);
    const Real lacks =
        weight * (std::sin(40 * degree) / std::tan(32 * degree) - std::cos(40 * degree));
    EXPECT_NEAR(support.force_mobilisation, action[0] == 'a' ? 1 : lacks / (bolts * 200e3), 1e-9);
  }
}

/// A block of 60 kN, 1 × 1 × 3 m, on a level floor, with rock from x = −2 on across a gap.
std::string standing_block(const std::string& friction_angle) {
  return "gravity = [0, 0, -10]\n" + with_rough_angle(rough_rock, friction_angle.c_str()) + R"(
[[solid]]
name = "base"
shape = "box"
min = [-6, -6, -6]
max = [6, 6, 0]
continues = ["xmin", "xmax", "ymin", "ymax", "zmin"]
[[solid]]
name = "wall"
shape = "box"
min = [-6, -6, 0]
max = [-2, 6, 4]
continues = ["xmin", "ymin", "ymax"]
[[solid]]
name = "block"
shape = "box"
min = [0, 0, 0]
max = [1, 1, 3]
interface = "rough"
[support]
target_factor_of_safety = 1.5
)";
}

// At rest by itself. T = 20 kN, level: F = W tan φ / T of sliding, W 0.5 m / (T z) of turning over.
TEST(AnchorsThatDrive, MoveABlockAtRest) {
  const auto pulled = [](const std::string& friction, const std::string& z,
                         const std::string& action) {
    return cut_rock(standing_block(friction) +
                    bolt("collar = [1, 0.5, " + z + "]\ndirection = [-1, 0, 0]\nlength = 6",
                         "action = '" + action + "'"));
  };
  const CutRock slides = pulled("20", "0.4", "active");
  EXPECT_TRUE(slides.keyblocks.keyblocks.empty());
  EXPECT_TRUE(slides.keyblocks.stable.empty());
  const BoltingReport sliding = supported(slides);
  ASSERT_EQ(sliding.at_rest.size(), 1u);
  EXPECT_EQ(sliding.at_rest[0].mode, SlidingMode::single_plane);
  EXPECT_NEAR(sliding.at_rest[0].held.factor_of_safety, 60 * std::tan(20 * degree) / 20, 1e-9);
  EXPECT_EQ(sliding.disturbed, (std::vector<Index>{slides.keyblocks.at_rest.at(0).block}));

  const BoltingReport turning = supported(pulled("70", "2.9", "active"));
  ASSERT_EQ(turning.at_rest.size(), 1u);
  EXPECT_EQ(turning.at_rest[0].mode, SlidingMode::rotation);
  EXPECT_NEAR(turning.at_rest[0].held.factor_of_safety, 60 * 0.5 / (20 * 2.9), 1e-9);
  EXPECT_EQ(turning.disturbed.size(), 1u);

  const BoltingReport firm = supported(pulled("70", "0.4", "active"));
  ASSERT_EQ(firm.at_rest.size(), 1u);
  EXPECT_NEAR(firm.at_rest[0].held.factor_of_safety, 60 * 0.5 / (20 * 0.4), 1e-9);
  EXPECT_TRUE(firm.at_rest[0].held.adequate);
  EXPECT_TRUE(firm.disturbed.empty());

  const CutRock slack = pulled("20", "0.4", "passive");
  EXPECT_TRUE(slack.keyblocks.at_rest.empty());
  EXPECT_TRUE(supported(slack).at_rest.empty());
}

// The lighter pattern would slide the block on its floor; the other one does nothing to it.
TEST(AnchorsThatDrive, AreNoPatternOfTheSearch) {
  const std::string model = standing_block("20") + R"(
[[bolt_type]]
name = "tensioned"
action = "active"
force_capacity = 20e3
displacement_capacity = 0.02
mass_per_metre = 1
[[bolt_type]]
name = "grouted"
force_capacity = 20e3
displacement_capacity = 0.02
mass_per_metre = 2
[pattern_search]
on = "block.xmax"
spacing = [2]
length = [6]
)";
  const CutRock rock = cut_rock(model);
  const PatternSearchReport report = search_pattern(rock.blocks, rock.keyblocks, rock.model);
  ASSERT_EQ(report.trials.size(), 2u);
  EXPECT_EQ(report.trials[0].disturbed, 1);
  EXPECT_EQ(report.best, 1);

  const CutRock tensioned = cut_rock(model + "types = [\"tensioned\"]\n");
  const PatternSearchReport none_left =
      search_pattern(tensioned.blocks, tensioned.keyblocks, tensioned.model);
  EXPECT_EQ(none_left.best, none);
  EXPECT_EQ(none_left.nearest, 0);
  EXPECT_TRUE(none_left.not_held.empty());
  ASSERT_EQ(none_left.disturbed.size(), 1u);
  EXPECT_NEAR(tensioned.blocks.centroid[none_left.disturbed[0]][2], 1.5, 1e-12);
}

std::string example(const std::string& name) {
  std::ifstream file(ROCKFOLD_SOURCE_DIR "/tests/cases/" + name + "/model.toml");
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

/// A cut model in which a block moves in a mode, with water on its joints and a bolt through it.
struct Moving {
  SlidingMode mode;
  std::string model;
};
std::vector<Moving> moving_models(const std::string& action) {
  const std::string slide =
      "[[water]]\ntable = {dip = 10, dip_direction = 200, point = [0, 7.5, 6]}\n";
  std::string wedge = example("wedge");
  wedge.replace(wedge.find("friction_angle = 30.0"), 21, "friction_angle = 20.0");
  const auto bolt = [&](const std::string& place, const std::string& more) {
    return rockfold::bolt(place, more + "\naction = '" + action + "'");
  };
  return {
      {SlidingMode::lifting,
       roof_wedge + "[[water]]\nhead = 0.7\n" +
           bolt("collar = [0.2, 0.1, 0]\ndirection = [0.1, 0, 1]\nlength = 3", "")},
      {SlidingMode::single_plane,
       with_rough_angle(two_cubes(), "55") + "[[water]]\npressure = 500\n" +
           bolt("collar = [0.95, 0.5, 1]\ndirection = [-1, 0, -1]\nlength = 3",
                "shear_capacity = 5e3")},
      {SlidingMode::two_planes,
       wedge + slide + bolt("collar = [0.3, 0.6, 9]\ndirection = [0, 1, -0.2]\nlength = 12", "")},
      {SlidingMode::rotation,
       column() + "[[water]]\npressure = 300\n" +
           bolt("collar = [0.7, 0.6, 1.5]\ndirection = [-1, 0.1, -0.3]\nlength = 4", "")}};
}

void expect_same_turned(const Moving& moving, std::mt19937_64& random) {
  std::normal_distribution<Real> normal;
  const CutRock rock = cut_rock(moving.model);
  ASSERT_FALSE(rock.keyblocks.keyblocks.empty());
  const Keyblock& before = rock.keyblocks.keyblocks[0];
  EXPECT_EQ(before.mode, moving.mode);
  const BlockSupport held = supported(rock).keyblocks.at(0);
  ASSERT_EQ(held.crossings.size(), 1u);
  EXPECT_GT(held.crossings[0].capacity, 0);
  for (int trial = 0; trial < 20; ++trial) {
    SCOPED_TRACE(trial);
    CutRock turned = rock;
    const Vec3 axis = normalized({normal(random), normal(random), normal(random)});
    const Real angle = 180 * normal(random);
    test::turn(turned.blocks, turned.model, axis, angle);
    turned.keyblocks = find_keyblocks(turned.blocks, turned.model);
    ASSERT_EQ(turned.keyblocks.batch, rock.keyblocks.batch);
    const Keyblock& after = turned.keyblocks.keyblocks.at(0);
    EXPECT_EQ(after.mode, before.mode);
    EXPECT_NEAR(after.sliding_force, before.sliding_force, 1e-10 * before.weight);
    EXPECT_NEAR(after.support_force, before.support_force, 1e-10 * before.weight);
    EXPECT_LT(norm(after.direction - test::rotated(before.direction, axis, angle)), 1e-10);
    if (std::isfinite(before.factor_of_safety)) {
      EXPECT_NEAR(after.factor_of_safety, before.factor_of_safety, 1e-10);
    }
    const BlockSupport now = supported(turned).keyblocks.at(0);
    EXPECT_EQ(now.mode, held.mode);
    constexpr Real rounding = 1e-10;
    EXPECT_NEAR(now.held.factor_of_safety, held.held.factor_of_safety,
                rounding * std::max(1.0, held.held.factor_of_safety));
    EXPECT_NEAR(now.crossings.at(0).capacity, held.crossings[0].capacity,
                rounding * held.crossings[0].capacity);
  }
}

// Limit equilibrium in all modes, with water, bolts and their forces, whichever way the model looks, to 1e-10.
TEST(SupportedBlocks, OfATurnedModelAreTheSame) {
  std::mt19937_64 random(31);
  for (const char* action : {"passive", "active"})
    for (const Moving& moving : moving_models(action)) {
      SCOPED_TRACE(action);
      expect_same_turned(moving, random);
    }
}

}  // namespace
}  // namespace rockfold
