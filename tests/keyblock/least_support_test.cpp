// Support forces against the closed forms of a bolted block and against a search over directions.
#include "host/keyblock/motions/least_support.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "src/base/vector.hpp"
#include "tests/keyblock/models/half_space_block.hpp"

namespace rockfold {
namespace {

using test::degrees;
using test::radians;
using test::upward;

const Vec3 down{0, 0, -1};

// Hoek's bolted block: W = 1000 kN, dip 50, φ 30, c = 0; the bolt at α from the plane's normal, T
// in kN: T = (F W sin β − W cos β tan φ − c A) / (cos α tan φ + F sin α).
class BoltedBlock : public testing::Test {
 protected:
  const std::vector<ContactPlane> planes{{.normal = -upward(50, 140),
                                          .area = 1,
                                          .friction = std::tan(radians(30)),
                                          .cohesion = 0,
                                          .face = 0}};
  const Movement movement = *find_movement(planes, 1000.0 * down);

  Real force(Real alpha, Real target) const {
    const Vec3 direction =
        std::cos(radians(alpha)) * planes[0].normal - std::sin(radians(alpha)) * movement.direction;
    return support_force_along(planes, movement, direction, target);
  }
};

TEST_F(BoltedBlock, NeedsTheClosedFormAlongAnyDirection) {
  const Real cases[][3] = {{1, 0, 684.0403},    {1, 30, 394.9308},   {1, 60, 342.0201},
                           {1, 90, 394.9308},   {1.5, 0, 1347.4542}, {1.5, 30, 622.3625},
                           {1.5, 60, 489.9834}, {1.5, 75, 486.7323}, {1.5, 90, 518.6354}};
  for (const auto& [target, alpha, kilonewton] : cases)
    EXPECT_NEAR(force(alpha, target), kilonewton, 5e-5) << "F " << target << " alpha " << alpha;
}

TEST_F(BoltedBlock, NeedsTheLeastForceAtTheAngleOfReducedFriction) {
  const SupportForce least = least_support(planes, movement, 1.5);
  EXPECT_NEAR(least.force, 484.0198, 5e-5);
  EXPECT_NEAR(degrees(std::acos(-dot(least.direction, movement.direction))), 21.0517, 5e-5);
  EXPECT_GT(dot(least.direction, planes[0].normal), 0);  // presses the block on
  EXPECT_NEAR(least_support(planes, movement, 1).force, 1000 * std::sin(radians(20)), 1e-9);
}

TEST_F(BoltedBlock, CannotBeHeldByAForceThatPullsItOff) {
  EXPECT_TRUE(std::isinf(force(180, 1.5)));
  EXPECT_TRUE(std::isinf(force(270, 1.5)));
}

TEST_F(BoltedBlock, NeedsNothingBelowItsOwnFactorOfSafety) {
  EXPECT_EQ(least_support(planes, movement, 0.9 * movement.factor_of_safety()).force, 0);
}

// Without friction the least force is the driving force itself, against the motion,
// at any target.
TEST(LeastSupport, OfAFrictionlessBlockIsAgainstTheMotion) {
  const std::vector<ContactPlane> planes{
      {.normal = -upward(5.7106, 90), .area = 1, .friction = 0, .cohesion = 0, .face = 0}};
  const Movement movement = *find_movement(planes, down);
  for (const Real target : {1.0, 1.5}) {
    const SupportForce least = least_support(planes, movement, target);
    EXPECT_NEAR(least.force, movement.driving, 1e-15);
    EXPECT_NEAR(dot(least.direction, movement.direction), -1, 1e-15);
  }
}

// A falling block needs F W upward: 15.588 kN for H = 1 m, 27 kN/m³.
TEST(LeastSupport, OfAFallingBlockIsItsWeightTimesTheTarget) {
  const std::vector<ContactPlane> planes{
      {.normal = upward(60, 30), .area = 1, .friction = 0, .cohesion = 0, .face = 0}};
  const Movement movement = *find_movement(planes, 15.588 * down);
  const SupportForce least = least_support(planes, movement, 2);
  EXPECT_NEAR(least.force, 31.176, 1e-12);
  EXPECT_EQ(std::ceil(least.force / 100), 1);
  EXPECT_EQ(least.direction, (Vec3{0, 0, 1}));
  EXPECT_NEAR(support_force_along(planes, movement, normalized({0, 1, 1}), 2),
              31.176 * std::sqrt(2.0), 1e-12);
  EXPECT_TRUE(std::isinf(support_force_along(planes, movement, down, 2)));
}

/// The least force over many directions: a coarse sphere, then ever smaller caps around the best.
Real searched(const std::vector<ContactPlane>& planes, const Movement& m, Real target,
              std::mt19937_64& random) {
  std::normal_distribution<Real> normal;
  Vec3 best_direction = -m.direction;
  Real best = support_force_along(planes, m, best_direction, target);
  Real cap = 10;
  for (int i = 0; i < 6000; ++i) {
    if (i > 1500 && i % 300 == 0) cap *= 0.4;
    const Vec3 d =
        normalized(best_direction + cap * Vec3{normal(random), normal(random), normal(random)});
    const Real force = support_force_along(planes, m, d, target);
    if (force < best) best = force, best_direction = d;
  }
  return best;
}

TEST(LeastSupport, OfWedgesIsNoMoreThanAnyOtherDirectionNeedsAndSuffices) {
  std::mt19937_64 random(17);
  std::normal_distribution<Real> normal;
  std::uniform_real_distribution<Real> unit;
  int wedges = 0, opened = 0;
  while (wedges < 200) {
    std::vector<ContactPlane> planes;
    for (int i = 0; i < 2; ++i)
      planes.push_back({.normal = normalized({normal(random), normal(random), normal(random)}),
                        .area = 1,
                        .friction = 1.2 * unit(random),
                        .cohesion = 0.02 * unit(random),
                        .face = 0});
    const auto m = find_movement(planes, down);
    if (!m || m->mode != SlidingMode::two_planes || m->sliding_force() <= 0) continue;
    ++wedges;
    const SupportForce least = least_support(planes, *m, 1.5);
    const auto held = find_movement(planes, down + least.force * least.direction);
    if (held && held->mode == SlidingMode::two_planes) {
      EXPECT_NEAR(held->factor_of_safety(), 1.5, 1e-6);
      opened += std::min(held->normal_force[0], held->normal_force[1]) < 1e-9;
    } else {
      ++opened;  // on the limit of losing one contact
    }
    const Real best = searched(planes, *m, 1.5, random);
    EXPECT_LE(least.force, best * (1 + 1e-9));
    EXPECT_GE(least.force, best * (1 - 2e-3));
  }
  EXPECT_GT(opened, 3);  // wedges whose least support just keeps a contact closed were among them
}

// The shortest vector of a polyhedron against many directions.
TEST(LeastSupport, OfManyMotionsIsTheLeastThatBringsEachOfThemToTheTarget) {
  std::mt19937_64 random(11);
  std::normal_distribution<Real> normal;
  int tight = 0;
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<SupportCondition> conditions;
    for (int i = 0; i < 8; ++i)
      conditions.push_back({{normal(random), normal(random), 0.3 + std::abs(normal(random))},
                            normal(random) + 0.5});  // along z all can be met
    const SupportForce least = least_support(conditions);
    ASSERT_TRUE(std::isfinite(least.force));
    const Vec3 p = least.force * least.direction;
    int met_exactly = 0;
    for (const SupportCondition& c : conditions) {
      EXPECT_GE(dot(c.gain, p) - c.deficit, -1e-8) << trial;
      met_exactly += std::abs(dot(c.gain, p) - c.deficit) < 1e-8;
    }
    tight += met_exactly > 1;
    EXPECT_NEAR(support_force_along(conditions, least.direction), least.force, 1e-8);
    for (int i = 0; i < 300; ++i) {
      const Real far = i < 100 ? 1 : 0.05;
      const Vec3 d =
          normalized(least.direction + far * Vec3{normal(random), normal(random), normal(random)});
      EXPECT_GE(support_force_along(conditions, d), least.force - 1e-8) << trial;
    }
    // One more motion never asks for less.
    const Real all = least.force;
    conditions.pop_back();
    EXPECT_LE(least_support(conditions).force, all + 1e-9);
  }
  EXPECT_GT(tight, 20);
}

TEST(LeastSupport, OfMotionsThatNoForceCanHoldTogetherIsInfinite) {
  const std::vector<SupportCondition> opposite{{{0, 0, 1}, 1}, {{0, 0, -1}, 1}};
  EXPECT_TRUE(std::isinf(least_support(opposite).force));
  EXPECT_TRUE(std::isinf(support_force_along(opposite, {0, 0, 1})));
  const std::vector<SupportCondition> no_arm{{{0, 0, 0}, 1}};
  EXPECT_TRUE(std::isinf(least_support(no_arm).force));
}

}  // namespace
}  // namespace rockfold
