// Motion under large kinematics: what the energy–momentum scheme promises, and statics far from where it began.
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "kernels/constraints/cover_system.hpp"
#include "kernels/finite/strained_body.hpp"
#include "src/base/vector.hpp"
#include "tests/time/rock.hpp"

namespace rockfold {
namespace {

/// Velocity v + ω × (x − c) of all nodes.
StateArrays thrown(const CoverArrays& covers, const Vec3& velocity, const Vec3& spin,
                   const Vec3& centre) {
  StateArrays state;
  state.displacement.assign(covers.unknown_count(), Vec3{});
  state.velocity = reference::sample_at_nodes(
      covers, [&](const Vec3& x) { return velocity + cross(spin, x - centre); });
  return state;
}

/// ∫ρ v and ∫ρ (x + u) × v, from the mass matrix.
struct Momenta {
  Vec3 linear{}, angular{};
};
Momenta momenta(const Rock& rock, const StateArrays& state) {
  const CoverSystem system(rock.covers(), rock.moments, rock.materials);
  const std::vector<Vec3> p = system.apply({0, 1, 0}, state.velocity);
  Momenta sum;
  for (Index i = 0; i < rock.covers().cover_count(); ++i) {
    sum.linear += p[i];
    sum.angular += cross(rock.covers().lattice.node_position(rock.covers().cover_node[i]), p[i]);
  }
  for (std::size_t i = 0; i < p.size(); ++i) sum.angular += cross(state.displacement[i], p[i]);
  return sum;
}

TEST(LargeMotion, OfAThrownAndSpinningBlockKeepsMomentaAndEnergy) {
  Rock rock = turned_box({0, 0, 0}, {0.5, 0.7, 0.9}, 0.4);
  MotionSetup setup = rock.setup();
  setup.large = true;
  setup.solver.tolerance = 1e-13;
  Motion motion(setup);
  motion.set_motion(thrown(rock.covers(), {3, -1, 2}, {5, 30, -12}, {0.25, 0.35, 0.45}));
  const Momenta before = momenta(rock, motion.state());
  const Energy start = motion.energy();
  const Real dt = 2e-3;
  ASSERT_TRUE(motion.start(dt).converged);
  for (int i = 0; i < 100; ++i) ASSERT_TRUE(motion.step(dt).converged);  // a turn
  const Momenta after = momenta(rock, motion.state());
  const Energy end = motion.energy();
  for (int d = 0; d < 3; ++d) {
    EXPECT_NEAR((after.linear[d] - before.linear[d]) / norm(before.linear), 0, 1e-10);
    EXPECT_NEAR((after.angular[d] - before.angular[d]) / norm(before.angular), 0, 1e-10);
  }
  EXPECT_NEAR((end.kinetic + end.strain) / (start.kinetic + start.strain), 1, 1e-10);
  EXPECT_GT(end.strain, 0);
}

struct TurnedLattice {
  LatticeKind kind;
  int order, steps;
  std::string name;
};
void PrintTo(const TurnedLattice& at, std::ostream* out) {
  *out << at.name;
}
class LongMotionInATurnedLattice : public testing::TestWithParam<TurnedLattice> {};

/// Soft rock that turns 3.6 degrees a step: strains vary within elements, and corners of elements hold little rock.
TEST_P(LongMotionInATurnedLattice, KeepsMomentumAndEnergy) {
  Lattice lattice =
      reference::turned_lattice({0.11, -0.23, 0.37}, 0.53, 0.7, 0.4, {0.5, 0.5, 0.5}, 0.9);
  lattice.kind = GetParam().kind;
  auto made = reference::cover_regions(lattice, {reference::box({0, 0, 0}, {1, 1, 1})});
  made.arrays.order = GetParam().order;
  Rock rock(std::move(made));
  rock.materials = {{2500, 1e7, 0.25}};
  MotionSetup setup = rock.setup();
  setup.large = true;
  setup.solver.tolerance = 1e-10;
  Motion motion(setup);
  motion.set_motion(thrown(rock.covers(), {1, 2, -3}, {1, 4, -5}, {0.5, 0.5, 0.5}));
  const Momenta before = momenta(rock, motion.state());
  const Real energy = motion.energy().kinetic, dt = 0.01;
  ASSERT_TRUE(motion.start(dt).converged);
  for (int i = 0; i < GetParam().steps; ++i) ASSERT_TRUE(motion.step(dt).converged) << i;
  const Energy end = motion.energy();
  EXPECT_NEAR((end.kinetic + end.strain) / energy, 1, 1e-9);
  EXPECT_GT(end.strain / energy, 1e-6);
  const Momenta after = momenta(rock, motion.state());
  EXPECT_LT(norm(after.linear - before.linear) / norm(before.linear), 1e-9);
  EXPECT_LT(norm(after.angular - before.angular) / norm(before.angular), 1e-9);
}

INSTANTIATE_TEST_SUITE_P(All, LongMotionInATurnedLattice,
                         testing::Values(TurnedLattice{LatticeKind::tet5, 1, 5, "tet5_linear"},
                                         TurnedLattice{LatticeKind::tet6, 2, 2, "tet6_quadratic"},
                                         TurnedLattice{LatticeKind::hex8, 0, 5, "hex8_constant"},
                                         TurnedLattice{LatticeKind::hex8, 1, 2, "hex8_linear"},
                                         TurnedLattice{LatticeKind::hex8, 2, 1, "hex8_quadratic"}),
                         [](const auto& of) { return of.param.name; });

TEST(LargeMotion, TurnsABlockTenTimesWithoutGrowth) {
  Rock rock = turned_box({0, 0, 0}, {0.5, 0.5, 0.5}, 0.3);
  rock.materials = {{2000, 1e10, 0.25}};
  MotionSetup setup = rock.setup();
  setup.large = true;
  Motion motion(setup);
  const Real spin =
      2 * std::acos(-1.0) / 100;  // so slowly that it is not stretched: ρω²l²/3K = 2e-11
  motion.set_motion(thrown(rock.covers(), {}, {0, 0, spin}, {0.25, 0.25, 0.25}));
  const Real dt = 2;
  ASSERT_TRUE(motion.start(dt).converged);
  const Real energy = motion.energy().kinetic;
  for (int i = 0; i < 500; ++i) ASSERT_TRUE(motion.step(dt).converged);
  const Energy end = motion.energy();
  EXPECT_LT(end.strain / energy, 1e-10);
  EXPECT_NEAR((end.kinetic + end.strain) / energy, 1,
              1e-4);  // forces of 1e10 Pa round to 1e-5 of its inertia
  const TrackedPoints corners = rock.track({{0, 0, 0}, {0.5, 0, 0}, {0, 0.5, 0}, {0, 0, 0.5}});
  const auto u = motion.at(corners).displacement;
  const Vec3 o = u[0], a = u[1] - o + Vec3{0.5, 0, 0}, b = u[2] - o + Vec3{0, 0.5, 0},
             c = u[3] - o + Vec3{0, 0, 0.5};
  EXPECT_NEAR(dot(a, cross(b, c)) / 0.125, 1, 1e-10);
}

TEST(LargeMotion, OfSmallAmplitudeIsThatOfSmallStrain) {
  Rock rock = turned_box({0, 0, 0}, {2, 0.5, 0.5}, 0.4);
  rock.hold([](const Vec3& x) { return x[0] < 1e-9; }, 1e9, false);
  MotionSetup setup = rock.setup();
  setup.gravity = {0, 0, -1e-3};
  auto tip = [&](bool large) {
    setup.large = large;
    Motion motion(setup);
    EXPECT_TRUE(motion.start(1e-3).converged);
    for (int i = 0; i < 20; ++i) EXPECT_TRUE(motion.step(1e-3).converged);
    return motion.at(rock.track({{2, 0.25, 0.25}}));
  };
  const auto large = tip(true), small = tip(false);
  EXPECT_NEAR(large.displacement[0][2] / small.displacement[0][2], 1, 1e-5);
  EXPECT_NEAR(large.velocity[0][2] / small.velocity[0][2], 1, 1e-4);
}

TEST(LargeMotion, AugmentedSupportsHoldInStaticsAndInMotion) {
  for (const bool augmented : {true, false}) {
    Rock rock = whole_box({4, 1, 1}, 0.5);
    rock.hold([](const Vec3& x) { return x[0] < 1e-9; }, 1e10, augmented);
    MotionSetup setup = rock.setup();
    setup.gravity = {0, 0, -2000};
    setup.large = true;
    Motion motion(setup);
    const SolveReport report = motion.solve_static();
    EXPECT_TRUE(report.converged);
    const TrackedPoints points = rock.track({{0, 0, 0}, {2, 0.25, 0.25}});
    const PointMotion at = motion.at(points);
    EXPECT_NEAR(norm(at.displacement[0]), 0, augmented ? 1e-10 : 1e-3);
    EXPECT_LT(at.displacement[1][2], -0.05);
    EXPECT_LT(at.displacement[1][0], 0);  // the tip comes nearer: large rotation
    Vec3 sum{};
    for (const Vec3& r : motion.reactions()) sum += r;
    EXPECT_NEAR(sum[2] / (2000 * 2000 * 0.5), 1, 1e-6);
    EXPECT_NEAR(sum[0] / (2000 * 2000 * 0.5), 0, 1e-6);
  }
}

TEST(LargeMotion, ToEquilibriumByQuasiStaticStepsIsStatic) {
  Rock rock = whole_box({4, 1, 1}, 0.5);
  rock.hold([](const Vec3& x) { return x[0] < 1e-9; }, 1e10, false);
  MotionSetup setup = rock.setup();
  setup.gravity = {0, 0, -2000};
  setup.large = true;
  Motion at_once(setup);
  ASSERT_TRUE(at_once.solve_static().converged);
  setup.dynamic_ratio = 0;
  Motion in_steps(setup);
  ASSERT_TRUE(in_steps.start(1).converged);
  for (int i = 0; i < 60; ++i) ASSERT_TRUE(in_steps.step(1).converged);
  const TrackedPoints tip = rock.track({{2, 0.25, 0.25}});
  const Vec3 a = at_once.at(tip).displacement[0], b = in_steps.at(tip).displacement[0];
  for (int d = 0; d < 3; ++d) EXPECT_NEAR((a[d] - b[d]) / norm(a), 0, 1e-6);
}

TEST(LargeMotion, LosesEnergyToRayleighDampingAsItSays) {
  Rock rock = turned_box({0, 0, 0}, {0.5, 0.7, 0.9}, 0.4);
  MotionSetup setup = rock.setup();
  setup.large = true;
  setup.damping = {0.5, 1e-4};
  setup.solver.tolerance = 1e-12;
  Motion motion(setup);
  motion.set_motion(thrown(rock.covers(), {0, 0, 0}, {5, 30, -12}, {0.25, 0.35, 0.45}));
  ASSERT_TRUE(motion.start(2e-3).converged);
  for (int i = 0; i < 50; ++i) ASSERT_TRUE(motion.step(2e-3).converged);
  const Energy end = motion.energy();
  EXPECT_GT(end.damping, 0.05 * end.kinetic);
  EXPECT_NEAR(end.numerical / end.damping, 0, 1e-6);
}

/// A bar of whole cells held at one end and pressed at the other, turned by a right angle: the force has turned too.
TEST(LargeMotion, PressuresFollowTheirFaces) {
  const auto turn = [](const Vec3& x) { return Vec3{-x[0] - x[2], 0, x[0] - x[2]}; };  // about y
  Rock rock = whole_box({4, 1, 1}, 0.5);
  rock.hold([](const Vec3& x) { return x[0] < 1e-9; }, 1e10, true, turn);
  MotionSetup setup = rock.setup();
  setup.large = true;
  LoadPoints& loads = setup.loads;
  const std::vector<Vec3> corners{{2, 0, 0}, {2, 0.5, 0}, {2, 0, 0.5}, {2, 0.5, 0.5}};
  loads.points = reference::locate(rock.covered, corners);
  loads.force.assign(4, {});
  loads.table.assign(4, none);
  loads.scale.assign(4, 0);
  loads.area.assign(4, {0.0625, 0, 0});
  loads.pressure.assign(4, 1e6);
  setup.dynamic_ratio = 0;
  Motion motion(setup);
  StateArrays turned;
  turned.displacement = reference::sample_at_nodes(rock.covers(), turn);
  turned.velocity.assign(turned.displacement.size(), Vec3{});
  motion.set_motion(turned);
  ASSERT_TRUE(motion.start(1).converged);
  for (int i = 0; i < 40; ++i) ASSERT_TRUE(motion.step(1).converged);
  Vec3 sum{};
  for (const Vec3& r : motion.reactions()) sum += r;
  // The pressed area grows by Poisson's ratio, and the coarse split bends the bar a little.
  EXPECT_NEAR(sum[2] / 0.25e6, 1, 0.01);
  EXPECT_NEAR(sum[0] / 0.25e6, 0, 0.01);
  EXPECT_NEAR(sum[1] / 0.25e6, 0, 0.01);
}

}  // namespace
}  // namespace rockfold
