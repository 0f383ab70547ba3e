#include "host/stability/spring_mass.hpp"

#include <numeric>

#include <gtest/gtest.h>

#include "tests/stability/planar_mass.hpp"

namespace rockfold {
namespace {

using test::block_on_plane;
using test::degree;

constexpr Real steady = 1e-6;

SpringMass::State settled(const RigidMass& mass, Real factor) {
  const ScaledMass scaled(mass);
  SpringMass springs(scaled);
  return springs.settle(1 / factor, springs.start(), steady);
}

Real own_factor(const RigidMass& mass, const SpringMass::State& state) {
  const ScaledMass scaled(mass);
  return SpringMass(scaled).factor(state);
}

TEST(SpringMass, PressureOfABlockThatStandsIsItsWeightAcrossThePlane) {
  const SpringMass::State state = settled(block_on_plane(30 * degree, 0.7), 1);
  EXPECT_EQ(state.ending, Ending::stands);
  const Real sum = std::accumulate(state.pressure.begin(), state.pressure.end(), 0.0);
  EXPECT_NEAR(sum, std::cos(30 * degree), 1e-5);
}

TEST(SpringMass, CreepsAboveTheFactorAtWhichABlockSlides) {
  for (const Real cohesion : {0.0, 5e3}) {
    const RigidMass mass = block_on_plane(30 * degree, 0.7, cohesion);
    const Real expected =
        0.7 / std::tan(30 * degree) + 4 * cohesion / (4 * 25e3 * std::sin(30 * degree));
    EXPECT_EQ(settled(mass, 0.99 * expected).ending, Ending::stands);
    for (const Real above : {1.02, 2.0, 20.0}) {
      const SpringMass::State creeping = settled(mass, above * expected);
      EXPECT_EQ(creeping.ending, Ending::creeps);
      EXPECT_NEAR(own_factor(mass, creeping), expected, 1e-5 * expected);
    }
  }
}

// It creeps as it falls in its first instant: at g sin β (1 − expected / F), here in parts of g, along the plane.
TEST(SpringMass, CreepsAsFastAsABlockBeginsToSlide) {
  const Real dip = 30 * degree, expected = 0.7 / std::tan(dip);
  const SpringMass::State creeping = settled(block_on_plane(dip, 0.7), 2 * expected);
  EXPECT_NEAR(creeping.velocity[0], std::sin(dip) * 0.5 * std::cos(dip), 1e-5);
  EXPECT_NEAR(creeping.velocity[2], -std::sin(dip) * 0.5 * std::sin(dip), 1e-5);
}

TEST(SpringMass, AWedgeBetweenTwoWallsNeedsNoRoomToSlip) {
  // Walls that touch the sides of a block do not hold it by friction where nothing presses it against them; slips that dilate would.
  RigidMass mass = block_on_plane(30 * degree, 0.7);
  ContactArea side;
  side.friction = 0.7;
  side.joint = "side";
  const std::vector<Vec3> base = mass.contacts[0].corner;
  const Vec3 up = mass.contacts[0].normal;
  for (const Real y : {0.0, 1.0}) {
    side.body = {0, none};
    side.normal = {0, y == 0 ? 1.0 : -1.0, 0};
    const Vec3 a{base[0][0], y, base[0][2]}, b{base[1][0], y, base[1][2]};
    side.corner = {a, b, b + up, a + up};
    mass.contacts.push_back(side);
  }
  const Real expected = 0.7 / std::tan(30 * degree);
  EXPECT_EQ(settled(mass, 0.99 * expected).ending, Ending::stands);
  const SpringMass::State creeping = settled(mass, 1.02 * expected);
  EXPECT_EQ(creeping.ending, Ending::creeps);
  EXPECT_NEAR(own_factor(mass, creeping), expected, 1e-3 * expected);
}

}  // namespace
}  // namespace rockfold
