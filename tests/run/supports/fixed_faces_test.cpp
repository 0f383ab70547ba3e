// Fixed faces from the model to the answer: on lattices that run through them and on such that do not.
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "host/cover/cover.hpp"
#include "host/cover/points/loads.hpp"
#include "host/cut/cut.hpp"
#include "host/flatten/flatten.hpp"
#include "src/base/error.hpp"
#include "src/base/vector.hpp"
#include "src/check/needs.hpp"
#include "src/model/read/read_model.hpp"
#include "src/run/run_analysis.hpp"
#include "src/space/shape_functions.hpp"
#include "tests/solve/systems/spaces.hpp"

namespace rockfold {
namespace {

struct Answer {
  RunResult result;
  std::vector<std::array<Real, 6>> stress;
  std::vector<Vec3> place, displacement;  ///< of the blocks' vertices and the monitors
};

Answer run(const std::string& text) {
  const Model model = parse_model(text, "m.toml", {}, Purpose::run);
  Progress silent;
  const Cutting cutting = cut_blocks(model, silent);
  const BlockArrays blocks = flatten_blocks(cutting, model);
  const Covering covering = build_covers(cutting, model, silent);
  const FixedPoints fixed = fixed_points(cutting, covering, model);
  const LoadPoints loads = load_points(cutting, covering, model);
  const QuietPoints quiet = quiet_points(cutting, covering, model);
  const MaterialPoints monitors = locate_points(covering, monitor_points(model)),
                       vertices = locate_block_vertices(covering, blocks);
  Answer answer;
  const auto store = [&](const StoredState& state) {
    answer.stress = state.element_stress;
    answer.place.clear();
    answer.displacement.clear();
    for (const MaterialPoints* points : {&vertices, &monitors})
      for (std::size_t n = 0; n < points->size(); ++n) {
        answer.place.push_back(point_position(covering.arrays, *points, n));
        answer.displacement.push_back(interpolate(*points, n, state.motion.displacement));
      }
  };
  answer.result = run_analysis(
      {model, covering.arrays, blocks, fixed, monitors, loads, quiet, {}, vertices}, store, silent);
  return answer;
}

const char* const lattices[] = {"spacing = 0.5\norigin = [0, 0, 0]\n",
                                "spacing = 0.5\norigin = [0.03, 0.02, 0.0371]\n",
                                R"(spacing = 0.45
origin = [0.03, 0.02, 0.0371]
directions = [[20, 30], [90, 120], [70, 210]]
)"};

std::string bar(Real poisson_ratio, const std::string& rest) {
  return fmt::format(R"(
[[material]]
density = 2000
young_modulus = 1e8
poisson_ratio = {}
[[solid]]
name = "bar"
shape = "box"
min = [0, 0, 0]
max = [1, 1, 2]
[analysis]
type = "static"
[solver]
tolerance = 1e-12
{})",
                     poisson_ratio, rest);
}

/// [[fixed]] of a face.
std::string hold(const std::string& face, const std::string& rest) {
  return "[[fixed]]\nwhere = {face = 'bar." + face + "'}\n" + rest + "\n";
}

TEST(FixedFaces, PassThePatchTestOnAnyLatticeAndByEachMethod) {
  // Rollers on three sides and a pull on the top: uniform stress.
  const std::string loads = "[[traction]]\nwhere = {face = 'bar.zmax'}\nvalue = [0, 0, 1e5]\n";
  for (const char* lattice : lattices)
    for (const char* method : {"augmented_lagrangian", "lagrange", "penalty"}) {
      const std::string by = fmt::format("method = '{}'\n", method);
      std::string held = hold("xmin", "components = ['x']\n" + by);
      held += hold("ymin", "components = ['y']\n" + by);
      held += hold("zmin", "components = ['z']\n" + by);
      const Answer answer =
          run("gravity = [0, 0, 0]\n" + bar(0.25, held + loads + "[cover]\n" + lattice));
      SCOPED_TRACE(std::string(lattice) + method);
      // Rollers without force do not deform their springs; the base sinks by a uniform 1e-3 of the elements' own.
      for (const auto& s : answer.stress)
        for (int k = 0; k < 6; ++k) ASSERT_NEAR(s[k], k == 2 ? 1e5 : 0, 1e5 * 1e-7);
    }
}

TEST(FixedFaces, MovedApartStretchABarUniformly) {
  // Without Poisson's effect both ends may be held in all directions.
  for (const char* lattice : lattices) {
    const Answer answer = run(
        "gravity = [0, 0, 0]\n" +
        bar(0, hold("zmin", "") + hold("zmax", "value = [0, 0, 1e-3]\n") + "[cover]\n" + lattice));
    SCOPED_TRACE(lattice);
    for (const auto& s : answer.stress)
      for (int k = 0; k < 6; ++k) ASSERT_NEAR(s[k], k == 2 ? 5e4 : 0, 5e4 * 1e-6);
    EXPECT_NEAR(answer.result.largest_displacement.length, 1e-3, 3e-4);
  }
}

class FixedFacesOf : public testing::TestWithParam<Space> {};
INSTANTIATE_TEST_SUITE_P(EveryLattice, FixedFacesOf, testing::ValuesIn(spaces(true)), space_name);

/// The top is pressed down between rollers, on a lattice whose planes run through no face and, but for hexahedra of higher order, are oblique
/// to all (hexahedra of which a sliver alone is rock make their functions nearly dependent: docs/decisions/0002): a uniform strain, which every
/// space holds.
TEST_P(FixedFacesOf, PressedDownStrainTheBarUniformly) {
  const auto [kind, order] = GetParam();
  const bool mixed = kind == LatticeKind::tet5_mixed;
  std::string cover =
      fmt::format("[cover]\nlattice = '{}'\norder = {}\n{}", mixed ? "tet5" : lattice_name(kind),
                  order, mixed ? "mixed = true\n" : "");
  if (kind != LatticeKind::block) cover += fmt::format("spacing = {}\n", order < 2 ? 0.6 : 0.9);
  if (kind == LatticeKind::hex8 && order > 0)
    cover += "origin = [0.3, 0.2, 0.371]\n";
  else if (kind != LatticeKind::block)
    cover += "origin = [0.03, 0.02, 0.0371]\ndirections = [[20, 30], [90, 120], [70, 210]]\n";
  const Real down = -1e-3, ratio = 0.25, strain = down / 2;
  const Answer answer = run(
      "gravity = [0, 0, 0]\n" +
      bar(ratio,
          hold("xmin", "components = ['x']") + hold("ymin", "components = ['y']") +
              hold("zmin", "components = ['z']") +
              hold("zmax", fmt::format("components = ['z']\nvalue = [0, 0, {}]", down)) + cover +
              "[[monitor]]\npoint = [0.31, 0.57, 1.13]\n[[monitor]]\npoint = [1, 0.02, 0.7]\n"));
  ASSERT_EQ(answer.place.size(), 10u);
  for (std::size_t n = 0; n < answer.place.size(); ++n) {
    const Vec3& x = answer.place[n];
    const Vec3 expected{-ratio * strain * x[0], -ratio * strain * x[1], strain * x[2]};
    for (int d = 0; d < 3; ++d)
      EXPECT_NEAR(answer.displacement[n][d], expected[d], 1e-9 * std::abs(down)) << n << d;
  }
  for (int k = 0; k < 6; ++k)
    EXPECT_NEAR(answer.result.block_stress[0][k] / (1e8 * strain), k == 2 ? 1 : 0, 1e-9);
  EXPECT_NEAR(answer.result.conditions[3].force[2] / (1e8 * strain), 1, 1e-9);
}

TEST(FixedFaces, ThatCutLatticeCellsKeepTheOrderOfConvergence) {
  // A column under its weight, held in all directions at its base, without Poisson's effect: strain energy (ρg)² A H³ / 6E. Linear
  // functions miss a share of it that falls with the square of the spacing, and hardly more where the base cuts cells.
  const Real exact = std::pow(2000 * 9.81, 2) * 8 / (6 * 1e8);
  const auto miss = [&](Real spacing, const std::string& lattice) {
    const Answer answer =
        run(bar(0, hold("zmin", "") + fmt::format("[cover]\nspacing = {}\n", spacing) + lattice));
    EXPECT_LT(answer.result.support_gap, 1e-9);
    return 1 - answer.result.energy.strain / exact;
  };
  const std::string through_nodes = "origin = [0, 0, 0]\n",
                    cuts = "origin = [0.03, 0.02, 0.0371]\n";
  const Real coarse = miss(0.5, cuts), fine = miss(0.25, cuts);
  EXPECT_GT(fine, 0);
  EXPECT_GT(std::log2(coarse / fine), 1.7);
  EXPECT_NEAR(fine / miss(0.25, through_nodes), 1, 0.15);
}

TEST(FixedFaces, ThatCutLatticeCellsCostLittleMore) {
  const auto iterations = [&](const std::string& lattice) {
    const std::string blocks = "preconditioner = \"node_block_jacobi\"\n";
    return run(bar(0.3, blocks + hold("zmin", "") + "[cover]\nspacing = 0.25\n" + lattice))
        .result.iterations.pcg;
  };
  // Some 20 times as many with every corner of the cut polygons held (docs/decisions/0004).
  EXPECT_LT(iterations("origin = [0.03, 0.02, 0.0371]\n"), 10 * iterations("origin = [0, 0, 0]\n"));
}

TEST(FixedFaces, LeaveNoMotionFreeThatTheyHold) {
  // A block within one lattice cell, held on a face that cuts it: no turn is left free.
  EXPECT_NO_THROW(
      run(bar(0.2, hold("zmin", "") + "[cover]\nspacing = 7\norigin = [-2, -2, -2.5]\n")));
  try {
    run(bar(0.2, hold("zmin", "components = ['z']\n") + "[cover]\nspacing = 0.45\n"));
    FAIL();
  } catch (const Error& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("free to move as a rigid body"), std::string::npos) << message;
    EXPECT_NE(message.find("rotation about (0.000, 0.000, "), std::string::npos) << message;
  }
}

