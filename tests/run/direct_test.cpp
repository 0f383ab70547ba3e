// Analyses that conjugate gradients end only with the factors of the matrix.
#include <cstdio>

#include <gtest/gtest.h>

#include "host/direct/multifrontal.hpp"
#include "src/base/vector.hpp"
#include "tests/run/run_model.hpp"
#include "tests/time/rock.hpp"

namespace rockfold {
namespace {

/// A column of quadratic covers on its base, its top pulled aside, turned by so little about y that slivers remain beside the lattice.
std::string leaning_column(Real angle, const std::string& preconditioner) {
  char prism[300];
  std::snprintf(prism, sizeof prism,
                "base = [[0, 0, 0], [1, 0, %.17g], [1, 1, %.17g], [0, 1, 0]]\n"
                "extrude = [%.17g, 0, 2]\n",
                -angle, -angle, 2 * angle);
  return std::string(
             "gravity = [0, 0, 0]\n[[material]]\nname = \"m\"\ndensity = 2500\n"
             "young_modulus = 1e9\npoisson_ratio = 0.25\n[[solid]]\nname = \"r\"\n"
             "shape = \"prism\"\n") +
         prism +
         "[cover]\nlattice = \"hex8\"\nspacing = 1\norder = 2\norigin = [0, 0, 0]\n"
         "[[fixed]]\nwhere = {face = \"r.cap0\"}\nmethod = \"augmented_lagrangian\"\n"
         "[[traction]]\nwhere = {face = \"r.cap1\"}\nvalue = [1e4, 5e3, -3e4]\n"
         "[analysis]\ntype = \"static\"\n[[monitor]]\npoint = [0.5, 0.5, 1.9]\n"
         "[solver]\npreconditioner = \"" +
         preconditioner + "\"\n";
}

Vec3 top_of(const ModelAnswer& answer) {
  return answer.result.monitors[0].displacement.back();
}

TEST(Factors, EndAnAnalysisOfQuadraticCoversBesideSlivers) {
  const ModelAnswer plain = run_model(leaning_column(0, "auto"));
  const ModelAnswer turned = run_model(leaning_column(1e-10, "auto"));
  EXPECT_EQ(turned.result.preconditioner, Preconditioner::direct);
  EXPECT_LE(norm(top_of(turned) - top_of(plain)), 0.01 * norm(top_of(plain)));
  EXPECT_NEAR(turned.result.energy.strain, plain.result.energy.strain,
              0.01 * plain.result.energy.strain);
}

TEST(Factors, MayBeAskedForByName) {
  const ModelAnswer plain = run_model(leaning_column(0, "auto")),
                    direct = run_model(leaning_column(0, "direct"));
  EXPECT_EQ(direct.result.preconditioner, Preconditioner::direct);
  EXPECT_LE(direct.result.iterations.pcg, plain.result.iterations.pcg);
  EXPECT_LE(norm(top_of(direct) - top_of(plain)), 1e-6 * norm(top_of(plain)));
}

/// A block of quadratic covers on a turned lattice, pulled at one point: blocks pass their limit in steps in which inertia outweighs stiffness.
Rock pulled_block() {
  Lattice lattice =
      reference::turned_lattice({0.11, -0.23, 0.37}, 0.8, 0.4, 0.3, {0.5, 0.4, 0.75}, 1.2);
  lattice.kind = LatticeKind::hex8;
  reference::CoveredRegions made =
      reference::cover_regions(lattice, {reference::box({0, 0, 0}, {1, 0.8, 1.5})});
  made.arrays.order = 2;
  return Rock(std::move(made));
}

TEST(Factors, BeginTheSolvesAfterAFallbackInAResumedMotionToo) {
  const Rock rock = pulled_block();
  MotionSetup setup = rock.setup();
  setup.loads = forces_at(rock, {{0.5, 0.4, 1.4}}, {{1e4, 0, 0}});
  setup.large = true;
  setup.direct = [] { return host::make_direct_solver(); };
  const Real dt = 3e-4;
  Motion first(setup);
  ASSERT_TRUE(first.start(dt).converged);
  const SolveReport fell_back = first.step(dt);
  ASSERT_TRUE(fell_back.converged);
  ASSERT_GT(fell_back.fallbacks, 0);
  Motion second(setup);
  second.restore(first.bytes());
  const SolveReport on = first.step(dt), resumed = second.step(dt);
  EXPECT_EQ(on.fallbacks, 0);
  EXPECT_EQ(on.preconditioner, Preconditioner::direct);
  EXPECT_LT(on.iterations, fell_back.iterations / 10);
  EXPECT_EQ(resumed.iterations, on.iterations);
  EXPECT_EQ(second.bytes(), first.bytes());
}

/// Dashpots stiff beside the rock in a step: what the preconditioner does not know of them, iterations pay for.
TEST(Dashpots, AreInTheFactorsAndOnTheLevels) {
  for (const Preconditioner by : {Preconditioner::direct, Preconditioner::multigrid}) {
    Rock rock = whole_box({12, 8, 8}, 0.5);
    rock.hold([](const Vec3& x) { return x[0] < 1e-9; }, 1e9, false);
    MotionSetup setup = rock.setup();
    setup.gravity = {0, 0, -9.81};
    setup.preconditioner = by;
    setup.direct = [] { return host::make_direct_solver(); };
    std::vector<Vec3> places;
    for (Real y = 0.25; y < 4; y += 0.5)
      for (Real z = 0.25; z < 4; z += 0.5) places.push_back({6, y, z});
    const Vec3 normal = normalized(Vec3{3, 1, 2});
    Index iterations[2];
    for (const bool damped : {false, true}) {
      if (damped)
        setup.quiet = {reference::locate(rock.covered, places),
                       std::vector<Vec3>(places.size(), normal),
                       std::vector<Real>(places.size(), by == Preconditioner::direct ? 1e11 : 1e7),
                       std::vector<Real>(places.size(), by == Preconditioner::direct ? 3e10 : 3e6)};
      Motion motion(setup);
      ASSERT_TRUE(motion.start(0.1).converged);
      const SolveReport report = motion.step(0.1);
      ASSERT_TRUE(report.converged);
      iterations[damped] = report.iterations;
    }
    EXPECT_LE(iterations[1], by == Preconditioner::direct ? iterations[0] + 1 : 2 * iterations[0]);
  }
}

}  // namespace
}  // namespace rockfold
