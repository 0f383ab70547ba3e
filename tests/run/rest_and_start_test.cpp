// Where a motion ends, at rest, and where it begins, on covers of several functions.
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "src/base/error.hpp"
#include "src/base/vector.hpp"
#include "tests/run/run_model.hpp"

namespace rockfold {
namespace {

std::string box(const std::string& size, Real young, const std::string& cover) {
  return fmt::format(R"(
[[material]]
density = 2500
young_modulus = {}
poisson_ratio = 0.2
[[solid]]
name = "rock"
shape = "box"
min = [0, 0, 0]
max = {}
[cover]
{}
)",
                     young, size, cover);
}

const std::string floor_held = "[[fixed]]\nwhere = {face = \"rock.zmin\"}\n";
const std::string on_rollers =
    "[[fixed]]\nwhere = {face = \"rock.zmin\"}\ncomponents = [\"z\"]\n"
    "[[fixed]]\nwhere = {face = \"rock.xmin\"}\ncomponents = [\"x\"]\n"
    "[[fixed]]\nwhere = {face = \"rock.ymin\"}\ncomponents = [\"y\"]\n";

struct Rest {
  const char* lattice;
  int order;
  const char* kinematics;
  const char* tolerance;
  bool rollers;
};

class AtRest : public testing::TestWithParam<Rest> {};

TEST_P(AtRest, AQuasiStaticColumnStaysAsItStandsUnderItsWeight) {
  const Rest& c = GetParam();
  const std::string column =
      box("[1, 1, 4]", 5e7,
          fmt::format("lattice = \"{}\"\norder = {}\nspacing = 1\norigin = [0, 0, 0]", c.lattice,
                      c.order)) +
      (c.rollers ? on_rollers : floor_held);
  const std::string tail =
      fmt::format("kinematics = \"{}\"\n[solver]\ntolerance = {}\n", c.kinematics, c.tolerance);
  const RunResult still = run_model(column + "[analysis]\ntype = \"static\"\n" + tail).result;
  const RunResult slow = run_model(column +
                                   "[analysis]\ntype = \"quasi_static\"\ntime_step = 0.2\nsteps = "
                                   "60\n" +
                                   tail)
                             .result;
  EXPECT_EQ(slow.steps, 60);
  EXPECT_NEAR(slow.energy.strain / still.energy.strain, 1, 1e-6);
  EXPECT_NEAR(slow.largest_displacement.length / still.largest_displacement.length, 1, 1e-6);
  // Steps at rest take none, from the second half on: all of them would take twice as many.
  EXPECT_LT(slow.iterations.pcg, 5500);
}

INSTANTIATE_TEST_SUITE_P(
    Covers, AtRest,
    testing::Values(
        Rest{"hex8", 1, "small", "1e-8", false}, Rest{"hex8", 2, "small", "1e-12", true},
        Rest{"tet5", 1, "small", "1e-8", true}, Rest{"tet5", 2, "small", "1e-12", false},
        Rest{"tet6", 1, "small", "1e-12", false}, Rest{"tet6", 2, "small", "1e-8", false},
        Rest{"tet24", 1, "small", "1e-8", false}, Rest{"tet24", 1, "large", "1e-8", true},
        Rest{"hex8", 1, "large", "1e-8", true}, Rest{"tet6", 1, "large", "1e-8", false}),
    [](const auto& test) {
      return fmt::format("{}_order{}_{}_{}_{}", test.param.lattice, test.param.order,
                         test.param.kinematics, test.param.rollers ? "rollers" : "floor",
                         std::string(test.param.tolerance) == "1e-8" ? "1e8" : "1e12");
    });

Real length(const Vec3& v) {
  return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

TEST(LongStart, StiffPenaltySupportsOnCoversOfSeveralFunctionsTakeFewIterations) {
  for (const char* cover : {"lattice = \"tet6\"\nspacing = 0.45\norder = 1",
                            "lattice = \"tet6\"\nspacing = 0.7\norder = 2"}) {
    const auto fall = [&](const char* method) {
      return run_model(box("[2, 2, 3]", 1e8, cover) + floor_held +
                       fmt::format("method = \"{}\"\n", method) +
                       "[[monitor]]\npoint = [1, 1, 2.5]\n[analysis]\nkinematics = "
                       "\"small\"\ntime_step = 0.005\nsteps = 1\n")
          .result;
    };
    const RunResult springs = fall("penalty"), multipliers = fall("augmented_lagrangian");
    EXPECT_LT(springs.iterations.pcg, 3000) << cover;
    EXPECT_LT(multipliers.iterations.pcg, 3000) << cover;
    const Vec3 by_springs = springs.monitors[0].displacement.back(),
               by_multipliers = multipliers.monitors[0].displacement.back();
    EXPECT_NEAR(by_springs[2] / by_multipliers[2], 1, 1e-3) << cover;
    const MonitorHistory& first = springs.monitors[0];
    EXPECT_NEAR(first.acceleration.back()[2], -9.81, 0.3) << cover;  // far from the floor
    // The whole residual is balanced from the start: energies close.
    EXPECT_NEAR(springs.energy.numerical, 0, 1e-6 * springs.energy.kinetic) << cover;
  }
}

TEST(Supports, ThatMoveWeightlessRockDoSoByEveryMethodUnderLargeKinematics) {
  const auto move = [&](const std::string& method) {
    return run_model("gravity = [0, 0, 0]\n" +
                     box("[1, 1, 1]", 1e7, "spacing = 0.5\norigin = [0, 0, 0]") + floor_held +
                     "value_table = [[0, 0, 0, 0], [2, 0.2, 0, 0]]\n" + method +
                     "[[monitor]]\npoint = [0.5, 0.5, 0.9]\n[analysis]\ntime_step = 0.05\nsteps = "
                     "10\n")
        .result;
  };
  const RunResult springs = move("method = \"penalty\"\n"),
                  multipliers = move("method = \"augmented_lagrangian\"\n");
  EXPECT_EQ(springs.steps, 10);
  EXPECT_LT(length(springs.monitors[0].displacement.back()), 0.1);
  EXPECT_NEAR(
      springs.monitors[0].displacement.back()[0] / multipliers.monitors[0].displacement.back()[0],
      1, 0.1);
}

TEST(Static, TheWorkOfLoadsWithATableIsThatOfConstantOnes) {
  for (const char* kinematics : {"small", "large"}) {
    const auto press = [&](const char* pressure) {
      return run_model(
                 "gravity = [0, 0, 0]\n" +
                 box("[1, 1, 1]", 1e7, "spacing = 0.5\norigin = [0, 0, 0]") + floor_held +
                 "[[traction]]\nwhere = {face = \"rock.zmax\"}\n" + pressure +
                 fmt::format("[analysis]\ntype = \"static\"\nkinematics = \"{}\"\n", kinematics))
          .result.energy;
    };
    const Energy constant = press("pressure = 1e4\n"),
                 table = press("pressure_table = [[0, 0], [2, 2e4]]\n");
    EXPECT_NEAR(table.strain / constant.strain, 1, 1e-6) << kinematics;
    EXPECT_NEAR(table.loads / (constant.loads - constant.potential), 1, 1e-6) << kinematics;
    // Put on at once, loads do twice the work that linear rock stores.
    EXPECT_NEAR(table.numerical / table.strain, 1, 0.01) << kinematics;
    EXPECT_NEAR(table.strain + table.potential + table.dissipated, table.loads + table.supports,
                1e-9 * table.strain)
        << kinematics;
  }
}

TEST(LongMultigrid, OfQuadraticCoversOnSliversTakesNoMoreCyclesThanOnOthers) {
  // A prism cut by a mixed tet5 lattice so that coarse covers move slivers alone.
  const std::string text = R"(
gravity = [0, 0, 0]
[[material]]
density = 1000
young_modulus = 507913034.16705984
poisson_ratio = -0.3
[[solid]]
name = "r"
shape = "prism"
base = [[0.44487719237816975, 1.4835149376883647, 0.5316366593887518], [1.425818034452707, -0.4355358901958097, -0.6772896317157017], [0.3881813118660116, -1.5666394622888564, 0.2762714038153302], [-0.5927595302085256, 0.3524113655953181, 1.4851976949197838]]
extrude = [-0.8330585042441814, 0.08312452460049158, -0.807908063204082]
[[joint]]
normal = [0.5104991860809034, -0.17923959051036997, -0.2166247490451455]
point = [0.32355265810632494, 0.1806924978076799, -0.3787039124739152]
[[joint]]
normal = [0.8932571010281543, 1.181848906062879, -0.6683959494010551]
point = [0.00822943792023334, 0.06961400626459781, 0.3097038814837648]
radius = 0.5212120664170439
sides = 6
[cover]
lattice = "tet5"
mixed = true
spacing = [0.6251923066373164, 0.3115279193657918, 0.6309492288402234]
directions = [[1.8250103743485457, 144.13837224333324], [76.3753719334772, 197.3700964152018], [31.494661653027414, 299.6559426356741]]
origin = [-0.08940499606922363, 0.8794821156783236, 0.0034064069199525315]
joints = "welded"
order = 2
[[traction]]
where = {face = "r.4"}
value = [726295, -149529, -207779]
[[traction]]
where = {face = "r.5"}
value = [-726295, 149529, 207779]
[[fixed]]
where = {point = [0.44487719237816975, 1.4835149376883647, 0.5316366593887518]}
[[fixed]]
where = {point = [1.425818034452707, -0.4355358901958097, -0.6772896317157017]}
[[fixed]]
where = {point = [-1.425818034452707, 0.4355358901958097, 0.6772896317157017]}
[analysis]
type = "static"
)";
  const RunResult grids = run_model(text + "[solver]\npreconditioner = \"multigrid\"\n").result,
                  blocks =
                      run_model(text + "[solver]\npreconditioner = \"node_block_jacobi\"\n").result;
  EXPECT_EQ(grids.preconditioner, Preconditioner::multigrid);
  EXPECT_LT(grids.iterations.pcg, 300);
  EXPECT_LT(5 * grids.iterations.pcg, blocks.iterations.pcg);
  EXPECT_NEAR(grids.energy.strain / blocks.energy.strain, 1, 1e-6);
}

TEST(Multigrid, IsAsGoodWhereSupportsMissTheLattice) {
  const auto solve = [&](const char* lattice, const char* method, const char* origin,
                         const char* preconditioner) {
    return run_model(
               box("[4, 4, 4]", 1e10,
                   fmt::format("lattice = \"{}\"\nspacing = 0.5\norigin = {}", lattice, origin)) +
               floor_held +
               fmt::format("method = \"{}\"\n[[monitor]]\npoint = [4, 4, 4]\n[analysis]\ntype "
                           "= \"static\"\n[solver]\npreconditioner = \"{}\"\n",
                           method, preconditioner))
        .result;
  };
  for (const char* lattice : {"tet6", "hex8"})
    for (const char* method : {"penalty", "augmented_lagrangian"}) {
      const RunResult fits = solve(lattice, method, "[0, 0, 0]", "multigrid"),
                      misses = solve(lattice, method, "[0.17, 0.08, 0.29]", "multigrid"),
                      plain = solve(lattice, method, "[0.17, 0.08, 0.29]", "node_block_jacobi");
      EXPECT_EQ(misses.preconditioner, Preconditioner::multigrid) << lattice << method;
      EXPECT_LE(misses.iterations.pcg, 10 * fits.iterations.pcg) << lattice << method;
      // Springs that yield to multipliers pull as springs do.
      const Vec3 u = plain.monitors[0].displacement.back();
      EXPECT_LE(length(misses.monitors[0].displacement.back() - u), 1e-6 * length(u))
          << lattice << method;
      EXPECT_NEAR(misses.conditions[0].force[2], plain.conditions[0].force[2],
                  1e-6 * plain.conditions[0].force[2])
          << lattice << method;
    }
}

TEST(QuasiStatic, IsAtItsEndAfterOneLongStepWhereMultipliersAreFoundSlowly) {
  const std::string prism = R"(
gravity = [0, 0, 0]
[[material]]
density = 8729
young_modulus = 1.86e8
poisson_ratio = 0.45
[[solid]]
name = "r"
shape = "prism"
base = [[0.0, 0.0, 0.0], [1.893803878589614, 1.3350088505584075, -0.38718509153887065],
        [1.4008959835236066, 1.8368189557623358, -1.0678671670523565],
        [0.4243763387941666, 1.0635081511894722, -0.7900737015841195],
        [-0.2953124197328771, 1.660235919181312, -1.6588276876041983],
        [-0.9858157901320147, 1.0036202104078564, -1.3613641510269716]]
extrude = [-0.4103231754702819, 0.8499828938717414, 0.9237521608584169]
[cover]
lattice = "tet5"
order = 1
mixed = true
spacing = [0.752, 1.393, 1.362]
directions = [[45.616, 334.231], [45.940, 135.513], [80.513, 234.819]]
[[traction]]
where = {face = "r.0"}
value = [-876, 545, 1805]
[[monitor]]
point = [0.374, 1.384, 0.396]
)" + [] {
    std::string held;
    for (const char* face : {"3", "4", "5"})
      held += fmt::format("[[fixed]]\nwhere = {{face = 'r.{}'}}\nmethod = 'lagrange'\n", face);
    return held;
  }();
  const auto top = [&](const std::string& analysis) {
    return run_model(prism + "[analysis]\n" + analysis).result.monitors[0].displacement.back();
  };
  const Vec3 still = top("type = 'static'\n"),
             steps =
                 top("type = 'quasi_static'\nkinematics = 'small'\ntime_step = 100\nsteps = 1\n");
  EXPECT_LE(norm(steps - still), 1e-6 * norm(still));
}

}  // namespace
}  // namespace rockfold