TEST(FixedFaces, DoNotHoldWhatAProlongedJointCutsOff) {
  // A disc amid the bar crosses all four cells of a layer: prolonged to their boundaries it cuts the bar in two.
  const auto jointed = [](const char* tips) {
    return bar(0.25,
               hold("zmin", "") + "[[joint_material]]\nfriction_angle = 30\n" +
                   "[[joint]]\npoint = [0.5, 0.5, 1.03]\nnormal = [0.1, 0.2, 1]\nradius = 0.37\n" +
                   "[cover]\nspacing = 0.5\nlattice = 'hex8'\njoint_tips = '" + tips + "'\n");
  };
  EXPECT_NO_THROW(run(jointed("keep")));
  try {
    run(jointed("extend"));
    FAIL() << "a loose part passed";
  } catch (const Error& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("cut off from the rest of block 1 (nothing holds it)"),
              std::string::npos)
        << message;
    EXPECT_NE(message.find("joint_tips"), std::string::npos) << message;
  }
}

/// 3-2-1: no rigid motion, and no force. The exact field is linear: the body shrinks by p (1 − 2ν) / E in all directions.
TEST(FixedPointsOfABody, ThatCarryNothingLeaveItWhereItIs) {
  for (const char* spacing : {"0.6", "0.55", "0.4"})
    for (const char* method : {"augmented_lagrangian", "lagrange"}) {
      const std::string by = fmt::format("method = '{}'\n", method);
      std::string text = R"(
gravity = [0, 0, 0]
[[material]]
density = 2500
young_modulus = 1e9
poisson_ratio = 0.3
[[solid]]
name = "ball"
shape = "sphere"
center = [10, 20, 30]
radius = 1.0
subdivisions = 1
[cover]
lattice = "tet6"
[[traction]]
where = {face = "ball.side"}
pressure = 1e6
[analysis]
type = "static"
)";
      text += "[[fixed]]\nwhere = {point = [10, 20, 30]}\n" + by;
      text += "[[fixed]]\nwhere = {point = [10.5, 20, 30]}\ncomponents = ['y', 'z']\n" + by;
      text += "[[fixed]]\nwhere = {point = [10, 20.5, 30]}\ncomponents = ['z']\n" + by;
      text.replace(text.find("lattice"), 0, fmt::format("spacing = {}\n", spacing));
      SCOPED_TRACE(text);
      const Answer answer = run(text);
      // At 0.55 m the multipliers are still 2e-5 off when their updates end.
      const Real tolerance = std::string(spacing) == "0.55" ? 1e-3 : 1e-6;
      for (std::size_t n = 0; n < answer.place.size(); ++n)
        EXPECT_LT(
            norm(answer.displacement[n] + 1e6 * 0.4 / 1e9 * (answer.place[n] - Vec3{10, 20, 30})),
            tolerance * 4e-4);
    }
}

