// Where an analysis is asked for what has no size, or for more than rock bears.
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "src/base/error.hpp"
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

TEST(LongKinematics, NeverAcceptRockTurnedInsideOut) {
  // St. Venant and Kirchhoff's rock bears (λ+2μ)/√27 = 0.26 E: under more there is no equilibrium but those inside out.
  for (const Real share : {0.3, 1e4}) {
    ModelAnswer answer;
    const std::string message =
        message_of(squeezed(share, "type = 'static'\nkinematics = 'large'"), answer);
    EXPECT_NE(message.find("step 1, time 1 s"), std::string::npos) << message;
    if (share > 1) {
      EXPECT_NE(message.find("block 1 is turned inside out"), std::string::npos) << message;
    }
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

TEST(FixedFaces, HoldRockHoweverWideTheLattice) {
  // Without Poisson's effect ρgH²/2E; one element of order 0 has it all at its top.
  for (const std::string spacing : {"1e2", "1e3", "1e5"})
    for (const char* cover :
         {"lattice = 'tet6'\norder = 1", "lattice = 'tet5'", "lattice = 'block'\norder = 1"}) {
      if (spacing == "1e5" && std::string(cover).starts_with("lattice = 'tet6'"))
        continue;  // refused
      SCOPED_TRACE(spacing + cover);
      std::string model = "gravity = [0, 0, -9.81]\n" +
                          box(std::string(cover) + "\nspacing = " + spacing, "type = 'static'") +
                          hold("zmin", "'x', 'y', 'z'");
      model.replace(model.find("poisson_ratio = 0.3"), 19, "poisson_ratio = 0.0");
      const ModelAnswer answer = run_model(model);
      EXPECT_NEAR(answer.result.largest_displacement.length, 2500 * 9.81 * 2 / 1e9, 1e-5);
      EXPECT_NEAR(answer.result.conditions[0].force[2] / 49050, 1, 1e-6);
    }
}

TEST(FixedFaces, HoldNarrowStripsAgainstTurning) {
  // A wall 1 mm thick on a lattice whose planes its base cuts.
  std::string model =
      "gravity = [0, 0, -9.81]\n" +
      box("lattice = 'tet6'\nspacing = 0.5\norigin = [0.1, 0.1, 0.1]", "type = 'static'") +
      hold("zmin", "'x', 'y', 'z'");
  model.replace(model.find("max = [1, 1, 0]"), 15, "max = [1, 0.001, 0]");
  const ModelAnswer answer = run_model(model);
  EXPECT_NEAR(answer.result.conditions[0].force[2] / 49.05, 1, 1e-6);
  EXPECT_LT(answer.result.largest_displacement.length, 1e-3);
}

/// A corner of edge `size` that a joint cuts off stands on the fixed base.
std::string sliver(const std::string& size, const std::string& analysis) {
  return "gravity = [0, 0, -9.81]\n" + box("lattice = 'tet6'\nspacing = 0.5", analysis) +
         hold("zmin", "'x', 'y', 'z'") +
         "[[joint_material]]\nname = 'j'\nfriction_angle = 30.0\n[[joint]]\nname = 'G'\n"
         "normal = [1, 1, 1]\npoint = [" +
         size + ", 0, -2]\n";
}

TEST(FixedFaces, HoldSliversThatStandOnThem) {
  Real settled = 0;
  for (const char* size : {"1e-3", "1e-4", "1e-6", "1e-9"})
    for (const char* analysis : {"type = 'static'", "type = 'dynamic'\nsteps = 5"}) {
      SCOPED_TRACE(std::string(size) + analysis);
      const RunResult result = run_model(sliver(size, analysis)).result;
      EXPECT_NEAR(result.conditions[0].force[2] / 49050, 1, result.steps > 1 ? 1 : 1e-6);
      if (result.steps > 1) continue;
      // The rest of the rock, the last block, moves as it does without the sliver. That of 1e-9 is no block.
      ASSERT_EQ(result.blocks.size(), std::string(size) == "1e-9" ? 1u : 2u);
      if (settled == 0) settled = result.blocks.back().displacement[2];
      EXPECT_NEAR(result.blocks.back().displacement[2] / settled, 1, 1e-4);
    }
}

TEST(FixedFaces, OfRockThatDoesNotMoveAreInTheirPlaces) {
  // Covers that only move as a whole, all held: not even gravity moves them.
  const ModelAnswer answer = run_model(
      "gravity = [0, 0, -9.81]\n" +
      box("lattice = 'block'\nspacing = 0.5", "type = 'dynamic'\ntime_step = 0.01\nsteps = 5") +
      "[[fixed]]\nwhere = {block_at = [0.5, 0.5, -1]}\nmethod = 'lagrange'\n");
  EXPECT_LT(answer.result.support_gap, 1e-9);
}

TEST(FixedRegions, InsideRockThatHoldNoVertexSayWhatIsMissing) {
  for (const char* where :
       {"{box = [[-1, -1, -1.95], [2, 2, -1.9]]}",
        "{plane = {point = [0, 0, -1.95], normal = [0, 0, 1], tolerance = 0.001}}"})
    try {
      run_model(box("spacing = 0.5", "type = 'static'") + "[[fixed]]\nwhere = " + where + "\n");
      FAIL() << where;
    } catch (const Error& error) {
      const std::string message = error.what();
      EXPECT_NE(message.find("there are none"), std::string::npos) << message;
      EXPECT_NE(message.find("0.5 m"), std::string::npos) << message;
    }
  try {
    run_model(box("spacing = 0.5", "type = 'static'") +
              "[[fixed]]\nwhere = {box = [[2, -1, -1.95], [3, 2, -1.9]]}\n");
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("no rock lies there"), std::string::npos);
  }
}

TEST(FixedFaces, ThatPointsContradictAreFoundByWhatTheyLeaveOffItsPlace) {
  const auto off_place = [](const char* value, const char* method) {
    return run_model(box("spacing = 0.5", "type = 'static'") + hold("zmin", "'x', 'y', 'z'") +
                     "method = 'penalty'\n[[fixed]]\nwhere = {point = [0.3, 0.6, -2]}\nvalue = " +
                     value + "\nmethod = " + method + "\n")
        .result.off_place;
  };
  for (const char* method : {"'penalty'", "'augmented_lagrangian'"}) {
    const OffPlace off = off_place("[0, 0, 0.01]", method);
    EXPECT_GT(off.distance, 1e-3) << method;
    EXPECT_EQ(off.condition + off.other, 1) << method;
    EXPECT_LT(off_place("[0, 0, 0]", method).distance, 1e-7) << method;
  }
}

}  // namespace
}  // namespace rockfold
