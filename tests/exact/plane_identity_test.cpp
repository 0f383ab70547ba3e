// Which planes are one: those that are equal; of what is given, those that coincide to 1e-10 too.
#include <gtest/gtest.h>

#include "tests/exact/exact_oracle.hpp"

namespace rockfold::test {
namespace {

constexpr Real size = 8;  // m: planes coincide to 8e-10 m

// A tilted plane, off the centre, whose normal is 7 long; and a horizontal one through the centre.
class PlaneIdentity : public testing::TestWithParam<Vec3> {
 protected:
  const Vec3 centre = GetParam();
  const Vec3 normal{2, -3, 6};
  const Vec3 unit = (1.0 / 7) * normal;
  const Vec3 across = normalized(cross(normal, {0, 0, 1}));
  const Vec3 point = centre + Vec3{0.5, 1, -0.25};
  PlaneTable table{centre, size};
  const Index horizontal = table.add(plane_through({0, 0, 1}, centre));
  const Index plane = table.add(plane_through(normal, point));

  // What a plane becomes, in a table of its own; none = added to it.
  HalfSpaceId equal_to(const ExactPlane& p) const {
    PlaneTable copy(table);
    return or_none(copy.find_or_add(p));
  }
  HalfSpaceId identified_with(const ExactPlane& p) const {
    PlaneTable copy(table);
    return or_none(copy.identify_or_add(p));
  }
  HalfSpaceId or_none(HalfSpaceId found) const {
    if (plane_of(found) < table.size()) return found;
    EXPECT_EQ(found, half_space(table.size(), true)) << "new planes are added with their own sense";
    return none;
  }
  // The tilted plane moved along its unit normal, m.
  ExactPlane moved(const Exact& distance) const {
    return plane_through(normal, point, 7 * distance);
  }
  // The same turned by a small angle about the foot of the centre on it: as far from the centre.
  ExactPlane turned(Real angle) const {
    return plane_through(unit + angle * across, centre + dot(unit, point - centre) * unit);
  }
  static ExactPlane scaled(const ExactPlane& p, const Exact& by) {
    return {{by * p.n[0], by * p.n[1], by * p.n[2]}, by * p.d};
  }
};

TEST_P(PlaneIdentity, FindsAnEqualPlaneThroughAnyOfItsPoints) {
  EXPECT_EQ(equal_to(plane_through(normal, point)), half_space(plane, true));
  EXPECT_EQ(equal_to(plane_through(normal, point + 3.0 * Vec3{3, 2, 0})), half_space(plane, true));
  EXPECT_EQ(equal_to(plane_through({0, 0, 1}, centre + Vec3{4, 4, 0})),
            half_space(horizontal, true));
}

TEST_P(PlaneIdentity, FindsAnEqualPlaneInEitherOrientation) {
  EXPECT_EQ(equal_to(plane_through(-normal, point)), half_space(plane, false));
  EXPECT_EQ(equal_to(opposite(plane_through({0, 0, 3}, centre))), half_space(horizontal, false));
}

TEST_P(PlaneIdentity, FindsAnEqualPlaneUnderANormalOfAnyLength) {
  const ExactPlane given = plane_through(normal, point);
  for (const Exact& length :
       {ten_to(-300), ten_to(-12), Exact(Exact(1) / Exact(3)), Exact(1), ten_to(200)}) {
    EXPECT_EQ(equal_to(scaled(given, length)), half_space(plane, true));
    EXPECT_EQ(equal_to(scaled(given, -length)), half_space(plane, false));
  }
}

TEST_P(PlaneIdentity, OfEqualityIsExact) {
  for (const Exact& distance : {ten_to(-12), ten_to(-17), ten_to(-30), ten_to(-300)}) {
    EXPECT_EQ(equal_to(moved(distance)), none);
    EXPECT_EQ(equal_to(moved(-distance)), none);
    const ExactPlane given = plane_through(normal, point);
    EXPECT_EQ(equal_to({{given.n[0] + distance, given.n[1], given.n[2]}, given.d}), none);
  }
  EXPECT_EQ(equal_to(moved(0)), half_space(plane, true));
}

TEST_P(PlaneIdentity, KeepsManyPlanesApartThatDifferByLessThanRounding) {
  std::vector<Index> ids{plane};
  for (int i = 1; i < 20; ++i)
    ids.push_back(plane_of(table.find_or_add(moved(Exact(i) * ten_to(-25)))));
  for (int i = 0; i < 20; ++i)
    EXPECT_EQ(equal_to(moved(Exact(i) * ten_to(-25))), half_space(ids[i], true)) << i;
  EXPECT_EQ(table.size(), plane + 20);
}

TEST_P(PlaneIdentity, OfGivenPlanesFollowsTheDistance) {
  for (const int sense : {-1, 1}) {
    const Exact within = Exact(sense) * decimal("0.99e-10") * Exact(size);
    const Exact beyond = Exact(sense) * decimal("1.01e-10") * Exact(size);
    EXPECT_EQ(identified_with(moved(within)), half_space(plane, true));
    EXPECT_EQ(identified_with(opposite(moved(within))), half_space(plane, false));
    EXPECT_EQ(identified_with(moved(beyond)), none);
    EXPECT_EQ(identified_with(opposite(moved(beyond))), none);
  }
}

TEST_P(PlaneIdentity, OfGivenPlanesFollowsTheAngle) {
  EXPECT_EQ(identified_with(turned(0.99e-10)), half_space(plane, true));
  EXPECT_EQ(identified_with(opposite(turned(0.99e-10))), half_space(plane, false));
  EXPECT_EQ(identified_with(turned(1.01e-10)), none);
  EXPECT_EQ(identified_with(opposite(turned(1.01e-10))), none);
}

TEST_P(PlaneIdentity, OfGivenPlanesDoesNotDependOnTheLengthOfTheNormal) {
  const Exact within = decimal("0.99e-10") * Exact(size),
              beyond = decimal("1.01e-10") * Exact(size);
  for (const Exact& length : {ten_to(-300), ten_to(-12), ten_to(12), ten_to(200)}) {
    EXPECT_EQ(identified_with(scaled(moved(within), length)), half_space(plane, true));
    EXPECT_EQ(identified_with(scaled(moved(within), -length)), half_space(plane, false));
    EXPECT_EQ(identified_with(scaled(moved(beyond), length)), none);
  }
}

TEST_P(PlaneIdentity, DoesNotTakeAMirrorImageForThePlane) {
  const ExactPlane mirrored = plane_through(normal, centre - (point - centre));
  EXPECT_EQ(equal_to(mirrored), none);
  EXPECT_EQ(identified_with(mirrored), none);
}

// Coincidence is not transitive: between two planes 1.5e-10 apart, what was added first counts.
TEST_P(PlaneIdentity, OfGivenPlanesTakesTheFirstOfSeveral) {
  const auto at = [&](const char* shares) { return moved(decimal(shares) * Exact(size)); };
  const Index second = table.add(at("1.5e-10"));
  EXPECT_EQ(identified_with(at("0.75e-10")), half_space(plane, true));
  EXPECT_EQ(identified_with(at("1.2e-10")), half_space(second, true));
}

TEST_P(PlaneIdentity, LeavesThePlaneThatWasThereAsItWas) {
  const HalfSpaceId found = table.identify_or_add(moved(decimal("0.5e-10")));
  ASSERT_EQ(found, half_space(plane, true));
  EXPECT_EQ(table.exact_side(point, plane), 0);
}

// At map coordinates points are exact multiples of 2⁻²⁹ m or so: all of those above are.
INSTANTIATE_TEST_SUITE_P(AboutTheOrigin, PlaneIdentity, testing::Values(Vec3{}));
INSTANTIATE_TEST_SUITE_P(AwayFromIt, PlaneIdentity, testing::Values(Vec3{16, -3.5, 0.25}));
INSTANTIATE_TEST_SUITE_P(AtMapCoordinates, PlaneIdentity, testing::Values(Vec3{5e6, 4e6, 1e3}));

}  // namespace
}  // namespace rockfold::test