/// A cube of 4 m held by a face that misses the lattice, under a traction that is nowhere symmetric.
std::string held_cube(const std::string& cover, const std::string& face, const std::string& loaded,
                      const std::string& traction, const std::string& monitors) {
  return R"(
[[material]]
density = 2700
young_modulus = 1e9
poisson_ratio = 0.25
[[joint_material]]
name = "j"
friction_angle = 30
[[solid]]
name = "rock"
shape = "box"
min = [-2, -2, 0]
max = [2, 2, 4]
[analysis]
type = "static"
[solver]
tolerance = 1e-12
[cover]
)" + cover +
         "\n[[fixed]]\nwhere = {face = 'rock." + face + "'}\n[[traction]]\nwhere = {face = 'rock." +
         loaded + "'}\nvalue = " + traction + "\n" + monitors;
}

TEST(FacesOffTheLattice, AreHeldAlikeHoweverWeldedJointsDivideThem) {
  const std::string monitors =
      "[[monitor]]\npoint = [1.1, 0.2, 3.6]\n[[monitor]]\npoint = [-1.3, -0.1, 0.8]\n";
  for (const int order : {0, 1})
    for (const char* kind : {"tet6", "hex8"}) {
      const std::string cube =
          held_cube(fmt::format("lattice = '{}'\norder = {}\nspacing = 1.0\norigin = [0.3, 0.3, "
                                "0.4]\njoints = 'welded'",
                                kind, order),
                    "zmin", "zmax", "[1e5, 2e4, -1e5]", monitors);
      const Answer whole = run(cube);
      const Answer jointed =
          run(cube + "[[joint]]\ndip = 50\ndip_direction = 60\npoint = [0.1, 0.05, 1.9]\n");
      SCOPED_TRACE(cube);
      for (std::size_t m = 1; m <= 2; ++m) {
        const Vec3 there = whole.displacement[whole.displacement.size() - m];
        EXPECT_LT(norm(jointed.displacement[jointed.displacement.size() - m] - there),
                  1e-9 * norm(there));
      }
    }
}

TEST(FacesOffTheLattice, AreHeldAlikeWhereTheModelIsTurnedByAQuarter) {
  const Answer first =
      run(held_cube("lattice = 'hex8'\nspacing = 1.0\norigin = [0.3, 0.1, 0.4]", "xmin", "xmax",
                    "[1e5, 2e4, -1e5]", "[[monitor]]\npoint = [1.1, 0.2, 3.6]\n"));
  const Answer turned =
      run(held_cube("lattice = 'hex8'\nspacing = 1.0\norigin = [-0.1, 0.3, 0.4]", "ymin", "ymax",
                    "[-2e4, 1e5, -1e5]", "[[monitor]]\npoint = [-0.2, 1.1, 3.6]\n"));
  const Vec3 u = first.displacement.back(), v = turned.displacement.back();
  EXPECT_LT(norm(v - Vec3{-u[1], u[0], u[2]}), 1e-9 * norm(u));
}

}  // namespace
}  // namespace rockfold
