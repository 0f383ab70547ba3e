// Points on corners of rock that misses lattice planes by next to nothing: what holds or loads them does not hang on slivers.
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "src/base/vector.hpp"
#include "tests/run/run_model.hpp"

namespace rockfold {
namespace {

struct Case {
  const char* lattice;
  int order;
  const char* kinematics;
  const char* method;
};

std::string name_of(const testing::TestParamInfo<Case>& info) {
  const Case& c = info.param;
  return fmt::format("{}_order{}_{}_{}", c.lattice, c.order, c.kinematics, c.method);
}

/// A block of 3 m × 2 m × 1 m under its weight, on three of its corners; a fourth is pulled down. All its faces lie `miss` beyond
/// lattice planes.
std::string block_on_corners(const Case& c, Real miss) {
  return fmt::format(R"(
gravity = [0, 0, -10]
[[material]]
density = 2000
young_modulus = 1e9
poisson_ratio = 0.25
[[solid]]
name = "r"
shape = "box"
min = [{0:.17g}, {0:.17g}, {0:.17g}]
max = [{1:.17g}, {2:.17g}, {3:.17g}]
[cover]
lattice = "{4}"
order = {5}
spacing = 1
origin = [0, 0, 0]
[[fixed]]
where = {{point = [{0:.17g}, {0:.17g}, {0:.17g}]}}
method = "{6}"
[[fixed]]
where = {{point = [{1:.17g}, {0:.17g}, {0:.17g}]}}
components = ["y", "z"]
method = "{6}"
[[fixed]]
where = {{point = [{0:.17g}, {2:.17g}, {0:.17g}]}}
components = ["z"]
method = "{6}"
[[point_load]]
point = [{1:.17g}, {2:.17g}, {0:.17g}]
force = [0, 0, -1e4]
[analysis]
type = "static"
kinematics = "{7}"
[[monitor]]
point = [{1:.17g}, {2:.17g}, {3:.17g}]
[[monitor]]
point = [1.4, 0.9, 0.6]
)",
                     -miss, 3 + miss, 2 + miss, 1 + miss, c.lattice, c.order, c.method,
                     c.kinematics);
}

class CornerPoints : public testing::TestWithParam<Case> {};

TEST_P(CornerPoints, HoldAndLoadRockAsIfThereWereNoSlivers) {
  const ModelAnswer plain = run_model(block_on_corners(GetParam(), 0));
  for (const Real miss : {8e-3, 1e-4, 1e-6, 1e-8}) {
    const ModelAnswer answer = run_model(block_on_corners(GetParam(), miss));
    for (std::size_t m = 0; m < 2; ++m) {
      const Vec3 u = plain.result.monitors[m].displacement.back();
      EXPECT_LE(norm(answer.result.monitors[m].displacement.back() - u), 0.05 * norm(u))
          << "miss " << miss << ", monitor " << m;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Blocks, CornerPoints,
                         testing::Values(Case{"tet6", 0, "large", "penalty"},
                                         Case{"tet6", 1, "small", "augmented_lagrangian"},
                                         Case{"tet24", 1, "small", "penalty"},
                                         Case{"tet5", 1, "large", "augmented_lagrangian"},
                                         Case{"hex8", 1, "large", "penalty"},
                                         Case{"hex8", 2, "small", "augmented_lagrangian"}),
                         name_of);

}  // namespace
}  // namespace rockfold
