// The meeting point of three planes: its position, and the bound on its error.
#include <cmath>
#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

#include "tests/exact/exact_oracle.hpp"

namespace rockfold::test {
namespace {

class VertexPosition : public testing::Test {
 protected:
  Random random;

  // |x − the exact point|, m.
  static Real error_of(const Planes& planes, const Vertex& v) {
    ExactVec3 e = planes.meeting_point(v.plane);
    for (int d = 0; d < 3; ++d) e[d] -= Exact(v.x[d]);
    return std::sqrt(CGAL::to_double(Exact(dot(e, e))));
  }
};

TEST_F(VertexPosition, IsOffByNoMoreThanItsErrorBound) {
  Real largest_ratio = 0;
  for (int i = 0; i < 20000; ++i) {
    const Real size = std::pow(10.0, i % 9 - 3);
    Planes planes(i % 2 ? random.point(size) : Vec3{5e6, 4e6, 1e3}, size);
    const Vec3 centre = planes.table.centre();
    for (int p = 0; p < 3; ++p) planes.add(random.vector(), centre + random.point(size));
    const Vertex v = planes.table.vertex(0, 1, 2);
    const Real error = error_of(planes, v);
    ASSERT_LE(error, v.error);
    if (v.error > 0) largest_ratio = std::max(largest_ratio, error / v.error);
  }
  EXPECT_GT(largest_ratio, 1e-3) << "the bound is so loose that the filter hardly ever decides";
}

// Three planes that nearly share a line: numerator and denominator are cut off and their quotient is rounded, 1.5 ε at most.
TEST_F(VertexPosition, OfIllConditionedPlanesIsExactButForTheLastDigit) {
  constexpr Real epsilon = std::numeric_limits<Real>::epsilon();
  int checked = 0;
  for (int i = 0; i < 2000; ++i) {
    const Real angle = std::pow(10.0, -2 - i % 14);
    const Vec3 a = normalized(random.vector()), b = normalized(random.vector());
    const Vec3 c = normalized(random.unit(random.engine) * a + random.unit(random.engine) * b +
                              angle * random.vector());
    Planes planes({0.25, 0.5, -1}, 10);
    for (const Vec3& n : {a, b, c}) planes.add(n, random.point(10));
    const Vertex v = planes.table.vertex(0, 1, 2);
    ASSERT_LE(error_of(planes, v), v.error);
    if (std::abs(dot(a, cross(b, c))) > 0.01) continue;
    const ExactVec3 x = planes.meeting_point(v.plane);
    for (int d = 0; d < 3; ++d, ++checked)
      EXPECT_LE(std::abs(CGAL::to_double(Exact(Exact(v.x[d]) - x[d]))),
                1.5 * epsilon * std::abs(v.x[d]));
  }
  EXPECT_GT(checked, 4500);
}

TEST_F(VertexPosition, OfTwoNearlyParallelPlanesIsFarAwayAndRight) {
  Planes planes({}, 1);
  planes.add({0, 0, 1}, {});
  planes.add({1e-9, 0, 1}, {0, 0, 1});  // meets z = 0 at x = 1e9
  planes.add({0, 1, 0}, {});
  const Vertex v = planes.table.vertex(0, 1, 2);
  EXPECT_NEAR(v.x[0], 1e9, 1e-6);
  EXPECT_EQ(v.x[1], 0);
  EXPECT_EQ(v.x[2], 0);
}

TEST_F(VertexPosition, DoesNotDependOnTheOrderOfThePlanes) {
  for (int i = 0; i < 100; ++i) {
    Planes planes(random.point(3), 3);
    for (int p = 0; p < 3; ++p) planes.add(random.vector(), random.point(3));
    const Vertex v = planes.table.vertex(0, 1, 2);
    for (const auto& [p, q, r] :
         {std::array{0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}) {
      const Vertex w = planes.table.vertex(p, q, r);
      EXPECT_EQ(w.plane, v.plane);
      EXPECT_EQ(w.x, v.x);
      EXPECT_EQ(w.error, v.error);
    }
  }
}

TEST_F(VertexPosition, OfParallelPlanesIsAnError) {
  Planes planes({}, 1);
  planes.add({1, 2, 3}, {});
  planes.add({-2, -4, -6}, {1, 1, 1});
  planes.add({0, 0, 1}, {});
  EXPECT_THROW(planes.table.vertex(0, 1, 2), std::logic_error);
}

// Nothing is lost at map coordinates: positions are relative to the centre, and the planes are exact.
TEST_F(VertexPosition, AtMapCoordinatesIsAsExactAsAtTheOrigin) {
  const Vec3 centre{5e6, 4e6, 1e3}, o = centre + Vec3{0.5, 0.25, -0.125};
  Planes planes(centre, 2);
  planes.add({1, 1, 0}, o);
  planes.add({0, 1, -1}, o);
  planes.add({1, 0, 3}, o);
  const Vertex v = planes.table.vertex(0, 1, 2);
  const Vec3 expected{0.5, 0.25, -0.125};
  for (int d = 0; d < 3; ++d) EXPECT_NEAR(v.x[d], expected[d], 2e-15);
}

}  // namespace
}  // namespace rockfold::test
