#include "src/io/triangulate.hpp"

#include <cmath>
#include <map>
#include <random>

#include <gtest/gtest.h>

#include "src/base/vector.hpp"

namespace rockfold {
namespace {

struct Polygon {
  std::vector<Vec3> points;
  std::vector<std::vector<Index>> loops;
};

/// A plane polygon from loops of (x, y), laid into an inclined plane off the origin.
constexpr Vec3 u_axis{0.6, 0, 0.8}, v_axis{0.64, 0.6, -0.48};  // orthonormal
const Vec3 plane_normal = cross(u_axis, v_axis);

Polygon in_plane(const std::vector<std::vector<std::array<Real, 2>>>& loops) {
  Polygon polygon;
  for (const auto& loop : loops) {
    polygon.loops.emplace_back();
    for (const auto& [x, y] : loop) {
      polygon.loops.back().push_back(static_cast<Index>(polygon.points.size()));
      polygon.points.push_back(Vec3{100, -20, 7} + x * u_axis + y * v_axis);
    }
  }
  return polygon;
}

Real signed_area(const std::vector<Index>& loop, const std::vector<Vec3>& points,
                 const Vec3& normal) {
  Vec3 sum{};
  for (std::size_t i = 0; i < loop.size(); ++i)
    sum += cross(points[loop[i]] - points[loop[0]],
                 points[loop[(i + 1) % loop.size()]] - points[loop[0]]);
  return dot(sum, normal) / 2;
}

/// Each triangle has positive area, the areas add up to the polygon's, and the edges fit: those of
/// the loops are used once in their sense, all others once in each sense. Together: the triangles
/// tile the polygon.
void expect_tiling(const Polygon& polygon, const Vec3& normal) {
  const std::vector<Loop> loops(polygon.loops.begin(), polygon.loops.end());
  const auto triangles = triangulate(loops, polygon.points, normal);
  std::map<std::pair<Index, Index>, int> uses;
  Real expected = 0, found = 0;
  std::size_t corners = 0;
  for (const auto& loop : polygon.loops) {
    expected += signed_area(loop, polygon.points, normal);
    corners += loop.size();
    for (std::size_t i = 0; i < loop.size(); ++i) --uses[{loop[i], loop[(i + 1) % loop.size()]}];
  }
  for (const auto& t : triangles) {
    const Real area = signed_area({t[0], t[1], t[2]}, polygon.points, normal);
    EXPECT_GT(area, 0);
    found += area;
    for (int i = 0; i < 3; ++i) ++uses[{t[i], t[(i + 1) % 3]}];
  }
  EXPECT_NEAR(found, expected, 1e-12 * std::abs(expected) * static_cast<Real>(corners));
  EXPECT_EQ(triangles.size(), corners + 2 * (loops.size() - 1) - 2);
  for (const auto& [edge, count] : uses) {
    const auto reverse = uses.find({edge.second, edge.first});
    EXPECT_EQ(count, reverse == uses.end() ? 0 : reverse->second)
        << edge.first << " " << edge.second;
  }
}

void expect_tiling(const Polygon& polygon) {
  expect_tiling(polygon, plane_normal);
}

const std::vector<std::array<Real, 2>> square{{0, 0}, {4, 0}, {4, 4}, {0, 4}};

TEST(Triangulate, AConvexPolygon) {
  expect_tiling(in_plane({square}));
}

TEST(Triangulate, AnL) {
  expect_tiling(in_plane({{{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}}}));
}

TEST(Triangulate, AComb) {
  std::vector<std::array<Real, 2>> comb{{0, 0}, {9, 0}};
  for (int tooth = 4; tooth >= 0; --tooth)
    for (const auto& corner : {std::array<Real, 2>{2. * tooth + 1, 5},
                               {2. * tooth, 5},
                               {2. * tooth, 1},
                               {2. * tooth - 1, 1}})
      if (tooth > 0 || corner[1] == 5) comb.push_back(corner);
  expect_tiling(in_plane({comb}));
}

TEST(Triangulate, CornersOnStraightEdgesStay) {
  expect_tiling(
      in_plane({{{0, 0}, {1, 0}, {2, 0}, {4, 0}, {4, 1}, {4, 4}, {3, 4}, {0, 4}, {0, 2}}}));
}

TEST(Triangulate, AHole) {
  expect_tiling(in_plane({square, {{1, 1}, {1, 3}, {3, 3}, {3, 1}}}));
}

TEST(Triangulate, HolesInARowAndAboveEachOther) {
  std::vector<std::vector<std::array<Real, 2>>> loops{{{0, 0}, {20, 0}, {20, 20}, {0, 20}}};
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 5; ++j) {
      const Real x = 4. * i + 1, y = 4. * j + 1;
      loops.push_back({{x, y}, {x, y + 2}, {x + 2, y + 2}, {x + 2, y}});
    }
  expect_tiling(in_plane(loops));
}

/// All triangles positive and the area right; the corners that meet are points of their own.
void expect_area(const Polygon& polygon, Real expected) {
  const std::vector<Loop> loops(polygon.loops.begin(), polygon.loops.end());
  Real area = 0;
  for (const auto& t : triangulate(loops, polygon.points, plane_normal)) {
    area += signed_area({t[0], t[1], t[2]}, polygon.points, plane_normal);
    EXPECT_GT(signed_area({t[0], t[1], t[2]}, polygon.points, plane_normal), 0);
  }
  EXPECT_NEAR(area, expected, 1e-12);
}

TEST(Triangulate, AHoleThatTouchesTheBoundaryAtACorner) {
  expect_area(in_plane({{{0, 0}, {4, 0}, {4, 4}, {2, 4}, {0, 4}}, {{2, 4}, {3, 2}, {1, 2}}}), 14);
}

TEST(Triangulate, HolesThatTouchEachOtherAndTheBoundary) {
  expect_area(in_plane({{{0, 0}, {9, 0}, {9, 6}, {0, 6}},
                        {{4, 3}, {3, 2}, {2, 3}, {3, 4}},
                        {{4, 3}, {5, 4}, {6, 3}, {5, 2}}}),
              50);
  expect_area(in_plane({{{0, 0}, {9, 0}, {9, 3}, {9, 6}, {0, 6}},
                        {{4, 3}, {3, 2}, {2, 3}, {3, 4}},
                        {{4, 3}, {5, 4}, {9, 3}, {5, 2}}}),
              47);
}

TEST(Triangulate, SeenFromBelow) {
  for (const Vec3& normal :
       {Vec3{0, 0, -1}, {0, 0, 1}, {0, -1, 0}, {0, 1, 0}, {-1, 0, 0}, {1, 0, 0}}) {
    Polygon polygon;
    const int d = normal[0] != 0 ? 0 : normal[1] != 0 ? 1 : 2;
    Vec3 u{}, v{};
    u[(d + 1) % 3] = 1;
    v[(d + 2) % 3] = normal[d];
    for (const auto& [x, y] : {std::pair{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}})
      polygon.points.push_back(Real(x) * u + Real(y) * v);
    polygon.loops = {{0, 1, 2, 3, 4, 5}};
    expect_tiling(polygon, normal);
  }
}

/// Star-shaped polygons with holes in the sectors between, of random radii: concave, and seldom
/// regular.
TEST(Triangulate, RandomStarsWithHoles) {
  for (unsigned seed = 0; seed < 500; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<Real> radius(4, 10);
    const int corners = 5 + static_cast<int>(random() % 60);
    std::vector<std::vector<std::array<Real, 2>>> loops(1);
    const auto at = [](Real r, Real angle) {
      return std::array<Real, 2>{r * std::cos(angle), r * std::sin(angle)};
    };
    for (int i = 0; i < corners; ++i)
      loops[0].push_back(at(radius(random), 2 * M_PI * i / corners));
    const int holes = static_cast<int>(random() % 6);
    for (int h = 0; h < holes;
         ++h) {  // about (r, angle), within 0.3 of it, inside the radius 4·cos(π/5)
      const std::array<Real, 2> centre = at(1 + 1.5 * (h % 2), 2 * M_PI * h / 6 + 0.1);
      loops.emplace_back();
      const int sides = 3 + static_cast<int>(random() % 5);
      for (int i = sides; i > 0; --i) {
        const auto offset = at(0.1 * (1 + static_cast<Real>(random() % 3)), 2 * M_PI * i / sides);
        loops.back().push_back({centre[0] + offset[0], centre[1] + offset[1]});
      }
    }
    expect_tiling(in_plane(loops));
    if (testing::Test::HasFailure()) FAIL() << "seed " << seed;
  }
}

TEST(IsConvex, LooksAtEachCorner) {
  const auto convex = [](const Polygon& polygon) {
    return is_convex(polygon.loops[0], polygon.points, plane_normal);
  };
  EXPECT_TRUE(convex(in_plane({square})));
  EXPECT_TRUE(convex(in_plane({{{0, 0}, {2, 0}, {4, 0}, {4, 4}, {0, 4}}})));
  EXPECT_FALSE(convex(in_plane({{{0, 0}, {4, 0}, {4, 4}, {3.9, 3}, {0, 4}}})));
  EXPECT_FALSE(convex(in_plane({{{0, 0}, {4, 0}, {2, 0}, {2, 4}}})));
}

}  // namespace
}  // namespace rockfold
