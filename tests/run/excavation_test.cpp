// Rock that a step of the analysis takes away: `excavate` of [[step]].
#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "src/base/vector.hpp"
#include "tests/run/run_model.hpp"

namespace rockfold {
namespace {

constexpr Real gravity = 9.81, density = 2500;

const std::string rock =
    "[[material]]\ndensity = 2500\nyoung_modulus = 1e9\npoisson_ratio = 0.2\n"
    "[[joint_material]]\nname = 'clean'\nfriction_angle = 30\n"
    "[cover]\nlattice = 'block'\n";

std::string box(const std::string& name, const std::string& min, const std::string& max) {
  return "[[solid]]\nname = '" + name + "'\nshape = 'box'\nmin = " + min + "\nmax = " + max + "\n";
}

std::string taken(const std::string& min, const std::string& max, int stage = 1) {
  return "[[excavation]]\nname = 'cut" + std::to_string(stage) +
         "'\nstage = " + std::to_string(stage) + "\nshape = 'box'\nmin = " + min +
         "\nmax = " + max + "\n";
}

const std::string settle =
    "[analysis]\nkinematics = 'large'\n"
    "[[step]]\nname = 'gravity'\ntype = 'quasi_static'\ntime_step = 1\nsteps = 10\n";
const std::string dig =
    "[[step]]\nname = 'dig'\ntype = 'dynamic'\ntime_step = 0.002\nend_time = 0.1\nexcavate = 1\n";
const std::string at_once = "release = [[0, 1]]\n";
const std::string then_fall = dig + at_once;

/// Three cubes on each other, on the lowest of which, held, all rest.
std::string tower(const std::string& analysis) {
  return rock + box("rock", "[0, 0, 0]", "[1, 1, 3]") +
         "[[joint_set]]\nname = 'bed'\nmaterial = 'clean'\ndip = 0\ndip_direction = 0\n"
         "spacing = 1\norigin = [0, 0, 1]\n"
         "[[fixed]]\nwhere = {block_at = [0.5, 0.5, 0.5]}\n"
         "[[monitor]]\nname = 'top'\npoint = [0.5, 0.5, 2.5]\n" +
         analysis;
}

/// What the account of energies leaves open from step `first` on, over the largest of them.
Real imbalance(const RunResult& run, std::size_t first) {
  Real worst = 0, largest = 0;
  for (std::size_t n = first; n < run.energies.size(); ++n) {
    const Energy& e = run.energies[n];
    largest = std::max({largest, std::abs(e.potential), std::abs(e.kinetic)});
    worst = std::max(worst, std::abs(e.numerical - run.energies[first].numerical));
  }
  return worst / largest;
}

TEST(Excavation, LetsFallFreelyWhatItHeld) {
  const std::string middle = taken("[-1, -1, 1]", "[2, 2, 2]");
  const ModelAnswer answer = run_model(tower(middle + settle + then_fall));
  const MonitorHistory& top = answer.result.monitors[0];
  ASSERT_EQ(top.time.size(), 61u);
  EXPECT_NEAR(top.displacement[10][2], 0, 1e-3);  // it stood
  for (std::size_t n = 10; n < 61; ++n) {
    const Real t = top.time[n] - top.time[10];
    // Its centroid: the rock that was pressed together vibrates about it.
    EXPECT_NEAR(top.displacement[n][2] - top.displacement[10][2], -0.5 * gravity * t * t, 1e-9);
  }
  const RunResult& run = answer.result;
  EXPECT_EQ(run.gone, (std::vector<std::uint8_t>{0, 1, 0}));
  EXPECT_EQ(run.contacts.stick + run.contacts.slide, 0);
  EXPECT_EQ(norm(run.blocks[1].displacement), 0);
  EXPECT_EQ(run.block_stress[1], Stress{});
  EXPECT_LT(imbalance(run, 10), 1e-9);
  // The cube that went, and both joints, had been pressed together; it had come down a little.
  EXPECT_EQ(run.energies[10].excavated, 0);
  EXPECT_NE(run.energy.excavated, 0);
  EXPECT_EQ(run.energy.excavated, run.energies[11].excavated);
}

TEST(Excavation, TakesWhatRestsOnSupportsOffThem) {
  const std::string side = taken("[1, -1, -1]", "[3, 2, 4]");
  const std::string model = rock + box("rock", "[0, 0, 0]", "[2, 1, 2]") +
                            "[[joint]]\nname = 'wall'\nmaterial = 'clean'\ndip = 90\n"
                            "dip_direction = 90\npoint = [1, 0, 0]\n"
                            "[[fixed]]\nwhere = {face = 'rock.zmin'}\n" +
                            side + settle +
                            "[[step]]\ntype = 'quasi_static'\ntime_step = 1\nsteps = 10\n"
                            "excavate = 1\n";
  const ModelAnswer answer = run_model(model);
  Real held = 0;
  for (const Vec3& force : answer.result.reactions) held += force[2];
  EXPECT_NEAR(held / (density * gravity * 2), 1, 1e-6);
}

TEST(Excavation, BoundariesPartNothingBeforehand) {
  // A block hangs from what is held; the excavation takes the upper half of what hangs.
  const std::string hanging = rock + box("rock", "[0, 0, 0]", "[1, 1, 3]") +
                              "[[fixed]]\nwhere = {block_at = [0.5, 0.5, 2.5]}\n"
                              "[[monitor]]\nname = 'low'\npoint = [0.5, 0.5, 0.5]\n" +
                              taken("[-1, -1, 1]", "[2, 2, 2]") + settle + then_fall;
  const ModelAnswer answer = run_model(hanging);
  const MonitorHistory& low = answer.result.monitors[0];
  EXPECT_LT(std::abs(low.displacement[10][2]), 1e-3);
  EXPECT_NEAR(low.displacement.back()[2] - low.displacement[10][2], -0.5 * gravity * 0.01, 1e-9);
}

TEST(Excavation, GoesStageByStage) {
  // The upper of two supports bears until its own stage comes; the lower one goes first and changes nothing.
  const std::string model =
      tower(taken("[-1, -1, 1]", "[2, 2, 2]", 2) + taken("[0.6, -1, 0]", "[2, 2, 1]", 1) + settle +
            "[[step]]\ntype = 'dynamic'\ntime_step = 0.002\nsteps = 20\nexcavate = 1\n" + at_once +
            "[[step]]\ntype = 'dynamic'\ntime_step = 0.002\nsteps = 20\nexcavate = 2\n" + at_once);
  const ModelAnswer answer = run_model(model);
  const MonitorHistory& top = answer.result.monitors[0];
  EXPECT_LT(std::abs(top.displacement[30][2]), 1e-3);
  const Real speed = top.velocity[30][2];
  const Real t = 0.04;
  EXPECT_NEAR(top.displacement[50][2] - top.displacement[30][2], speed * t - 0.5 * gravity * t * t,
              1e-9);
}

TEST(Excavation, OfNoRockChangesNothing) {
  const std::string beside = taken("[5, 5, 5]", "[6, 6, 6]");
  const std::string go_on = "[[step]]\ntype = 'dynamic'\ntime_step = 0.002\nsteps = 3\n";
  const ModelAnswer plain = run_model(tower(settle + go_on)),
                    named = run_model(tower(beside + settle + go_on + "excavate = 1\n"));
  EXPECT_EQ(plain.result.monitors[0].displacement, named.result.monitors[0].displacement);
}

TEST(Excavation, BeforeTheFirstStepIsAsWithoutOne) {
  const std::string middle = taken("[-1, -1, 1]", "[2, 2, 2]");
  const std::string fall =
      "[analysis]\nkinematics = 'large'\n"
      "[[step]]\ntype = 'dynamic'\ntime_step = 0.002\nsteps = 10\n";
  const ModelAnswer plain = run_model(tower(middle + fall)),
                    named = run_model(tower(middle + fall + "excavate = 1\n"));
  EXPECT_EQ(plain.result.monitors[0].displacement, named.result.monitors[0].displacement);
}

TEST(Settling, LeavesBlocksThatNothingHoldsToTheStep) {
  const std::string middle = taken("[-1, -1, 1]", "[2, 2, 2]");
  const ModelAnswer answer = run_model(tower(middle + settle + dig));
  ASSERT_EQ(answer.result.settled.size(), 1u);
  const Settled& settled = answer.result.settled[0];
  EXPECT_TRUE(settled.ended);
  EXPECT_EQ(settled.moving, 1);
  EXPECT_EQ(settled.fastest, 2);
  EXPECT_EQ(settled.block, 2);
  // In each of its steps it moves a ten thousandth of its size or what it falls in 2 ms at rest, g Δt²/4.
  EXPECT_GT(settled.steps, 10);
  EXPECT_LT(settled.largest, 2e-4 * settled.steps);
  // From there it falls freely.
  const MonitorHistory& top = answer.result.monitors[0];
  for (std::size_t n = 11; n < 61; ++n) {
    const Real t = top.time[n] - top.time[10];
    EXPECT_NEAR(top.displacement[n][2] - top.displacement[10][2],
                -settled.largest - 0.5 * gravity * t * t, 1e-6);
  }
  EXPECT_LT(imbalance(answer.result, 11), 1e-9);
}

/// A block between two walls that a stress along x presses on it by far more than its friction needs; what stands under it is dug away.
std::string clamped_block(const std::string& steps) {
  return rock + box("rock", "[-2, 0, 0]", "[3, 1, 2]") +
         "[[joint]]\nname = 'left'\nmaterial = 'clean'\ndip = 90\ndip_direction = 90\n"
         "point = [0, 0, 0]\n"
         "[[joint]]\nname = 'right'\nmaterial = 'clean'\ndip = 90\ndip_direction = 90\n"
         "point = [1, 0, 0]\n"
         "[[fixed]]\nwhere = {face = 'rock.xmin'}\n[[fixed]]\nwhere = {face = 'rock.xmax'}\n"
         "[initial_stress]\nvalue = [[-5e6, 0, 0], [0, 0, 0], [0, 0, 0]]\n"
         "[[monitor]]\nname = 'key'\npoint = [0.5, 0.5, 1.5]\n" +
         taken("[0, -1, -1]", "[1, 2, 1]") + steps;
}

TEST(Settling, KeepsAClampedBlockWhereItIs) {
  // The walls bear 5 MPa · 1 m² · tan 30° each, a hundred times its weight. Let go at once, it swings and is shaken loose.
  const ModelAnswer answer = run_model(clamped_block(settle + dig + "reset_displacement = true\n"));
  const RunResult& run = answer.result;
  ASSERT_EQ(run.settled.size(), 1u);
  EXPECT_EQ(run.settled[0].moving, 0);
  EXPECT_TRUE(run.settled[0].ended);
  const Real stored = 2 * 0.5 * 5e6 * 5e6 / 1e9;  // J, of the two joints and more, at least
  EXPECT_LT(run.energy.kinetic, 1e-6 * stored);
  EXPECT_LT(norm(run.monitors[0].displacement.back()), 0.01);
  EXPECT_LT(norm(run.monitors[0].velocity.back()), 1e-3);
}

TEST(Release, OverTimeLeavesItsShareOnTheWalls) {
  // Of three cubes the upper two go: half of their weight at first, all of it in a later step.
  const std::string steps =
      settle +
      "[[step]]\ntype = 'quasi_static'\ntime_step = 1\nsteps = 20\nexcavate = 1\n"
      "release = [[5, 0.5]]\n"
      "[[step]]\ntype = 'quasi_static'\ntime_step = 1\nsteps = 20\nrelease = [[5, 1]]\n";
  const std::string model =
      rock + box("rock", "[0, 0, 0]", "[1, 1, 3]") + "[[fixed]]\nwhere = {face = 'rock.zmin'}\n" +
      taken("[-1, -1, 1]", "[2, 2, 4]") + "[[monitor]]\nname = 'low'\npoint = [0.5, 0.5, 1]\n";
  const ModelAnswer half = run_model(model + steps.substr(0, steps.rfind("[[step]]"))),
                    all = run_model(model + steps);
  const Real cube = density * gravity;
  const auto bears = [](const RunResult& run) { return run.conditions[0].force[2]; };
  EXPECT_NEAR(bears(half.result) / (cube + 0.5 * 2 * cube), 1, 1e-6);
  EXPECT_EQ(half.result.walls, 0.5);
  const ModelAnswer again = run_model(model + steps.substr(0, steps.rfind("1]]")) + "0.5]]\n");
  EXPECT_EQ(again.result.walls, 0.25);  // of what was left
  EXPECT_NEAR(bears(all.result) / cube, 1, 1e-6);
  EXPECT_EQ(all.result.walls, 0);
}

/// A cube rests on rock that goes, half of its weight in each of two steps. Two bolts that are put in with the first hang it up; the other two, put in with the
/// second, bear their share of the second half alone.
TEST(Release, LoadsEachBoltWithWhatGoesOnceItIsIn) {
  std::string model = rock + box("rock", "[0, 0, 0]", "[1, 1, 3]") +
                      "[[joint]]\nname = 'bed'\nmaterial = 'clean'\ndip = 0\ndip_direction = 0\n"
                      "point = [0, 0, 2]\n[[fixed]]\nwhere = {face = 'rock.zmin'}\n"
                      "[[fixed]]\nwhere = {face = 'rock.zmax'}\n" +
                      taken("[-1, -1, -1]", "[2, 2, 1]") + settle +
                      "[[step]]\nname = 'first half'\ntype = 'quasi_static'\ntime_step = 1\n"
                      "steps = 10\nexcavate = 1\nrelease = [[5, 0.5]]\n"
                      "[[step]]\nname = 'second half'\ntype = 'quasi_static'\ntime_step = 1\n"
                      "steps = 10\nrelease = [[5, 1]]\n";
  constexpr const char* when[] = {"first half", "second half"};
  for (int k = 0; k < 4; ++k)
    model += "[[bolt]]\nname = 'B" + std::to_string(k) + "'\ncollar = [" +
             (k % 2 == 0 ? "0.3" : "0.7") + ", " + (k == 1 || k == 2 ? "0.3" : "0.7") +
             ", 1]\ndirection = [0, 0, 1]\nlength = 1.8\ncoupling = 'DMFC'\naction = 'passive'\n"
             "force_capacity = 1e6\ndisplacement_capacity = 1\nstiffness = 1e7\ninstall = '" +
             when[k / 2] + "'\n";
  const std::vector<BoltResult> bolts = run_model(model).result.bolts;
  const Real weight = density * gravity;
  for (int k = 0; k < 4; ++k)
    EXPECT_NEAR(bolts.at(k).force / weight, k < 2 ? 0.375 : 0.125, 1e-3) << bolts[k].name;
}

TEST(Release, InMotionClosesTheAccountOfEnergies) {
  const std::string middle = taken("[-1, -1, 1]", "[2, 2, 2]");
  const ModelAnswer answer =
      run_model(tower(middle + settle + dig + "release = [[0.01, 0.3], [0.05, 1]]\n"));
  EXPECT_LT(imbalance(answer.result, 10), 1e-9);
  // The cube on top falls by the share of its weight that is gone: 0.3 t/0.01 g at first.
  const MonitorHistory& top = answer.result.monitors[0];
  EXPECT_NEAR(top.velocity[15][2] - top.velocity[10][2], -0.5 * 30 * gravity * 0.01 * 0.01, 1e-3);
}

TEST(WallsLeft, GoLinearlyFromRowToRow) {
  const std::vector<std::array<Real, 2>> release{{0.5, 0.4}, {1.5, 0.9}};
  const Real expected[][2] = {{0, 1}, {0.25, 0.8}, {0.5, 0.6}, {1, 0.35}, {1.5, 0.1}, {9, 0.1}};
  for (const auto& [time, left] : expected) EXPECT_NEAR(walls_left(release, time), left, 1e-15);
  EXPECT_EQ(walls_left({{0, 1}}, 0), 0);
}

TEST(Settling, EndsWhereNothingMoves) {
  Settling settling;
  settling.begin(0.01, 1, 9.81, 9.81);
  int steps = 0;
  for (; !settling.done(); ++steps) settling.add({{0, 0, 0}}, {{0, 0, 0}});
  EXPECT_EQ(steps, 11);
  EXPECT_EQ(settling.settled().block, none);
}

TEST(Settling, TakesNoRoundingForMotion) {
  Settling settling;
  settling.begin(0.01, 1, 9.81, 9.81, 1e-11);
  while (!settling.done()) settling.add({{4.86e-62, 0, 0}}, {{4.86e-62, 0, 0}});
  EXPECT_EQ(settling.settled().block, none);
  EXPECT_EQ(settling.settled().largest, 0);
}

TEST(Settling, DoesNotTakeWhatStressPushesForRockThatFalls) {
  // 30 m/s², the same in each step: joints that unload push a block so, in steps too short to see that they do. Later it falls.
  Settling settling;
  settling.begin(0.01, 1, 9.81, 9.81);
  const auto go = [&settling](Real acceleration) {
    const Real way = 0.25 * acceleration * settling.time_step() * settling.time_step();
    settling.add({{0, 0, -way}}, {{0, 0, -way}});
  };
  for (int n = 0; n < 20; ++n) go(30);
  EXPECT_FALSE(settling.done());
  for (int n = 0; n < 2; ++n) go(9.81);
  EXPECT_TRUE(settling.done());
  EXPECT_EQ(settling.settled().moving, 1);
}

TEST(Settling, TellsWhatDoesNotComeToRest) {
  // It swings: what accelerates to and fro is neither at rest nor steady.
  Settling settling;
  settling.begin(0.01, 1, 9.81, 9.81);
  Real to = 1e-3;
  for (; !settling.done(); to = -to) settling.add({{to, 0, 0}}, {{std::max<Real>(to, 0), 0, 0}});
  EXPECT_FALSE(settling.settled().ended);
  EXPECT_EQ(settling.settled().largest, 1e-3);
}

}  // namespace
}  // namespace rockfold
