// Frustums and cylinders.
#include <gtest/gtest.h>

#include "tests/shapes/bases.hpp"
#include "tests/shapes/measure.hpp"

namespace rockfold::test {
namespace {

constexpr Real pi = std::numbers::pi;

Polygon2 regular(int corners, Real radius) {
  Polygon2 p;
  for (int i = 0; i < corners; ++i)
    p.push_back({radius * std::cos(2 * pi * i / corners), radius * std::sin(2 * pi * i / corners)});
  return p;
}

TEST(Frustum, HasTheVolumeOfTheFormula) {
  Random random(5);
  for (int i = 0; i < 30; ++i) {
    const Real reach = std::array{0.0, 1e3, 1e6}[i % 3];
    const Placement low = random_placement(reach, random);
    Placement high = low;
    const Real height = random.uniform(0.5, 2), ratio = random.uniform(0.3, 2);
    high.origin += height * low.normal() + 0.3 * low.u;
    const Polygon2 base = regular(3 + i % 9, 1);
    Polygon2 top = base;
    for (auto& [x, y] : top) x *= ratio, y *= ratio;
    const ShapeGeometry geometry = geometry_of(FrustumShape{low(base), high(top)});
    const Measured measured = measure_parts(geometry);
    const Real area = shoelace(base);
    const Real volume = height * area / 3 * (1 + ratio + ratio * ratio);
    EXPECT_NEAR(measured.volume, volume, (1e-12 + 1e-14 * reach) * volume) << i;
    EXPECT_EQ(geometry.parts.size(), 1u);
    const auto n = static_cast<Index>(base.size());
    EXPECT_NEAR(measured.area.at(n), area, (1e-12 + 1e-14 * reach) * area);
    EXPECT_NEAR(measured.area.at(n + 1), area * ratio * ratio, 1e-11 + 1e-13 * reach);
    for (Index s = 0; s <= n + 1; ++s) EXPECT_EQ(geometry.parts[0].faces[s].face, s);
  }
}

TEST(Frustum, NamesItsSidesByTheBasesEdges) {
  const FrustumShape shape{{{0, 0, 0}, {4, 0, 0}, {4, 2, 0}, {0, 2, 0}},
                           {{1, 0.5, 3}, {3, 0.5, 3}, {3, 1.5, 3}, {1, 1.5, 3}}};
  const auto faces = geometry_of(shape).parts.at(0).faces;
  for (int i = 0; i < 4; ++i)
    for (const Vec3& p :
         {shape.base[i], shape.base[(i + 1) % 4], shape.top[i], shape.top[(i + 1) % 4]})
      EXPECT_TRUE(on_exactly(faces[i].plane, p));
}

TEST(Frustum, RefusesTwistedAndFlatOnes) {
  const std::vector<Vec3> base{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const std::vector<Vec3> twisted{{0.2, 0, 1}, {1, 0.2, 1}, {0.8, 1, 1}, {0, 0.8, 1}};
  const std::vector<Vec3> next{{1, 0, 1}, {1, 1, 1}, {0, 1, 1}, {0, 0, 1}};
  std::vector<Vec3> bent = base;
  for (Vec3& p : bent) p[2] = 1 + 0.5 * p[0] * p[1];
  EXPECT_NE(refusal(FrustumShape{base, twisted}).find("off the plane of face"), std::string::npos);
  EXPECT_NE(refusal(FrustumShape{base, bent}).find("off the plane of face 5"), std::string::npos);
  EXPECT_NE(refusal(FrustumShape{base, next}).find("in the same order"), std::string::npos);
  EXPECT_NE(refusal(FrustumShape{base, base}).find("no area"), std::string::npos);
  EXPECT_NE(refusal(FrustumShape{base, {{0, 0, 1}}}).find("equally many"), std::string::npos);
}

TEST(Cylinder, HasTheVolumeOfTheRegularPolygon) {
  Random random(8);
  for (int i = 0; i < 30; ++i) {
    const Real reach = std::array{0.0, 1e3, 1e6}[i % 3];
    const Vec3 start = reach * random.direction(), end = start + 3.0 * random.direction();
    const Index sides = 3 + i;
    const CylinderShape shape{{start, end}, 0.7, sides};
    const ShapeGeometry geometry = geometry_of(shape);
    const Measured measured = measure_parts(geometry);
    const Real area = sides / 2.0 * 0.49 * std::sin(2 * pi / sides);
    // Of the decimals that name its ends: at 1e6 m they are up to 6e-11 m from the doubles.
    const ExactVec3 a = exact(start), b = exact(end);
    const ExactVec3 axis{b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    const Real length = std::sqrt(CGAL::to_double(dot(axis, axis)));
    EXPECT_NEAR(measured.volume, area * length, 1e-12 * area * length) << i;
    for (Index s = 0; s < sides; ++s)
      EXPECT_NEAR(measured.area.at(s), 2 * 0.7 * std::sin(pi / sides) * length, 1e-11);
    const auto& faces = geometry.parts.at(0).faces;
    for (Index s = 0; s < sides; ++s) EXPECT_EQ(dot(faces[s].plane.n, axis), 0);
    EXPECT_TRUE(on_exactly(faces[sides].plane, start));
    EXPECT_TRUE(on_exactly(faces[sides + 1].plane, end));
    EXPECT_EQ(faces[sides].plane.n, axis);
  }
}

TEST(Cylinder, StartsToTheRightOfItsAxis) {
  const auto first = [](const Vec3& axis) {
    return geometry_of(CylinderShape{{Vec3{}, axis}, 2, 8}).corners.at(0);
  };
  EXPECT_EQ(first({0, 5, 0}), (Vec3{2, 0, 0}));
  EXPECT_EQ(first({5, 0, 0}), (Vec3{0, -2, 0}));
  EXPECT_EQ(first({0, 0, 5}), (Vec3{2, 0, 0}));
  EXPECT_EQ(first({0, 0, -5}), (Vec3{2, 0, 0}));
  const auto corners = geometry_of(CylinderShape{{Vec3{}, Vec3{0, 5, 0}}, 2, 8}).corners;
  EXPECT_EQ(corners.at(2), (Vec3{0, 0, 2})) << "counter-clockwise seen along the axis";
}

TEST(Cylinder, OfFourSidesOnAnAxisIsExact) {
  // Corner to corner over the axis: planes x ± z = ±2, to the last bit.
  const ShapeGeometry geometry = geometry_of(CylinderShape{{Vec3{}, Vec3{0, 5, 0}}, 2, 4});
  for (const FacePlane& f : geometry.parts[0].faces) {
    if (f.face >= 4) continue;
    EXPECT_EQ(abs(f.plane.n[0]), abs(f.plane.n[2]));
    EXPECT_EQ(abs(f.plane.d), 2 * abs(f.plane.n[0]));
  }
}

TEST(Cylinder, RefusesWhatHasNoVolume) {
  EXPECT_NE(refusal(CylinderShape{{Vec3{1, 2, 3}, Vec3{1, 2, 3}}, 1, 8}), "");
  EXPECT_NE(refusal(CylinderShape{{Vec3{}, Vec3{1, 2, 3}}, 0, 8}), "");
  EXPECT_NE(refusal(CylinderShape{{Vec3{}, Vec3{1, 2, 3}}, 1, 2}), "");
}

}  // namespace
}  // namespace rockfold::test
