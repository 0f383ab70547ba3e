// Steps by explicit substeps: blocks move as statics, kinematics and implicit steps say, and their accounts close.
#include <cmath>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include "src/base/vector.hpp"
#include "tests/run/run_model.hpp"

namespace rockfold {
namespace {

constexpr Real gravity = 9.81;

std::string rock(Real friction_angle, const std::string& more = "") {
  return "[[material]]\ndensity = 2500\nyoung_modulus = 1e10\npoisson_ratio = 0.25\n"
         "[[joint_material]]\nname = 'clean'\nnormal_stiffness = 1e9\nfriction_angle = " +
         std::to_string(friction_angle) + "\n" + more;
}

/// A block of 2 × 1 × about 1.5 m on another that is held, on a plane that dips by 30° to the east.
std::string on_incline(Real friction_angle, const std::string& analysis) {
  return rock(friction_angle) +
         "[[solid]]\nname = 'rock'\nshape = 'box'\nmin = [0, 0, 0]\nmax = [2, 1, 3]\n"
         "[[joint]]\nname = 'J'\ndip = 30\ndip_direction = 90\npoint = [1, 0.5, 1.5]\n"
         "[cover]\nlattice = 'block'\n[[fixed]]\nwhere = {block_at = [1, 0.5, 0.2]}\n"
         "[[monitor]]\nname = 'top'\npoint = [1, 0.5, 2.5]\n"
         "[analysis]\nkinematics = 'large'\n" +
         analysis;
}

/// A first step in which the block comes to rest on its plane, and one by substeps.
std::string then_by_substeps(Real dt, int steps, const std::string& more = "") {
  return "[[step]]\ntype = 'quasi_static'\ntime_step = 0.1\nsteps = 5\n"
         "[[step]]\ntype = 'dynamic'\nscheme = 'explicit'\nreset_displacement = true\ntime_step "
         "= " +
         std::to_string(dt) + "\nsteps = " + std::to_string(steps) + "\n" + more;
}

Real way(const ModelAnswer& answer) {
  return norm(answer.result.monitors[0].displacement.back());
}

/// Of what is turned over, what may be missing.
void expect_closed_accounts(const RunResult& run, Real share) {
  Real largest = 0;
  for (const Energy& e : run.energies)
    largest = std::max({largest, std::abs(e.potential), e.kinetic, e.friction});
  const Energy& end = run.energies.back();
  EXPECT_LT(std::abs(end.numerical - run.energies[5].numerical), share * largest);
  for (std::size_t n = 6; n < run.energies.size(); ++n)
    EXPECT_GE(run.energies[n].friction, run.energies[n - 1].friction) << n;
}

TEST(ExplicitSteps, LetABlockSlideAsFrictionDoes) {
  const Real slope = 30 * std::numbers::pi / 180, friction = 20 * std::numbers::pi / 180;
  const Real acceleration = gravity * (std::sin(slope) - std::cos(slope) * std::tan(friction));
  // It starts from rest, held by friction at rest: what it lacks comes at once.
  const ModelAnswer answer = run_model(
      "gravity = [0, 0, -9.81]\n" +
      on_incline(20, "type = 'dynamic'\nscheme = 'explicit'\ntime_step = 0.01\nsteps = 40\n"));
  EXPECT_NEAR(way(answer) / (0.5 * acceleration * 0.16), 1, 1e-3);
  EXPECT_GT(answer.result.contacts.slide, 0);
}

TEST(ExplicitSteps, LeaveAtRestWhatFrictionHolds) {
  const ModelAnswer answer =
      run_model("gravity = [0, 0, -9.81]\n" + on_incline(31, then_by_substeps(0.01, 50)));
  EXPECT_LT(way(answer), 1e-5);
  expect_closed_accounts(answer.result, 1e-3);
}

TEST(ExplicitSteps, KeepTheEnergyOfABlockThatSpinsInTheAir) {
  const ModelAnswer answer = run_model(R"(
gravity = [0, 0, 0]
[[material]]
density = 2500
young_modulus = 1e9
poisson_ratio = 0.2
[[solid]]
name = 'rock'
shape = 'box'
min = [0, 0, 0]
max = [1, 2, 3]
[cover]
lattice = 'block'
order = 1
[[initial_velocity]]
where = {block_at = [0.5, 1, 1.5]}
velocity = [1, 0, 0]
angular_velocity = [0.3, 2, 0.1]
[analysis]
type = 'dynamic'
scheme = 'explicit'
time_step = 0.05
steps = 40
)");
  const RunResult& run = answer.result;
  const Energy &first = run.energies.front(), &last = run.energies.back();
  EXPECT_NEAR(last.kinetic + last.strain, first.kinetic + first.strain, 1e-4 * first.kinetic);
}

/// A cube of 1 m that falls by 0.2 m.
std::string dropped(Real restitution) {
  return "gravity = [0, 0, -9.81]\n" + rock(30) +
         "[[solid]]\nname = 'floor'\nshape = 'box'\nmin = [-2, -2, -1]\nmax = [3, 3, 0]\n"
         "[[solid]]\nname = 'cube'\nshape = 'box'\nmin = [0, 0, 0.2]\nmax = [1, 1, 1.2]\n"
         "[cover]\nlattice = 'block'\n[[fixed]]\nwhere = {block_at = [0.5, 0.5, -0.5]}\n"
         "[[monitor]]\nname = 'cube'\npoint = [0.5, 0.5, 0.7]\n[contact]\nrestitution = " +
         std::to_string(restitution) +
         "\n[analysis]\ntype = 'dynamic'\nscheme = 'explicit'\ntime_step = 0.002\nsteps = 250\n";
}

TEST(ExplicitSteps, GiveARebound) {
  for (const Real restitution : {0.0, 0.5, 1.0}) {
    const ModelAnswer answer = run_model(dropped(restitution));
    const MonitorHistory& cube = answer.result.monitors[0];
    Real lowest = 0, highest = -1;
    for (const Vec3& u : cube.displacement) {
      if (u[2] < lowest) {
        lowest = u[2];
        highest = -1;
      }
      highest = std::max(highest, u[2]);
    }
    EXPECT_NEAR((highest + 0.2) / 0.2, restitution * restitution, 0.03) << restitution;
  }
}

TEST(ExplicitSteps, HoldPointsExactlyInTheirPlaces) {
  const ModelAnswer answer =
      run_model("gravity = [0, 0, -9.81]\n" + on_incline(31, then_by_substeps(0.01, 20)));
  const RunResult& run = answer.result;
  ASSERT_EQ(run.conditions.size(), 1U);
  const Real weight = 2500 * gravity * 6;
  EXPECT_NEAR(run.conditions[0].force[2] / weight, 1, 1e-2);
  EXPECT_LT(run.off_place.distance, 1e-12);
}

/// Two blocks on a footing that stands on three of its corners: what they bear strains it.
std::string on_corners(const std::string& steps) {
  return "gravity = [0, 0, -9.81]\n" + rock(30) +
         "[[solid]]\nname = 'rock'\nshape = 'box'\nmin = [0, 0, 0]\nmax = [2, 1, 3]\n"
         "[[joint]]\nname = 'low'\ndip = 0\ndip_direction = 0\npoint = [0, 0, 1]\n"
         "[[joint]]\nname = 'high'\ndip = 10\ndip_direction = 90\npoint = [1, 0.5, 2]\n"
         "[cover]\nlattice = 'block'\n"
         "[[fixed]]\nwhere = {point = [0, 0, 0]}\n[[fixed]]\nwhere = {point = [2, 0, 0]}\n"
         "[[fixed]]\nwhere = {point = [1, 1, 0]}\n"
         "[[monitor]]\nname = 'top'\npoint = [1, 0.5, 2.9]\n"
         "[analysis]\nkinematics = 'large'\n" +
         steps;
}

TEST(ExplicitSteps, LeaveAtRestBlocksThatAreHeldAtPoints) {
  const RunResult run = run_model(on_corners(then_by_substeps(0.01, 5))).result;
  EXPECT_LT(norm(run.monitors[0].displacement.back()), 1e-9);
  for (std::size_t n = 6; n < run.energies.size(); ++n)
    EXPECT_LT(run.energies[n].kinetic, 1e-6 * run.energies[n].strain) << n;
  Real sum = 0;
  for (const Reaction& reaction : run.conditions) {
    EXPECT_GT(reaction.force[2], 0);
    sum += reaction.force[2];
  }
  EXPECT_NEAR(sum / (2500 * gravity * 6), 1, 1e-6);
}

TEST(ExplicitSteps, RelaxToTheRestThatImplicitStepsComeTo) {
  const std::string steps = "[[step]]\ntype = 'quasi_static'\ntime_step = 0.1\nsteps = 5\n";
  const RunResult implicit = run_model(on_corners(steps)).result,
                  relaxed = run_model(on_corners(steps + "scheme = 'explicit'\n")).result;
  ASSERT_EQ(implicit.blocks.size(), relaxed.blocks.size());
  for (std::size_t b = 0; b < implicit.blocks.size(); ++b)
    for (int d = 0; d < 3; ++d)
      EXPECT_NEAR(relaxed.blocks[b].displacement[d], implicit.blocks[b].displacement[d],
                  1e-3 * norm(implicit.blocks[b].displacement))
          << b;
  for (std::size_t c = 0; c < implicit.conditions.size(); ++c)
    EXPECT_NEAR(relaxed.conditions[c].force[2] / implicit.conditions[c].force[2], 1, 1e-3) << c;
}

/// A crumb of 1 cm on a cube of 1 m.
std::string on_a_cube(const std::string& scaling) {
  return "gravity = [0, 0, -9.81]\n" + rock(30) +
         "[[solid]]\nname = 'floor'\nshape = 'box'\nmin = [-2, -2, -1]\nmax = [3, 3, 0]\n"
         "[[solid]]\nname = 'cube'\nshape = 'box'\nmin = [0, 0, 0.1]\nmax = [1, 1, 1.1]\n"
         "[[solid]]\nname = 'crumb'\nshape = 'box'\nmin = [0.5, 0.5, 1.1]\nmax = [0.51, 0.51, "
         "1.11]\n"
         "interface = 'clean'\n"
         "[cover]\nlattice = 'block'\n[[fixed]]\nwhere = {block_at = [0.5, 0.5, -0.5]}\n"
         "[[monitor]]\nname = 'cube'\npoint = [0.5, 0.5, 0.6]\n"
         "[[monitor]]\nname = 'crumb'\npoint = [0.505, 0.505, 1.105]\n"
         "[analysis]\ntype = 'dynamic'\nscheme = 'explicit'\ntime_step = 0.005\nsteps = 100\n" +
         scaling;
}

TEST(ExplicitSteps, LetACrumbGoByItsOwnClock) {
  const RunResult run = run_model(on_a_cube("")).result;
  const Vec3 cube = run.monitors[0].displacement.back(),
             crumb = run.monitors[1].displacement.back();
  EXPECT_NEAR(cube[2], -0.1, 1e-3);
  EXPECT_NEAR(crumb[2], cube[2], 1e-3);
  EXPECT_EQ(run.by_substeps.at(0).added_mass, 0);
}

TEST(ExplicitSteps, AddMassToTheFastestBlocksWhereThatIsAskedFor) {
  const BySubsteps own = run_model(on_a_cube("")).result.by_substeps.at(0);
  const RunResult run = run_model(on_a_cube("mass_scaling = 1e-4\n")).result;
  const BySubsteps& scaled = run.by_substeps.at(0);
  EXPECT_GT(scaled.added_mass, 0);
  EXPECT_LE(scaled.added_mass, 1e-4);
  EXPECT_LT(2 * scaled.visits, own.visits);
  EXPECT_NEAR(run.monitors[0].displacement.back()[2], -0.1, 1e-3);
  // What is added has its weight: the crumb falls with the cube.
  const MonitorHistory &cube = run.monitors[0], &crumb = run.monitors[1];
  const std::size_t falling = 25;
  EXPECT_LT(cube.displacement[falling][2], -0.07);
  EXPECT_NEAR(crumb.displacement[falling][2], cube.displacement[falling][2], 1e-6);
}

}  // namespace
}  // namespace rockfold
