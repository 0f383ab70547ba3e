// The one predicate: on which side of a plane the meeting point of three others lies. The answer is the exact sign, always.
#include <algorithm>

#include <gtest/gtest.h>

#include "tests/exact/exact_oracle.hpp"

namespace rockfold::test {
namespace {

class Side : public testing::Test {
 protected:
  Random random;
  int checked = 0, on = 0;

  // Each of planes 0 … 3 against the meeting point of the other three.
  void check_quadruple(const Planes& planes) {
    for (Index s = 0; s < 4; ++s) {
      const std::array<Index, 3> p{(s + 1) % 4, (s + 2) % 4, (s + 3) % 4};
      if (planes.determinant(p) == 0) continue;
      const int expected = planes.side(p, s);
      const Vertex vertex = planes.table.vertex(p[0], p[1], p[2]);
      ASSERT_EQ(planes.table.side(vertex, s), expected)
          << "plane " << s << ", distance " << planes.table.distance(vertex, s);
      ++checked;
      on += expected == 0 ? 1 : 0;
    }
  }
};

TEST_F(Side, OfRandomPlanesIsTheExactSign) {
  for (int i = 0; i < 2000; ++i) {
    const Real size = std::pow(10.0, i % 9 - 3);
    const Vec3 centre = i % 3 == 0 ? Vec3{5e6, 4e6, 1e3} : random.point(10);
    Planes planes(centre, size);
    for (int p = 0; p < 4; ++p) planes.add(random.vector(), centre + random.point(size));
    check_quadruple(planes);
  }
  EXPECT_EQ(checked, 8000);
}

// Small integers: many quadruples meet in one point.
TEST_F(Side, OfLatticePlanesIsTheExactSign) {
  std::uniform_int_distribution<int> small(-3, 3);
  const auto any = [&] { return 1.0 * small(random.engine); };
  for (int i = 0; i < 4000; ++i) {
    Planes planes({}, 4);
    for (int p = 0; p < 4; ++p) {
      Vec3 n{};
      while (norm(n) == 0) n = {any(), any(), any()};
      planes.add(n, {any() / 2, any() / 2, any() / 2});
    }
    check_quadruple(planes);
  }
  EXPECT_GT(on, 100);
}

// Four planes through one point, but that the fourth misses it by 1e-9 … 1e-30 of the size: no tolerance makes them one.
TEST_F(Side, OfNearlyConcurrentPlanesIsTheExactSignHoweverNear) {
  for (int i = 0; i < 4000; ++i) {
    const Real size = std::pow(10.0, i % 7 - 3);
    const Vec3 common = random.point(size);
    Planes planes(i % 5 == 0 ? Vec3{5e6, 4e6, 1e3} : random.point(size), size);
    for (int p = 0; p < 3; ++p) planes.add(random.vector(), common);
    const int miss = i % 3 - 1;
    planes.add(random.vector(), common, Exact(miss) * exact(size) * ten_to(-9 - i % 22));
    check_quadruple(planes);
    EXPECT_EQ(planes.table.side(planes.table.vertex(0, 1, 2), 3), -miss);
  }
  EXPECT_GT(checked, 15900);
}

// As above, the fourth plane turned from the first by 1e-2 … 1e-15 besides.
TEST_F(Side, OfNearlyParallelPlanesIsTheExactSignWhateverTheAngle) {
  for (int i = 0; i < 4000; ++i) {
    const Real size = std::pow(10.0, i % 5 - 2);
    const Vec3 common = random.point(size), first = normalized(random.vector());
    Planes planes(random.point(size), size);
    planes.add(first, common);
    planes.add(random.vector(), common);
    planes.add(random.vector(), common);
    const Vec3 across = normalized(cross(first, random.vector()));
    planes.add(first + std::pow(10.0, -2 - i % 14) * across, common,
               Exact(i % 3 - 1) * exact(size) * ten_to(-8 - i % 13));
    check_quadruple(planes);
  }
  EXPECT_GT(checked, 15000);
}

// Three planes that nearly share a line meet far away, or at a place that doubles do not know.
TEST_F(Side, OfAVertexOfIllConditionedPlanesIsTheExactSign) {
  for (int i = 0; i < 3000; ++i) {
    const Vec3 a = random.vector(), b = random.vector();
    const Vec3 c = random.unit(random.engine) * a + random.unit(random.engine) * b +
                   std::pow(10.0, -2 - i % 14) * random.vector();
    Planes planes({0.25, 0.5, -1}, 10);
    for (const Vec3& n : {a, b, c, random.vector()}) planes.add(n, random.point(10));
    check_quadruple(planes);
  }
  EXPECT_GT(checked, 11900);
}

// A pencil of planes about one line to rounding: exact arithmetic sees that they have no line in common.
TEST_F(Side, OfPlanesThroughOneLineButForRoundingIsTheExactSign) {
  for (int i = 0; i < 1000; ++i) {
    const Vec3 point = random.point(100), along = random.vector();
    Planes planes({1, 2, 3}, 100);
    for (int p = 0; p < 3; ++p) planes.add(normalized(cross(along, random.vector())), point);
    planes.add(along, random.point(100));
    check_quadruple(planes);
  }
  EXPECT_LT(on, checked / 10);
}

// Joints through the centre of a model: offsets are next to nothing, and so are the bounds of their errors.
TEST_F(Side, AboutTheTablesCentreIsTheExactSignHoweverSmallTheOffsets) {
  for (int i = 0; i < 8000; ++i) {
    const Real tiny = std::pow(10.0, -10 - i % 51);
    const Vec3 common = tiny * random.vector(), a = random.vector(), b = random.vector();
    Planes planes({}, 1);
    planes.add(a, common);
    planes.add(b, common);
    planes.add(a + b + 0.2 * random.vector(), common);
    planes.add(random.vector(), common, Exact(i % 3 - 1) * exact(tiny) * ten_to(-13 - i % 7));
    check_quadruple(planes);
  }
  EXPECT_GT(checked, 31900);
}

TEST_F(Side, OfAVertexOnItsOwnPlanesIsOn) {
  Planes planes({}, 1);
  for (int p = 0; p < 3; ++p) planes.add(random.vector(), random.point(1));
  for (Index p = 0; p < 3; ++p) EXPECT_EQ(planes.table.side(planes.table.vertex(2, 0, 1), p), 0);
}

TEST_F(Side, FollowsTheDirectionOfTheNormalAndNotItsLength) {
  PlaneTable table({}, 1);
  const Index x = table.add(plane_through({1, 0, 0}, {0.5, 0, 0}));
  const Index y = table.add(plane_through({0, 1, 0}, {}));
  const Index z = table.add(plane_through({0, 0, 1}, {}));
  const Vertex corner = table.vertex(x, y, z);  // (1/2, 0, 0)
  for (const Real length : {1e-200, 1e-12, 1.0, 1e12, 1e200}) {
    const Vec3 n{length, length, length};
    EXPECT_EQ(table.side(corner, table.add(plane_through(n, {}))), 1) << length;
    EXPECT_EQ(table.side(corner, table.add(plane_through(-n, {}))), -1) << length;
    EXPECT_EQ(table.side(corner, table.add(plane_through(n, {0, 0.5, 0}))), 0) << length;
    EXPECT_EQ(table.side(corner, table.add(plane_through(n, {0, 0, 1}))), -1) << length;
  }
}

// Of a point instead of a vertex, in model coordinates.
class SideOfAPoint : public testing::Test {
 protected:
  Random random;
};

TEST_F(SideOfAPoint, IsOnForTheDecimalsThatAPlaneIsThrough) {
  PlaneTable table({5e6, 0.3, -7}, 100);
  const Vec3 a{0.1, 0.2, 0.3}, b{1.7, -0.4, 1e6 + 0.1}, c{-3.3, 2.9, 0.7};
  const Index plane = table.add(plane_through_points(exact(a), exact(b), exact(c)));
  for (const Vec3& x : {a, b, c}) EXPECT_EQ(table.exact_side(x, plane), 0);
  // 1/10, 2/10 and 3/10 lie on x + y = z; their doubles do not.
  EXPECT_EQ(table.exact_side(a, table.add(plane_through({1, 1, -1}, {}))), 0);
}

TEST_F(SideOfAPoint, SeesTheLastDigitAndLess) {
  PlaneTable table({1, 1, 1}, 10);
  const Vec3 x{0.1, 0.2, 0.3};
  const Index on = table.add(plane_through({0, 0, 1}, x));
  EXPECT_EQ(table.exact_side(Vec3{0.1, 0.2, std::nextafter(0.3, 1.0)}, on), 1);
  EXPECT_EQ(table.exact_side(Vec3{0.1, 0.2, std::nextafter(0.3, 0.0)}, on), -1);
  EXPECT_EQ(table.exact_side(x, table.add(plane_through({0, 0, 1}, x, ten_to(-300)))), -1);
  EXPECT_EQ(table.exact_side(x, table.add(plane_through({0, 0, 1}, x, -ten_to(-300)))), 1);
}

TEST_F(SideOfAPoint, IsTheExactSign) {
  for (int i = 0; i < 2000; ++i) {
    const Vec3 centre = i % 2 ? Vec3{5e6, 4e6, 1e3} : random.point(10);
    const Vec3 n = random.vector(), x = centre + random.point(2);
    PlaneTable table(centre, 2);
    const Index plane = table.add(plane_through(n, centre + random.point(2)));
    const Index through = table.add(plane_through(n, x, Exact(i % 3 - 1) * ten_to(-i % 40)));
    const Index own = plane_of(table.find_or_add(plane_through(n, x)));
    EXPECT_EQ(table.exact_side(x, through), 1 - i % 3);
    EXPECT_EQ(table.exact_side(x, own), 0);
    const Real distance = dot(table.normal(plane), x - centre) - table.offset(plane);
    if (std::abs(distance) > 1e-9) {
      EXPECT_EQ(table.exact_side(x, plane), distance > 0 ? 1 : -1);
    }
  }
}

// What cutting knows of a vertex beyond its three planes.
class NotedPlanes : public testing::Test {
 protected:
  // 0, 1, 2: the axes' planes; 3 … 6 pass through the origin too; 7 and 8 miss it by some 1e-40 m on either side.
  NotedPlanes() {
    for (const Vec3& n :
         {Vec3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}, {1, -2, 3}, {2, 1, 0}, {0, 1, 5}})
      table.add(plane_through(n, {}));
    table.add(plane_through({1, 2, 4}, {}, ten_to(-40)));
    table.add(plane_through({1, 2, 4}, {}, -ten_to(-40)));
    vertex = table.vertex(0, 1, 2);
  }
  PlaneTable table{{}, 1};
  Vertex vertex;
};

TEST_F(NotedPlanes, AreOnWithoutAskingThePlane) {
  vertex.note(7);
  EXPECT_EQ(table.side(vertex, 7), 0);
}

TEST_F(NotedPlanes, DoNotChangeOtherAnswers) {
  const auto answers = [&] {
    std::vector<int> sides;
    for (Index p = 0; p < table.size(); ++p) sides.push_back(table.side(vertex, p));
    return sides;
  };
  const std::vector<int> expected{0, 0, 0, 0, 0, 0, 0, -1, 1};
  EXPECT_EQ(answers(), expected);
  for (const Index p : {3, 4, 5, 6}) {
    vertex.note(p);
    EXPECT_EQ(answers(), expected);
  }
}

TEST_F(NotedPlanes, AreTheVertexOwnAndTwoMore) {
  for (const Index p : {0, 2, 3, 3, 1, 4, 5}) vertex.note(p);
  EXPECT_EQ(vertex.also, (std::array<Index, 2>{3, 4}));
  for (Index p = 0; p < 5; ++p) EXPECT_TRUE(vertex.is_on(p));
  EXPECT_FALSE(vertex.is_on(5));
  EXPECT_EQ(vertex.plane, (std::array<Index, 3>{0, 1, 2}));
}

}  // namespace
}  // namespace rockfold::test
