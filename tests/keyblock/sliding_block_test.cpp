// Newmark's sliding block against closed forms: resultants that are constant for a time.
#include "host/keyblock/motions/sliding_block.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "src/base/vector.hpp"
#include "tests/keyblock/models/half_space_block.hpp"

namespace rockfold {
namespace {

using test::radians;
using test::upward;

constexpr Real mass = 2000, g = 9.81;
const Vec3 weight{0, 0, -mass* g};

/// A plane that the block lies on.
ContactPlane under(Real dip, Real dip_direction, Real friction_angle, Real cohesion = 0) {
  return {.normal = -upward(dip, dip_direction),
          .area = 1,
          .friction = std::tan(radians(friction_angle)),
          .cohesion = cohesion,
          .face = none};
}

PlaneStrength residual_of(const ContactPlane& plane) {
  return {plane.friction, 0};
}

SlidingBlock make_block(const std::vector<ContactPlane>& planes) {
  const auto movement = find_movement(planes, weight);
  std::array<PlaneStrength, 2> residual;
  for (int k = 0; k < 2 && movement->planes[k] != none; ++k)
    residual[k] = residual_of(planes[movement->planes[k]]);
  return {planes, *movement, residual, mass};
}

/// Under the ground's acceleration a, m/s², for so long; 0.1 ms a step.
void shake(SlidingBlock& block, const Vec3& a, Real time) {
  constexpr Real dt = 1e-4;
  for (int n = 0; n < std::lround(time / dt); ++n) block.go(weight - mass * a, dt);
}

/// m, that a block comes which gains `faster` for a time and loses `slower` after it, m/s².
Real pulse_way(Real faster, Real slower, Real time) {
  return 0.5 * faster * time * time * (1 + faster / slower);
}

/// Plane of dip α: driven by g sin α + a cos α, held by (g cos α − a sin α) tan φ, a the ground's acceleration into the slope.
TEST(SlidingBlock, ComesDownOnePlaneAsFarAsAPulseTakesIt) {
  const Real dip = radians(30), tan_phi = std::tan(radians(35));
  for (const Real a : {1.0, 2.5, 6.0}) {
    SCOPED_TRACE(a);
    SlidingBlock block = make_block({under(30, 90, 35)});
    const auto rate = [&](Real into) {
      return g * std::sin(dip) + into * std::cos(dip) -
             (g * std::cos(dip) - into * std::sin(dip)) * tan_phi;
    };
    shake(block, {-a, 0, 0}, 0.4);
    shake(block, {}, 5);
    const Real way = rate(a) > 0 ? pulse_way(rate(a), -rate(0), 0.4) : 0;
    EXPECT_NEAR(norm(block.displacement()), way, 2e-4 * way);
    EXPECT_NEAR(block.displacement()[2], -way * std::sin(dip), 2e-4 * way);
    EXPECT_FALSE(block.has_lifted());
  }
}

/// Equal planes of 45/135 and 45/225: the line plunges by ψ to the south, tan ψ = tan 45° cos 45°. Of what presses across the line each
/// plane bears 1/(2 sin β), sin β the cosine between its normal and the plane of symmetry (Hoek & Bray 1981).
TEST(SlidingBlock, ComesDownTheLineOfTwoPlanes) {
  const Vec3 n = upward(45, 135), line{0, -std::cos(std::atan(std::cos(radians(45)))),
                                       -std::sin(std::atan(std::cos(radians(45))))};
  const Vec3 across{0, -line[2], line[1]};  // up, square to the line, in the plane of symmetry
  const Real wedging = 1 / std::abs(dot(n, across)), tan_phi = std::tan(radians(33));
  ASSERT_NEAR(dot(n, line), 0, 1e-12);
  const auto rate = [&](Real into) {  // into the slope: the ground goes north
    const Vec3 r{0, -into, -g};
    return dot(r, line) - std::abs(dot(r, across)) * wedging * tan_phi;
  };
  ASSERT_LT(rate(0), 0);
  ASSERT_GT(rate(2), 0);
  SlidingBlock block = make_block({under(45, 135, 33), under(45, 225, 33)});
  shake(block, {0, 2, 0}, 0.3);
  shake(block, {}, 5);
  const Real way = pulse_way(rate(2), -rate(0), 0.3);
  EXPECT_NEAR(dot(block.displacement(), line), way, 2e-4 * way);
  EXPECT_NEAR(norm(block.displacement() - way * line), 0, 2e-4 * way);
}

/// 50 kN of cohesion hold 2 t on 30° without friction (9.8 kN) until a pulse breaks it: it then never stops.
TEST(SlidingBlock, LosesItsCohesionAtTheFirstSlip) {
  SlidingBlock block = make_block({under(30, 90, 0, 50e3)});
  shake(block, {-10, 0, 0}, 0.5);  // drives with 27.1 kN
  EXPECT_EQ(block.displacement(), Vec3{});
  shake(block, {-30, 0, 0}, 1e-3);  // 61.8 kN
  const Vec3 begun = block.displacement();
  EXPECT_GT(norm(begun), 0);
  shake(block, {}, 1);
  EXPECT_NEAR(norm(block.displacement() - begun), 0.5 * g * std::sin(radians(30)), 0.03);
}

TEST(SlidingBlock, GoesUphillUnlessAPlaneBehindItIsInTheWay) {
  const ContactPlane behind{.normal = Vec3{-1, 0, 0}, .area = 1, .face = none};
  for (const bool wall : {false, true}) {
    std::vector planes{under(10, 90, 15)};
    if (wall) planes.push_back(behind);
    SlidingBlock block = make_block(planes);
    shake(block, {8, 0, 0}, 0.3);  // away from the slope: the block goes west, uphill
    if (wall)
      EXPECT_NEAR(norm(block.displacement()), 0, 1e-15);
    else
      EXPECT_LT(block.displacement()[0], -0.05);
  }
}

/// On a plane that hardly dips it stays behind the ground, whatever way that goes.
TEST(SlidingBlock, GoesAnyWayOnOnePlane) {
  const Real dip = radians(0.01);
  SlidingBlock block = make_block({under(0.01, 90, 20)});
  shake(block, {0, 5, 0}, 0.2);
  const Real rate = 5 - g * std::cos(dip) * std::tan(radians(20));
  EXPECT_NEAR(block.displacement()[1], -0.5 * rate * 0.04, 1e-5);
  EXPECT_NEAR(block.displacement()[0], 0, 1e-4);
}

TEST(SlidingBlock, TellsWhereItWouldLeaveItsPlane) {
  SlidingBlock block = make_block({under(30, 90, 35)});
  shake(block, {0, 0, -g}, 0.1);
  EXPECT_FALSE(block.has_lifted());
  shake(block, {0, 0, -1.1 * g}, 0.1);
  EXPECT_TRUE(block.has_lifted());
}

}  // namespace
}  // namespace rockfold
