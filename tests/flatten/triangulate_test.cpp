#include "host/flatten/triangulate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>

#include "tests/flatten/plane_polygon.hpp"

namespace rockfold::test {
namespace {

using Triangles = std::vector<std::array<Index, 3>>;

/// The edges of the loops are used once in their sense, all others once in each sense.
void expect_edges_fit(const PlanePolygon& polygon, const Triangles& triangles) {
  std::map<std::pair<Index, Index>, int> uses;
  for (const auto& loop : polygon.loops)
    for (std::size_t i = 0; i < loop.size(); ++i) --uses[{loop[i], loop[(i + 1) % loop.size()]}];
  for (const auto& t : triangles)
    for (int i = 0; i < 3; ++i) ++uses[{t[i], t[(i + 1) % 3]}];
  for (const auto& [edge, count] : uses) {
    const auto reverse = uses.find({edge.second, edge.first});
    EXPECT_EQ(count, reverse == uses.end() ? 0 : reverse->second)
        << edge.first << " " << edge.second;
  }
}

/// Each triangle has positive area, the areas add up to the polygon's, and the edges fit. Together:
/// the triangles tile the polygon.
void expect_tiling(const PlanePolygon& polygon, const Vec3& normal) {
  const Triangles triangles = triangles_of(polygon, normal);
  Real expected = 0, found = 0;
  std::size_t corners = 0;
  for (const auto& loop : polygon.loops) {
    expected += signed_area(loop, polygon.points, normal);
    corners += loop.size();
  }
  for (const auto& t : triangles) {
    const Real area = signed_area({t[0], t[1], t[2]}, polygon.points, normal);
    EXPECT_GT(area, 0);
    found += area;
  }
  EXPECT_NEAR(found, expected, 1e-12 * std::abs(expected) * static_cast<Real>(corners));
  EXPECT_EQ(triangles.size(), corners + 2 * (polygon.loops.size() - 1) - 2);
  expect_edges_fit(polygon, triangles);
}

void expect_tiling(const PlanePolygon& polygon) {
  expect_tiling(polygon, plane_normal);
}

const std::vector<Point2> square{{0, 0}, {4, 0}, {4, 4}, {0, 4}};

TEST(Triangulate, AConvexPolygon) {
  expect_tiling(in_plane({square}));
}

TEST(Triangulate, AnL) {
  expect_tiling(in_plane({{{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}}}));
}

TEST(Triangulate, AComb) {
  std::vector<Point2> comb{{0, 0}, {9, 0}};
  for (int tooth = 4; tooth >= 0; --tooth)
    for (const auto& corner :
         {Point2{2. * tooth + 1, 5}, {2. * tooth, 5}, {2. * tooth, 1}, {2. * tooth - 1, 1}})
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
  Outlines loops{{{0, 0}, {20, 0}, {20, 20}, {0, 20}}};
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 5; ++j) {
      const Real x = 4. * i + 1, y = 4. * j + 1;
      loops.push_back({{x, y}, {x, y + 2}, {x + 2, y + 2}, {x + 2, y}});
    }
  expect_tiling(in_plane(loops));
}

/// All triangles positive and the area right; the corners that meet are points of their own.
void expect_area(const PlanePolygon& polygon, Real expected) {
  Real area = 0;
  for (const auto& t : triangles_of(polygon, plane_normal)) {
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

/// Each triangle takes the point of its side of the place where two corners meet.
TEST(Triangulate, ALoopThatTouchesItself) {
  expect_tiling(in_plane({{{0, 0}, {4, 0}, {4, 4}, {2, 4}, {3, 2}, {1, 2}, {2, 4}, {0, 4}}}));
}

TEST(Triangulate, SeenFromBelow) {
  for (const Vec3& normal :
       {Vec3{0, 0, -1}, {0, 0, 1}, {0, -1, 0}, {0, 1, 0}, {-1, 0, 0}, {1, 0, 0}}) {
    PlanePolygon polygon;
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
    Outlines loops(1);
    const auto at = [](Real r, Real angle) {
      return Point2{r * std::cos(angle), r * std::sin(angle)};
    };
    for (int i = 0; i < corners; ++i)
      loops[0].push_back(at(radius(random), 2 * M_PI * i / corners));
    const int holes = static_cast<int>(random() % 6);
    for (int h = 0; h < holes;
         ++h) {  // about (r, angle), within 0.3 of it, inside the radius 4·cos(π/5)
      const Point2 centre = at(1 + 1.5 * (h % 2), 2 * M_PI * h / 6 + 0.1);
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

/// The loops as they are, and each turned by a corner; where nothing is rounded and where all is.
void expect_area_of_any(Outlines outlines, Real expected) {
  for (int turn = 0; turn < 3; ++turn) {
    EXPECT_NEAR(area_of_triangles(flat(outlines), {0, 0, 1}), expected, 1e-12);
    EXPECT_NEAR(area_of_triangles(in_plane(outlines), plane_normal), expected, 1e-12);
    for (auto& loop : outlines)
      if (!loop.empty()) std::rotate(loop.begin(), loop.begin() + 1, loop.end());
  }
}

TEST(TriangulateAnything, LoopsWithoutAreaHaveNoTriangles) {
  for (const auto& loop : std::vector<std::vector<Point2>>{{},
                                                           {{1, 2}},
                                                           {{1, 2}, {3, 5}},
                                                           {{1, 2}, {1, 2}, {1, 2}, {1, 2}},
                                                           {{1, 2}, {3, 5}, {1, 2}, {3, 5}},
                                                           {{0, 0}, {1, 1}, {2, 2}},
                                                           {{0, 0}, {3, 1}, {6, 2}, {3, 1}},
                                                           {{0, 0}, {3, 1}, {9, 3}, {6, 2}}})
    EXPECT_TRUE(triangles_of(flat({loop}), {0, 0, 1}).empty());
  EXPECT_TRUE(triangles_of({}, {0, 0, 1}).empty());
  EXPECT_TRUE(triangles_of(flat({{}, {}}), {0, 0, 1}).empty());
  EXPECT_TRUE(triangles_of(flat({square, {{0, 0}, {0, 4}, {4, 4}, {4, 0}}}), {0, 0, 1}).empty());
}

TEST(TriangulateAnything, RepeatedCornersCountOnce) {
  expect_area_of_any({{{0, 0}, {0, 0}, {4, 0}, {4, 4}, {4, 4}, {4, 4}, {0, 4}}}, 16);
  PlanePolygon polygon = in_plane({square});
  polygon.loops = {{0, 0, 1, 2, 2, 3, 3, 0}};
  EXPECT_EQ(triangles_of(polygon, plane_normal).size(), 2u);
}

TEST(TriangulateAnything, StripsWithoutAreaAreLeftOut) {
  expect_area_of_any({{{0, 0}, {4, 0}, {7, 0}, {4, 0}, {4, 4}, {0, 4}}}, 16);          // outwards
  expect_area_of_any({{{0, 0}, {4, 0}, {4, 4}, {2, 4}, {2, 1}, {2, 4}, {0, 4}}}, 16);  // inwards
  expect_area_of_any({{{0, 0}, {4, 0}, {9, 0}, {7, 0}, {4, 0}, {4, 4}, {0, 4}}}, 16);
  // Two squares joined by one.
  expect_area_of_any({{{0, 0},
                       {2, 0},
                       {2, 1},
                       {5, 1},
                       {5, 0},
                       {7, 0},
                       {7, 2},
                       {5, 2},
                       {5, 1},
                       {2, 1},
                       {2, 2},
                       {0, 2}}},
                     8);
}

TEST(TriangulateAnything, HolesThatShareEdgesWithTheBoundary) {
  expect_area_of_any({square, {{0, 0}, {0, 4}, {2, 2}}}, 12);          // a whole edge
  expect_area_of_any({square, {{1, 0}, {1, 1}, {2, 1}, {2, 0}}}, 15);  // a part of one
  expect_area_of_any({square, {{0, 0}, {0, 2}, {2, 2}, {2, 0}}}, 12);  // two parts at a corner
  expect_area_of_any({square, {{1, 1}, {1, 2}, {2, 2}, {2, 1}}, {{2, 1}, {2, 2}, {3, 2}, {3, 1}}},
                     14);  // with each other
}

TEST(TriangulateAnything, HolesThatTouchTheBoundaryAtAVertex) {
  expect_area_of_any({square, {{2, 4}, {3, 2}, {1, 2}}}, 14);  // which the boundary has not
  expect_area_of_any({square, {{0, 0}, {1, 3}, {3, 1}}}, 12);  // which it has
  expect_area_of_any({square, {{0, 2}, {2, 4}, {4, 2}, {2, 0}}}, 8);
}

/// Each crossing is of some 1e-16 and would be none without rounding.
TEST(TriangulateAnything, LoopsThatCrossInTheLastBits) {
  const Real e = 1e-15;
  expect_area_of_any({square, {{1, -e}, {1, 1}, {2, 1}, {2, -e}}}, 15);
  expect_area_of_any({square, {{2, 4 + e}, {3, 2}, {1, 2}}}, 14);
  expect_area_of_any({square, {{-e, 2}, {2, 4 + e}, {4 + e, 2}, {2, -e}}}, 8);
  expect_area_of_any(
      {square, {{1, 1}, {1, 2}, {2 + e, 2}, {2 + e, 1}}, {{2, 1}, {2, 2}, {3, 2}, {3, 1}}}, 14);
  expect_area_of_any({{{0, 0}, {4, 0}, {4, 4}, {2 + e, 4}, {2 - e, 1}, {2 - e, 4}, {0, 4}}}, 16);
}

TEST(TriangulateAnything, OverlapsAreCoveredOnce) {
  expect_area_of_any({{{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}, {4, 0}, {4, 4}, {0, 4}}}, 16);
  expect_area_of_any({square, {{1, 1}, {1, 3}, {3, 3}, {3, 1}}, {{1, 1}, {1, 3}, {3, 3}, {3, 1}}},
                     12);
}

TEST(TriangulateAnything, OfAnySize) {
  for (const Real size : {1e-300, 1e-160, 1e-20, 1e20, 1e150}) {
    const PlanePolygon polygon =
        polygon_in({}, {size, 0, 0}, {0, size, 0}, {square, {{1, 1}, {1, 3}, {3, 3}, {3, 1}}});
    EXPECT_EQ(triangles_of(polygon, {0, 0, 1}).size(), 8u) << size;
  }
  const Real infinite = std::numeric_limits<Real>::infinity();
  EXPECT_TRUE(triangles_of(flat({{{0, 0}, {infinite, 0}, {0, 1}}}), {0, 0, 1}).empty());
  EXPECT_TRUE(triangles_of(flat({{{0, 0}, {1, 0}, {std::nan(""), 1}}}), {0, 0, 1}).empty());
  EXPECT_EQ(triangles_of(flat({square}), {0, 0, 0}).size(), 0u);  // no normal: edge on
}

TEST(IsConvex, LooksAtEachCorner) {
  const auto convex = [](const PlanePolygon& polygon) {
    return is_convex(polygon.loops[0], polygon.points, plane_normal);
  };
  EXPECT_TRUE(convex(in_plane({square})));
  EXPECT_TRUE(convex(in_plane({{{0, 0}, {2, 0}, {4, 0}, {4, 4}, {0, 4}}})));
  EXPECT_FALSE(convex(in_plane({{{0, 0}, {4, 0}, {4, 4}, {3.9, 3}, {0, 4}}})));
  EXPECT_FALSE(convex(in_plane({{{0, 0}, {4, 0}, {2, 0}, {2, 4}}})));
  EXPECT_FALSE(convex(in_plane({{{0, 0}, {4, 0}, {1, 1}, {1, 1}, {0, 4}}})));
  EXPECT_FALSE(convex(in_plane({{{0, 0}, {4, 0}}})));
}

}  // namespace
}  // namespace rockfold::test
