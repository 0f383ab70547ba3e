// Boxes that hold rock which misses lattice planes by next to nothing: the same rows whatever the way of solving, and no more than the
// rock in the box.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "src/base/vector.hpp"
#include "tests/run/run_model.hpp"

namespace rockfold {
namespace {

/// A unit cube under little weight, its lattice a little off its corner.
std::string cube(const std::string& cover, const Vec3& origin, const std::string& fixed,
                 const std::string& analysis) {
  return fmt::format(R"(
gravity = [0.01, 0.02, -0.05]
[[material]]
density = 2600
young_modulus = 1e9
poisson_ratio = 0.25
[[solid]]
name = "r"
shape = "box"
min = [0, 0, 0]
max = [1, 1, 1]
[cover]
{}
origin = [{}, {}, {}]
[[fixed]]
{}
[analysis]
{}
[[monitor]]
point = [0.7, 0.6, 0.9]
)",
                     cover, origin[0], origin[1], origin[2], fixed, analysis);
}

Vec3 motion(const std::string& text) {
  return run_model(text).result.monitors[0].displacement.back();
}

constexpr const char* touching = "where = {box = [[-1, -1, -1], [2, 2, 0]]}";

TEST(BoxSupports, ThatTouchAFaceHoldItByEveryKindOfAnalysis) {
  const auto expect_as_face = [](const std::string& cover, const Vec3& origin) {
    const Vec3 u = motion(cube(cover, origin, "where = {face = 'r.zmin'}", "type = 'static'"));
    for (const char* analysis :
         {"type = 'static'", "type = 'static'\nkinematics = 'large'",
          "type = 'quasi_static'\nkinematics = 'small'\ntime_step = 1\nsteps = 4"})
      EXPECT_LE(norm(motion(cube(cover, origin, touching, analysis)) - u), 1e-4 * norm(u))
          << cover << analysis;
  };
  expect_as_face("lattice = 'tet5'\norder = 2\nspacing = 1", {1e-5, 1e-5, 1e-5});
  expect_as_face("lattice = 'tet6'\norder = 2\nspacing = 1", {4e-8, 4e-8, 4e-8});
  expect_as_face("lattice = 'tet6'\norder = 1\nspacing = 0.5", {-4e-4, -1e-3, -2e-6});
}

TEST(BoxSupports, HoldNoMoreByMultipliersThanByPenalty) {
  const auto expect_alike = [](const std::string& cover, const Vec3& origin, Real top) {
    const std::string where =
        fmt::format("where = {{box = [[-1, -1, -1], [2, 2, {}]]}}\nmethod = ", top);
    const Vec3 exact = motion(cube(cover, origin, where + "'lagrange'", "type = 'static'")),
               by_penalty = motion(cube(cover, origin, where + "'penalty'", "type = 'static'"));
    EXPECT_LE(norm(by_penalty - exact), 5e-3 * norm(exact)) << cover;
  };
  // Slivers below the face that the box holds, beside its edges and beyond them.
  expect_alike("lattice = 'tet6'\norder = 0\nspacing = 1", {-1e-8, 0, 3e-7}, 1e-4);
  expect_alike("lattice = 'tet6'\norder = 1\nspacing = 1", {1e-7, 6e-4, 6e-3}, 2e-2);
  expect_alike("lattice = 'tet6'\norder = 2\nspacing = 1", {6e-5, -3e-3, -1e-7}, 0.4);
}

TEST(BoxSupports, ThatEndInRockHoldAlikeByPenaltyAndMultipliers) {
  const auto expect_alike = [](const std::string& cover, const Vec3& origin, Real top,
                               Real tolerance) {
    const std::string where =
        fmt::format("where = {{box = [[-1, -1, -1], [2, 2, {}]]}}\nmethod = ", top);
    const Vec3 exact = motion(cube(cover, origin, where + "'lagrange'", "type = 'static'")),
               by_penalty = motion(cube(cover, origin, where + "'penalty'", "type = 'static'"));
    EXPECT_LE(norm(by_penalty - exact), tolerance * norm(exact)) << cover;
  };
  // Vertices of whose displacement little does not follow from that of others; parts of faces, small ones and beside whole elements.
  expect_alike("lattice = 'tet6'\norder = 1\nspacing = 0.811", {0.478, 0.02, 0.546}, 0.468, 0.03);
  expect_alike("lattice = 'tet6'\norder = 1\nspacing = 1.02", {0.741, 0.372, 0.457}, 0.247, 0.05);
  expect_alike("lattice = 'tet6'\norder = 0\nspacing = 0.397", {0.149, 0.247, 0.198}, 0.115, 0.01);
  expect_alike("lattice = 'tet5'\norder = 1\nspacing = 0.987", {0.781, 0.749, 0.589}, 0.467, 0.02);
}

TEST(BoxSupports, HoldThrownRockWithoutAGap) {
  for (const Vec3& origin : {Vec3{0, 5e-9, 2e-2}, Vec3{3e-5, 2e-3, -5e-9}}) {
    const RunResult result =
        run_model(cube("lattice = 'hex8'\norder = 0\nspacing = 0.3", origin,
                       "where = {box = [[-1, -1, -1], [2, 2, 0.1]]}\nmethod = 'lagrange'",
                       "type = 'dynamic'\nkinematics = 'small'\ntime_step = 3.5e-4\nsteps = 10\n"
                       "[[initial_velocity]]\nwhere = {all = true}\nvelocity = [0.1, 0.05, -0.02]"))
            .result;
    EXPECT_LE(result.support_gap, 1e-9);
    EXPECT_LE(result.energy.kinetic + result.energy.strain, 0.5 * 2600 * 0.0129);
  }
}

}  // namespace
}  // namespace rockfold
