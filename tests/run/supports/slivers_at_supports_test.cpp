// Fixed faces and planes beside lattice planes: slivers of rock between the two change nothing.
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/run/run_model.hpp"

namespace rockfold {
namespace {

/// Corner k of the part of a box that ends a hundredth before its free faces.
Vec3 measured_at(const Vec3& low, const Vec3& high, int k) {
  Vec3 x = low;
  for (int d = 0; d < 3; ++d)
    if ((k >> d & 1) != 0) x[d] += 0.99 * (high[d] - low[d]);
  return x;
}

/// A box of about 1 m with rollers on three sides and a pressure of 1e-3 Young's moduli on the top.
std::string pressed_box(const Vec3& low, const Vec3& high, const std::string& method,
                        const std::string& cover) {
  std::string text = fmt::format(R"(
gravity = [0, 0, 0]
[[material]]
density = 1000
young_modulus = 1e9
poisson_ratio = 0.25
[[solid]]
name = "r"
shape = "box"
min = [{:.17g}, {:.17g}, {:.17g}]
max = [{:.17g}, {:.17g}, {:.17g}]
[[traction]]
where = {{face = "r.zmax"}}
value = [0, 0, -1e6]
[solver]
tolerance = 1e-9
[analysis]
type = "static"
[cover]
{}
)",
                                 low[0], low[1], low[2], high[0], high[1], high[2], cover);
  for (const char axis : {'x', 'y', 'z'})
    text +=
        fmt::format("[[fixed]]\nwhere = {{face = 'r.{}min'}}\ncomponents = ['{}']\nmethod = '{}'\n",
                    axis, axis, method);
  for (int k = 0; k < 8; ++k) {
    const Vec3 x = measured_at(low, high, k);
    text += fmt::format("[[monitor]]\npoint = [{:.17g}, {:.17g}, {:.17g}]\n", x[0], x[1], x[2]);
  }
  return text;
}

/// Uniaxial pressure: its displacement at points of the held faces and inside the box, within `tolerance` of its largest. At the
/// free corners, specks of 1e-8 m, it is as near as the solver's tolerance leaves them: 3e-7.
void expect_uniform_strain(const std::string& text, const Vec3& low, const Vec3& high,
                           Real tolerance) {
  const ModelAnswer answer = run_model(text);
  EXPECT_LE(answer.result.support_gap, 1e-9);
  const Vec3 strain{2.5e-4, 2.5e-4, -1e-3};
  const auto& monitors = answer.result.monitors;
  ASSERT_EQ(monitors.size(), 8u);
  for (int k = 0; k < 8; ++k)
    for (int d = 0; d < 3; ++d)
      EXPECT_NEAR(monitors[k].displacement.back()[d],
                  strain[d] * (measured_at(low, high, k)[d] - low[d]), tolerance * 1e-3)
          << "point " << k << ", component " << d;
}

class LongSliversAtSupports : public testing::TestWithParam<std::tuple<const char*, int>> {};
INSTANTIATE_TEST_SUITE_P(EveryLattice, LongSliversAtSupports,
                         testing::Combine(testing::Values("tet5", "tet6", "hex8"),
                                          testing::Values(0, 1, 2)),
                         [](const auto& at) {
                           return fmt::format("{}{}", std::get<0>(at.param), std::get<1>(at.param));
                         });

TEST_P(LongSliversAtSupports, FacesAnyDistanceFromALatticePlaneAreHeld) {
  const auto [lattice, order] = GetParam();
  for (const Real d : {0.0, 1e-15, 1e-13, 1e-12, 1e-10, 3e-10, 1e-9, 1e-8, 1e-6, 1e-5, 1e-3})
    for (const char* method : {"augmented_lagrangian", "lagrange", "penalty"}) {
      SCOPED_TRACE(fmt::format("{} m off, {}", d, method));
      const Vec3 low{}, high{1 + d, 1 + d, 1 + d};
      expect_uniform_strain(
          pressed_box(low, high, method,
                      fmt::format("lattice = '{}'\norder = {}\nspacing = 0.5\norigin = "
                                  "[0, 0, {:.17g}]",
                                  lattice, order, -d)),
          low, high, std::string(method) == "penalty" ? 1e-3 : 1e-8);
    }
}

TEST_P(LongSliversAtSupports, BoxesInMapCoordinatesAreHeldOnALatticeFromTheirCorner) {
  // What rounding leaves of a face's place is 1e-11 to 1e-9 m there, and as much of a displacement at a point of it.
  const auto [lattice, order] = GetParam();
  for (const Real far : {1e5, 1e6, 5e6}) {
    SCOPED_TRACE(far);
    const Vec3 low{std::round(7.3 * far) / 10, std::round(6.1 * far + 3) / 10,
                   std::round(5.2 * far + 9) / 10},
        high{std::round(10 * low[0] + 9) / 10, std::round(10 * low[1] + 6) / 10,
             std::round(10 * low[2] + 9) / 10};
    expect_uniform_strain(
        pressed_box(low, high, "augmented_lagrangian",
                    fmt::format("lattice = '{}'\norder = {}\nspacing = 0.3\norigin = "
                                "[{:.17g}, {:.17g}, {:.17g}]",
                                lattice, order, low[0], low[1], low[2])),
        low, high, 1e-8 + 4e-15 * far);
  }
}

/// −Work of the loads of a block that a plane or box about z = 1, a lattice plane, holds; and how far the loaded part moves.
std::array<Real, 2> bent_block(const std::string& where, const std::string& method) {
  const ModelAnswer answer = run_model(fmt::format(R"(
gravity = [0, 0, 0]
[[material]]
density = 2500
young_modulus = 2e9
poisson_ratio = 0.3
[[solid]]
name = "r"
shape = "box"
min = [0, 0, 0]
max = [1.6, 1.2, 2]
[cover]
lattice = "tet6"
spacing = [0.43, 0.37, 0.5]
[[fixed]]
where = {}
method = "{}"
[[point_load]]
point = [1.5, 1.1, 1.9]
force = [1e4, 2e4, -5e4]
[[monitor]]
point = [0.8, 0.6, 1.7]
[analysis]
type = "static"
)",
                                                   where, method));
  const Vec3& u = answer.result.monitors[0].displacement.back();
  return {-answer.result.energy.potential, std::sqrt(u[0] * u[0] + u[1] * u[1] + u[2] * u[2])};
}

