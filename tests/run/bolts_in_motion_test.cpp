// Bolts hold blocks in motion: by closed forms of what the steel bears, and by the sums of block theory.
#include <cmath>
#include <fstream>
#include <iterator>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "host/bolting/bolt_capacity.hpp"
#include "host/bolting/bolt_law.hpp"
#include "src/base/vector.hpp"
#include "tests/run/run_model.hpp"

namespace rockfold {
namespace {

constexpr Real gravity = 9.81, degree = std::numbers::pi / 180;

std::string number(Real x) {
  return fmt::format("{:.17g}", x);
}
std::string vector_text(const Vec3& v) {
  return fmt::format("[{:.17g}, {:.17g}, {:.17g}]", v[0], v[1], v[2]);
}

std::string rock(Real modulus) {
  return "[[material]]\ndensity = 2500\nyoung_modulus = " + number(modulus) +
         "\npoisson_ratio = 0.0\n[[joint_material]]\nname = 'j'\nfriction_angle = 20\n";
}

/// Of a bolt that is pulled at x = 0 and ends at L, over its force at 0.
Real force_along(Real lambda, Real length, Real x) {
  return std::sinh(lambda * (length - x)) / std::sinh(lambda * length);
}

/// A column of 3 m with a joint 2 m over its foot, and a bolt of 2.8 m down from its head; the upper block is drawn off over a second.
std::string drawn(const std::string& bolt, Real way, const std::string& steps,
                  Real modulus = 1e13) {
  return "gravity = [0, 0, 0]\n" + rock(modulus) +
         "[[solid]]\nname = 'rock'\nshape = 'box'\nmin = [0, 0, 0]\nmax = [1, 1, 3]\n"
         "[[joint]]\nname = 'joint'\nmaterial = 'j'\ndip = 0\ndip_direction = 0\npoint = [0, 0, "
         "2]\n[[bolt]]\nname = 'B'\ncollar = [0.5, 0.5, 3]\ndirection = [0, 0, -1]\nlength = 2.8\n"
         "displacement_capacity = 0.05\ndiameter = 0.025\n" +
         bolt +
         "[cover]\nlattice = 'block'\n[[fixed]]\nwhere = {block_at = [0.5, 0.5, 1]}\n[[fixed]]\n"
         "where = {block_at = [0.5, 0.5, 2.5]}\nvalue_table = [[0, 0, 0, 0], [1, 0, 0, " +
         number(way) + "]]\n" + steps + "[output]\nevery = 0\n";
}
const std::string ten_steps = "[[step]]\ntype = 'quasi_static'\ntime_step = 0.1\nsteps = 10\n";

TEST(Bolts, TakeTheirLoadAlongTheirBond) {
  const Real section = 200e9 * std::numbers::pi / 4 * 0.025 * 0.025, bond = 2e8;
  const Real lambda = std::sqrt(bond / section), stiffness = std::sqrt(bond * section);
  // Below the joint 1.8 m that end free, above it 1 m to the plate.
  const Real below = stiffness * std::tanh(lambda * 1.8),
             above = stiffness / std::tanh(lambda * 1.0);
  const ModelAnswer answer =
      run_model(drawn("force_capacity = 250e3\nbond_stiffness = 2e8\n", 0.5e-3, ten_steps));
  const BoltResult& bolt = answer.result.bolts.at(0);
  EXPECT_NEAR(bolt.force, 0.5e-3 / (1 / below + 1 / above), 0.01 * bolt.force);
  for (std::size_t i = 0; i < bolt.at.size(); ++i)
    if (bolt.at[i] > 1) {
      EXPECT_NEAR(bolt.along[i], bolt.force * force_along(lambda, 1.8, bolt.at[i] - 1),
                  0.01 * bolt.along[i]);
    }
  EXPECT_NEAR(bolt.plate, bolt.force / std::cosh(lambda * 1.0), 0.01 * bolt.plate);
  EXPECT_EQ(bolt.status, BoltStatus::elastic);
  // What supports have done is in the bolt.
  EXPECT_NEAR(answer.result.energy.bolts, 0.5 * bolt.force * 0.5e-3,
              0.01 * answer.result.energy.bolts);
  EXPECT_NEAR(answer.result.energy.supports, answer.result.energy.bolts,
              0.01 * answer.result.energy.bolts);
}

TEST(Bolts, SlideWhereTheirBondIsUsedUp) {
  const ModelAnswer answer = run_model(drawn(
      "force_capacity = 500e3\nbond_stiffness = 1e9\nbond_strength = 100e3\n", 0.02, ten_steps));
  const BoltResult& bolt = answer.result.bolts.at(0);
  EXPECT_EQ(bolt.status, BoltStatus::slides);
  EXPECT_NEAR(bolt.force, 100e3 * (1.8 - 0.02), 0.005 * 180e3);  // by as much it has come out
  for (std::size_t i = 0; i < bolt.at.size(); ++i)
    if (bolt.at[i] > 1.1) {
      EXPECT_NEAR(bolt.along[i], bolt.force * (1 - (bolt.at[i] - 1) / 1.8), 0.01 * bolt.force);
    }
}

TEST(Bolts, ComeOutOfTheirHolesForGood) {
  const RunResult run =
      run_model(drawn("force_capacity = 500e3\nplate_capacity = 0\nbond_stiffness = 1e9\n"
                      "bond_strength = 50e3\n",
                      5, "[[step]]\ntype = 'quasi_static'\ntime_step = 0.01\nsteps = 100\n"))
          .result;
  // At the joint; where the bond had slid, what it had taken there is locked in.
  const BoltResult& bolt = run.bolts[0];
  for (std::size_t i = 0; i < bolt.at.size(); ++i)
    if (std::abs(bolt.at[i] - 1) < 1e-9) {
      EXPECT_NEAR(bolt.along[i], 0, 1);
    }
  EXPECT_EQ(run.bolts[0].status, BoltStatus::slides);
  EXPECT_NEAR(run.energy.bolts, 0.5 * 50e3, 0.05 * 25e3);  // of the metre in the upper block
}

TEST(Bolts, SlideAtTheirAnchor) {
  const BoltResult bolt =
      run_model(drawn("coupling = 'DMFC'\naction = 'passive'\nforce_capacity = 500e3\n"
                      "anchor_length = 0.5\nbond_strength = 15e3\n",
                      0.1, ten_steps))
          .result.bolts[0];
  EXPECT_NEAR(bolt.force, 15e3 * (0.5 - 0.1), 0.01 * 7.5e3);
  EXPECT_NEAR(bolt.peak, 7.5e3, 0.01 * 7.5e3);
}

TEST(Bolts, YieldHardenAndBreakAtTheStrainOfRupture) {
  const Real section = std::numbers::pi / 4 * 0.025 * 0.025, length = 2.8;
  const std::string steel =
      "coupling = 'DMFC'\naction = 'passive'\nforce_capacity = 300e3\nyield = 400e6\n"
      "rupture = 0.01\nplate_capacity = 1e6\n";
  const Real yield = 400e6 * section, elastic = yield / (200e9 * section) * length;
  const auto force = [&](Real way) {
    return run_model(drawn(steel, way, ten_steps)).result.bolts.at(0);
  };
  EXPECT_NEAR(force(0.5 * elastic).force, 0.5 * yield, 0.005 * yield);
  // Half of the plastic strain, half of the hardening.
  const Real half = 0.5 * (yield + 300e3);
  const BoltResult hard = force(half / (200e9 * section) * length + 0.005 * length);
  EXPECT_NEAR(hard.force, half, 0.005 * half);
  EXPECT_EQ(hard.status, BoltStatus::yields);
  const BoltResult broken = force(1.2 * (0.01 * length + 300e3 / (200e9 * section) * length));
  EXPECT_EQ(broken.status, BoltStatus::broken);
  EXPECT_LT(broken.force, 1);
  EXPECT_NEAR(broken.peak, 300e3, 1);
  EXPECT_TRUE(broken.broken_at.has_value());
}

TEST(Bolts, PullWithWhatTheyWereTensionedTo) {
  const std::string anchor = "coupling = 'DMFC'\nforce_capacity = 100e3\n";
  EXPECT_NEAR(run_model(drawn(anchor, 0, ten_steps)).result.bolts[0].force, 100e3, 0.1e3);
  const ModelAnswer told = run_model(drawn(anchor + "pretension = 40e3\n", 0, ten_steps));
  EXPECT_NEAR(told.result.bolts[0].force, 40e3, 0.1e3);
  EXPECT_NEAR(told.result.bolts[0].plate, 40e3, 0.1e3);
  EXPECT_NEAR(told.result.conditions[1].force[2], 40e3, 0.1e3);  // holds the block off the joint
}

TEST(Bolts, FeelOnlyWhatMovesOnceTheyAreIn) {
  const std::string two =
      "[[step]]\nname = 'before'\ntype = 'quasi_static'\ntime_step = 0.1\nsteps = 5\n"
      "[[step]]\nname = 'after'\ntype = 'quasi_static'\ntime_step = 0.1\nsteps = 5\n";
  const std::string bolt = "force_capacity = 250e3\nbond_stiffness = 2e8\n";
  const Real all = run_model(drawn(bolt, 0.5e-3, two)).result.bolts[0].force;
  const ModelAnswer late = run_model(drawn(bolt + "install = 'after'\n", 0.5e-3, two));
  EXPECT_NEAR(late.result.bolts[0].force, 0.5 * all, 0.01 * all);
}

/// A box of 2 × 2 × 1 m, 10 t, on a plane that stands for one of 30°; a bolt through the middle of its base at an angle to the direction against
/// its motion, and a push along the plane.
struct OnPlane {
  Real angle = 0, push = 0;
  std::string bolt, step = "type = 'quasi_static'\n", cover = "lattice = 'block'";
  int steps = 30;

