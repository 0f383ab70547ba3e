// Analyses that follow each other: [[step]].
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "src/base/vector.hpp"
#include "tests/run/run_model.hpp"

namespace rockfold {
namespace {

/// A column of 4 m on its base: 0.5 ρgH²/E = 1.9620e-3 m shorter under its weight (ν = 0).
std::string column(const std::string& kinematics, const std::string& steps) {
  return R"(
[[material]]
density = 2500
young_modulus = 1e8
poisson_ratio = 0
[[solid]]
name = "rock"
shape = "box"
min = [0, 0, 0]
max = [1, 1, 4]
[cover]
lattice = "hex8"
spacing = 0.5
order = 0
origin = [0, 0, 0]
[[fixed]]
where = {face = "rock.zmin"}
[[monitor]]
name = "top"
point = [0.4, 0.6, 4]
[solver]
tolerance = 1e-12
[analysis]
time_step = 0.01
kinematics = ")" +
         kinematics + "\"\n" + steps;
}

const char* const settle =
    "[[step]]\nname = 'gravity'\ntype = 'quasi_static'\ntime_step = 0.5\nsteps = 10\n";
const char* const at_once = "[[step]]\nname = 'gravity'\ntype = 'static'\n";
const char* const go_on = "[[step]]\nname = 'motion'\ntype = 'dynamic'\nend_time = 0.25\n";

TEST(Stages, GoOnFromTheEquilibriumThatTheFirstHasFound) {
  for (const char* kinematics : {"small", "large"})
    for (const char* first : {settle, at_once}) {
      SCOPED_TRACE(std::string(kinematics) + first);
      const ModelAnswer answer = run_model(column(kinematics, std::string(first) + go_on));
      const MonitorHistory& top = answer.result.monitors[0];
      const std::size_t settled = first == settle ? 10 : 1;
      ASSERT_EQ(top.time.size(), settled + 1 + 25);
      EXPECT_NEAR(top.time[settled], first == settle ? 5 : 1, 1e-12);
      EXPECT_NEAR(top.time.back(), top.time[settled] + 0.25, 1e-12);
      EXPECT_NEAR(top.displacement[settled][2], -1.962e-3, 5e-5);
      for (std::size_t n = settled; n < top.time.size(); ++n) {
        EXPECT_NEAR(norm(top.displacement[n] - top.displacement[settled]), 0, 1e-9);
        EXPECT_NEAR(norm(top.velocity[n]), n == settled ? norm(top.velocity[n]) : 0, 1e-7);
      }
      EXPECT_NEAR(answer.result.energy.kinetic, 0, 1e-9);
      EXPECT_EQ(answer.result.steps, static_cast<Index>(settled) + 25);
    }
}

TEST(Stages, CountDisplacementsAnewWhereAsked) {
  const std::string push =
      "[[traction]]\nwhere = {face = 'rock.zmax'}\nvalue_table = [[0, 0, 0, 0], [1, 0, 0, "
      "0], [2, 0, 0, -1e5]]\n";
  const std::string stages =
      std::string(at_once) + "[[step]]\ntype = 'static'\nreset_displacement = true\n";
  const ModelAnswer answer = run_model(column("small", stages + push));
  const MonitorHistory& top = answer.result.monitors[0];
  ASSERT_EQ(top.time.size(), 3u);
  EXPECT_NEAR(top.displacement[1][2], -1.962e-3, 5e-5);
  EXPECT_NEAR(top.displacement[2][2], -1e5 / 1e8 * 4, 1e-9);  // of the push alone
  EXPECT_NEAR(top.stress[2][2], top.stress[1][2] - 1e5, 1);   // stress is all there is
  EXPECT_NEAR(answer.result.largest_displacement.length, 4e-3, 1e-9);
  EXPECT_NEAR(answer.result.blocks[0].displacement[2], -2e-3, 1e-9);
}

TEST(Stages, ThrowFromRest) {
  // What moves in one dynamic stage goes on in the next; a quasi-static stage between brings it to rest.
  const std::string thrown =
      "[[initial_velocity]]\nwhere = {all = true}\nvelocity = [3, 0, 0]\n"
      "[[step]]\ntype = 'dynamic'\nsteps = 2\n";
  std::string free =
      column("large", thrown + "[[step]]\ntype = 'dynamic'\nsteps = 3\ntime_step = 0.02\n");
  free.erase(free.find("[[fixed]]"),
             std::string("[[fixed]]\nwhere = {face = \"rock.zmin\"}\n").size());
  const ModelAnswer answer = run_model(free);
  const MonitorHistory& top = answer.result.monitors[0];
  EXPECT_NEAR(top.time.back(), 0.08, 1e-12);
  EXPECT_NEAR(top.displacement.back()[0], 0.24, 1e-9);
  EXPECT_NEAR(top.displacement.back()[2], -0.5 * 9.81 * 0.08 * 0.08, 1e-9);
}

}  // namespace
}  // namespace rockfold
