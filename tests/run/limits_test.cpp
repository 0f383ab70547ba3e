// Where an analysis is asked for what has no size, or for more than rock bears.
#include <cmath>
#include <csignal>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "src/base/error.hpp"
#include "src/base/interrupt.hpp"
#include "tests/run/run_model.hpp"

namespace rockfold {
namespace {

std::string box(const std::string& cover, const std::string& analysis) {
  return R"(
[[material]]
density = 2500
young_modulus = 1e9
poisson_ratio = 0.3
[[solid]]
name = "rock"
shape = "box"
min = [0, 0, -2]
max = [1, 1, 0]
[cover]
)" + cover +
         "\n[analysis]\n" + analysis + "\n";
}

std::string hold(const std::string& face, const std::string& components) {
  return fmt::format("[[fixed]]\nwhere = {{face = 'rock.{}'}}\ncomponents = [{}]\n", face,
                     components);
}

/// Rollers on five sides, and the stress in the ground of ρ = 2500 kg/m³ under 9.81 m/s².
std::string ground_at_rest(const std::string& cover, const std::string& analysis) {
  return "gravity = [0, 0, -9.81]\n" + box(cover, analysis) + hold("zmin", "'z'") +
         hold("xmin", "'x'") + hold("xmax", "'x'") + hold("ymin", "'y'") + hold("ymax", "'y'") +
         R"(
[initial_stress]
value = [[-10000.0, 0, 0], [0, -20000.0, 0], [0, 0, 0]]
reference_z = 0.0
gradient = [[-12262.5, 0, 0], [0, -17167.5, 0], [0, 0, -24525.0]]
)";
}

TEST(Equilibrium, OfLoadsThatCancelIsNoMotionAtOnce) {
  // Gravity alone would settle it by ρgH²/2E = 5e-5 m.
  for (const char* cover :
       {"lattice = 'tet6'\norder = 0\nspacing = 0.4", "lattice = 'tet5'\norder = 1\nspacing = 0.4",
        "lattice = 'hex8'\norder = 0\nspacing = 0.4"})
    for (const char* analysis :
         {"type = 'static'\nkinematics = 'small'", "type = 'static'\nkinematics = 'large'",
          "type = 'dynamic'\ntime_step = 0.01\nsteps = 2\nkinematics = 'small'",
          "type = 'dynamic'\ntime_step = 0.01\nsteps = 2\nkinematics = 'large'"}) {
      SCOPED_TRACE(fmt::format("{} {}", cover, analysis));
      const ModelAnswer answer = run_model(ground_at_rest(cover, analysis));
      EXPECT_LT(answer.result.largest_displacement.length, 1e-12);
      // Nothing has moved: no gap is large beside what the loads would do.
      EXPECT_LT(answer.result.support_gap, 1e-9);
      EXPECT_NEAR(answer.result.conditions[0].force[2], 49050, 1e-3);
    }
}

/// Rollers on five sides, and a pressure of a share of E on the sixth that keeps its direction.
std::string squeezed(Real share_of_stiffness, const std::string& analysis) {
  return "gravity = [0, 0, 0]\n" + box("lattice = 'hex8'\nspacing = 0.5", analysis) +
         hold("zmin", "'z'") + hold("xmin", "'x'") + hold("xmax", "'x'") + hold("ymin", "'y'") +
         hold("ymax", "'y'") +
         fmt::format("[[traction]]\nwhere = {{face = 'rock.zmax'}}\nvalue = [0, 0, {}]\n",
                     -1e9 * share_of_stiffness);
}

std::string message_of(const std::string& model, ModelAnswer& answer) {
  try {
    run_model(model, answer);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::analysis);
    return error.what();
  }
  return "no error";
}

TEST(LargeKinematics, NeverAcceptRockTurnedInsideOut) {
  // St. Venant and Kirchhoff's rock bears (λ+2μ)/√27 = 0.26 E: under more there is no equilibrium but those inside out.
  for (const Real share : {0.3, 1e4}) {
    ModelAnswer answer;
    const std::string message =
        message_of(squeezed(share, "type = 'static'\nkinematics = 'large'"), answer);
    EXPECT_NE(message.find("block 1 is turned inside out"), std::string::npos) << message;
    EXPECT_NE(message.find("step 1, time 1 s"), std::string::npos) << message;
    EXPECT_EQ(answer.stored, (std::vector<Index>{0}));
  }
  ModelAnswer answer;
  const std::string message =
      message_of(squeezed(0.5, "type = 'dynamic'\ntime_step = 1e-4\nsteps = 100"), answer);
  EXPECT_NE(message.find("block 1 is turned inside out"), std::string::npos) << message;
  ASSERT_FALSE(answer.stored.empty());
  EXPECT_GT(answer.stored.back(), 0);
  EXPECT_GT(answer.last.motion.time, 0);
}

TEST(LargeKinematics, TakeShorterStepsWhereOneWouldTurnRockInsideOut) {
  const ModelAnswer answer =
      run_model(squeezed(0.1, "type = 'dynamic'\ntime_step = 0.01\nsteps = 20"));
  EXPECT_GT(answer.result.blocks[0].volume, 0.5 * 2);
}

TEST(Newmark, ThatIsUnstableEndsWhereNumbersLeaveTheirRange) {
  ModelAnswer answer;
  const std::string message =
      message_of("gravity = [0, 0, -9.81]\n" +
                     box("lattice = 'hex8'\nspacing = 0.5",
                         "type = 'dynamic'\nkinematics = 'small'\ntime_step = 0.1\nsteps = 1000\n"
                         "newmark = {beta = 0.05, gamma = 0.3}") +
                     hold("zmin", "'x', 'y', 'z'") + "[output]\nevery = 0\n",
                 answer);
  EXPECT_NE(message.find("the motion grew beyond all numbers"), std::string::npos) << message;
  ASSERT_EQ(answer.stored.size(), 2u);
  EXPECT_GT(answer.stored[1], 10);
  for (const Vec3& d : answer.last.motion.displacement)
    for (int i = 0; i < 3; ++i) ASSERT_TRUE(std::isfinite(d[i]));
}

}  // namespace
}  // namespace rockfold
