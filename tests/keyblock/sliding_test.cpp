// Modes and forces against closed forms, against the printed formula that is wrong, and against
// what any answer must satisfy.
#include "host/keyblock/motions/sliding.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "host/keyblock/motions/pyramid.hpp"
#include "src/base/vector.hpp"
#include "tests/keyblock/models/half_space_block.hpp"

namespace rockfold {
namespace {

using test::degrees;
using test::radians;
using test::upward;

const Vec3 down{0, 0, -1};

/// A plane that the block lies on (its upward normal points into the block).
ContactPlane under(Real dip, Real dip_direction, Real friction_angle = 0, Real cohesion = 0) {
  return {.normal = -upward(dip, dip_direction),
          .area = 1,
          .friction = std::tan(radians(friction_angle)),
          .cohesion = cohesion,
          .face = none};
}
ContactPlane over(Real dip, Real dip_direction) {
  return {
      .normal = upward(dip, dip_direction), .area = 1, .friction = 0, .cohesion = 0, .face = none};
}

Real plunge(const Vec3& s) {
  return degrees(std::asin(-s[2]));
}
Real trend(const Vec3& s) {
  return std::fmod(degrees(std::atan2(s[0], s[1])) + 360, 360);
}

// A block on a plane of dip a: acceleration g (sin a − cos a tan φ).
TEST(SinglePlane, AccelerationsEqualTheClosedForm) {
  const Real cases[][3] = {{30, 0, 4.905},
                           {30, 10, 3.406977},
                           {30, 20, 1.812815},
                           {45, 30, 2.931802},
                           {22.6, 0, 3.769937}};
  for (const auto& [dip, phi, acceleration] : cases) {
    const auto m = find_movement(std::vector{under(dip, 70, phi)}, 9.81 * down);
    ASSERT_TRUE(m);
    EXPECT_EQ(m->mode, SlidingMode::single_plane);
    EXPECT_NEAR(m->sliding_force(), acceleration, 1e-6);
    EXPECT_NEAR(plunge(m->direction), dip, 1e-12);
    EXPECT_NEAR(trend(m->direction), 70, 1e-12);
  }
}

// A block of 1 m³, 2600 kg/m³, dip 40, φ 20, A = 1 m².
TEST(SinglePlane, CohesionHoldsAsTheClosedForm) {
  const Real weight = 2600 * 9.81;
  const auto with = [&](Real cohesion) {
    return *find_movement(std::vector{under(40, 200, 20, cohesion)}, weight * down);
  };
  EXPECT_NEAR(with(10000).factor_of_safety(), 1.043707, 1e-6);
  EXPECT_NEAR(with(0).sliding_force(), weight * std::tan(radians(20)),
              1e-8);  // sin 40 − cos 40 tan 20 = tan 20
  EXPECT_NEAR(with(5000).sliding_force() / 2600, 1.647471, 1e-6);
}

struct Wedge {
  Real dip_i, direction_i, dip_j, direction_j;
};
std::vector<ContactPlane> on(const Wedge& w, Real phi_i = 0, Real phi_j = 0) {
  return {under(w.dip_i, w.direction_i, phi_i), under(w.dip_j, w.direction_j, phi_j)};
}

// Case E4. Wedges by trigonometry; the first is 3DEC's sliding wedge, critical friction 33.3572°.
TEST(TwoPlanes, WedgesEqualTheClosedForm) {
  const Wedge wedge{40, 130, 60, 220};
  const auto m = find_movement(on(wedge), 9.81 * down);
  ASSERT_TRUE(m);
  EXPECT_EQ(m->mode, SlidingMode::two_planes);
  EXPECT_NEAR(plunge(m->direction), 37.0583, 5e-5);
  EXPECT_NEAR(trend(m->direction), 155.848, 5e-4);
  EXPECT_NEAR(m->normal_force[0], 6.60519, 5e-6);
  EXPECT_NEAR(m->normal_force[1], 2.37506, 5e-6);
  EXPECT_NEAR(m->sliding_force(), 5.911774, 1e-6);
  EXPECT_NEAR(find_movement(on(wedge, 20, 20), 9.81 * down)->sliding_force(), 2.643227, 1e-6);
  EXPECT_NEAR(find_movement(on(wedge, 33, 33), 9.81 * down)->sliding_force(), 0.079926, 1e-6);

  const auto unit = find_movement(on(wedge), down);
  EXPECT_NEAR(unit->normal_force[0], 0.673312, 5e-7);
  EXPECT_NEAR(unit->normal_force[1], 0.242106, 5e-7);
  EXPECT_NEAR(degrees(std::atan(unit->driving / (unit->normal_force[0] + unit->normal_force[1]))),
              33.3572, 5e-5);

  const auto flat = find_movement(on({52, 63, 53, 296}), 9.81 * down);
  EXPECT_NEAR(flat->sliding_force(), 4.930751, 1e-6);
  EXPECT_NEAR(plunge(flat->direction), 30.1738, 5e-5);
  EXPECT_NEAR(find_movement(on({45, 135, 45, 225}, 20, 20), 9.81 * down)->sliding_force(), 2.297461,
              1e-6);
}

// Case E7. Hoek & Bray: F = sin β / sin(ξ/2) · tan φ / tan ψ; both planes dip 45, 90 degrees apart.
TEST(TwoPlanes, TheSymmetricWedgeEqualsTheClosedForm) {
  const auto m = find_movement(on({45, 135, 45, 225}, 30, 30), down);
  EXPECT_NEAR(plunge(m->direction), degrees(std::asin(1 / std::sqrt(3.0))), 1e-12);
  EXPECT_NEAR(m->factor_of_safety(), 0.942809, 5e-7);
  EXPECT_NEAR(degrees(std::atan(std::tan(radians(30)) / m->factor_of_safety())), 31.4822, 5e-5);
}

/// The thesis' Eq. 5-4 as it is printed: upward normals, no absolute values.
Real printed_equation_5_4(const Vec3& n_i, const Vec3& n_j, const Vec3& r, Real tan_i, Real tan_j) {
  const Vec3 line = cross(n_i, n_j);
  return (dot(r, line) * norm(line) - dot(cross(r, n_j), line) * tan_i -
          dot(cross(r, n_i), line) * tan_j) /
         dot(line, line);
}

// Case E8. The sign of the printed formula goes with the order of the planes; ours does not.
TEST(TwoPlanes, TheForceDoesNotDependOnTheOrderOfThePlanes) {
  const auto check = [](const Wedge& w, Real phi_i, Real phi_j, Real right, Real printed) {
    const auto m = find_movement(on(w, phi_i, phi_j), down);
    const auto swapped =
        find_movement(on({w.dip_j, w.direction_j, w.dip_i, w.direction_i}, phi_j, phi_i), down);
    EXPECT_NEAR(m->sliding_force(), right, 1e-6);
    EXPECT_NEAR(swapped->sliding_force(), right, 1e-6);
    const Vec3 n_i = upward(w.dip_i, w.direction_i), n_j = upward(w.dip_j, w.direction_j);
    const Real t_i = std::tan(radians(phi_i)), t_j = std::tan(radians(phi_j));
    EXPECT_NEAR(std::abs(printed_equation_5_4(n_i, n_j, down, t_i, t_j)), printed, 1e-6);
    EXPECT_NEAR(printed_equation_5_4(n_i, n_j, down, t_i, t_j),
                -printed_equation_5_4(n_j, n_i, down, t_j, t_i), 1e-12);
  };
  check({40, 130, 60, 220}, 20, 20, 0.269442, 0.759573);
  check({45, 105, 70, 235}, 20, 30, -0.055226, 0.525565);
}

// Case E2. What each joint pyramid of 60/030, 60/150, 60/270 does under gravity, φ = 20. A
// block above one joint lies on it alone: it slides straight down, away from the two others. Above
// all three it is at rest.
TEST(Modes, OfTheEightJointPyramidsOfThreeSets) {
  const Real tan_phi = std::tan(radians(20));
  const std::vector<Vec3> sets{upward(60, 30), upward(60, 150), upward(60, 270)};
  for (int bits = 0; bits < 8; ++bits) {
    std::string code;
    for (int i = 0; i < 3; ++i) code += (bits >> i & 1) ? '1' : '0';
    std::vector<ContactPlane> planes;
    for (const Vec3& n : joint_pyramid(sets, code))
      planes.push_back({.normal = n, .area = 1, .friction = tan_phi, .cohesion = 0, .face = none});
    const auto m = find_movement(planes, down);
    const auto lies_above = std::count(code.begin(), code.end(), '0');
    ASSERT_EQ(m.has_value(), lies_above != 3) << code;
    if (!m) continue;
    EXPECT_EQ(static_cast<int>(m->mode), static_cast<int>(lies_above)) << code;
    const Real expected[] = {1, 0.68404, 0.23869};
    EXPECT_NEAR(m->sliding_force(), expected[lies_above], 5e-6) << code;
  }
}

TEST(Lifting, IsAlongTheResultantAndNothingResists) {
  const auto m = find_movement(std::vector{over(60, 30), over(60, 150), over(60, 270)}, 3.0 * down);
  ASSERT_TRUE(m);
  EXPECT_EQ(m->mode, SlidingMode::lifting);
  EXPECT_EQ(m->direction, down);
  EXPECT_DOUBLE_EQ(m->sliding_force(), 3);
  EXPECT_TRUE(std::isnan(m->factor_of_safety()));
}

// Between vertical joints nothing presses on them: the block falls.
TEST(Lifting, AlongVerticalJointsIsFalling) {
  std::vector<ContactPlane> shaft;
  for (const Real direction : {10.0, 100.0, 190.0, 280.0})
    shaft.push_back(under(90, direction, 40));
  const auto m = find_movement(shaft, 2.0 * down);
  ASSERT_TRUE(m);
  EXPECT_EQ(m->mode, SlidingMode::lifting);
  EXPECT_DOUBLE_EQ(m->sliding_force(), 2);
}

// Between two parallel joints of dip 50 the lower one carries; the upper one opens nothing and
// holds nothing.
TEST(SinglePlane, BetweenParallelJointsTheLowerOneCarries) {
  const auto m = find_movement(std::vector{over(50, 90), under(50, 90, 30, 0.1)}, down);
  ASSERT_TRUE(m);
  EXPECT_EQ(m->mode, SlidingMode::single_plane);
  EXPECT_EQ(m->planes[0], 1);
  EXPECT_NEAR(m->sliding_force(),
              std::sin(radians(50)) - std::cos(radians(50)) * std::tan(radians(30)) - 0.1, 1e-15);
}

TEST(Rest, OnAHorizontalJointOrInATrench) {
  EXPECT_FALSE(find_movement(std::vector{under(0, 0)}, down));
  EXPECT_FALSE(find_movement(std::vector{under(45, 90), under(45, 270)}, down));
  EXPECT_FALSE(find_movement(std::vector{under(45, 90), under(90, 270)}, down));  // against a wall
  EXPECT_FALSE(find_movement(std::vector{under(45, 90)}, Vec3{}));
}

// A trough with four sides along one line: any pair that carries is statics' choice; ours is the
// least safe, which wedges the least.
TEST(TwoPlanes, InATroughOfParallelEdgesTheLeastSafePairCarries) {
  const Vec3 axis = normalized({0, 1, -0.6});
  std::vector<ContactPlane> trough;
  for (const Real angle : {-75.0, -30.0, 30.0, 75.0})
    trough.push_back(
        {.normal = normalized(test::rotated(normalized(cross(axis, {1, 0, 0})), axis, angle)),
         .area = 1,
         .friction = 0.2,
         .cohesion = 0,
         .face = none});
  for (ContactPlane& p : trough)
    if (p.normal[2] > 0) p.normal = -p.normal;
  const auto m = find_movement(trough, down);
  ASSERT_TRUE(m);
  EXPECT_EQ(m->mode, SlidingMode::two_planes);
  const Real across = norm(down - dot(down, axis) * axis);
  EXPECT_NEAR(m->driving, dot(down, axis), 1e-12);
  EXPECT_NEAR(m->resisting, 0.2 * across / std::cos(radians(30)), 1e-12);
  std::reverse(trough.begin(), trough.end());
  EXPECT_NEAR(find_movement(trough, down)->resisting, m->resisting, 1e-12);
}

std::vector<ContactPlane> random_planes(std::mt19937_64& random, std::size_t count) {
  std::normal_distribution<Real> normal;
  std::uniform_real_distribution<Real> unit;
  std::vector<ContactPlane> planes;
  for (std::size_t i = 0; i < count; ++i)
    planes.push_back({.normal = normalized({normal(random), normal(random), normal(random)}),
                      .area = 1,
                      .friction = unit(random),
                      .cohesion = 0.1 * unit(random),
                      .face = none});
  return planes;
}

/// r = T s + Σ N n, T > 0, N ≥ 0, s allowed and along the planes it slides on: these conditions
/// have one solution (s T is the point of the cone nearest to r), so an answer that meets them is
/// the right one.
void expect_certified(const std::vector<ContactPlane>& planes, const Vec3& r, const Movement& m) {
  Vec3 rest = r - m.driving * m.direction;
  EXPECT_GT(m.driving, 0);
  EXPECT_NEAR(norm(m.direction), 1, 1e-14);
  for (const ContactPlane& p : planes) EXPECT_LE(dot(p.normal, m.direction), 1e-8);
  for (std::size_t k = 0; k < static_cast<std::size_t>(m.mode); ++k) {
    const ContactPlane& p = planes[static_cast<std::size_t>(m.planes[k])];
    EXPECT_GE(m.normal_force[k], 0);
    EXPECT_NEAR(dot(p.normal, m.direction), 0, 1e-12);
    rest -= m.normal_force[k] * p.normal;
  }
  EXPECT_LT(norm(rest), 1e-9);  // two of 10,000 random planes may be nearly parallel: N of some 1e4
}

TEST(Modes, OfRandomBlocksAreCertified) {
  std::mt19937_64 random(3);
  std::normal_distribution<Real> normal;
  std::array<int, 3> found{};
  for (int trial = 0; trial < 10000; ++trial) {
    const auto planes = random_planes(random, 1 + random() % 6);
    const Vec3 r = normalized({normal(random), normal(random), normal(random)});
    if (const auto m = find_movement(planes, r)) {
      ++found[static_cast<std::size_t>(m->mode)];
      expect_certified(planes, r, *m);
      continue;
    }
    for (int sample = 0; sample < 200;
         ++sample) {  // at rest: no allowed direction has a component of r
      const Vec3 u = normalized({normal(random), normal(random), normal(random)});
      const bool allowed = std::all_of(planes.begin(), planes.end(), [&](const ContactPlane& p) {
        return dot(p.normal, u) <= 0;
      });
      EXPECT_FALSE(allowed && dot(r, u) > 1e-8) << "trial " << trial;
    }
  }
  for (const int count : found) EXPECT_GT(count, 1000);
}

TEST(Modes, TurnWithTheModel) {
  std::mt19937_64 random(5);
  std::normal_distribution<Real> normal;
  std::uniform_real_distribution<Real> angle(-180, 180);
  for (int trial = 0; trial < 2000; ++trial) {
    auto planes = random_planes(random, 1 + random() % 4);
    const Vec3 r = normalized({normal(random), normal(random), normal(random)});
    const Vec3 axis = normalized({normal(random), normal(random), normal(random)});
    const Real turn = angle(random);
    const auto before = find_movement(planes, r);
    for (ContactPlane& p : planes) p.normal = test::rotated(p.normal, axis, turn);
    const auto after = find_movement(planes, test::rotated(r, axis, turn));
    ASSERT_EQ(before.has_value(), after.has_value());
    if (!before) continue;
    EXPECT_EQ(before->mode, after->mode);
    EXPECT_EQ(before->planes, after->planes);
    EXPECT_LT(norm(test::rotated(before->direction, axis, turn) - after->direction), 1e-10);
    EXPECT_NEAR(before->driving, after->driving, 1e-10);
    EXPECT_NEAR(before->resisting, after->resisting, 1e-10 * (1 + before->resisting));
  }
}

}  // namespace
}  // namespace rockfold
