#include "host/stability/spring_mass.hpp"

#include <numeric>

#include <gtest/gtest.h>

#include "tests/stability/planar_mass.hpp"

namespace rockfold {
namespace {

using test::degree;
using test::PlanarMass;
using test::Point2;

/// A flat block on a plane that dips by 30° towards +x.
RigidMass block_on_plane(Real friction, Real cohesion = 0) {
  const Real dip = 30 * degree;
  const auto at = [&](Real s, Real t) {
    return Point2{s * std::cos(dip) + t * std::sin(dip), -s * std::sin(dip) + t * std::cos(dip)};
  };
  PlanarMass planar;
  planar.add_block({at(0, 0), at(4, 0), at(4, 1), at(0, 1)});
  planar.add_contact(0, none, at(0, 0), at(4, 0), friction, cohesion);
  return planar.mass();
}

TEST(SpringMass, PressureOfABlockThatStandsIsItsWeightAcrossThePlane) {
  const RigidMass mass = block_on_plane(0.7);
  const ScaledMass scaled(mass);
  SpringMass springs(scaled);
  const SpringMass::State state = springs.settle(1, springs.start());
  EXPECT_TRUE(state.settled);
  EXPECT_TRUE(SpringMass::stands(state));
  const Real sum = std::accumulate(state.pressure.begin(), state.pressure.end(), 0.0);
  EXPECT_NEAR(sum, std::cos(30 * degree), 1e-5);
}

TEST(SpringMass, CreepsAboveTheFactorAtWhichABlockSlides) {
  for (const Real cohesion : {0.0, 5e3}) {
    const RigidMass mass = block_on_plane(0.7, cohesion);
    const ScaledMass scaled(mass);
    SpringMass springs(scaled);
    const Real expected =
        0.7 / std::tan(30 * degree) + 4 * cohesion / (4 * 25e3 * std::sin(30 * degree));
    EXPECT_TRUE(SpringMass::stands(springs.settle(1 / (0.99 * expected), springs.start())));
    const SpringMass::State creeping = springs.settle(1 / (1.02 * expected), springs.start());
    EXPECT_FALSE(SpringMass::stands(creeping));
    EXPECT_NEAR(springs.factor(creeping), expected, 1e-4 * expected);
  }
}

TEST(SpringMass, AWedgeBetweenTwoWallsNeedsNoRoomToSlip) {
  // Walls that touch the sides of a block do not hold it by friction where nothing presses it against them; slips that dilate would.
  RigidMass mass = block_on_plane(0.7);
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
  const ScaledMass scaled(mass);
  SpringMass springs(scaled);
  const Real expected = 0.7 / std::tan(30 * degree);
  EXPECT_TRUE(SpringMass::stands(springs.settle(1 / (0.99 * expected), springs.start())));
  const SpringMass::State creeping = springs.settle(1 / (1.02 * expected), springs.start());
  EXPECT_FALSE(SpringMass::stands(creeping));
  EXPECT_NEAR(springs.factor(creeping), expected, 1e-3 * expected);
}

}  // namespace
}  // namespace rockfold
