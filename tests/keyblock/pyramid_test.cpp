// Joint pyramids against counts of block theory and against two oracles: sampled directions, and
// the theorem of the alternative on normals with small integer coordinates, in integers.
#include "host/keyblock/motions/pyramid.hpp"

#include <array>
#include <cstdint>
#include <random>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "src/base/vector.hpp"
#include "tests/keyblock/models/half_space_block.hpp"

namespace rockfold {
namespace {

using test::upward;

std::vector<std::string> all_codes(std::size_t joints) {
  std::vector<std::string> codes;
  for (std::size_t bits = 0; bits < (std::size_t{1} << joints); ++bits) {
    std::string code;
    for (std::size_t i = 0; i < joints; ++i) code += (bits >> i & 1) ? '1' : '0';
    codes.push_back(code);
  }
  return codes;
}

/// The codes whose joint pyramid is not empty and, with `excavation`, makes a finite block.
std::vector<std::string> removable_codes(const std::vector<Vec3>& joints,
                                         const std::vector<Vec3>& excavation) {
  std::vector<std::string> found;
  for (const std::string& code : all_codes(joints.size()))
    if (is_removable(joint_pyramid(joints, code), excavation)) found.push_back(code);
  std::sort(found.begin(), found.end());
  return found;
}

/// Whether a joint pyramid holds one of ±axis, on its boundary too.
bool holds_axis(const std::vector<Vec3>& cone, const Vec3& axis) {
  const auto inside = [&](const Vec3& u) {
    return std::all_of(cone.begin(), cone.end(), [&](const Vec3& n) { return dot(n, u) <= 1e-12; });
  };
  return inside(axis) || inside(-axis);
}

bool is_in(const std::vector<Vec3>& normals, const Vec3& u, Real tolerance = 1e-8) {
  return std::all_of(normals.begin(), normals.end(),
                     [&](const Vec3& n) { return dot(n, u) <= tolerance; });
}

Vec3 random_direction(std::mt19937_64& random) {
  std::normal_distribution<Real> normal;
  return normalized({normal(random), normal(random), normal(random)});
}

// Case E1: joints in general position (Goodman & Shi): n² − n + 2 joint pyramids are not empty.
class JointSets : public testing::TestWithParam<std::array<std::size_t, 4>> {};

TEST_P(JointSets, InGeneralPositionGiveTheCountsOfBlockTheory) {
  const auto [n, nonempty, under_a_plane, in_a_tunnel] = GetParam();
  std::mt19937_64 random(n);
  std::vector<Vec3> joints;
  for (std::size_t i = 0; i < n; ++i) joints.push_back(random_direction(random));
  const Vec3 axis = random_direction(random);
  std::size_t found = 0, tunnel = 0;
  for (const std::string& code : all_codes(n)) {
    const auto cone = joint_pyramid(joints, code);
    if (!removable_direction(cone)) continue;
    ++found;
    tunnel += !holds_axis(cone, axis);
  }
  EXPECT_EQ(found, nonempty);
  EXPECT_EQ(removable_codes(joints, {random_direction(random)}).size(), under_a_plane);
  EXPECT_EQ(tunnel, in_a_tunnel);
}

INSTANTIATE_TEST_SUITE_P(Joints, JointSets,
                         testing::Values(std::array<std::size_t, 4>{3, 8, 1, 6},
                                         std::array<std::size_t, 4>{4, 14, 3, 12},
                                         std::array<std::size_t, 4>{5, 22, 6, 20},
                                         std::array<std::size_t, 4>{6, 32, 10, 30}));

// Case E2: three sets 60/030, 60/150, 60/270; 0 = above. The excavation pyramid's normals
// point out of the rock.
const std::vector<Vec3> three_sets{upward(60, 30), upward(60, 150), upward(60, 270)};
using Codes = std::vector<std::string>;

TEST(RemovableJointPyramids, OfARoofAFloorASlopeAndAWall) {
  EXPECT_EQ(removable_codes(three_sets, {{0, 0, -1}}), Codes{"111"});       // rock above the roof
  EXPECT_EQ(removable_codes(three_sets, {{0, 0, 1}}), Codes{"000"});        // rock below the floor
  EXPECT_EQ(removable_codes(three_sets, {upward(60, 180)}), Codes{"100"});  // rock below a slope
  EXPECT_EQ(removable_codes(three_sets, {upward(90, 90)}), Codes{"001"});   // rock west of a wall
}

TEST(RemovableJointPyramids, OfATunnelAreThoseThatDoNotHoldItsAxis) {
  const Vec3 axis{std::cos(test::radians(10)) * std::sin(test::radians(20)),
                  std::cos(test::radians(10)) * std::cos(test::radians(20)),
                  -std::sin(test::radians(10))};
  Codes held;
  for (const std::string& code : all_codes(3))
    if (holds_axis(joint_pyramid(three_sets, code), axis)) held.push_back(code);
  std::sort(held.begin(), held.end());
  EXPECT_EQ(held, (Codes{"011", "100"}));
  // An axis along a joint is on the boundary of the cones beside it: none holds it inside.
  for (const std::string& code : all_codes(3)) {
    const auto cone = joint_pyramid(three_sets, code);
    for (const Vec3& along : {Vec3{0, 1, 0}, Vec3{0, -1, 0}})
      EXPECT_FALSE(std::all_of(cone.begin(), cone.end(), [&](const Vec3& n) {
        return dot(n, along) < -1e-12;
      })) << code;
  }
}

TEST(JointPyramid, OfACodeTakesTheSideItNames) {
  const std::vector<Vec3> joints{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}};
  EXPECT_EQ(joint_pyramid(joints, "012"), (std::vector<Vec3>{{0, 0, -1}, {1, 0, 0}}));
  EXPECT_EQ(joint_pyramid(joints, "322"), (std::vector<Vec3>{{0, 0, -1}, {0, 0, 1}}));
  EXPECT_THROW(joint_pyramid(joints, "01"), std::invalid_argument);
  EXPECT_THROW(joint_pyramid(joints, "0a1"), std::invalid_argument);
}

// Cones without interior: repeated joint sets (code digit 3).
TEST(RemovableDirection, BetweenParallelJointsLiesInThem) {
  const Vec3 n = upward(35, 100);
  const auto u = removable_direction(std::vector<Vec3>{n, -n});
  ASSERT_TRUE(u);
  EXPECT_NEAR(norm(*u), 1, 1e-15);
  EXPECT_NEAR(dot(*u, n), 0, 1e-15);
}
TEST(RemovableDirection, OfOneJointIsAlongIt) {
  const Vec3 n = upward(35, 100);
  ASSERT_TRUE(removable_direction(std::vector<Vec3>{n}));
  EXPECT_TRUE(is_in({n}, *removable_direction(std::vector<Vec3>{n}), 1e-15));
}
TEST(RemovableDirection, BetweenTwoPairsIsTheirLine) {
  const Vec3 a = upward(70, 20), b = upward(50, 130);
  const auto u = removable_direction(std::vector<Vec3>{a, -a, b, -b});
  ASSERT_TRUE(u);
  EXPECT_NEAR(norm(cross(*u, normalized(cross(a, b)))), 0, 1e-15);
}
TEST(RemovableDirection, IsEmptyBetweenThreePairs) {
  const Vec3 a = upward(70, 20), b = upward(50, 130), c = upward(20, 250);
  EXPECT_TRUE(
      removable_direction(std::vector<Vec3>{a, -a, b, -b, c}));  // one end of the line is open
  EXPECT_FALSE(removable_direction(std::vector<Vec3>{a, -a, b, -b, c, -c}));
}
TEST(RemovableDirection, OfThreeSidesOfAPrismIsItsAxis) {
  const std::vector<Vec3> sides{{1, 0, 0}, {-0.5, std::sqrt(0.75), 0}, {-0.5, -std::sqrt(0.75), 0}};
  const auto u = removable_direction(sides);
  ASSERT_TRUE(u);
  EXPECT_NEAR(std::abs((*u)[2]), 1, 1e-15);
}
TEST(RemovableDirection, OfAFreeBlockExists) {
  EXPECT_TRUE(removable_direction({}));
}

// Normals that differ by rounding only are one plane; parallel joints with noise stay parallel.
TEST(RemovableDirection, DoesNotDependOnRounding) {
  const Vec3 n = upward(35, 100);
  const Vec3 noisy = normalized(-n + Vec3{1e-15, -1e-15, 2e-15});
  EXPECT_TRUE(removable_direction(std::vector<Vec3>{n, noisy, upward(80, 100)}));
  const Vec3 a = upward(70, 20), c = upward(20, 250);
  EXPECT_TRUE(removable_direction(
      std::vector<Vec3>{n, noisy, a, normalized(-a + Vec3{1e-15, 1e-15, 0}), c}));
}

// Three joints 1e-8 apart through one line: the line is removable however it is turned, although it
// is known only from differences of 1e-8.
TEST(RemovableDirection, BetweenNearlyParallelJointsIsTheirLine) {
  std::mt19937_64 random(31);
  for (int trial = 0; trial < 1000; ++trial) {
    const Vec3 n = random_direction(random), line = normalized(cross(n, random_direction(random)));
    const Real apart = test::degrees(1e-8);
    EXPECT_TRUE(removable_direction(
        std::vector<Vec3>{n, test::rotated(-n, line, apart), test::rotated(-n, line, -apart)}));
  }
}

// A taper of one part in a million is a taper: the block narrows towards the free face.
TEST(RemovableDirection, SeesASlightTaper) {
  const auto wall = [](Real azimuth, Real taper) {
    return normalized({std::cos(test::radians(azimuth)), std::sin(test::radians(azimuth)), taper});
  };
  for (const Real taper : {1e-6, 1e-3}) {
    std::vector<Vec3> narrowing, widening;  // upwards, on a floor
    for (const Real azimuth : {0.0, 90.0, 180.0, 270.0}) {
      narrowing.push_back(wall(azimuth, taper));
      widening.push_back(wall(azimuth, -taper));
    }
    narrowing.push_back({0, 0, -1});
    widening.push_back({0, 0, -1});
    EXPECT_FALSE(removable_direction(narrowing)) << taper;
    EXPECT_TRUE(removable_direction(widening)) << taper;
  }
}

// A direction that was found proves itself; that none was missed is what the samples try to
// disprove.
TEST(RemovableDirection, IsFoundWhereverRandomDirectionsHitTheCone) {
  std::mt19937_64 random(7);
  std::vector<Vec3> directions(4000);
  for (Vec3& u : directions) u = random_direction(random);
  int hit = 0;
  for (int cone = 0; cone < 10000; ++cone) {
    std::vector<Vec3> normals(3 + random() % 6);
    for (Vec3& n : normals) n = random_direction(random);
    const auto u = removable_direction(normals);
    if (u) {
      EXPECT_TRUE(is_in(normals, *u)) << "cone " << cone;
    }
    if (std::any_of(directions.begin(), directions.end(),
                    [&](const Vec3& d) { return is_in(normals, d, 0); })) {
      ++hit;
      EXPECT_TRUE(u) << "cone " << cone;
    }
  }
  EXPECT_GT(hit, 1000);  // the test has something to try
}

// The alternative: the cone is the origin alone exactly if each of ±e_x, ±e_y, ±e_z is a
// non-negative combination of the normals (they span space positively), of three of them at most
// (Carathéodory).
using Int3 = std::array<std::int64_t, 3>;
Int3 cross_of(const Int3& a, const Int3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
std::int64_t dot_of(const Int3& a, const Int3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

bool combines(const std::vector<Int3>& normals, const Int3& target) {
  // Linearly independent triples alone suffice where the normals span space; if they do not, some
  // target fails.
  for (const Int3& a : normals)
    for (const Int3& b : normals)
      for (const Int3& c : normals) {
        const std::int64_t det = dot_of(a, cross_of(b, c));
        if (det <= 0) continue;  // the other sense is the triple (a, c, b)
        if (dot_of(target, cross_of(b, c)) >= 0 && dot_of(target, cross_of(c, a)) >= 0 &&
            dot_of(target, cross_of(a, b)) >= 0)
          return true;
      }
  return false;
}

/// Coordinates up to 2: parallel and coplanar normals abound; up to 10,000: general position.
class IntegerNormals : public testing::TestWithParam<std::int64_t> {};

TEST_P(IntegerNormals, HaveARemovableDirectionUnlessTheySpanSpacePositively) {
  std::mt19937_64 random(11);
  std::uniform_int_distribution<std::int64_t> coordinate(-GetParam(), GetParam());
  const std::vector<Int3> axes{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  int removable = 0;
  for (int cone = 0; cone < 10000; ++cone) {
    std::vector<Int3> integers;
    std::vector<Vec3> normals;
    const std::size_t count = 3 + random() % 6;
    while (integers.size() < count) {
      const Int3 n{coordinate(random), coordinate(random), coordinate(random)};
      if (n == Int3{}) continue;
      integers.push_back(n);
      normals.push_back(
          normalized({static_cast<Real>(n[0]), static_cast<Real>(n[1]), static_cast<Real>(n[2])}));
    }
    const bool empty = std::all_of(axes.begin(), axes.end(),
                                   [&](const Int3& axis) { return combines(integers, axis); });
    ASSERT_EQ(removable_direction(normals).has_value(), !empty) << "cone " << cone;
    removable += !empty;
  }
  EXPECT_GT(removable, 1000);
  EXPECT_LT(removable, 9000);
}

INSTANTIATE_TEST_SUITE_P(Coordinates, IntegerNormals, testing::Values(1, 2, 10000));

}  // namespace
}  // namespace rockfold