  Vec3 direction() const { return {-std::cos(angle), 0, -std::sin(angle)}; }
  std::string model() const {
    const Vec3 d = direction();
    const Real back = (1 - 1e-9) * std::min(1 / std::max(std::sin(angle), 1e-9),
                                            1 / std::max(std::cos(angle), 1e-9));
    return "gravity = [4.905, 0, -8.495709211126]\n" + rock(1e10) +
           "[[solid]]\nname = 'plane'\nshape = 'box'\nmin = [-6, -1, -6]\nmax = [7, 3, 0]\n"
           "[[solid]]\nname = 'box'\nshape = 'box'\nmin = [0, 0, 0]\nmax = [2, 2, 1]\n"
           "interface = 'j'\n[[bolt]]\nname = 'B'\ncollar = " +
           vector_text({1 - back * d[0], 1, -back * d[2]}) + "\ndirection = " + vector_text(d) +
           "\nlength = " + number(back + 3) + "\n" + bolt + "[cover]\n" + cover +
           "\n[[fixed]]\nwhere = {face = 'plane.zmin'}\n[[point_load]]\npoint = [1, 1, 0.5]\n"
           "force_table = [[0, 0, 0, 0], [0.5, " +
           number(push) + ", 0, 0]]\n[[step]]\ntime_step = 0.05\nsteps = " + std::to_string(steps) +
           "\n" + step + "[output]\nevery = 0\n[[monitor]]\nname = 'middle'\npoint = [1, 1, 0.5]\n";
  }
};

constexpr Real weight = 10000 * gravity;

/// N, the push at which it slides: friction under what bolt and weight press it with, and the bolt.
Real limit(const Vec3& force_of_bolt) {
  return (weight * std::cos(30 * degree) - force_of_bolt[2]) * std::tan(20 * degree) -
         force_of_bolt[0] - weight * std::sin(30 * degree);
}

/// m, that the box goes in the last of its steps.
Real last_way(const OnPlane& box) {
  const auto u = run_model(box.model()).result.monitors[0].displacement;
  return u.back()[0] - u[u.size() - 2][0];
}

const std::string stiff =
    "force_capacity = 100e3\ndisplacement_capacity = 1\nstiffness = 5e9\nplate_capacity = 1e6\n";

class BoltAtAnAngle : public testing::TestWithParam<int> {};
TEST_P(BoltAtAnAngle, HoldsABlockUpToTheSumsOfBlockTheory) {
  OnPlane box{.angle = GetParam() * degree, .bolt = stiff};
  const Real slides = limit(100e3 * box.direction());
  box.push = 0.99 * slides;
  EXPECT_LT(std::abs(last_way(box)), 1e-7);
  box.push = 1.01 * slides;
  EXPECT_GT(last_way(box), 1e-5);
}
INSTANTIATE_TEST_SUITE_P(Degrees, BoltAtAnAngle, testing::Values(5, 30, 60, 80));

TEST(Bolts, HoldABlockByExplicitStepsAndOnLatticesToo) {
  constexpr Real still =
      1e-7;  // m; steps that relax give what moves mass, and start anew from rest
  OnPlane box{.angle = 30 * degree, .bolt = stiff};
  const Real slides = limit(100e3 * box.direction());
  for (const bool lattice : {false, true}) {
    SCOPED_TRACE(lattice);
    if (lattice)
      box.cover = "lattice = 'hex8'\nspacing = 1";
    else
      box.step = "type = 'quasi_static'\nscheme = 'explicit'\n";
    box.push = 0.99 * slides;
    EXPECT_LT(std::abs(last_way(box)), still);
    box.push = 1.01 * slides;
    EXPECT_GT(last_way(box), still);
    box.step = "type = 'quasi_static'\n";
  }
}

/// A block that nothing holds falls beside one on a bolt, which comes to rest all the same: mass is added as far as what touches needs it.
TEST(Bolts, BearABlockByExplicitStepsBesideOneThatFalls) {
  std::string model = rock(2e10) +
                      "[[solid]]\nname = 'roof'\nshape = 'box'\nmin = [0, 0, 1]\nmax = [4, 1, 4]\n"
                      "[cover]\nlattice = 'block'\n[[fixed]]\nwhere = {face = 'roof.zmax'}\n"
                      "[[bolt]]\nname = 'B'\ncollar = [0.5, 0.5, 0]\ndirection = [0, 0, 1]\n"
                      "length = 3\nforce_capacity = 100e3\ndisplacement_capacity = 0.005\n"
                      "plate_capacity = 100e3\n"
                      "[[step]]\ntype = 'quasi_static'\nscheme = 'explicit'\ntime_step = 0.2\n"
                      "steps = 5\n[output]\nevery = 0\n";
  for (const int x : {0, 3})
    model += "[[solid]]\nname = 'block" + std::to_string(x) + "'\nshape = 'box'\nmin = [" +
             std::to_string(x) + ", 0, 0]\nmax = [" + std::to_string(x + 1) +
             ", 1, 1]\ninterface = 'j'\n";
  const RunResult run = run_model(model).result;
  EXPECT_NEAR(run.bolts[0].force, 2500 * gravity, 0.01 * 2500 * gravity);
  EXPECT_EQ(run.rest->moving.size(), 1u);
  EXPECT_NEAR(run.unbalanced->force, 2500 * gravity, 1);
}

/// With shear strength the force of a joint that has slipped is that of the most work, whatever it was when it began to.
TEST(Bolts, BearWhatBlockTheorySaysOnceTheJointHasSlipped) {
  for (const int angle : {20, 45, 70, 90}) {
    SCOPED_TRACE(angle);
    OnPlane box{.angle = angle * degree, .bolt = stiff + "shear_capacity = 60e3\n"};
    BoltType type;
    type.force_capacity = 100e3;
    type.shear_capacity = 60e3;
    const BoltForce wanted = bolt_force(type, box.direction(), 100e3, {1, 0, 0});
    box.push = 1.1 * limit(wanted.force);
    box.step = "type = 'dynamic'\n";
    box.steps = 40;
    const ModelAnswer answer = run_model(box.model());
    ASSERT_GT(answer.result.monitors[0].displacement.back()[0], 0.05);
    EXPECT_NEAR(answer.result.bolts[0].force, wanted.axial, 0.01 * 100e3);
    EXPECT_NEAR(answer.result.bolts[0].shear, wanted.shear, 0.01 * 60e3);
  }
}

/// Bolts that break where they have given as much as they can: of three the stiffest takes most, and goes first. Each bears the push by itself until it does.
TEST(Bolts, BreakOneAfterTheOther) {
  OnPlane box{.angle = 5 * degree, .bolt = stiff, .steps = 80};
  std::string more;
  const std::vector<std::string> reach{"0.002", "0.003", "0.004"};
  const Vec3 d = box.direction();
  for (int k = 0; k < 3; ++k)
    more += "[[bolt]]\nname = 'C" + std::to_string(k) + "'\ncollar = " +
            vector_text({2 - 1e-9, 0.5 + 0.5 * k, 0.087488663525924 * (2 - 1e-9)}) +
            "\ndirection = " + vector_text(d) +
            "\nlength = 6\nforce_capacity = 100e3\nplate_capacity = 1e6\ndisplacement_capacity = " +
            reach[k] + "\n";
  for (const std::string cover : {"lattice = 'block'", "lattice = 'hex8'\nspacing = 2"}) {
    SCOPED_TRACE(cover);
    box.cover = cover;
    std::string model = box.model();
    const auto from = model.find("[[bolt]]"), to = model.find("[cover]");
    model.replace(from, to - from, more);
    const auto table = model.find("force_table"), end = model.find('\n', table);
    model.replace(
        table, end - table,
        "force_table = [[0, 0, 0, 0], [4, " + number(1.5 * limit(300e3 * d)) + ", 0, 0]]");
    const std::vector<BoltResult> bolts = run_model(model).result.bolts;
    for (const BoltResult& bolt : bolts) {
      EXPECT_EQ(bolt.status, BoltStatus::broken) << bolt.name;
      EXPECT_NEAR(bolt.peak, 100e3, 1) << bolt.name;
      ASSERT_TRUE(bolt.broken_at.has_value());
    }
    EXPECT_LT(*bolts[0].broken_at, *bolts[1].broken_at);
    EXPECT_LE(*bolts[1].broken_at, *bolts[2].broken_at);
  }
}

/// Blocks in a row that hold on to each other: what one bolt no longer bears comes onto the next. Where the joints between them bear less than the others have
/// left, the first block falls alone.
TEST(Bolts, BreakLikeAZipperInARowOfKeyBlocks) {
  std::ifstream file(ROCKFOLD_SOURCE_DIR "/tests/cases/bolt_row/model.toml");
  const std::string model{std::istreambuf_iterator<char>(file), {}};
  const std::vector<BoltResult> all = run_model(model).result.bolts;
  ASSERT_EQ(all.size(), 8u);
  Real before = 0;
  for (const BoltResult& bolt : all) {
    ASSERT_TRUE(bolt.broken_at.has_value()) << bolt.name;
    EXPECT_GT(*bolt.broken_at, before) << bolt.name;
    before = *bolt.broken_at;
  }
  std::string weak = model;
  for (const std::string key : {"cohesion", "tensile_strength"}) {
    const auto at = weak.find(key + " = \"60 kPa\"");
    ASSERT_NE(at, std::string::npos);
    weak.replace(at, key.size() + 11, key + " = \"3 kPa\"");
  }
  const std::vector<BoltResult> first = run_model(weak).result.bolts;
  EXPECT_EQ(first[0].status, BoltStatus::broken);
  for (std::size_t i = 1; i < first.size(); ++i) {
    EXPECT_EQ(first[i].status, BoltStatus::elastic) << first[i].name;
    EXPECT_NEAR(first[i].force, 2500 * gravity, 0.02 * 2500 * gravity) << first[i].name;
  }
}

/// Two cubes in space, drawn apart by 0.2 m/s each: they swing on the bolt between them until that is slack.
TEST(Bolts, KeepMomentumAndEnergy) {
  for (const std::string scheme : {"implicit", "explicit"}) {
    SCOPED_TRACE(scheme);
    const std::string model =
        "gravity = [0, 0, 0]\n" + rock(1e11) +
        "[[solid]]\nname = 'rock'\nshape = 'box'\nmin = [0, 0, 0]\nmax = [1, 1, 2]\n"
        "[[joint]]\nname = 'joint'\nmaterial = 'j'\ndip = 0\ndip_direction = 0\npoint = [0, 0, "
        "1]\n[[bolt]]\nname = 'B'\ncollar = [0.5, 0.5, 2]\ndirection = [0, 0, -1]\nlength = 2\n"
        "coupling = 'DMFC'\naction = 'passive'\nforce_capacity = 1e6\ndisplacement_capacity = "
        "0.1\nstiffness = 5e7\n[cover]\nlattice = 'block'\n"
        "[[initial_velocity]]\nwhere = {block_at = [0.5, 0.5, 0.5]}\nvelocity = [0, 0, -0.2]\n"
        "[[initial_velocity]]\nwhere = {block_at = [0.5, 0.5, 1.5]}\nvelocity = [0, 0, 0.2]\n"
        "[analysis]\ntype = 'dynamic'\ntime_step = 5e-5\nend_time = 0.0075\nscheme = '" +
        scheme +
        "'\n[output]\nevery = 0\n[[monitor]]\nname = 'low'\npoint = [0.5, 0.5, 0.5]\n"
        "[[monitor]]\nname = 'high'\npoint = [0.5, 0.5, 1.5]\n";
    const RunResult run = run_model(model).result;
    const MonitorHistory &low = run.monitors[0], &high = run.monitors[1];
    const Real frequency = std::sqrt(2 * 5e7 / 2500);  // of two cubes of 2500 kg on one spring
    for (std::size_t k = 0; k < low.time.size(); ++k) {
      const Real wanted = 0.2 / frequency * std::sin(frequency * low.time[k]);
      EXPECT_NEAR(high.displacement[k][2], wanted, 0.03 * 0.2 / frequency);
      EXPECT_NEAR(low.displacement[k][2] + high.displacement[k][2], 0, 1e-9);
    }
    const Real began = run.energies.front().kinetic;
    EXPECT_NEAR(run.energy.kinetic + run.energy.bolts + run.energy.strain, began, 0.02 * began);
  }
}

/// A bar of rock on a lattice, drawn at its end: rock and steel share the force, and in the middle their strain.
TEST(Bolts, StretchWithRockThatTheyGoThrough) {
  const Real steel = 200e9 * std::numbers::pi / 4 * 0.05 * 0.05, section = 1e8 + steel;
  const std::string model =
      "gravity = [0, 0, 0]\n" + rock(1e8) +
      "[[solid]]\nname = 'bar'\nshape = 'box'\nmin = [0, 0, 0]\nmax = [8, 1, 1]\n[[bolt]]\n"
      "name = 'B'\ncollar = [8, 0.5, 0.5]\ntoe = [0, 0.5, 0.5]\nforce_capacity = 1e9\n"
      "displacement_capacity = 1\ndiameter = 0.05\nbond_stiffness = 1e9\n"
      "[cover]\nlattice = 'hex8'\nspacing = 0.5\n[[fixed]]\nwhere = {face = 'bar.xmin'}\n"
      "[[traction]]\nwhere = {face = 'bar.xmax'}\nvalue = [1e5, 0, 0]\n"
      "[[step]]\ntype = 'quasi_static'\ntime_step = 1\nsteps = 3\n[output]\nevery = 0\n"
      "[[monitor]]\nname = 'a'\npoint = [3, 0.5, 0.5]\n[[monitor]]\nname = 'b'\npoint = [5, 0.5, "
      "0.5]\n";
  const RunResult run = run_model(model).result;
  const Real strain =
      (run.monitors[1].displacement.back()[0] - run.monitors[0].displacement.back()[0]) / 2;
  EXPECT_NEAR(strain / (1e5 / section), 1, 0.02);
  const BoltResult& bolt = run.bolts[0];
  for (std::size_t i = 0; i < bolt.at.size(); ++i)
    if (std::abs(bolt.at[i] - 4) < 1) {
      EXPECT_NEAR(bolt.along[i] / (steel * strain), 1, 0.02);
    }
}

TEST(Bolts, AreRestoredBitForBit) {
  OnPlane box{.angle = 40 * degree,
              .bolt =
                  "force_capacity = 100e3\ndisplacement_capacity = 1\nbond_strength = 60e3\n"
                  "diameter = 0.025\nbond_stiffness = 2e8\nshear_capacity = 40e3\n",
              .step = "type = 'dynamic'\n"};
  box.push = 1.2 * limit(100e3 * box.direction());
  box.steps = 12;
  std::vector<std::vector<std::byte>> checkpoints;
  ModelAnswer whole;
  run_model(box.model(), whole, {},
            {.checkpoints = {.save =
                                 [&](std::span<const std::byte> bytes) {
                                   checkpoints.emplace_back(bytes.begin(), bytes.end());
                                 },
                             .every = 0}});
  ASSERT_GT(checkpoints.size(), 6u);
  ModelAnswer rest;
  run_model(box.model(), rest, {},
            {.checkpoints = {.save = {}, .every = 1e9, .from = checkpoints[5]}});
  const BoltResult &one = whole.result.bolts[0], &other = rest.result.bolts[0];
  EXPECT_GT(one.force, 0);
  EXPECT_EQ(one.along, other.along);
  EXPECT_EQ(one.shear, other.shear);
  EXPECT_EQ(one.peak, other.peak);
  EXPECT_EQ(whole.result.monitors[0].displacement, rest.result.monitors[0].displacement);
}

/// A cube of 1 m in the roof of a slab, on joints that do not hold it, above shotcrete of so many Pa, 1 cm thick: its edge is 4 m.
ModelAnswer roof(Real strength, const std::string& more = "") {
  std::string joints;
  for (const int x : {1, 2})
    joints += "[[joint]]\nname = 'x" + std::to_string(x) +
              "'\ndip = 90\ndip_direction = 90\npoint = [" + std::to_string(x) +
              ", 0, 0]\nmaterial = 'smooth'\n[[joint]]\nname = 'y" + std::to_string(x) +
              "'\ndip = 90\ndip_direction = 0\npoint = [0, " + std::to_string(x) +
              ", 0]\nmaterial = 'smooth'\n";
  return run_model(
      "gravity = [0, 0, -9.81]\n" + rock(1e10) +
      "[[joint_material]]\nname = 'smooth'\nfriction_angle = 0\n"
      "[[solid]]\nname = 'slab'\nshape = 'box'\nmin = [0, 0, 0]\nmax = [3, 3, 1]\n" +
      joints + "[shotcrete]\non = 'slab.zmin'\nthickness = 0.01\nshear_strength = " +
      number(strength) + "\n" + more +
      "[cover]\nlattice = 'block'\n[[fixed]]\nwhere = {face = 'slab.xmin'}\n[[fixed]]\n"
      "where = {face = 'slab.xmax'}\n[[fixed]]\nwhere = {face = 'slab.ymin'}\n"
      "[[fixed]]\nwhere = {face = 'slab.ymax'}\n[[step]]\nname = 'first'\ntype = "
      "'quasi_static'\ntime_step = 0.05\nsteps = 10\n[output]\nevery = 0\n"
      "[[monitor]]\nname = 'cube'\npoint = [1.5, 1.5, 0.5]\n");
}

TEST(Shotcrete, HoldsABlockByTheStrengthOfItsEdge) {
  const Real limit = 2500 * gravity / 4 / 0.01;
  const ModelAnswer held = roof(1.01 * limit);
  EXPECT_GT(held.result.monitors[0].displacement.back()[2], -1e-5);
  ASSERT_TRUE(held.result.shotcrete);
  EXPECT_NEAR(held.result.shotcrete->length, 12, 1e-9);
  EXPECT_GT(held.result.shotcrete->mobilisation, 0.95);
  EXPECT_LT(roof(0.99 * limit).result.monitors[0].displacement.back()[2], -3e-4);
  // Adhesion, where that is less.
  EXPECT_LT(
      roof(10 * limit, "bond_width = 0.02\nadhesion_strength = " + number(0.99 * limit / 2) + "\n")
          .result.monitors[0]
          .displacement.back()[2],
      -3e-4);
}

/// Rock beyond the model's edge holds a bolt that goes there.
TEST(Bolts, AreHeldByRockThatGoesOn) {
  const std::string bolt = "force_capacity = 500e3\nbond_stiffness = 1e9\nbond_strength = 50e3\n";
  std::string model = drawn(bolt, 0.02, ten_steps);
  const auto at = model.find("length = 2.8");
  model.replace(at, 12, "length = 5.0");
  EXPECT_NEAR(run_model(model).result.bolts[0].force, 50e3 * 2, 0.01 * 100e3);
  model.insert(model.find("[[joint]]"), "continues = ['zmin']\n");
  EXPECT_NEAR(run_model(model).result.bolts[0].force, 50e3 * 4, 0.01 * 200e3);
}

TEST(BoltLaw, IsThatOfBlockTheoryByDefault) {
  BoltType type;
  type.force_capacity = 200e3;
  type.displacement_capacity = 0.01;
  type.stiffness = 20e6;
  const BoltLaw law = bolt_law(type, 3);
  EXPECT_NEAR(0.5 * std::sqrt(law.bond_stiffness * law.section), 20e6, 1);
  EXPECT_EQ(law.yield, 200e3);
  EXPECT_EQ(law.pretension, 0);
  type.coupling = Coupling::dmfc;
  type.action = BoltAction::active;
  EXPECT_NEAR(bolt_law(type, 3).section / 3, 20e6, 1e-3);
  EXPECT_EQ(bolt_law(type, 3).pretension, 200e3);
}

/// A bar of 25 mm in rock of 30 GPa: hinges a diameter or two apart, as tests of bolted joints show (Spang & Egger 1990).
TEST(BoltLaw, BendsAcrossAJointWithinADiameterOrTwo) {
  BoltType type;
  type.diameter = 0.025;
  type.force_capacity = 250e3;
  Material granite;
  granite.young_modulus = 30e9;
  granite.poisson_ratio = 0.25;
  const Dowel dowel = dowel_of(type, granite);
  EXPECT_GT(dowel.length, 0.025);
  EXPECT_LT(dowel.length, 0.06);
  // Softer rock lets it bend further.
  granite.young_modulus = 3e9;
  EXPECT_GT(dowel_of(type, granite).length, dowel.length);
  EXPECT_LT(dowel_of(type, granite).stiffness, dowel.stiffness);
}

}  // namespace
}  // namespace rockfold
