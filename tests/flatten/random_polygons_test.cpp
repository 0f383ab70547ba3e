// Triangles of random polygons, many of which touch and degenerate, against winding numbers at random points.
#include <algorithm>
#include <cmath>
#include <random>

#include "tests/flatten/plane_polygon.hpp"

namespace rockfold::test {
namespace {

Real turn(const Point2& a, const Point2& b, const Point2& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// How often the loops wind around a point that lies on none of their edges.
int winding(const Outlines& outlines, const Point2& p) {
  int count = 0;
  for (const auto& loop : outlines)
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Point2 &a = loop[i], &b = loop[(i + 1) % loop.size()];
      if ((a[1] > p[1]) == (b[1] > p[1])) continue;
      const bool up = b[1] > a[1];
      if ((turn(a, b, p) > 0) == up) count += up ? 1 : -1;
    }
  return count;
}

/// Whether two edges cross elsewhere than at an end of either; exact for small integers.
bool any_crossing(const Outlines& outlines) {
  std::vector<std::array<Point2, 2>> edges;
  for (const auto& loop : outlines)
    for (std::size_t i = 0; i < loop.size(); ++i)
      edges.push_back({loop[i], loop[(i + 1) % loop.size()]});
  for (const auto& [a, b] : edges)
    for (const auto& [c, d] : edges)
      if (turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0) return true;
  return false;
}

std::size_t triangles_around(const PlanePolygon& polygon,
                             const std::vector<std::array<Index, 3>>& triangles, const Point2& p) {
  std::size_t count = 0;
  for (const auto& t : triangles) {
    bool inside = true;
    for (int k = 0; k < 3; ++k) {
      const Vec3 &a = polygon.points[t[k]], &b = polygon.points[t[(k + 1) % 3]];
      inside = inside && turn({a[0], a[1]}, {b[0], b[1]}, p) > 0;
    }
    count += inside;
  }
  return count;
}

using Random = std::mt19937;

/// A star about a point: concave, simple unless it is snapped to a grid.
std::vector<Point2> star(Random& random, const Point2& centre, Real least, Real most, int corners) {
  std::uniform_real_distribution<Real> radius(least, most);
  std::vector<Point2> loop;
  for (int i = 0; i < corners; ++i) {
    const Real r = radius(random), angle = 2 * M_PI * i / corners;
    loop.push_back({centre[0] + r * std::cos(angle), centre[1] + r * std::sin(angle)});
  }
  return loop;
}

/// A star of radii 4 to 8 with up to 4 stars as holes that keep clear of it and of each other.
Outlines star_with_holes(Random& random) {
  Outlines outlines{star(random, {0, 0}, 4, 8, 6 + static_cast<int>(random() % 40))};
  const int holes = static_cast<int>(random() % 5);
  for (int h = 0; h < holes; ++h) {
    const Real angle = M_PI / 2 * h;
    outlines.push_back(star(random, {1.6 * std::cos(angle), 1.6 * std::sin(angle)}, 0.4, 1.1,
                            3 + static_cast<int>(random() % 9)));
    std::reverse(outlines.back().begin(), outlines.back().end());
  }
  return outlines;
}

/// Coordinates as multiples of 1/fineness, times fineness.
Outlines snapped(Outlines outlines, Real fineness) {
  for (auto& loop : outlines)
    for (Point2& p : loop) p = {std::round(p[0] * fineness), std::round(p[1] * fineness)};
  return outlines;
}

/// Loops of any corners of a coarse grid, up to four.
Outlines scribble(Random& random, Index extent) {
  Outlines outlines(1 + random() % 4);
  std::uniform_int_distribution<Index> at(0, extent);
  for (auto& loop : outlines)
    for (auto n = random() % 12; n > 0; --n) loop.push_back({1. * at(random), 1. * at(random)});
  return outlines;
}

Real size_of(const Outlines& outlines) {
  Real size = 0;
  for (const auto& loop : outlines)
    for (const Point2& p : loop) size = std::max({size, std::abs(p[0]), std::abs(p[1])});
  return size;
}

/// Whatever the loops are: triangles of positive area that do not overlap. Where no edges cross: one over each point that
/// the loops wind around. Random points lie on no edge of a grid.
void expect_once(const Outlines& outlines, Random& random, bool crossing) {
  const PlanePolygon polygon = flat(outlines);
  const auto triangles = triangles_of(polygon, {0, 0, 1});
  for (const auto& t : triangles)
    EXPECT_GT(signed_area({t[0], t[1], t[2]}, polygon.points, {0, 0, 1}), 0);
  const Real size = size_of(outlines);
  std::uniform_real_distribution<Real> at(-size, size);
  for (int k = 0; k < 20; ++k) {
    const Point2 p{at(random), at(random)};
    const std::size_t found = triangles_around(polygon, triangles, p);
    if (crossing)
      EXPECT_LE(found, 1u);
    else
      EXPECT_EQ(found, winding(outlines, p) > 0 ? 1u : 0u);
  }
}

/// The same loops with every coordinate off by up to 1e-13, so that what touches overlaps or gapes: the same area, to that
/// times the length of the edges, below 1000.
void expect_same_area_rounded(Outlines outlines, Random& random) {
  const Real area = area_of_triangles(flat(outlines), {0, 0, 1});
  EXPECT_NEAR(area_of_triangles(in_plane(outlines), plane_normal), area, 1e-10);
  std::uniform_real_distribution<Real> noise(-1e-13, 1e-13);
  for (auto& loop : outlines)
    for (Point2& p : loop) p = {p[0] + noise(random), p[1] + noise(random)};
  EXPECT_NEAR(area_of_triangles(flat(outlines), {0, 0, 1}), area, 1e-10);
}

TEST(RandomPolygons, StarsWithHolesHaveTheirArea) {
  for (unsigned seed = 0; seed < 1000; ++seed) {
    Random random(seed);
    const Outlines outlines = star_with_holes(random);
    const PlanePolygon polygon = in_plane(outlines);
    Real area = 0;
    for (const auto& loop : polygon.loops) area += signed_area(loop, polygon.points, plane_normal);
    EXPECT_NEAR(area_of_triangles(polygon, plane_normal), area, 1e-11);
    expect_once(outlines, random, false);
    if (testing::Test::HasFailure()) FAIL() << "seed " << seed;
  }
}

TEST(RandomPolygons, StarsSnappedToCoarseGridsAreCoveredOnce) {
  int touching = 0;
  for (unsigned seed = 0; seed < 4000; ++seed) {
    Random random(seed);
    const Outlines outlines = snapped(star_with_holes(random), seed % 4 == 0 ? 4 : seed % 4);
    const bool crossing = any_crossing(outlines);
    expect_once(outlines, random, crossing);
    if (!crossing) expect_same_area_rounded(outlines, random);
    touching += !crossing;
    if (testing::Test::HasFailure()) FAIL() << "seed " << seed;
  }
  EXPECT_GT(touching, 1000);
}

TEST(RandomPolygons, ScribblesAreCoveredAtMostOnce) {
  int clean = 0;
  for (unsigned seed = 0; seed < 8000; ++seed) {
    Random random(seed);
    const Outlines outlines = scribble(random, 1 + static_cast<Index>(seed % 6));
    const bool crossing = any_crossing(outlines);
    expect_once(outlines, random, crossing);
    if (!crossing) expect_same_area_rounded(outlines, random);
    area_of_triangles(in_plane(outlines), plane_normal);
    clean += !crossing;
    if (testing::Test::HasFailure()) FAIL() << "seed " << seed;
  }
  EXPECT_GT(clean, 1000);
}

}  // namespace
}  // namespace rockfold::test
