// A number is the shortest decimal that reads back as its double; a plane is what such numbers say, exactly.
#include <bit>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>

#include <gtest/gtest.h>

#include "tests/exact/exact_oracle.hpp"

namespace rockfold::test {
namespace {

// With that many significant digits, correctly rounded.
std::string text_of(Real x, int digits) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*e", digits - 1, x);
  return text;
}

// The shortest that reads back, by trying.
std::string shortest(Real x) {
  int digits = 1;
  while (std::strtod(text_of(x, digits).c_str(), nullptr) != x) ++digits;
  return text_of(x, digits);
}

// Finite doubles of all signs, sizes and digits.
class AnyDouble {
 public:
  Real operator()() {
    while (true)
      if (const Real x = std::bit_cast<Real>(engine_()); std::isfinite(x)) return x;
  }

 private:
  std::mt19937_64 engine_{20261121};
};

TEST(ExactNumber, OfOneTenthIsOneTenth) {
  EXPECT_EQ(exact(0.1), Exact(1) / Exact(10));
  EXPECT_NE(exact(0.1), Exact(0.1)) << "the double itself is 3602879701896397/2^55";
  EXPECT_EQ(exact(0.1) + exact(0.2), exact(0.3));
}

TEST(ExactNumber, IsTheTextThatTheUserWrote) {
  for (const char* text :
       {"0.1", "-0.1", "0.25", "123456.789", "-4567891.23", "5000000.001", "0.000125", "1e-7",
        "-3e-12", "999999999999999", "1.23456789012345", "9.99999999999999e-5", "1e22", "1e23",
        "6.02214076e23", "-1e100", "1e300", "2.5e-300"})
    EXPECT_EQ(exact(std::strtod(text, nullptr)), decimal(text)) << text;
}

TEST(ExactNumber, IsTextOfUpToFifteenDigitsAsItWasWritten) {
  std::mt19937_64 engine{15};
  for (int i = 0; i < 20000; ++i) {
    const int digits = 1 + i % 15;
    std::string text = i % 2 ? "-" : "";
    for (int d = 0; d < digits; ++d) {
      text += static_cast<char>('0' + engine() % 10);
      if (d == 0) text += '.';
    }
    text += "e" + std::to_string(static_cast<int>(engine() % 41) - 20);
    ASSERT_EQ(exact(std::strtod(text.c_str(), nullptr)), decimal(text)) << text;
  }
}

TEST(ExactNumber, IsTheShortestDecimalThatReadsBack) {
  AnyDouble any;
  for (int i = 0; i < 1000; ++i) {
    const Real x = any();
    ASSERT_EQ(exact(x), decimal(shortest(x))) << shortest(x);
  }
}

// Nearer to its double than to the middle between that and the next one.
TEST(ExactNumber, ReadsBackAsItsDouble) {
  AnyDouble any;
  constexpr Real infinity = std::numeric_limits<Real>::infinity();
  for (int i = 0; i < 1000; ++i) {
    const Real x = any(), above = std::nextafter(x, infinity), below = std::nextafter(x, -infinity);
    if (!std::isfinite(above) || !std::isfinite(below)) continue;
    EXPECT_LE(2 * exact(x), Exact(x) + Exact(above));
    EXPECT_GE(2 * exact(x), Exact(x) + Exact(below));
  }
}

TEST(ExactNumber, HasTheSignOfItsDouble) {
  AnyDouble any;
  for (int i = 0; i < 1000; ++i) {
    const Real x = any();
    EXPECT_EQ(exact(-x), -exact(x));
    EXPECT_EQ(exact(x) > 0, x > 0);
  }
  EXPECT_EQ(exact(0.0), 0);
  EXPECT_EQ(exact(-0.0), 0);
}

TEST(ExactNumber, OfAnIntegerBelowTwoToThe53IsTheInteger) {
  for (const Real x : {1.0, -1.0, 7.0, 5e6, 1e15, 9007199254740991.0, -9007199254740991.0})
    EXPECT_EQ(exact(x), Exact(x)) << x;
}

// 2^60 is 1152921504606846976, but 1152921504606847000 reads back as the same double with fewer digits.
TEST(ExactNumber, OfALargerIntegerIsItsShortestDecimal) {
  EXPECT_EQ(exact(std::ldexp(1.0, 60)), decimal("1152921504606847e3"));
  EXPECT_EQ(exact(9007199254740992.0), Exact(9007199254740992.0));
  EXPECT_EQ(exact(9007199254740994.0), Exact(9007199254740994.0));
}

TEST(ExactNumber, OfTheLargestAndTheSmallestDoublesIsTheirShortestDecimal) {
  using Limits = std::numeric_limits<Real>;
  EXPECT_EQ(exact(Limits::max()), decimal("1.7976931348623157e308"));
  EXPECT_EQ(exact(Limits::lowest()), decimal("-1.7976931348623157e308"));
  EXPECT_EQ(exact(Limits::min()), decimal("2.2250738585072014e-308"));
  EXPECT_EQ(exact(Limits::denorm_min()), decimal("5e-324"));
  EXPECT_EQ(exact(1.5e-320), decimal("1.5e-320"));
  EXPECT_EQ(exact(-Limits::denorm_min()), decimal("-5e-324"));
}

TEST(PlaneThrough, PassesThroughItsPointExactly) {
  const Vec3 n{0.1, 0.7, -1.0 / 3}, p{5e6 + 0.1, 4e6 - 1.0 / 7, 1e3 / 3};
  const ExactPlane plane = plane_through(n, p);
  EXPECT_EQ(dot(plane.n, exact(p)), plane.d);
  EXPECT_EQ(plane.n[0], decimal("0.1"));
}

TEST(PlaneThrough, MovesAlongTheNormal) {
  const ExactPlane plane = plane_through({0, 0, 1}, {1, 2, 0.3}, ten_to(-30));
  EXPECT_EQ(plane.d, decimal("0.3") + ten_to(-30));
}

TEST(PlaneThroughPoints, PassesThroughAllThreeExactlyAndFacesTheirTurn) {
  const Vec3 a{0.1, 0.2, 0.3}, b{1.7, -0.4, 1e6 + 0.1}, c{-3.3, 2.9, 0.7};
  const ExactPlane plane = plane_through_points(exact(a), exact(b), exact(c));
  for (const Vec3& p : {a, b, c}) EXPECT_EQ(dot(plane.n, exact(p)), plane.d);
  const ExactPlane up =
      plane_through_points(exact(Vec3{0, 0, 1}), exact(Vec3{1, 0, 1}), exact(Vec3{0, 1, 1}));
  EXPECT_GT(up.n[2], 0);
}

TEST(PlaneAlong, PassesThroughItsPointAndBothDirectionsExactly) {
  const ExactVec3 point = exact(Vec3{0.1, 0.2, 0.3}), u = exact(Vec3{0.7, 1e-9, 3}),
                  v = exact(Vec3{-0.3, 0.4, 1e6});
  const ExactPlane plane = plane_along(point, u, v);
  EXPECT_EQ(dot(plane.n, point), plane.d);
  EXPECT_EQ(dot(plane.n, u), 0);
  EXPECT_EQ(dot(plane.n, v), 0);
}

// In least integers and about the centre: what the same plane in fractions is.
TEST(PlaneThroughEdge, IsThePlaneOfItsFractions) {
  const Vec3 points[] = {{0.1, 0.2, 0.3},           {1.7, -0.4, 1e6 + 0.1}, {-3.3, 1.0 / 7, 2},
                         {500000.25, 4e6 - 0.1, 3}, {1e-9, 2e-20, -5e15},   {1, 2, 3}};
  const Vec3 normals[] = {{0, 0, 1}, {1.0 / 3, -2.0 / 3, 0.1}, {1e-8, 1, -1e-8}};
  const Vec3 centres[] = {{0, 0, 0}, {499999.125, 1.0 / 3, -7e-5}};
  for (const Vec3& a : points)
    for (const Vec3& b : points)
      for (const Vec3& normal : normals)
        for (const Vec3& centre : centres) {
          const ExactVec3 p = exact(a), q = exact(b);
          const ExactPlane plane =
              plane_along(p, {q[0] - p[0], q[1] - p[1], q[2] - p[2]}, exact(normal));
          if (plane.n[0] == 0 && plane.n[1] == 0 && plane.n[2] == 0) continue;
          const IntegerPlane expected = integers(plane.n, plane.d - dot(plane.n, exact(centre)));
          const IntegerPlane found = plane_through_edge(a, b, normal, centre);
          EXPECT_EQ(found.n, expected.n);
          EXPECT_EQ(found.d, expected.d);
        }
}

TEST(Opposite, IsTheSamePlaneSeenFromBelow) {
  const ExactPlane plane = plane_through({0.1, -2, 3}, {0.4, 0.5, 0.6}), other = opposite(plane);
  EXPECT_EQ(other.d, -plane.d);
  for (int d = 0; d < 3; ++d) EXPECT_EQ(other.n[d], -plane.n[d]);
}

TEST(RoundedPlane, HasAUnitNormalWhateverTheLengthGiven) {
  for (const Real length : {1e-300, 1e-12, 1.0, 1e12, 1e300}) {
    const UnitPlane plane =
        rounded(plane_through(length * Vec3{2, -3, 6}, {0.5, 1, -0.25}), {0, 0, 0});
    EXPECT_NEAR(plane.normal[0], 2.0 / 7, 1e-15) << length;
    EXPECT_NEAR(plane.normal[1], -3.0 / 7, 1e-15) << length;
    EXPECT_NEAR(plane.normal[2], 6.0 / 7, 1e-15) << length;
    EXPECT_NEAR(plane.offset, -3.5 / 7, 1e-15) << length;
  }
}

}  // namespace
}  // namespace rockfold::test
