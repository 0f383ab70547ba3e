// A local series handed to the program: from a model with CoverSpec::series to all that a run answers.
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "src/base/vector.hpp"
#include "tests/run/run_model.hpp"
#include "tests/solve/series.hpp"

namespace rockfold {
namespace {

/// Two welded blocks with covers of their own on one floor; loads and conditions of every sort that enters by functions at points.
std::string model(int order, const std::string& origin, const std::string& kind,
                  const std::string& held) {
  return fmt::format(R"(
gravity = [0, 0, -10]
[[material]]
density = 2000
young_modulus = 1e8
poisson_ratio = 0.25
cohesion = 1e6
friction_angle = 30
[[solid]]
name = "left"
shape = "box"
min = [0, 0, 0]
max = [1, 1, 1.5]
[[solid]]
name = "right"
shape = "box"
min = [1.2, 0, 0]
max = [2, 1, 1.5]
[cover]
lattice = "tet6"
spacing = 0.5
origin = {}
order = {}
{}
[[traction]]
where = {{face = "left.zmax"}}
value = [1e4, 0, -2e4]
[[traction]]
where = {{face = "right.xmax"}}
pressure = 1e4
[[point_load]]
point = [0.43, 0.52, 1.2]
force = [0, 3e3, 0]
[[monitor]]
point = [0.31, 0.57, 1.13]
[[monitor]]
point = [1.9, 0.02, 0.7]
[analysis]
{}
[solver]
tolerance = 1e-12
)",
                     origin, order, held, kind);
}

const char* const on_floor =
    "[[fixed]]\nwhere = {face = 'left.zmin'}\n[[fixed]]\nwhere = {face = 'right.zmin'}\n";

/// A cubic lattice of the model's spacing.
std::shared_ptr<const LocalSeries> linear_monomials() {
  Lattice lattice;
  lattice.edge = {{{0.5, 0, 0}, {0, 0.5, 0}, {0, 0, 0.5}}};
  return std::make_shared<MonomialSeries>(lattice, 0, 1);
}

ModelAnswer run_with(const std::string& text, std::shared_ptr<const LocalSeries> series) {
  ModelAnswer answer;
  run_model(text, answer, [&](Model& of) { of.cover->series = std::move(series); });
  return answer;
}

void expect_near(const Vec3& found, const Vec3& expected, Real size, const char* what) {
  EXPECT_LE(norm(found - expected), size) << what;
}

/// All that the run hands back, within `share` of its size.
void expect_alike(const RunResult& a, const RunResult& b, Real share) {
  const Real moved = a.largest_displacement.length;
  EXPECT_NEAR(b.largest_displacement.length, moved, share * moved);
  ASSERT_EQ(a.blocks.size(), b.blocks.size());
  for (std::size_t k = 0; k < a.blocks.size(); ++k) {
    EXPECT_NEAR(a.blocks[k].volume, b.blocks[k].volume, 1e-4 * share);
    expect_near(b.blocks[k].displacement, a.blocks[k].displacement, share * moved, "displacement");
    expect_near(b.blocks[k].rotation, a.blocks[k].rotation, share * moved, "rotation");
    for (int c = 0; c < 6; ++c)
      EXPECT_NEAR(a.block_stress[k][c], b.block_stress[k][c], share * 5e4) << k << c;
  }
  for (std::size_t n = 0; n < a.monitors.size(); ++n) {
    expect_near(b.monitors[n].displacement.back(), a.monitors[n].displacement.back(), share * moved,
                "monitor");
    for (int c = 0; c < 6; ++c)
      EXPECT_NEAR(a.monitors[n].stress.back()[c], b.monitors[n].stress.back()[c], share * 5e4);
  }
  for (std::size_t k = 0; k < a.conditions.size(); ++k)
    expect_near(b.conditions[k].force, a.conditions[k].force, share * 5e4, "reaction");
  EXPECT_NEAR(b.energy.strain / a.energy.strain, 1, share);
  EXPECT_NEAR(b.strength.least_ratio / a.strength.least_ratio, 1, share);
}

/// Linear functions given as a series are order 1 to all of the program, on faces that run through lattice nodes and where single points are held.
TEST(LocalSeriesOfLinearFunctions, RunsAsOrderOne) {
  const std::string at_points =
      "[[fixed]]\nwhere = {point = [0.1, 0.1, 0.1]}\n[[fixed]]\nwhere = {point = [0.9, 0.1, 0.2]}\n"
      "[[fixed]]\nwhere = {point = [0.2, 0.9, 1.1]}\n[[fixed]]\nwhere = {point = [1.3, 0.1, 0.1]}\n"
      "[[fixed]]\nwhere = {point = [1.9, 0.1, 0.2]}\n[[fixed]]\nwhere = {point = [1.4, 0.9, "
      "1.1]}\n";
  for (const auto& [origin, held] : {std::pair<std::string, std::string>{"[0, 0, 0]", on_floor},
                                     {"[0.03, 0.02, 0.0371]", at_points}})
    for (const char* kind : {"type = 'static'",
                             "type = 'dynamic'\nkinematics = 'small'\n"
                             "time_step = 1e-3\nsteps = 5"}) {
      SCOPED_TRACE(origin + kind);
      const ModelAnswer expected = run_model(model(1, origin, kind, held)),
                        found = run_with(model(0, origin, kind, held), linear_monomials());
      expect_alike(expected.result, found.result, 1e-6);
    }
}

/// On a face through lattice nodes every function of a cover is held, polynomial or not: nothing moves anywhere on it.
TEST(LocalSeriesOfHarmonicFunctions, HoldAFaceThroughNodes) {
  std::string text = model(0, "[0, 0, 0]", "type = 'static'", on_floor);
  for (const char* point : {"[0.13, 0.37, 0]", "[0.61, 0.77, 0]", "[1.87, 0.21, 0]"})
    text += fmt::format("[[monitor]]\npoint = {}\n", point);
  const ModelAnswer found = run_with(text, std::make_shared<HarmonicSeries>(3));
  const auto& monitors = found.result.monitors;
  ASSERT_EQ(monitors.size(), 5u);
  const Real moved = norm(monitors[0].displacement.back());
  for (std::size_t n = 2; n < monitors.size(); ++n)
    EXPECT_LE(norm(monitors[n].displacement.back()), 1e-8 * moved) << n;
  // The functions are at work: the rock gives more than with constants alone.
  EXPECT_GT(moved, 1.05 * norm(run_model(text).result.monitors[0].displacement.back()));
}

/// Held on a face that cuts elements, whose rows are fewer than the functions: as near to order 1 as another set of rows may be.
TEST(LocalSeriesOfLinearFunctions, HoldAFaceThatCutsElements) {
  const std::string origin = "[0.03, 0.02, 0.0371]", kind = "type = 'static'";
  const ModelAnswer expected = run_model(model(1, origin, kind, on_floor)),
                    found = run_with(model(0, origin, kind, on_floor), linear_monomials());
  expect_near(found.result.monitors[0].displacement.back(),
              expected.result.monitors[0].displacement.back(),
              0.03 * expected.result.largest_displacement.length, "monitor");
  Vec3 total{};
  for (const Reaction& reaction : found.result.conditions) total += reaction.force;
  // Weights, the traction on the left and the pressure on the right, the point load.
  const Vec3 loads{1e4 - 1e4 * 1.5, 3e3, -2e4 - 2e4 * (1.5 + 0.8 * 1.5)};
  expect_near(total, -loads, 1e-6 * norm(loads), "reactions");
}

/// Strains of 1e-3 squared are what the rules of elements differ in.
TEST(LocalSeriesOfLinearFunctions, RunsAsOrderOneUnderLargeKinematics) {
  const std::string kind = "type = 'dynamic'\ntime_step = 1e-3\nsteps = 5";
  const ModelAnswer expected = run_model(model(1, "[0, 0, 0]", kind, on_floor)),
                    found = run_with(model(0, "[0, 0, 0]", kind, on_floor), linear_monomials());
  expect_alike(expected.result, found.result, 1e-5);
}

}  // namespace
}  // namespace rockfold
