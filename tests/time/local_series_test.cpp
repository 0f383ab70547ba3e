// Motions of covers with a local series: displacement, stress, reactions and energy of a field that no polynomial holds.
#include <gtest/gtest.h>

#include "kernels/time/initial_stress.hpp"
#include "src/arrays/element_points.hpp"
#include "src/arrays/shape_functions.hpp"
#include "src/base/error.hpp"
#include "tests/reference/face_points.hpp"
#include "tests/solve/series.hpp"
#include "tests/time/rock.hpp"

namespace rockfold {
namespace {

const Vec3 low{0.05, 0.02, 0.03}, high{1.1, 0.95, 0.9};
const ElasticMaterial material{2000, 1e8, 0.25};
constexpr Real shear_modulus = 4e7;
constexpr HarmonicField field{2, 1e-4, 2e-4};
constexpr Real weight_density = -4 * shear_modulus * field.bend;  // N/m³

/// The box with a series beside covers of order 1, which hold the field; beside those of order 0 its harmonic part alone.
Rock loaded_box(int order = 1) {
  Rock rock = turned_box(low, high, 0.8);
  CoverArrays& covers = rock.covered.arrays;
  covers.order = order;
  covers.series = std::make_shared<HarmonicSeries>(field.rate, 14, -1e300, order > 0);
  rock.moments = piece_moments(covers);
  rock.materials = {material};
  rock.fixed = reference::fix(
      rock.covered, {{0.1, 0.1, 0.1}, {1.0, 0.1, 0.2}, {0.2, 0.9, 0.1}, {0.6, 0.5, 0.8}},
      [](const Vec3& x) { return field.at(x); }, 1e8, false);
  return rock;
}

LoadPoints tractions(const CoverArrays& covers, const HarmonicField& of) {
  LoadPoints loads;
  reference::for_each_face_point(covers, low, high, 9,
                                 [&](Index e, const Vec3& x, const Vec3& n, Real area) {
                                   add_material_point(covers, x, e, loads.points);
                                   loads.force.push_back(area * of.traction(material, x, n));
                                 });
  const std::size_t count = loads.force.size();
  loads.table.assign(count, none);
  loads.scale.assign(count, 1);
  loads.area.assign(count, {});
  loads.pressure.assign(count, 0);
  return loads;
}

TEST(LocalSeries, HasTheDisplacementStressReactionsAndEnergyOfAFieldThatItHolds) {
  const Rock rock = loaded_box();
  const CoverArrays& covers = rock.covers();
  MotionSetup setup = rock.setup();
  setup.gravity = {0, 0, weight_density / material.density};
  setup.loads = tractions(covers, field);
  Motion motion(setup);
  ASSERT_TRUE(motion.solve_static().converged);

  const std::vector<Vec3> points{{0.07, 0.9, 0.88}, {0.5, 0.5, 0.5}, {1.05, 0.03, 0.85}};
  const PointMotion at = motion.at(rock.track(points));
  for (std::size_t n = 0; n < points.size(); ++n) {
    const Vec3 u = field.at(points[n]), slope = field.slope(points[n]);
    EXPECT_LE(norm(at.displacement[n] - u), 1e-9 * norm(u));
    const Real expected[6] = {0, 0, 0, 0, shear_modulus * slope[1], shear_modulus * slope[0]};
    for (int k = 0; k < 6; ++k)
      EXPECT_NEAR(at.stress[n][k], expected[k], 1e-7 * shear_modulus * norm(slope)) << n << k;
  }

  // Means of elements and the whole energy, by points of their own. What the solve leaves is small in energy: slivers that hardly resist
  // are less well determined, as the root of their share of the volume.
  Real box = 1;
  for (int d = 0; d < 3; ++d) box *= high[d] - low[d];
  const ElementPoints rule(covers, 20);
  const auto stress = motion.element_stress();
  std::vector<RockPoint> in_element;
  Real energy = 0;
  for (Index e = 0; e < covers.element_count(); ++e) {
    in_element.clear();
    rule.add_element(e, in_element);
    Vec3 mean{};
    Real volume = 0, largest = 0;
    for (const RockPoint& p : in_element) {
      Vec3 x = covers.lattice.cell_centre(element_nodes(covers, e).cell);
      for (int d = 0; d < 3; ++d) x += p.eta[d] * covers.lattice.edge[d];
      const Vec3 slope = field.slope(x);
      volume += p.weight;
      mean += p.weight * slope;
      energy += 0.5 * shear_modulus * p.weight * dot(slope, slope);
      largest = std::max(largest, shear_modulus * norm(slope));
    }
    const Real tolerance = 1e-8 * largest * std::sqrt(box / volume);
    EXPECT_NEAR(stress[e][5], shear_modulus * mean[0] / volume, tolerance) << e << ' ' << volume;
    EXPECT_NEAR(stress[e][4], shear_modulus * mean[1] / volume, tolerance) << e << ' ' << volume;
    EXPECT_NEAR(stress[e][2], 0, tolerance) << e << ' ' << volume;
  }
  EXPECT_NEAR(motion.energy().strain / energy, 1, 1e-10);
  for (const Vec3& reaction : motion.reactions())
    EXPECT_LE(norm(reaction), 1e-7 * std::abs(weight_density) * box);
}

TEST(LocalSeries, FallsFreely) {
  Rock rock = loaded_box();
  rock.fixed = {};
  MotionSetup setup = rock.setup();
  setup.gravity = {0.3, 0, -10};
  Motion motion(setup);
  const Real dt = 0.01;
  ASSERT_TRUE(motion.start(dt).converged);
  for (int k = 0; k < 5; ++k) ASSERT_TRUE(motion.step(dt).converged);
  const Real t = motion.time();
  const PointMotion at = motion.at(rock.track({{0.5, 0.5, 0.5}, {1.05, 0.03, 0.85}}));
  for (const Vec3& u : at.displacement)
    EXPECT_LE(norm(u - (0.5 * t * t) * setup.gravity), 1e-9 * t * t);
  const Energy e = motion.energy();
  EXPECT_NEAR((e.kinetic + e.strain + e.potential) / e.kinetic, 0, 1e-9);
}

/// Swings about with all of its energy: average acceleration, no damping. Beside constants alone the functions are independent enough for
/// their mass matrix to be solved to ten digits; beside linear ones they nearly are not (docs/local_series.md).
TEST(LocalSeries, KeepsItsEnergyAsItSwings) {
  const Rock rock = loaded_box(0);
  MotionSetup setup = rock.setup();
  setup.gravity = {0, 3, -10};
  setup.solver.tolerance = 1e-10;
  Motion motion(setup);
  const Real dt = 5e-4;
  const SolveReport first = motion.start(dt);
  ASSERT_TRUE(first.converged) << first.residual << " after " << first.iterations;
  Real most = 0;
  for (int k = 0; k < 20; ++k) {
    const SolveReport report = motion.step(dt);
    ASSERT_TRUE(report.converged) << report.residual << " after " << report.iterations;
    const Energy e = motion.energy();
    most = std::max(most, e.kinetic);
    EXPECT_NEAR(e.numerical, 0, 1e-7 * most);
  }
  EXPECT_GT(most, 0);
}

TEST(LocalSeries, OfMonomialsIsPulledByInitialStressAsTheirOrder) {
  InitialStress stress;
  stress.at = {-1e5, -2e5, -3e5, 1e4, 2e4, 3e4};
  stress.gradient = {-1e4, -2e4, -3e4, 1e3, 2e3, 3e3};
  stress.reference_z = 0.4;
  stress.any = true;
  Rock rock = turned_box(low, high, 0.35);
  CoverArrays& covers = rock.covered.arrays;
  ASSERT_GT(covers.regular_count(), 0);
  covers.order = 1;
  const PieceMoments moments = piece_moments(covers);
  const auto expected = motion::initial_stress_force(covers, moments, stress);
  covers.order = 0;
  covers.series = std::make_shared<MonomialSeries>(covers.lattice, 0, 1);
  const auto found = motion::initial_stress_force(covers, moments, stress);
  EXPECT_LE(reference::largest_difference(expected, found), 1e-12 * reference::largest(expected));
}

/// So little deformed that large kinematics are small ones, but for the rule of degree 6 that holds the state of elements.
TEST(LocalSeries, HasTheSameFieldUnderLargeKinematics) {
  const HarmonicField slight{field.rate, 1e-9};
  Rock rock = loaded_box(0);
  rock.fixed = reference::fix(
      rock.covered, {{0.1, 0.1, 0.1}, {1.0, 0.1, 0.2}, {0.2, 0.9, 0.1}, {0.6, 0.5, 0.8}},
      [&](const Vec3& x) { return slight.at(x); }, 1e8, false);
  MotionSetup setup = rock.setup();
  setup.large = true;
  setup.solver.tolerance = 1e-9;
  setup.loads = tractions(rock.covers(), slight);
  Motion motion(setup);
  StateArrays state;
  state.displacement.resize(rock.covers().unknown_count());
  state.velocity.resize(state.displacement.size());
  state.acceleration.resize(state.displacement.size());
  motion.set_motion(state);
  ASSERT_TRUE(motion.solve_static().converged);
  const std::vector<Vec3> points{{0.07, 0.9, 0.88}, {0.5, 0.5, 0.5}, {1.05, 0.03, 0.85}};
  const PointMotion at = motion.at(rock.track(points));
  for (std::size_t n = 0; n < points.size(); ++n) {
    const Vec3 u = slight.at(points[n]), slope = slight.slope(points[n]);
    EXPECT_LE(norm(at.displacement[n] - u), 1e-4 * norm(u));
    EXPECT_NEAR(at.stress[n][5], shear_modulus * slope[0], 1e-3 * shear_modulus * norm(slope));
    EXPECT_NEAR(at.stress[n][4], shear_modulus * slope[1], 1e-3 * shear_modulus * norm(slope));
  }
}

/// Thrown and spinning: momentum and energy stay, volume too.
TEST(LocalSeries, SpinsFreelyUnderLargeKinematics) {
  Rock rock = loaded_box(0);
  rock.fixed = {};
  const CoverArrays& covers = rock.covers();
  MotionSetup setup = rock.setup();
  setup.large = true;
  setup.solver.tolerance = 1e-11;
  Motion motion(setup);
  StateArrays state;
  state.displacement.resize(covers.unknown_count());
  state.acceleration = state.velocity = state.displacement;
  const Vec3 turn{3, -2, 5}, middle{0.575, 0.485, 0.465};
  for (Index p = 0; p < covers.cover_count(); ++p)
    state.velocity[p] = cross(turn, covers.lattice.node_position(covers.cover_node[p]) - middle);
  motion.set_motion(state);
  const Real dt = 0.02;
  ASSERT_TRUE(motion.start(dt).converged);
  const Energy before = motion.energy();
  for (int k = 0; k < 25; ++k) ASSERT_TRUE(motion.step(dt).converged) << k;
  const Energy after = motion.energy();
  const Real total = before.kinetic + before.strain;
  EXPECT_NEAR((after.kinetic + after.strain) / total, 1, 1e-7);
  const auto at = motion.at(rock.track({middle}));
  EXPECT_LE(norm(at.displacement[0]), 1e-3);  // stretched a little by its spin, it stays in place
}

}  // namespace
}  // namespace rockfold
