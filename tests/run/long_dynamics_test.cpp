// Steps far longer than the periods of the rock, many steps, steps taken again, and the start of motions that supports dictate.
#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <utility>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/run/run_model.hpp"

namespace rockfold {
namespace {

std::string block(Real young, const std::string& cover, const std::string& fixed,
                  const std::string& analysis) {
  return fmt::format(R"(
[[material]]
density = 2500
young_modulus = {}
poisson_ratio = 0.25
[[solid]]
name = "rock"
shape = "box"
min = [0, 0, 0]
max = [1, 1, 1.5]
[cover]
{}
[[fixed]]
where = {{face = "rock.zmin"}}
{}
[[monitor]]
point = [0.5, 0.5, 0]
[analysis]
type = "dynamic"
{}
)",
                     young, cover, fixed, analysis);
}

Real largest(const std::vector<Vec3>& field) {
  Real most = 0;
  for (const Vec3& v : field)
    for (const Real x : v) most = std::max(most, std::abs(x));
  return most;
}

class LongSteps : public testing::TestWithParam<std::tuple<const char*, const char*>> {};

/// Free flight over hundreds of periods would go metres where rock moves micrometres.
TEST_P(LongSteps, KeepTheEnergyOfRockThatIsLetGo) {
  const auto& [method, kinematics] = GetParam();
  for (const char* cover : {"lattice = \"tet6\"\nspacing = 0.5\norder = 0",
                            "lattice = \"tet6\"\nspacing = 0.5\norder = 1",
                            "lattice = \"hex8\"\nspacing = 0.5\norder = 1"})
    for (const Real young : {1e9, 5e13}) {
      const ModelAnswer answer = run_model(
          block(young, cover, fmt::format("method = \"{}\"", method),
                fmt::format("kinematics = \"{}\"\ntime_step = 1.0\nsteps = 3", kinematics)));

      // Let go at once, it swings to twice its static deflection: the strain energy there is the weight's work.
      Real most = 0;
      for (const Energy& energy : answer.result.energies) most = std::max(most, energy.strain);
      EXPECT_GT(most, 0) << cover << young;
      for (const Energy& energy : answer.result.energies)
        EXPECT_NEAR(energy.numerical / most, 0, 1e-6) << cover << ' ' << young;
    }
}

INSTANTIATE_TEST_SUITE_P(All, LongSteps,
                         testing::Combine(testing::Values("augmented_lagrangian", "penalty"),
                                          testing::Values("small", "large")),
                         [](const auto& of) {
                           return fmt::format("{}_{}", std::get<0>(of.param),
                                              std::get<1>(of.param));
                         });

/// Covers with several functions can move without moving rock, which nothing resists (docs/theory.md).
TEST(LongMotions, LeaveFunctionsThatMoveNoRockAtRest) {
  for (const char* method : {"augmented_lagrangian", "penalty"}) {
    const ModelAnswer answer =
        run_model(block(3e10, "lattice = \"tet6\"\nspacing = 0.5\norder = 1",
                        fmt::format("method = \"{}\"", method),
                        "kinematics = \"small\"\ntime_step = 0.001\nsteps = 60"));
    const Real rock = answer.result.largest_displacement.length;
    EXPECT_LT(largest(answer.last.motion.displacement), 100 * rock) << method;
    const Energy& energy = answer.result.energy;
    EXPECT_NEAR(energy.numerical / (energy.strain + energy.kinetic), 0, 1e-6) << method;
  }
}

/// The same for as long as you like.
TEST(SlowMotions, LeaveFunctionsThatMoveNoRockAtRestForTenThousandSteps) {
  constexpr const char *average = "{beta = 0.25, gamma = 0.5}",
                       *damped = "{beta = 0.3025, gamma = 0.6}";
  for (const auto& [order, newmark] :
       {std::pair{1, average}, std::pair{2, average}, std::pair{1, damped}}) {
    const ModelAnswer answer = run_model(
        block(3e10, fmt::format("lattice = \"tet6\"\nspacing = 0.5\norder = {}", order), "",
              fmt::format("kinematics = \"small\"\ntime_step = 0.001\nsteps = 10000\nnewmark = {}",
                          newmark)));
    const Real rock = answer.result.largest_displacement.length;
    EXPECT_LT(largest(answer.last.motion.displacement), 100 * rock) << order << newmark;
    const Energy& energy = answer.result.energy;
    EXPECT_GT(energy.numerical / std::abs(energy.potential), -1e-6) << order << newmark;
  }
}

/// Nothing acts but rounding, which grows with the way: a share of no force at all cannot be asked for.
TEST(FreeFlight, WithoutLoadsGoesOnAsItBegan) {
  for (const char* cover : {"lattice = \"hex8\"\nspacing = 0.45\norder = 1",
                            "lattice = \"hex8\"\nspacing = 0.45\norder = 0",
                            "lattice = \"tet6\"\nspacing = 0.7\norder = 2"}) {
    const std::string thrown =
        "gravity = [0, 0, 0]\n[[initial_velocity]]\nwhere = {all = true}\nvelocity = [0.1, 0.2, "
        "0.3]\n" +
        block(1e9, cover, "", "kinematics = \"small\"\ntime_step = 0.01\nsteps = 10");
    std::string free = thrown;
    const std::string held = "[[fixed]]\nwhere = {face = \"rock.zmin\"}\n";
    free.erase(free.find(held), held.size());
    const RunResult result = run_model(free).result;
    const Vec3 end = result.monitors[0].displacement.back();
    EXPECT_NEAR(end[2], 0.03, 1e-12) << cover;
    EXPECT_NEAR(result.energy.numerical / result.energy.kinetic, 0, 1e-12) << cover;
  }
}

TEST(Supports, ThatMoveCarryRockLikewiseWhereStepsAreTakenAgain) {
  for (const char* kinematics : {"small", "large"})
    for (const char* method : {"augmented_lagrangian", "penalty"}) {
      const auto carry = [&](const char* limit) {
        return run_model(
                   "gravity = [0, 0, 0]\n" +
                   block(1e9, "lattice = \"tet6\"\nspacing = 0.8\norder = 1",
                         fmt::format("method = \"{}\"\nvalue_table = [[0, 0, 0, 0], [1, 0, 0, "
                                     "0.03]]",
                                     method),
                         fmt::format("kinematics = \"{}\"\ntime_step = 0.02\nsteps = 4\n{}",
                                     kinematics, limit)))
            .result;
      };
      const RunResult once = carry(""), again = carry("max_displacement_ratio = 4e-4");
      EXPECT_GT(again.largest_substeps, once.largest_substeps);
      for (const RunResult* run : {&once, &again}) {
        const Vec3 foot = run->monitors[0].displacement.back();
        EXPECT_NEAR(foot[2] / (0.03 * 0.08), 1, 2e-3) << kinematics << ' ' << method;
      }
    }
}

TEST(LongQuadraticCovers, OnALatticeThatFitsNothingKeepTheEnergyOfABeam) {
  const RunResult beam = run_model(R"(
gravity = [0, 0, 0]
[[material]]
density = 2000
young_modulus = 1e7
poisson_ratio = 0.25
[[solid]]
name = "b"
shape = "box"
min = [0, 0, 0]
max = [4, 1, 1]
[cover]
lattice = "tet6"
order = 2
spacing = 0.8
origin = [0.11, 0.23, 0.31]
[[fixed]]
where = {face = "b.xmin"}
[[traction]]
where = {face = "b.xmax"}
value = [100, 200, -300]
[analysis]
type = "dynamic"
kinematics = "small"
time_step = 0.002
steps = 12
)")
                             .result;
  for (const Energy& e : beam.energies) EXPECT_LE(std::abs(e.numerical), 1e-5);  // J, of 0.1 J
}

/// Damped, on its base, pulled at a side: functions that all but depend on each other neither grow from step to step nor stop the solver.
TEST(LongQuadraticCovers, OnObliqueHexahedraComeToRestWithTheirEnergyClosed) {
  const RunResult rock = run_model(R"(
gravity = [0, 0, -9.81]
[[material]]
density = 2900
young_modulus = 2.5e10
poisson_ratio = 0.35
[[solid]]
name = "r"
shape = "box"
min = [16.28, 10.32, -28.41]
max = [31.87, 21.33, -17.17]
[cover]
lattice = "hex8"
spacing = 7.76
order = 2
directions = [[5.0, 309.8], [71.7, 290.8], [82.6, 224.4]]
origin = [2.46, 0.5, 0.88]
[[fixed]]
where = {face = "r.zmin"}
method = "penalty"
[[traction]]
where = {face = "r.xmax"}
value = [-1e5, 3.6e5, 2.6e5]
[analysis]
type = "dynamic"
kinematics = "small"
time_step = 1.2e-3
steps = 40
rayleigh = {alpha = 166, beta = 3e-4}
[solver]
preconditioner = "direct"
)")
                             .result;
  const Energy& end = rock.energies.back();
  EXPECT_LE(std::abs(end.numerical), 1e-4 * end.strain);
  EXPECT_LE(end.kinetic, 1e-2 * end.strain);
  EXPECT_LE(rock.iterations.pcg, 5000);
}

}  // namespace
}  // namespace rockfold
