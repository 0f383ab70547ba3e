// Volume and first moment of cells so thin that doubles cannot measure them.
#include <gtest/gtest.h>

#include "tests/exact/exact_oracle.hpp"

namespace rockfold::test {
namespace {

using Triangles = std::vector<std::array<Index, 3>>;

// Vertex i is the meeting of all planes but i.
std::vector<Vertex> tetrahedron(const PlaneTable& table) {
  return {table.vertex(1, 2, 3), table.vertex(0, 2, 3), table.vertex(0, 1, 3),
          table.vertex(0, 1, 2)};
}
const Triangles faces{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};

// x, y, z ≥ 0, x + y + z ≤ 3·t, about a centre elsewhere: volume (3t)³/6, centroid at 3t/4 along each axis.
TEST(ExactMoments, OfATinyCornerAreItsClosedForm) {
  for (const int power : {1, 9, 30, 50}) {
    PlaneTable table({0.5, 0.25, 3}, 1);
    for (const Vec3& n : {Vec3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}) table.add(plane_through(n, {}));
    table.add(plane_through({1, 1, 1}, {}, 3 * ten_to(-power)));
    const auto m = table.exact_moments(tetrahedron(table), faces);
    const Real t = std::pow(10.0, -power),
               volume = -27 * t * t * t / 6;  // the order above is inside out
    EXPECT_NEAR(m.volume / volume, 1, 1e-14) << power;
    const Vec3 centroid = Vec3{0.75 * t, 0.75 * t, 0.75 * t} - table.centre();
    for (int d = 0; d < 3; ++d) EXPECT_NEAR(m.first[d] / (volume * centroid[d]), 1, 1e-14) << power;
  }
}

// A plate 1 m wide and long, t thick: two planes that doubles cannot tell apart.
TEST(ExactMoments, OfAPlateThinnerThanRoundingAreItsClosedForm) {
  for (const int power : {12, 17, 30, 45}) {
    PlaneTable table({5e6, 4e6, 1e3}, 10);
    Index at[3][2];
    for (int d = 0; d < 3; ++d)
      for (int s = 0; s < 2; ++s) {
        Vec3 n{};
        n[d] = 1;
        const Exact offset = s == 0 ? Exact(0) : d == 2 ? ten_to(-power) : Exact(1);
        at[d][s] = table.add(plane_through(n, {5e6 + 2, 4e6, 1e3 - 0.125}, offset));
      }
    std::vector<Vertex> corner;
    for (int c = 0; c < 8; ++c)
      corner.push_back(table.vertex(at[0][c & 1], at[1][c >> 1 & 1], at[2][c >> 2 & 1]));
    const Triangles box{{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                        {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
    const auto m = table.exact_moments(corner, box);
    const Real t = std::pow(10.0, -power);
    EXPECT_NEAR(m.volume / t, 1, 1e-14) << power;
    EXPECT_NEAR(m.first[0] / (2.5 * t), 1, 1e-14) << power;
    EXPECT_NEAR(m.first[1] / (0.5 * t), 1, 1e-14) << power;
    EXPECT_NEAR(m.first[2] / (-0.125 * t), 1, 1e-11) << power;
  }
}

// Four random planes that miss a common point by 1e-5 … 1e-39 of the size.
TEST(ExactMoments, OfIrregularSliversAreThoseOfRationalArithmetic) {
  Random random;
  for (int i = 0; i < 500; ++i) {
    const Vec3 common = random.point(10);
    Planes planes(random.point(10), 10);
    for (int p = 0; p < 4; ++p)
      planes.add(random.vector(), common, p == 3 ? ten_to(-4 - i % 35) : Exact(0));
    const auto vertices = tetrahedron(planes.table);
    std::vector<ExactVec3> x;
    for (const Vertex& v : vertices) x.push_back(planes.meeting_point(v.plane));
    ExactVec3 edge[3], first;
    for (int k = 0; k < 3; ++k)
      for (int d = 0; d < 3; ++d) edge[k][d] = x[k + 1][d] - x[0][d];
    const Exact volume = dot(edge[0], cross(edge[1], edge[2])) / 6;
    for (int d = 0; d < 3; ++d) first[d] = volume * (x[0][d] + x[1][d] + x[2][d] + x[3][d]) / 4;
    const auto m = planes.table.exact_moments(vertices, faces);
    EXPECT_NEAR(m.volume / CGAL::to_double(volume), 1, 1e-13);
    for (int d = 0; d < 3; ++d) EXPECT_NEAR(m.first[d] / CGAL::to_double(first[d]), 1, 1e-13);
  }
}

}  // namespace
}  // namespace rockfold::test