TEST(HeldRegions, HoldNoLessWhereTheyAreWiderAndTheSameByEachMethod) {
  const auto plane = [](Real half) {
    return fmt::format("{{plane = {{point = [0, 0, 1], normal = [0, 0, 1], tolerance = {}}}}}",
                       half);
  };
  const auto box = [](Real half) {
    return fmt::format("{{box = [[-1, -1, {}], [3, 3, {}]]}}", 1 - half, 1 + half);
  };
  for (const bool of_plane : {true, false}) {
    Real before = 1e30;
    const Real narrow = bent_block(of_plane ? plane(1e-6) : box(1e-6), "lagrange")[1];
    for (const Real half : {1e-6, 0.01, 0.03, 0.06, 0.1, 0.2, 0.3}) {
      SCOPED_TRACE(fmt::format("{} {}", of_plane ? "plane" : "box", half));
      const std::string where = of_plane ? plane(half) : box(half);
      const auto by_penalty = bent_block(where, "penalty"), exact = bent_block(where, "lagrange");
      EXPECT_LE(exact[0], before * (1 + 1e-6));
      before = exact[0];
      if (half > 0.1) continue;
      EXPECT_NEAR(by_penalty[0] / exact[0], 1, 2e-3);
      EXPECT_NEAR(by_penalty[1] / exact[1], 1, 5e-3);
      // A block 1 m high that is clamped 0.03 m higher moves 7.5 % less (linear covers, spacing 0.1 m).
      EXPECT_GT(exact[1], 0.9 * narrow);
    }
  }
}

}  // namespace
}  // namespace rockfold
