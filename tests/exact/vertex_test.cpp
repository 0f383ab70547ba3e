// The meeting point of three planes: its position, and the bound on its error.
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include <gtest/gtest.h>

#include "src/base/vector.hpp"
#include "tests/exact/exact_oracle.hpp"

namespace rockfold::test {
namespace {

class VertexPosition : public testing::Test {
 protected:
  std::mt19937 random{4};
  std::normal_distribution<Real> gauss;
  std::uniform_real_distribution<Real> unit{-1, 1};
  Vec3 any_vector() { return {gauss(random), gauss(random), gauss(random)}; }
  Vec3 any_point(Real size) {
    return {size / 2 * unit(random), size / 2 * unit(random), size / 2 * unit(random)};
  }

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
    Planes planes(i % 2 ? any_point(size) : Vec3{5e6, 4e6, 1e3}, size);
    const Vec3 centre = planes.table.centre();
    for (int p = 0; p < 3; ++p) planes.add(any_vector(), centre + any_point(size));
    const Vertex v = planes.table.vertex(0, 1, 2);
    const Real error = error_of(planes, v);
    ASSERT_LE(error, v.error);
    if (v.error > 0) largest_ratio = std::max(largest_ratio, error / v.error);
  }
  EXPECT_GT(largest_ratio, 1e-3) << "the bound is so loose that the filter hardly ever decides";
}

// Three planes that nearly share a line: the error bound holds, and the position is exact to its last digit.
TEST_F(VertexPosition, OfIllConditionedPlanesIsRoundedOnce) {
  for (int i = 0; i < 2000; ++i) {
    const Real angle = std::pow(10.0, -2 - i % 9);
    const Vec3 a = normalized(any_vector()), b = normalized(any_vector());
    const Vec3 c = normalized(unit(random) * a + unit(random) * b + angle * any_vector());
    Planes planes({0.25, 0.5, -1}, 10);
    for (const Vec3& n : {a, b, c}) planes.add(n, any_point(10));
    const Vertex v = planes.table.vertex(0, 1, 2);
    const ExactVec3 x = planes.meeting_point(v.plane);
    ASSERT_LE(error_of(planes, v), v.error);
    if (std::abs(dot(a, cross(b, c))) > 0.01) continue;
    for (int d = 0; d < 3; ++d) {
      const Real ulp = std::nextafter(std::abs(v.x[d]), std::numeric_limits<Real>::infinity()) -
                       std::abs(v.x[d]);
      const Exact difference = Exact(v.x[d]) - x[d];
      EXPECT_LE(std::abs(CGAL::to_double(difference)), ulp);
    }
  }
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
    Planes planes(any_point(3), 3);
    for (int p = 0; p < 3; ++p) planes.add(any_vector(), any_point(3));
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

TEST(ExactMoments, OfASliverTetrahedronAreExact) {
  // x, y, z ≥ 0, x + y + z ≤ 3·t with t = 2⁻³⁰: volume (3t)³/6, centroid at 3t/4 along each axis.
  const Real t = std::ldexp(1.0, -30);
  Planes planes({0.5, 0.5, 0.5}, 1);
  planes.add({1, 0, 0}, {});
  planes.add({0, 1, 0}, {});
  planes.add({0, 0, 1}, {});
  planes.add({1, 1, 1}, {t, t, t});
  std::vector<Vertex> v;
  for (const auto& [p, q, r] : {std::array{0, 1, 2}, {1, 2, 3}, {0, 2, 3}, {0, 1, 3}})
    v.push_back(planes.table.vertex(p, q, r));
  const auto m = planes.table.exact_moments(v, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}});
  const Real volume = 27 * t * t * t / 6;
  EXPECT_DOUBLE_EQ(m.volume, volume);
  for (int d = 0; d < 3; ++d) EXPECT_DOUBLE_EQ(m.first[d], volume * (0.75 * t - 0.5));
}

}  // namespace
}  // namespace rockfold::test
