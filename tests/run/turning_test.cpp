// Plates that spin on a plane: uniform pressure brakes them by μ m g · the mean distance from the axis.
#include <cmath>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include "src/base/vector.hpp"
#include "tests/run/run_model.hpp"

namespace rockfold {
namespace {

constexpr Real gravity = 9.81, friction = 0.3, spin = 3;

/// On a floor, spinning about the z axis.
std::string spinning(const std::string& plate, const std::string& scheme, Real dt, Real end) {
  return "gravity = [0, 0, -9.81]\n[[material]]\ndensity = 2600\nyoung_modulus = 1e10\n"
         "poisson_ratio = 0.25\n[[joint_material]]\nname = 'f'\nfriction_angle = " +
         std::to_string(std::atan(friction) * 180 / std::numbers::pi) +
         "\n[[solid]]\nname = 'floor'\nshape = 'box'\nmin = [-2, -2, -0.5]\nmax = [2, 2, 0]\n"
         "[[solid]]\nname = 'plate'\ninterface = 'f'\n" +
         plate +
         "[cover]\nlattice = 'block'\n[[fixed]]\nwhere = {block_at = [1.9, 1.9, -0.25]}\n"
         "[[initial_velocity]]\nwhere = {block_at = [0, 0, 0.02]}\nangular_velocity = [0, 0, " +
         std::to_string(spin) +
         "]\n[[monitor]]\nname = 'rim'\npoint = [0.45, 0, 0.02]\n"
         "[analysis]\ntype = 'dynamic'\nkinematics = 'large'\nscheme = '" +
         scheme + "'\ntime_step = " + std::to_string(dt) + "\nend_time = " + std::to_string(end) +
         "\n";
}

/// Of the point on the x axis at 0.45 m; less than half a turn.
Real angle(const RunResult& run) {
  const Vec3 u = run.monitors[0].displacement.back();
  return std::atan2(u[1], 0.45 + u[0]);
}

struct Plate {
  std::string name, solid;
  Real arm;      ///< m, mean distance from the axis
  Real inertia;  ///< m², over the mass
};

/// 1 m across.
Plate square() {
  return {"square", "shape = 'box'\nmin = [-0.5, -0.5, 0]\nmax = [0.5, 0.5, 0.05]\n",
          (std::sqrt(2.0) + std::log(1 + std::sqrt(2.0))) / 6, 1.0 / 6};
}
/// A polygon of 24 sides in a circle of 0.5 m: with α = π/24 half of a side's angle, a/r = (1 + cos²α ln tan(π/4 + α/2)/ sin α)/3,
/// I/m r² = (1 + 2 cos²α)/6.
Plate disc() {
  const Real a = std::numbers::pi / 24, c = std::cos(a), r = 0.5;
  return {"disc",
          "shape = 'cylinder'\naxis = [[0, 0, 0], [0, 0, 0.05]]\nradius = 0.5\nsides = 24\n",
          r / 3 * (1 + c * c / std::sin(a) * std::log(std::tan(std::numbers::pi / 4 + a / 2))),
          r * r * (1 + 2 * c * c) / 6};
}

void expect_stops(const Plate& plate, const std::string& scheme) {
  SCOPED_TRACE(plate.name + " " + scheme);
  const Real slowing = friction * gravity * plate.arm / plate.inertia;  // rad/s²
  const ModelAnswer answer = run_model(spinning(plate.solid, scheme, 0.005, 1.3 * spin / slowing));
  EXPECT_NEAR(angle(answer.result) / (spin * spin / (2 * slowing)), 1, 0.02);
  EXPECT_LT(norm(answer.result.monitors[0].velocity.back()), 1e-3);
}

TEST(SpinningPlate, StopsByTheTorqueOfAUniformPressure) {
  expect_stops(square(), "implicit");
  expect_stops(square(), "explicit");
}

TEST(SpinningPlate, RoundStopsByTheTorqueOfAUniformPressure) {
  expect_stops(disc(), "explicit");
}

}  // namespace
}  // namespace rockfold
