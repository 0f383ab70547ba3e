#include "src/run/run_analysis.hpp"

#include <cmath>
#include <csignal>
#include <string>

#include <gtest/gtest.h>
#include <unistd.h>

#include "src/base/error.hpp"
#include "src/base/interrupt.hpp"
#include "src/base/timer.hpp"
#include "tests/reference/box_covers.hpp"

namespace rockfold {
namespace {

/// A model of one box with a lattice turned against it, its floor fixed or not; made without host/.
struct Case {
  reference::CoveredRegions covered = reference::cover_regions(
      reference::turned_lattice({0.11, -0.23, 0.37}, 0.5, 0.3, 0.2, {1, 0.6, 0.6}, 1.4),
      {reference::box({0, 0, 0}, {2, 1.2, 1.3})});
  Model model;
  BlockArrays blocks;
  FixedPoints fixed;
  MaterialPoints monitors, vertices;
  LoadPoints loads;
  QuietPoints quiet;
  std::vector<RigidVelocity> velocities;
  std::vector<Index> stored;
  std::vector<Real> stored_times;
  Real stored_fall = 0;  ///< z displacement of the first cover in the last stored state

  explicit Case(AnalysisType type, bool hold_floor = false) {
    model.gravity = {0, 0, -10};
    model.materials = {{"rock", 2000, 1e8, 0.25, {}}};
    model.analysis = Analysis{};
    model.analysis->stages[0].type = type;
    model.analysis->stages[0].time_step = 0.05;
    model.analysis->stages[0].steps = type == AnalysisType::static_ ? 1 : 7;
    model.output.every = 3;
    model.monitors = {{"crest", {1.9, 1.1, 1.2}}};
    std::vector<Vec3> corners;
    for (int c = 0; c < 8; ++c)
      corners.push_back({2.0 * (c & 1), 1.2 * (c >> 1 & 1), 1.3 * (c >> 2)});
    blocks.vertex = corners;
    blocks.vertex_begin = {0, 8};
    blocks.volume = {2 * 1.2 * 1.3};
    blocks.mass = {2000 * 2 * 1.2 * 1.3};
    monitors = reference::locate(covered, {model.monitors[0].point});
    vertices = reference::locate(covered, corners);
    if (hold_floor)
      fixed = reference::fix(
          covered, reference::corner_points(covered, [](const Vec3& x) { return x[2] < 1e-9; }),
          [](const Vec3&) { return Vec3{}; }, 1e9, false);
  }

  RunResult run() {
    Progress progress;
    const auto store = [&](const StoredState& state) {
      stored.push_back(state.step);
      stored_times.push_back(state.motion.time);
      stored_block_stress = state.block_stress;
      stored_fall = state.motion.displacement[0][2];
      EXPECT_EQ(state.element_stress.size(), std::size_t(covered.arrays.element_count()));
      if (state.step == stop_after) interrupt_signal = SIGINT;
    };
    return run_analysis(
        {model, covered.arrays, blocks, fixed, monitors, loads, quiet, velocities, vertices}, store,
        progress);
  }
  Index stop_after = none;
  std::vector<Stress> stored_block_stress;  ///< of the last state
};

std::string message_of(Case& c) {
  try {
    c.run();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::analysis);
    return error.what();
  }
  return "no error";
}

TEST(RunAnalysis, StoresTheFirstAndLastStateAndEveryThird) {
  Case c(AnalysisType::dynamic);
  const RunResult result = c.run();
  EXPECT_EQ(c.stored, (std::vector<Index>{0, 3, 6, 7}));
  EXPECT_NEAR(c.stored_times[1], 0.15, 1e-12);
  EXPECT_EQ(result.steps, 7);
  EXPECT_NEAR(result.time, 0.35, 1e-12);
  EXPECT_FALSE(result.interrupted);
  EXPECT_NEAR(c.stored_fall, -5 * 0.35 * 0.35, 1e-12);
  c.stored.clear();
  c.model.output.every = 0;
  c.run();
  EXPECT_EQ(c.stored, (std::vector<Index>{0, 7}));
}

TEST(RunAnalysis, KeepsAHistoryOfEachMonitor) {
  Case c(AnalysisType::dynamic);
  const RunResult result = c.run();
  ASSERT_EQ(result.monitors.size(), 1u);
  const MonitorHistory& crest = result.monitors[0];
  EXPECT_EQ(crest.name, "crest");
  ASSERT_EQ(crest.time.size(), 8u);
  for (std::size_t i = 0; i < crest.time.size(); ++i) {
    const Real t = 0.05 * i;
    EXPECT_NEAR(crest.time[i], t, 1e-12);
    EXPECT_NEAR(crest.displacement[i][2], -5 * t * t, 1e-12);
    EXPECT_NEAR(crest.velocity[i][2], -10 * t, 1e-11);
    EXPECT_NEAR(crest.acceleration[i][2], -10, 1e-10);
    EXPECT_NEAR(crest.stress[i][2], 0, 1e-3);  // E · 1e-12 of rounding
  }
}

TEST(RunAnalysis, ReportsBlocksAndEnergies) {
  Case c(AnalysisType::dynamic);
  const RunResult result = c.run();
  const Real fall = 5 * 0.35 * 0.35, mass = 2000 * 2 * 1.2 * 1.3;
  ASSERT_EQ(result.blocks.size(), 1u);
  EXPECT_NEAR(result.blocks[0].volume, 2 * 1.2 * 1.3, 1e-12);
  EXPECT_NEAR(result.blocks[0].displacement[2], -fall, 1e-12);
  for (Real angle : result.blocks[0].rotation) EXPECT_NEAR(angle, 0, 1e-12);
  EXPECT_NEAR(result.energy.potential / (-mass * 10 * fall), 1, 1e-11);
  EXPECT_NEAR(result.energy.kinetic / (mass * 10 * fall), 1, 1e-11);
  EXPECT_NEAR(result.largest_displacement.length, fall, 1e-12);
  EXPECT_EQ(result.largest_displacement.block, 0);
}

TEST(RunAnalysis, StartsBlocksWithTheirVelocityAndKeepsEnergiesAndStressOverTime) {
  Case c(AnalysisType::dynamic);
  c.model.gravity = {0, 0, 0};
  c.velocities = {{{0}, {1, -2, 0.5}, {}}};
  const RunResult result = c.run();
  const Real kinetic = 0.5 * 2000 * 2 * 1.2 * 1.3 * 5.25;
  ASSERT_EQ(result.energies.size(), 8u);
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_NEAR(result.energy_time[i], 0.05 * i, 1e-12);
    EXPECT_NEAR(result.energies[i].kinetic / kinetic, 1, 1e-12);
    EXPECT_NEAR(result.monitors[0].displacement[i][1], -2 * 0.05 * i, 1e-12);
  }
  ASSERT_EQ(c.stored_block_stress.size(), 1u);
  EXPECT_NEAR(c.stored_block_stress[0][2], 0, 1e-3);
}

