// Planes that coincide to 1e-10 in angle, and in distance over the model's size, are one plane.
#include <cmath>

#include <gtest/gtest.h>

#include "src/base/vector.hpp"
#include "tests/exact/exact_oracle.hpp"

namespace rockfold::test {
namespace {

constexpr Real size = 8;  // tolerance 8e-10 m

class Identification : public testing::TestWithParam<Vec3> {
 protected:
  // Tilted, off the centre, of a length that is not one.
  const Vec3 centre = GetParam();
  const Vec3 normal{2, -3, 6};  // length 7
  const Vec3 unit = (1.0 / 7) * normal;
  const Vec3 across = normalized(cross(normal, {0, 0, 1}));
  const Vec3 point = centre + Vec3{0.5, 1, -0.25};
  Planes planes{centre, size};
  const Index first = planes.add({0, 0, 1}, centre);
  const Index plane = planes.add(normal, point);

  HalfSpaceId find(const Vec3& n, const Vec3& p, Real offset = 0) const {
    return planes.table.find(plane_through(n, p, offset));
  }
};

TEST_P(Identification, FindsAPlaneAgain) {
  EXPECT_EQ(find(normal, point), half_space(plane, true));
  EXPECT_EQ(find(normal, point + 3.0 * Vec3{3, 2, 0}), half_space(plane, true));
  EXPECT_EQ(find({0, 0, 1}, centre + Vec3{4, 4, 0}), half_space(first, true));
}

TEST_P(Identification, FindsItUnderTheOppositeNormal) {
  EXPECT_EQ(find(-normal, point), half_space(plane, false));
  EXPECT_EQ(find({0, 0, -3}, centre), half_space(first, false));
}

TEST_P(Identification, FindsItUnderANormalOfAnyLength) {
  for (const Real length : {1e-200, 1e-12, 1.0, 1e12, 1e200}) {
    EXPECT_EQ(find(length * normal, point), half_space(plane, true)) << length;
    EXPECT_EQ(find(-length * normal, point), half_space(plane, false)) << length;
  }
}

// `offset` moves along a normal of length 7: a distance of offset/7.
TEST_P(Identification, FollowsTheDistance) {
  for (const Real sense : {-1.0, 1.0}) {
    EXPECT_EQ(find(normal, point, sense * 7 * 0.99e-10 * size), half_space(plane, true));
    EXPECT_EQ(find(normal, point, sense * 7 * 1.01e-10 * size), none);
    EXPECT_EQ(find(-normal, point, sense * 7 * 0.99e-10 * size), half_space(plane, false));
    EXPECT_EQ(find(-normal, point, sense * 7 * 1.01e-10 * size), none);
  }
}

TEST_P(Identification, FollowsTheAngle) {
  // Turned about the foot of the centre on the plane, so that its distance from the centre does not change.
  const Vec3 foot = centre + dot(unit, point - centre) * unit;
  EXPECT_EQ(find(unit + 0.99e-10 * across, foot), half_space(plane, true));
  EXPECT_EQ(find(unit + 1.01e-10 * across, foot), none);
  EXPECT_EQ(find(-(unit + 0.99e-10 * across), foot), half_space(plane, false));
  EXPECT_EQ(find(-(unit + 1.01e-10 * across), foot), none);
}

TEST_P(Identification, DoesNotTakeAMirrorImageForThePlane) {
  EXPECT_EQ(find(normal, centre - (point - centre)), none);
}

TEST_P(Identification, TakesTheFirstOfSeveral) {
  planes.add(plane_through(normal, point, 7 * 1.5e-10 * size));
  EXPECT_EQ(find(normal, point, 7 * 0.75e-10 * size), half_space(plane, true));
  EXPECT_EQ(find(normal, point, 7 * 1.2e-10 * size), half_space(plane + 1, true));
}

// At map coordinates points are exact multiples of 2⁻²⁹ m or so: all of those above are.
INSTANTIATE_TEST_SUITE_P(AboutTheOrigin, Identification, testing::Values(Vec3{}));
INSTANTIATE_TEST_SUITE_P(AwayFromIt, Identification, testing::Values(Vec3{16, -3.5, 0.25}));

TEST(PlaneThrough, PassesThroughItsPointExactly) {
  const Vec3 n{0.1, 0.7, -1.0 / 3}, p{5e6 + 0.1, 4e6 - 1.0 / 7, 1e3 / 3};
  const ExactPlane plane = plane_through(n, p);
  EXPECT_EQ(dot(plane.n, exact(p)), plane.d);
}

TEST(PlaneAlong, PassesThroughItsThreePointsExactly) {
  const Vec3 a{0.1, 0.2, 0.3}, b{1.7, -0.4, 1e6 + 0.1}, c{-3.3, 2.9, 0.7};
  const auto difference = [](const Vec3& x, const Vec3& y) {
    const ExactVec3 u = exact(x), v = exact(y);
    return ExactVec3{u[0] - v[0], u[1] - v[1], u[2] - v[2]};
  };
  const ExactPlane plane = plane_along(exact(a), difference(b, a), difference(c, a));
  for (const Vec3& p : {a, b, c}) EXPECT_EQ(dot(plane.n, exact(p)), plane.d);
  const ExactPlane other = opposite(plane);
  EXPECT_EQ(other.d, -plane.d);
  EXPECT_EQ(other.n[1], -plane.n[1]);
}

}  // namespace
}  // namespace rockfold::test
