// Tunnels: mitres, frames, faces and refusals.
#include <gtest/gtest.h>

#include "tests/shapes/bases.hpp"
#include "tests/shapes/measure.hpp"

namespace rockfold::test {
namespace {

const Polygon2 rectangle{{-1, -1.5}, {1, -1.5}, {1, 1.5}, {-1, 1.5}};
const Polygon2 horseshoe{{-2, -1.5}, {2, -1.5}, {2, 1}, {1.2, 2.2}, {0, 2.7}, {-1.2, 2.2}, {-2, 1}};
// Concave, its centroid on the path.
const Polygon2 cross_shape{{-1, -3}, {1, -3}, {1, -1}, {3, -1}, {3, 1},   {1, 1},
                           {1, 3},   {-1, 3}, {-1, 1}, {-3, 1}, {-3, -1}, {-1, -1}};

Real length_of(const std::vector<Vec3>& path) {
  Real length = 0;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) length += norm(path[i + 1] - path[i]);
  return length;
}

Real perimeter(const Polygon2& p) {
  Real sum = 0;
  for (std::size_t i = 0; i < p.size(); ++i) sum += edge_length(p, i);
  return sum;
}

// A section whose centroid is on the path: mitres take on one side what they give on the other.
void expect_balanced(const std::vector<Vec3>& path, const Polygon2& section, Real tolerance) {
  const ShapeGeometry geometry = geometry_of(TunnelShape{path, section});
  const Measured measured = measure_parts(geometry);
  const Real volume = shoelace(section) * length_of(path);
  EXPECT_NEAR(measured.volume, volume, tolerance * volume);
  EXPECT_LE(measured.overlap, tolerance * volume);
  EXPECT_EQ(measured.empty_parts, 0);
  EXPECT_LE(norm(measured.boundary), tolerance * volume);
  const auto n = static_cast<Index>(section.size());
  Real sides = 0;
  for (Index i = 0; i < n; ++i) sides += measured.area.at(i);
  EXPECT_NEAR(sides, perimeter(section) * length_of(path), tolerance * sides)
      << "symmetric sections have sides of the path's length on average";
  EXPECT_NEAR(measured.area.at(n), shoelace(section), tolerance * volume);
  EXPECT_NEAR(measured.area.at(n + 1), shoelace(section), tolerance * volume);
}

TEST(Tunnel, WithALevelBendHasSectionTimesLength) {
  for (const Polygon2& section : {rectangle, cross_shape})
    for (const Real reach : {0.0, 1e3, 1e6}) {
      const Vec3 o{reach, -reach, 0.1 * reach};
      const Real tolerance = 1e-12 + 1e-15 * reach;
      expect_balanced({o, o + Vec3{10, 0, 0}}, section, tolerance);
      expect_balanced({o, o + Vec3{10, 0, 0}, o + Vec3{10, 20, 0}}, section, tolerance);
      expect_balanced({o, o + Vec3{10, 3, 0}, o + Vec3{7, 20, 0}, o + Vec3{-8, 31, 0}}, section,
                      tolerance);
    }
}

TEST(Tunnel, ThatDipsInOneVerticalPlaneHasSectionTimesLength) {
  expect_balanced({{0, 0, 0}, {10, 10, -3}, {20, 20, -12}, {30, 30, -12}}, rectangle, 1e-12);
  expect_balanced({{0, 0, 0}, {0, 0, -20}, {0, 15, -20}}, rectangle, 1e-12);
  expect_balanced({{0, 0, 0}, {0, 0, 20}, {0, 15, 20}}, cross_shape, 1e-12);
}

TEST(Tunnel, IsShorterOnTheInnerSideOfABend) {
  // A right-angled turn to the right takes 2·x from every line x to the right of the path.
  Polygon2 section = rectangle;
  for (auto& [x, y] : section) x += 0.25;
  const auto volume = [&](const Vec3& end) {
    return measure_parts(geometry_of(TunnelShape{{{0, 0, 0}, {0, 10, 0}, end}, section})).volume;
  };
  EXPECT_NEAR(volume({10, 10, 0}), 6 * (20 - 2 * 0.25), 1e-11);
  EXPECT_NEAR(volume({-10, 10, 0}), 6 * (20 + 2 * 0.25), 1e-11);
}

TEST(Tunnel, HasItsSectionUprightSeenAlongThePath) {
  // Face 1 is the side of the points 1 and 2: to the right; face 2 the roof.
  const auto outward = [](const Vec3& end, Index face) {
    const ShapeGeometry geometry = geometry_of(TunnelShape{{{0, 0, 0}, end}, rectangle});
    const FacePlane& f = geometry.parts.at(0).faces.at(face);
    Vec3 n;
    for (int d = 0; d < 3; ++d) n[d] = CGAL::to_double(f.plane.n[d]);
    return f.inside_above ? -normalized(n) : normalized(n);
  };
  const auto expect = [&](const Vec3& end, const Vec3& right, const Vec3& up) {
    EXPECT_LE(norm(outward(end, 1) - right), 1e-15);
    EXPECT_LE(norm(outward(end, 2) - up), 1e-15);
  };
  expect({0, 9, 0}, {1, 0, 0}, {0, 0, 1});
  expect({9, 0, 0}, {0, -1, 0}, {0, 0, 1});
  expect({0, 9, 9}, {1, 0, 0}, {0, -std::sqrt(0.5), std::sqrt(0.5)});
  expect({0, 0, 9}, {1, 0, 0}, {0, -1, 0});
  expect({0, 0, -9}, {1, 0, 0}, {0, 1, 0});
}

TEST(Tunnel, SharesOneExactMitrePlaneThroughThePathPoint) {
  const TunnelShape shape{{{0.1, 0.2, 0.3}, {10.7, 3.3, 0.3}, {15.1, 20.9, 0.3}}, horseshoe};
  const ShapeGeometry geometry = geometry_of(shape);
  ASSERT_EQ(geometry.parts.size(), 2u);
  const FacePlane &end = geometry.parts[0].faces.back(),
                  &start = *(geometry.parts[1].faces.end() - 2);
  EXPECT_EQ(end.plane.n, start.plane.n);
  EXPECT_EQ(end.plane.d, start.plane.d);
  EXPECT_NE(end.inside_above, start.inside_above);
  EXPECT_EQ(end.face, none);
  EXPECT_EQ(start.face, none);
  EXPECT_TRUE(on_exactly(end.plane, shape.path[1]));
  for (int s = 0; s < 2; ++s) {
    const ExactVec3 a = exact(shape.path[s]), b = exact(shape.path[s + 1]);
    const ExactVec3 along{b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    for (Index i = 0; i < 7; ++i) {
      EXPECT_EQ(dot(geometry.parts[s].faces[i].plane.n, along), 0);
      EXPECT_EQ(geometry.parts[s].faces[i].face, i);
    }
    const FacePlane& cap =
        s == 0 ? *(geometry.parts[0].faces.end() - 2) : geometry.parts[1].faces.back();
    EXPECT_EQ(cap.plane.n, along);
    EXPECT_TRUE(on_exactly(cap.plane, shape.path[s == 0 ? 0 : 2]));
    EXPECT_EQ(cap.face, s == 0 ? 7 : 8);
  }
}

TEST(Tunnel, LeavesOutPointsOnAStraightLine) {
  const TunnelShape shape{{{0, 0, 0}, {0.1, 0.2, 0.3}, {0.1, 0.2, 0.3}, {0.3, 0.6, 0.9}, {1, 2, 3}},
                          rectangle};
  EXPECT_EQ(geometry_of(shape).parts.size(), 1u);
  expect_balanced({{0, 0, 0}, {1, 2, 3}}, rectangle, 1e-12);
}

TEST(Tunnel, ThatTurnsAndInclinesAtOnceIsStillTheUnionOfItsSegments) {
  const TunnelShape shape{{{0, 0, 0}, {0, 20, 0}, {15, 30, -12}}, rectangle};
  const ShapeGeometry geometry = geometry_of(shape);
  const Measured measured = measure_parts(geometry);
  EXPECT_NEAR(measured.volume, 6 * length_of(shape.path), 1e-10);
  EXPECT_LE(measured.overlap, 1e-10);
  // The sections are rolled against each other: what stands out belongs to the end faces.
  EXPECT_EQ(geometry.parts[0].faces.back().face, 5);
  EXPECT_EQ((geometry.parts[1].faces.end() - 2)->face, 4);
  EXPECT_LE(norm(measured.boundary), 1e-10);
}

TEST(Tunnel, HasAllItsCornersInTheHull) {
  const ShapeGeometry geometry =
      geometry_of(TunnelShape{{{0, 0, 0}, {0, 10, 0}, {10, 10, 0}}, rectangle});
  Vec3 min{1e9, 1e9, 1e9}, max{-1e9, -1e9, -1e9};
  for (const Vec3& p : geometry.corners)
    for (int d = 0; d < 3; ++d) min[d] = std::min(min[d], p[d]), max[d] = std::max(max[d], p[d]);
  EXPECT_LE(norm(min - Vec3{-1, 0, -1.5}), 1e-14);
  EXPECT_LE(norm(max - Vec3{10, 11, 1.5}), 1e-14);
}

TEST(Tunnel, RefusesBendsThatItsWidthDoesNotAllow) {
  // Two right-angled turns to the right, 1.5 m apart, take 1 m each from the inner wall.
  const auto turns = [](Real apart) {
    return refusal(TunnelShape{{{0, 0, 0}, {0, 10, 0}, {apart, 10, 0}, {apart, 0, 0}}, rectangle});
  };
  EXPECT_EQ(turns(2.5), "");
  const std::string message = turns(1.5);
  EXPECT_NE(message.find("bend at point 2"), std::string::npos) << message;
  EXPECT_NE(message.find("1.5 m long"), std::string::npos) << message;
  EXPECT_NE(message.find("take 2 m"), std::string::npos) << message;
  // A Z of the same legs has its inner walls on opposite sides: each corner loses 1 m and gains 1 m.
  EXPECT_EQ(refusal(TunnelShape{{{0, 0, 0}, {0, 10, 0}, {1.5, 10, 0}, {1.5, 20, 0}}, rectangle}),
            "");
  EXPECT_NE(
      refusal(TunnelShape{{{0, 0, 0}, {0, 10, 0}, {0.1, 0, 0}}, rectangle}).find("bend at point 2"),
      std::string::npos);
  EXPECT_NE(refusal(TunnelShape{{{0, 0, 0}, {0, 10, 0}, {0, 3, 0}}, rectangle}).find("turns back"),
            std::string::npos);
}

TEST(Tunnel, DoesNotCrashOnWhatTheReaderRefuses) {
  EXPECT_NE(refusal(TunnelShape{{{1, 1, 1}, {1, 1, 1}}, rectangle}), "");
  EXPECT_NE(refusal(TunnelShape{{}, rectangle}), "");
  EXPECT_NE(refusal(TunnelShape{{{0, 0, 0}, {1, 0, 0}}, {}}), "");
  EXPECT_NE(refusal(TunnelShape{{{0, 0, 0}, {1, 0, 0}}, {{0, 0}, {1, 0}, {2, 0}}}), "");
  EXPECT_NE(refusal(TunnelShape{{{0, 0, 0}, {1, 0, 0}}, {{0, 0}, {1, 1}, {1, 0}, {0, 1}}}), "");
}

}  // namespace
}  // namespace rockfold::test