/// The mean vertical stress of a block on the floor is half its weight over its area.
TEST(RunAnalysis, SumsReactionsByConditionAndAveragesStressByBlock) {
  Case c(AnalysisType::static_, true);
  c.model.fixed.resize(2);
  c.fixed.condition.assign(c.fixed.points.size(), 1);
  const RunResult result = c.run();
  const Real weight = 2000 * 10 * 2 * 1.2 * 1.3;
  ASSERT_EQ(result.conditions.size(), 2u);
  EXPECT_EQ(result.conditions[0].force, (Vec3{}));
  EXPECT_NEAR(result.conditions[1].force[2] / weight, 1, 1e-6);
  EXPECT_NEAR(result.conditions[1].moment[0] / (0.6 * weight), 1, 1e-6);
  EXPECT_NEAR(result.conditions[1].moment[1] / (-1.0 * weight), 1, 1e-6);
  ASSERT_EQ(c.stored_block_stress.size(), 1u);
  EXPECT_NEAR(c.stored_block_stress[0][2] / (-0.5 * weight / (2 * 1.2)), 1, 1e-6);
}

TEST(RunAnalysis, TakesSubstepsWhereAVertexWouldMoveTooFar) {
  Case c(AnalysisType::dynamic);
  // Half the height is 0.65 m. The last step falls 10·0.05·(0.3 + 0.025) = 0.1625 m: in parts of at most 0.065 m it takes 4.
  c.model.analysis->max_displacement_ratio = 0.1;
  RunResult result = c.run();
  EXPECT_EQ(result.largest_substeps, 4);
  EXPECT_EQ(result.steps, 7);
  EXPECT_NEAR(result.monitors[0].displacement[7][2], -5 * 0.35 * 0.35, 1e-12);
  c.model.analysis->max_displacement_ratio = 1e-7;
  EXPECT_NE(message_of(c).find("max_displacement_ratio"), std::string::npos);
}

TEST(RunAnalysis, StopsAtTheLastStepDoneWhenItIsInterrupted) {
  Case c(AnalysisType::dynamic, true);
  c.stop_after = 3;
  const RunResult result = c.run();
  interrupt_signal = 0;
  EXPECT_TRUE(result.interrupted);
  EXPECT_EQ(result.steps, 3);
  EXPECT_NEAR(result.time, 0.15, 1e-12);
  EXPECT_EQ(c.stored, (std::vector<Index>{0, 3}));
  ASSERT_EQ(result.energies.size(), 4u);
}

