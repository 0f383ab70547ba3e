// Both kinematics are one where strains and rotations are next to nothing, on lattices beside the faces of rock too.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "src/base/vector.hpp"
#include "tests/run/run_model.hpp"

namespace rockfold {
namespace {

/// A unit cube on one face, strained by 1e-6; a plane through it is welded.
std::string strained_cube(const std::string& cover, const Vec3& normal, const Vec3& point,
                          const std::string& kinematics) {
  return fmt::format(R"(
gravity = [0, 0, 0]
[[material]]
density = 2000
young_modulus = 1e9
poisson_ratio = 0.3
[[solid]]
name = "r"
shape = "box"
min = [0, 0, 0]
max = [1, 1, 1]
[cover]
joints = "welded"
{}
[[joint]]
normal = [{}, {}, {}]
point = [{}, {}, {}]
[[joint_material]]
friction_angle = 10
[[fixed]]
where = {{face = "r.xmin"}}
method = "penalty"
[[traction]]
where = {{face = "r.zmax"}}
value = [1000, 0, -500]
[analysis]
type = "static"
kinematics = "{}"
[[monitor]]
point = [0.93, 0.81, 0.77]
[[monitor]]
point = [0.41, 0.33, 0.92]
)",
                     cover, normal[0], normal[1], normal[2], point[0], point[1], point[2],
                     kinematics);
}

void expect_alike(const std::string& cover, const Vec3& normal, const Vec3& point) {
  const ModelAnswer small = run_model(strained_cube(cover, normal, point, "small")),
                    large = run_model(strained_cube(cover, normal, point, "large"));
  EXPECT_NEAR(large.result.energy.strain, small.result.energy.strain,
              1e-4 * small.result.energy.strain)
      << cover;
  for (std::size_t m = 0; m < 2; ++m) {
    const Vec3 u = small.result.monitors[m].displacement.back();
    EXPECT_LE(norm(large.result.monitors[m].displacement.back() - u), 1e-4 * norm(u)) << cover;
  }
}

TEST(Kinematics, AreOneForTinyStrainsBesideSlivers) {
  const Vec3 across{-0.935, 0.481, -0.281}, amid{0.5, 0.5, 0.5};
  for (const char* lattice : {"tet6", "tet24"})
    for (const int order : {1, 2})
      for (const Real miss : {1e-11, 1e-5})
        expect_alike(
            fmt::format("lattice = '{}'\norder = {}\nspacing = 0.5\norigin = [{}, {}, {}]\n",
                        lattice, order, 0.77 * miss, -1.33 * miss, 1.62 * miss),
            across, amid);
}

}  // namespace
}  // namespace rockfold
