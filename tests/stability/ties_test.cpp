// Bolts in the limit analysis of a mass.
#include <gtest/gtest.h>

#include "host/stability/sliding.hpp"
#include "host/stability/verify.hpp"
#include "src/base/vector.hpp"
#include "tests/stability/factors.hpp"
#include "tests/stability/planar_mass.hpp"

namespace rockfold {
namespace {

using test::bilinear_slope;
using test::block_on_plane;
using test::degree;
using test::Factors;
using test::factors_of;

constexpr Real dip = 40 * degree, weight = 4 * 25e3;  // of block_on_plane

/// Through the middle of the block, at this angle to its plane, down into the rock.
BoltTie bolt(const RigidMass& mass, Real angle, Real least, Real most) {
  const Vec3 up_slope{-std::cos(dip), 0, std::sin(dip)};
  const Vec3 axis = std::cos(angle) * up_slope - std::sin(angle) * mass.contacts[0].normal;
  return {{0, none}, mass.bodies[0].centre, axis, least, most, "bolt"};
}

/// What holds the block over what drives it along its plane, the joint's share of strength divided by the factor.
Real factor_with(Real tension, Real angle, Real friction) {
  const Real driving = weight * std::sin(dip) - tension * std::cos(angle);
  return friction * (weight * std::cos(dip) + tension * std::sin(angle)) / driving;
}

TEST(Ties, APassiveBoltPullsAsMuchAsItCanWhereTheBlockSlides) {
  for (const Real angle : {0 * degree, 30 * degree, 60 * degree}) {
    RigidMass mass = block_on_plane(dip, 0.5);
    const Real most = 0.2 * weight, expected = factor_with(most, angle, 0.5);
    mass.ties = {bolt(mass, angle, 0, most)};
    const Factors found = factors_of(mass);
    EXPECT_NEAR(found.sliding.factor, expected, 1e-3 * expected) << angle;
    EXPECT_GE(found.bound.above.factor, found.sliding.factor);
    EXPECT_NEAR(found.sliding.balance.tension[0], most, 1e-3 * most);
  }
}

// Across the plane it presses the block on it; a passive bolt there is not pulled.
TEST(Ties, AStressedBoltPressesTheBlockOnItsPlane) {
  RigidMass mass = block_on_plane(dip, 0.5);
  const Real tension = 0.5 * weight, expected = factor_with(tension, 90 * degree, 0.5);
  mass.ties = {bolt(mass, 90 * degree, tension, tension)};
  EXPECT_NEAR(factors_of(mass).sliding.factor, expected, 1e-3 * expected);
  mass.ties = {bolt(mass, 90 * degree, 0, tension)};
  const Real alone = factor_with(0, 0, 0.5);
  EXPECT_NEAR(factors_of(mass).sliding.factor, alone, 1e-3 * alone);
}

TEST(Ties, ABoltBetweenTwoBlocksThatGoTogetherHoldsNeither) {
  const RigidMass bare = bilinear_slope(std::tan(25 * degree));
  RigidMass mass = bare;
  mass.ties = {{{0, 1}, mass.bodies[0].centre, {-1, 0, 0}, 0, 100e3, "between"}};
  // The upper block moves down against the lower one, and towards it: the bolt is shortened.
  EXPECT_NEAR(factors_of(mass).sliding.factor, factors_of(bare).sliding.factor, 2e-3);
  mass.ties[0].body = {0, none};
  EXPECT_GT(factors_of(mass).sliding.factor, 1.01 * factors_of(bare).sliding.factor);
}

TEST(Ties, AreCheckedByTheVerifier) {
  RigidMass mass = block_on_plane(dip, 0.5);
  mass.ties = {bolt(mass, 0, 0, 0.2 * weight)};
  const Factors found = factors_of(mass);
  Certificate certificate{mass, found.bound.below, found.bound.above, found.sliding.balance,
                          found.sliding.mechanism};
  const auto refused = [&](auto spoil) {
    Certificate spoiled = certificate;
    spoil(spoiled);
    return !verify(spoiled).holds();
  };
  EXPECT_TRUE(refused([](Certificate& c) { c.below.tension[0] *= 1.5; }));
  EXPECT_TRUE(refused([](Certificate& c) { c.below.tension[0] *= 0.99; }));
  EXPECT_TRUE(refused([](Certificate& c) { c.below.tension.clear(); }));
  EXPECT_TRUE(refused([](Certificate& c) { c.mass.ties[0].most *= 0.9; }));
  EXPECT_TRUE(refused([](Certificate& c) { c.mass.ties[0].least = c.mass.ties[0].most * 2; }));
  EXPECT_TRUE(refused([](Certificate& c) { c.mass.ties[0].body = {none, none}; }));
  EXPECT_TRUE(refused([](Certificate& c) { c.mass.ties[0].body = {0, 7}; }));
  EXPECT_TRUE(refused([](Certificate& c) { c.mass.ties[0].axis = {0, 0, 2}; }));
  EXPECT_TRUE(refused([](Certificate& c) { c.mass.ties[0].most *= 2; }));  // then it takes up more
  EXPECT_TRUE(refused([](Certificate& c) { c.sliding_balance.tension[0] *= 0.5; }));
}

}  // namespace
}  // namespace rockfold