TEST(LongRunAnalysis, InterruptedAtAnyMomentHasDoneTheStepsOfTheWholeRun) {
  const auto run = [](int microseconds) {
    Case c(AnalysisType::dynamic, true);
    c.model.analysis->kinematics = Kinematics::large;
    std::signal(SIGALRM, [](int signal) { interrupt_signal = signal; });
    ualarm(microseconds, 0);
    RunResult result = c.run();
    ualarm(0, 0);
    interrupt_signal = 0;
    return result;
  };
  const Timer timer;
  const RunResult whole = run(0);
  const Real microseconds = 1e6 * timer.seconds();
  constexpr int moments = 100;
  for (int i = 1; i < moments; ++i) {
    const RunResult part = run(1 + static_cast<int>(microseconds * i / moments));
    for (Index step = 0; step <= part.steps; ++step)
      EXPECT_EQ(part.monitors[0].displacement[step], whole.monitors[0].displacement[step])
          << step << " of " << part.steps;
  }
}

TEST(RunAnalysis, InterruptedInItsOnlySolveKeepsTheStart) {
  for (const auto type : {AnalysisType::static_, AnalysisType::dynamic}) {
    Case c(type, true);
    interrupt_signal = SIGTERM;
    const RunResult result = c.run();
    interrupt_signal = 0;
    EXPECT_TRUE(result.interrupted);
    EXPECT_EQ(result.steps, 0);
    EXPECT_EQ(c.stored, (std::vector<Index>{0}));
    EXPECT_EQ(c.stored_fall, 0);
  }
}

TEST(RunAnalysis, StaticEqualsTheEndOfQuasiStatic) {
  Case statics(AnalysisType::static_, true), slow(AnalysisType::quasi_static, true);
  statics.model.solver.tolerance = slow.model.solver.tolerance = 1e-12;
  slow.model.analysis->stages[0].time_step = 10;
  slow.model.analysis->kinematics = Kinematics::small;
  const RunResult a = statics.run(), b = slow.run();
  EXPECT_EQ(statics.stored, (std::vector<Index>{0, 1}));
  ASSERT_EQ(a.monitors[0].displacement.size(), 2u);
  const Real settled = a.monitors[0].displacement[1][2];
  // ρgh²/2E = 1.7e-4 m if nothing hindered it sideways.
  EXPECT_LT(settled, -1e-4);
  EXPECT_GT(settled, -2e-4);
  EXPECT_NEAR(b.monitors[0].displacement[7][2] / settled, 1, 1e-9);
  EXPECT_FALSE(a.unbalanced);
  ASSERT_TRUE(b.unbalanced);
  EXPECT_LT(b.unbalanced->share, 1e-6);
  Vec3 total{};
  for (const Vec3& r : a.reactions)
    for (int d = 0; d < 3; ++d) total[d] += r[d];
  EXPECT_NEAR(total[2] / (2000 * 10 * 2 * 1.2 * 1.3), 1, 1e-9);
}

TEST(RunAnalysis, ABlockTurnedByItsSupportsReportsTheRotation) {
  Case c(AnalysisType::static_);
  c.model.gravity = {0, 0, 0};
  const Vec3 turn{1e-3, -2e-3, 3e-3};
  c.fixed = reference::fix(
      c.covered, reference::corner_points(c.covered, [](const Vec3&) { return true; }),
      [&](const Vec3& x) {
        return Vec3{turn[1] * x[2] - turn[2] * x[1], turn[2] * x[0] - turn[0] * x[2],
                    turn[0] * x[1] - turn[1] * x[0]};
      },
      1e9, false);
  c.model.solver.tolerance = 1e-12;
  const RunResult result = c.run();
  for (int d = 0; d < 3; ++d) EXPECT_NEAR(result.blocks[0].rotation[d], turn[d], 1e-9);
  EXPECT_NEAR(result.blocks[0].displacement[0], turn[1] * 0.65 - turn[2] * 0.6, 1e-9);
}

TEST(RunAnalysis, RefusesAStaticSystemThatNothingHolds) {
  Case c(AnalysisType::static_);
  EXPECT_NE(message_of(c).find("block 1 (nothing holds it)"), std::string::npos) << message_of(c);
}

TEST(RunAnalysis, ASolveThatDoesNotConvergeSaysWhereAndKeepsTheLastGoodState) {
  Case c(AnalysisType::dynamic, true);
  c.model.analysis->kinematics = Kinematics::small;  // one solve a step
  c.model.solver.max_iterations = 3;
  const std::string message = message_of(c);
  EXPECT_NE(message.find("did not converge: residual"), std::string::npos) << message;
  EXPECT_NE(message.find("after 3 iterations"), std::string::npos) << message;
  EXPECT_NE(message.find("step "), std::string::npos) << message;
  EXPECT_FALSE(c.stored.empty());
}

}  // namespace
}  // namespace rockfold
