// Plates and rods that are thin beside the lattice's spacing, clamped at their narrow face: on lattice nodes, off them, and beside them.
#include <cmath>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/run/run_model.hpp"

namespace rockfold {
namespace {

constexpr Real young_modulus = 1e9, length = 2, tip = 1e-4;

struct Cantilever {
  std::string lattice;
  int order = 1;
  std::string method = "augmented_lagrangian";
  Real width = 1, thickness = 0.02;
  Vec3 origin{};
  bool at_a_corner = false;  ///< a force there instead of a uniform pressure
};

/// How far the corners of the free end sink, of what a beam's end does: q L⁴ / (8 E I), or F L³ / (3 E I).
std::array<Real, 2> sinks(const Cantilever& c) {
  const Real inertia = c.width * std::pow(c.thickness, 3) / 12;
  const Real pressure = 8 * young_modulus * inertia * tip / std::pow(length, 4) / c.width;
  const Real force = 3 * young_modulus * inertia * tip / std::pow(length, 3);
  std::string text = fmt::format(R"(
gravity = [0, 0, 0]
[[material]]
density = 1000
young_modulus = {}
poisson_ratio = 0
[[solid]]
name = "r"
shape = "box"
min = [0, 0, 0]
max = [{}, {}, {}]
[cover]
lattice = "{}"
order = {}
spacing = 0.5
origin = [{:.17g}, {:.17g}, {:.17g}]
[[fixed]]
where = {{face = "r.xmin"}}
method = "{}"
[analysis]
type = "static"
)",
                                 young_modulus, length, c.width, c.thickness, c.lattice, c.order,
                                 c.origin[0], c.origin[1], c.origin[2], c.method);
  for (const Real y : {0.0, c.width})
    text += fmt::format("[[monitor]]\npoint = [{}, {}, {}]\n", length, y, c.thickness / 2);
  text += c.at_a_corner
              ? fmt::format("[[point_load]]\npoint = [{}, 0, {}]\nforce = [0, 0, {:.17g}]\n",
                            length, c.thickness / 2, -force)
              : fmt::format("[[traction]]\nwhere = {{face = 'r.zmax'}}\nvalue = [0, 0, {:.17g}]\n",
                            -pressure);
  const auto answer = run_model(text);
  const auto& monitors = answer.result.monitors;
  return {-monitors[0].displacement.back()[2] / tip, -monitors[1].displacement.back()[2] / tip};
}

class LongThinPlates : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(EveryLattice, LongThinPlates, testing::Values("tet5", "tet6", "hex8"),
                         [](const auto& at) { return std::string(at.param); });

/// Its origin's x and z: the narrow face runs through nodes or between them, the plate through the middle of cells, along lattice
/// planes, or 1e-6 m beyond one.
constexpr std::array<std::array<Real, 2>, 4> origins{{{0, -0.2}, {0, 0}, {0, 1e-6}, {0.13, 1e-6}}};

void expect_a_beam(const char* lattice, Real thickness, const std::array<Real, 2>& origin) {
  const auto& [x, z] = origin;
  for (const char* method : {"augmented_lagrangian", "penalty"})
    for (const int order : {1, 2}) {
      SCOPED_TRACE(
          fmt::format("{} m thick, {}, order {}, origin {} {}", thickness, method, order, x, z));
      const auto sink = sinks({lattice, order, method, 1, thickness, {x, 0, z}, false});
      // Covers of order 1 are quadratic within cells half a metre long; shear makes 0.2 % at 0.1 m, the penalty 0.1 %.
      for (const Real w : sink) EXPECT_NEAR(w, 1, order == 1 ? 0.05 : 0.005);
    }
}

/// Quadratic hexahedra of which 2 mm of 0.5 m lie in rock are solved to rounding alone: 88,000 iterations, minutes.
bool takes_minutes(std::string_view lattice, Real thickness, const std::array<Real, 2>& origin) {
  return lattice == "hex8" && thickness == 0.002 && origin == origins[3];
}

TEST_P(LongThinPlates, ClampedAtTheirNarrowFaceBendAsBeams) {
  for (const Real thickness : {0.1, 0.02, 0.002})
    for (const auto& origin : origins)
      if (!takes_minutes(GetParam(), thickness, origin))
        expect_a_beam(GetParam(), thickness, origin);
}

TEST(SlowThinPlates, OfHexahedraThatHardlyTouchThemBendAsBeams) {
  expect_a_beam("hex8", 0.002, origins[3]);
}

TEST_P(LongThinPlates, AreClampedAlongAllOfTheirNarrowFace) {
  // The shape that a force at a corner gives a thin plate does not depend on its thickness.
  for (const Real x : {0.0, 0.13}) {
    SCOPED_TRACE(x);
    const auto shape = [&](Real thickness) {
      return sinks({GetParam(), 2, "augmented_lagrangian", 1, thickness, {x, 0, -0.2}, true});
    };
    const auto thick = shape(0.02), thin = shape(0.002);
    EXPECT_GT(thick[0], thick[1] + 0.15);
    for (int k = 0; k < 2; ++k) EXPECT_NEAR(thin[k], thick[k], 3e-3);
  }
}

TEST_P(LongThinPlates, AsNarrowAsThickAreClampedToo) {
  for (const Real side : {0.05, 0.01})
    for (const Real x : {0.0, 0.13}) {
      SCOPED_TRACE(fmt::format("{} {}", side, x));
      const auto sink =
          sinks({GetParam(), 2, "augmented_lagrangian", side, side, {x, -0.2, -0.2}, false});
      for (const Real w : sink) EXPECT_NEAR(w, 1, 0.005);
    }
}

}  // namespace
}  // namespace rockfold
