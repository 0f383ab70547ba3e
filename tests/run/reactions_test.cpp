// What supports do to rock that turns, that starts with a velocity, or that cannot go where they want it.
#include <cmath>
#include <numbers>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "src/base/vector.hpp"
#include "tests/run/run_model.hpp"

namespace rockfold {
namespace {

/// A box from the origin.
std::string box(const Vec3& size, const Vec3& gravity, const std::string& rest) {
  return fmt::format(R"(
gravity = [{}, {}, {}]
[[material]]
density = 2000
young_modulus = 1e9
poisson_ratio = 0.2
[[solid]]
name = "r"
shape = "box"
min = [0, 0, 0]
max = [{}, {}, {}]
{})",
                     gravity[0], gravity[1], gravity[2], size[0], size[1], size[2], rest);
}

std::string held_point(const Vec3& x, const Vec3& to) {
  return fmt::format(
      "[[fixed]]\nwhere = {{point = [{}, {}, {}]}}\nmethod = 'lagrange'\n"
      "value = [{:.17g}, {:.17g}, {:.17g}]\n",
      x[0], x[1], x[2], to[0] - x[0], to[1] - x[1], to[2] - x[2]);
}

TEST(Reactions, HaveTheMomentsOfTheForcesWhereTheRockIs) {
  const Real angle = std::numbers::pi / 3;
  const auto turned = [&](const Vec3& x) {
    return Vec3{std::cos(angle) * x[0] - std::sin(angle) * x[1],
                std::sin(angle) * x[0] + std::cos(angle) * x[1], x[2]};
  };
  std::string text =
      "[cover]\nlattice = 'hex8'\nspacing = 1\n"
      "[analysis]\ntype = 'static'\nkinematics = 'large'\n";
  for (const Vec3& x : {Vec3{0.1, 0.1, 0.1}, Vec3{1.9, 0.1, 0.1}, Vec3{0.1, 0.9, 0.1}})
    text += held_point(x, turned(x));
  const ModelAnswer answer = run_model(box({2, 1, 1}, {0, 0, -10}, text));
  Vec3 force{}, moment{};
  for (const Reaction& r : answer.result.conditions) force += r.force, moment += r.moment;
  const Vec3 weight{0, 0, -10.0 * 2000 * 2}, centre = turned({1, 0.5, 0.5});
  EXPECT_LE(norm(force + weight), 1e-6 * norm(weight));
  EXPECT_LE(norm(moment + cross(centre, weight)), 1e-4 * norm(cross(centre, weight)));
}

/// A cube of 2 t under 5 m/s² on springs, which alone resist: at rest, and kept there by one step of any length.
TEST(Springs, StretchByWhatTheyCarryHoweverLittleResistsBesideThem) {
  for (const Real stiffness : {1e5, 1e8, 1e12})
    for (const Real dt : {0.01, 250.0}) {
      const RunResult run =
          run_model(box({1, 1, 1}, {5, 0, 0},
                        fmt::format("[cover]\nlattice = 'block'\norder = 0\n"
                                    "[[fixed]]\nwhere = {{face = 'r.xmin'}}\nstiffness = {}\n"
                                    "[[monitor]]\npoint = [0.5, 0.5, 0.5]\n"
                                    "[analysis]\nkinematics = 'small'\n[[step]]\ntype = 'static'\n"
                                    "[[step]]\ntype = 'dynamic'\ntime_step = {}\nsteps = 1\n",
                                    stiffness, dt)))
              .result;
      const Real force = 5 * 2000, way = force / stiffness;
      for (const Vec3& u : {run.monitors[0].displacement[1], run.monitors[0].displacement[2]})
        EXPECT_NEAR(u[0] / way, 1, 1e-8) << stiffness << ' ' << dt;
      EXPECT_NEAR(run.energy.supports / (-0.5 * force * way), 1, 1e-8) << stiffness << ' ' << dt;
    }
}

/// Let go at once, whatever the scheme: springs store ½ k u², and what the scheme takes is `numerical`.
TEST(Springs, StoreWhatTheyAreStretchedByInTheFirstStepToo) {
  for (const char* newmark :
       {"{beta = 0.25, gamma = 0.5}", "{beta = 0.5, gamma = 1}", "{beta = 0.3025, gamma = 0.6}"}) {
    const RunResult run =
        run_model(box({1, 1, 1}, {5, 0, 0},
                      fmt::format("[cover]\nlattice = 'block'\norder = 0\n"
                                  "[[fixed]]\nwhere = {{face = 'r.xmin'}}\nstiffness = 1e5\n"
                                  "[[monitor]]\npoint = [0.5, 0.5, 0.5]\n"
                                  "[analysis]\ntype = 'dynamic'\nkinematics = 'small'\n"
                                  "time_step = 0.0625\nsteps = 1\nnewmark = {}\n",
                                  newmark)))
            .result;
    const Real u = run.monitors[0].displacement[1][0];
    EXPECT_NEAR(run.energy.supports / (-0.5 * 1e5 * u * u), 1, 1e-9) << newmark;
  }
}

/// A swinging cube whose analysis is divided in two, and one whose is not.
TEST(Springs, PullInASecondAnalysisAsTheyDidAtTheEndOfTheFirst) {
  const auto swing = [](const char* motion, const char* steps) {
    return run_model(box({1, 1, 1}, {5, 0, 0},
                         fmt::format("[cover]\nlattice = 'hex8'\nspacing = 0.5\n"
                                     "[[fixed]]\nwhere = {{face = 'r.xmin'}}\nstiffness = 1e5\n"
                                     "[[monitor]]\npoint = [0.5, 0.5, 0.5]\n"
                                     "[analysis]\n{}\ntime_step = 0.05\n{}",
                                     motion, steps)))
        .result;
  };
  for (const char* motion : {"kinematics = 'small'", "kinematics = 'large'",
                             "kinematics = 'small'\nnewmark = {beta = 0.3025, gamma = 0.6}"}) {
    const RunResult once = swing(motion, "type = 'dynamic'\nsteps = 10\n"),
                    twice = swing(motion,
                                  "[[step]]\ntype = 'dynamic'\nsteps = 7\n"
                                  "[[step]]\ntype = 'dynamic'\nsteps = 3\n");
    for (std::size_t step = 0; step <= 10; ++step)
      EXPECT_NEAR(twice.monitors[0].displacement[step][0], once.monitors[0].displacement[step][0],
                  1e-9)
          << motion << ' ' << step;
    EXPECT_NEAR(twice.energy.supports / once.energy.supports, 1, 1e-7) << motion;
  }
}

TEST(Supports, AtRestOnlyTakeEnergyFromRockThatIsThrown) {
  for (const char* kinematics : {"small", "large"})
    for (const Real dt : {1e-4, 1e-3, 1e-2}) {
      const ModelAnswer answer = run_model(
          box({1, 1, 1}, {},
              fmt::format("[cover]\nlattice = 'tet6'\nspacing = 0.5\norigin = [0, 0, 0]\n"
                          "[[fixed]]\nwhere = {{face = 'r.zmin'}}\n"
                          "[[initial_velocity]]\nwhere = {{all = true}}\n"
                          "angular_velocity = [0, 0, 0.1]\n"
                          "[analysis]\ntype = 'dynamic'\nkinematics = '{}'\ntime_step = {}\n"
                          "steps = 20\n",
                          kinematics, dt)));
      const auto& energies = answer.result.energies;
      const Real start = energies.front().kinetic, blow = energies.front().supports;
      EXPECT_LT(blow, -0.1 * start);
      for (const Energy& e : energies) {
        EXPECT_NEAR(e.kinetic + e.strain, start, 1e-6 * start) << kinematics << ", step of " << dt;
        EXPECT_NEAR(e.supports, blow, 1e-6 * start) << kinematics << ", step of " << dt;
      }
    }
}

TEST(Supports, OfMorePointsThanABlockCanFollowLeaveItNearThem) {
  // 15 displacements of a block that has 12 unknowns, one of them a millimetre aside.
  const std::vector<Vec3> points{
      {0.1, 0.2, 0.1}, {0.9, 0.1, 0.3}, {0.2, 0.8, 0.6}, {0.7, 0.7, 0.9}, {0.5, 0.4, 0.4}};
  std::string text =
      "[cover]\nlattice = 'block'\norder = 1\n[analysis]\ntype = 'static'\n"
      "[[monitor]]\npoint = [0.5, 0.5, 0.5]\n";
  for (const Vec3& x : points)
    text += held_point(x, x + (x == points[4] ? Vec3{1e-3, 0, 0} : Vec3{}));
  const ModelAnswer answer = run_model(box({1, 1, 1}, {}, text));
  EXPECT_LE(norm(answer.result.monitors[0].displacement.back()), 1e-3);
  EXPECT_GT(answer.result.support_gap, 0.01);
}

TEST(LongSupports, OfABoxThatCutsElementsMoveRockAsFarAsTheyAreMoved) {
  const Vec3 moved{1e-3, -2e-3, 5e-4};
  for (const char* lattice : {"tet5", "tet6", "tet24", "hex8"})
    for (const int order : {0, 1, 2})
      for (const char* where :
           {"box = [[-1, -1, -1], [2, 2, 0.1474]]",
            "plane = {point = [0, 0, 0.05], normal = [0, 0, 1], tolerance = 0.1}"}) {
        const ModelAnswer answer =
            run_model(box({1, 1, 1}, {},
                          fmt::format("[cover]\nlattice = '{}'\norder = {}\nspacing = 0.3997\n"
                                      "origin = [0.1224, 0.0288, -0.0218]\n"
                                      "[[fixed]]\nwhere = {{{}}}\nvalue = [{}, {}, {}]\n"
                                      "[analysis]\ntype = 'static'\n"
                                      "[[monitor]]\npoint = [0.77, 0.63, 0.91]\n",
                                      lattice, order, where, moved[0], moved[1], moved[2])));
        EXPECT_LE(norm(answer.result.monitors[0].displacement.back() - moved), 1e-8)
            << lattice << " of order " << order << ", " << where;
      }
}

TEST(Static, HoldsRockThatMissesLatticePlanesByAnyTinyAmount) {
  for (const char* lattice : {"tet5", "tet6", "tet24", "hex8"})
    for (Real miss = 1e-10; miss < 1e-5; miss *= 1.5) {
      const ModelAnswer answer = run_model(
          box({1, 1, 1}, {0, 0, -10},
              fmt::format("[cover]\nlattice = '{}'\nspacing = 0.5\norigin = [{}, {}, {}]\n"
                          "[[fixed]]\nwhere = {{face = 'r.zmin'}}\n[analysis]\ntype = 'static'\n",
                          lattice, miss, -miss, -miss)));
      EXPECT_NEAR(answer.result.conditions[0].force[2], 20000, 1e-3) << lattice << ", " << miss;
    }
}

TEST(LongStatic, SlenderBeamsOfQuadraticCoversAreSolvedOnLatticesOfAnyFit) {
  // Functions depend on each other, most of all where the lattice fits the beam: what is left of the residual is rounding along them.
  constexpr Real length = 10, width = 0.5, height = 0.2, pressure = 1000, modulus = 1e9;
  const Real inertia = width * std::pow(height, 3) / 12, force = pressure * width * height;
  const Real tip = force * std::pow(length, 3) / (3 * modulus * inertia);
  for (const auto& [lattice, spacing] :
       {std::pair{"tet5", "[1.0, 0.25, 0.2]"}, std::pair{"tet5", "[1.0, 0.5, 0.5]"},
        std::pair{"tet6", "[0.5, 0.5, 0.2]"}, std::pair{"tet6", "[1.0, 0.5, 0.5]"},
        std::pair{"tet6_kuhn", "[1.0, 0.25, 0.2]"}, std::pair{"hex8", "[1.0, 0.25, 0.2]"}}) {
    const ModelAnswer answer = run_model(fmt::format(
        "gravity = [0, 0, 0]\n[[material]]\ndensity = 1000\nyoung_modulus = {}\npoisson_ratio = 0\n"
        "[[solid]]\nname = 'beam'\nshape = 'box'\nmin = [0, 0, 0]\nmax = [{}, {}, {}]\n"
        "[cover]\nlattice = '{}'\norder = 2\nspacing = {}\norigin = [0, 0, 0]\n"
        "[[fixed]]\nwhere = {{face = 'beam.xmin'}}\n"
        "[[traction]]\nwhere = {{face = 'beam.xmax'}}\nvalue = [0, 0, {}]\n"
        "[analysis]\ntype = 'static'\nkinematics = 'small'\n"
        "[[monitor]]\npoint = [{}, {}, {}]\n",
        modulus, length, width, height, lattice, spacing, pressure, length, width / 2, height / 2));
    EXPECT_NEAR(answer.result.monitors[0].displacement.back()[2], tip, 1e-3 * tip)
        << lattice << ", " << spacing;
  }
}

TEST(DynamicRatioOfZero, DampsTheFirstStepToo) {
  const ModelAnswer answer = run_model(
      box({1, 1, 1}, {},
          "[cover]\nlattice = 'block'\norder = 0\n[[initial_velocity]]\nwhere = {all = true}\n"
          "velocity = [1, 0, 0]\n[[monitor]]\npoint = [0.5, 0.5, 0.5]\n"
          "[analysis]\ntype = 'dynamic'\nkinematics = 'small'\ntime_step = 0.05\nsteps = 2\n"
          "dynamic_ratio = 0\nnewmark = {beta = 0.5, gamma = 1}\nrayleigh = {alpha = 20}\n"));
  EXPECT_NEAR(answer.result.monitors[0].velocity[1][0], 1 / (1 + 20 * 0.05), 1e-12);
}

}  // namespace
}  // namespace rockfold
