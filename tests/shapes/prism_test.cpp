// Prisms and pyramids on convex and concave bases.
#include <gtest/gtest.h>

#include "tests/shapes/bases.hpp"
#include "tests/shapes/measure.hpp"

namespace rockfold::test {
namespace {

const Polygon2 l_shape{{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 4}, {0, 4}};
const Polygon2 plus_shape{{1, 0}, {2, 0}, {2, 1}, {3, 1}, {3, 2}, {2, 2},
                          {2, 3}, {1, 3}, {1, 2}, {0, 2}, {0, 1}, {1, 1}};

// Each face has the area of its own side, the parts fill the volume once, and what is no face cancels.
void expect_prism(const Polygon2& base, const Placement& placement, const Vec3& extrude,
                  Real tolerance) {
  const PrismShape prism{placement(base), extrude};
  const ShapeGeometry geometry = geometry_of(prism);
  const Measured measured = measure_parts(geometry);
  const Real area = std::abs(shoelace(base));
  const Real volume = area * std::abs(dot(placement.normal(), extrude));
  EXPECT_NEAR(measured.volume, volume, tolerance * volume);
  EXPECT_LE(measured.overlap, tolerance * volume);
  EXPECT_EQ(measured.empty_parts, 0);
  EXPECT_LE(norm(measured.boundary), tolerance * area);
  const std::size_t n = base.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 edge = prism.base[(i + 1) % n] - prism.base[i];
    const Real side = norm(cross(edge, extrude));
    ASSERT_TRUE(measured.area.contains(static_cast<Index>(i))) << "side " << i;
    EXPECT_NEAR(measured.area.at(static_cast<Index>(i)), side, tolerance * (side + area))
        << "side " << i;
  }
  for (std::size_t i = n; i < n + 2; ++i)
    EXPECT_NEAR(measured.area.at(static_cast<Index>(i)), area, tolerance * area);
}

void expect_exact_sides(const PrismShape& prism) {
  const std::size_t n = prism.base.size();
  for (const ConvexPart& part : geometry_of(prism).parts)
    for (const FacePlane& f : part.faces) {
      if (f.face >= static_cast<Index>(n)) continue;
      EXPECT_EQ(dot(f.plane.n, exact(prism.extrude)), 0);
      int held = 0;
      for (const Vec3& p : prism.base) held += on_exactly(f.plane, p) ? 1 : 0;
      EXPECT_GE(held, 2);
      if (f.face == none) continue;
      EXPECT_TRUE(on_exactly(f.plane, prism.base[f.face]));
      EXPECT_TRUE(on_exactly(f.plane, prism.base[(f.face + 1) % n]));
    }
}

void expect_pyramid(const Polygon2& base, const Placement& placement, const Vec3& apex,
                    Real tolerance) {
  const PyramidShape pyramid{placement(base), apex};
  const ShapeGeometry geometry = geometry_of(pyramid);
  const Measured measured = measure_parts(geometry);
  const Real area = std::abs(shoelace(base));
  const Real volume = area * std::abs(dot(placement.normal(), apex - placement.origin)) / 3;
  EXPECT_NEAR(measured.volume, volume, tolerance * volume);
  EXPECT_LE(measured.overlap, tolerance * volume);
  EXPECT_LE(norm(measured.boundary), tolerance * area);
  const std::size_t n = base.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 &a = pyramid.base[i], &b = pyramid.base[(i + 1) % n];
    const Real side = norm(cross(b - a, apex - a)) / 2;
    ASSERT_TRUE(measured.area.contains(static_cast<Index>(i))) << "side " << i;
    EXPECT_NEAR(measured.area.at(static_cast<Index>(i)), side, tolerance * (side + area));
  }
  EXPECT_NEAR(measured.area.at(static_cast<Index>(n)), area, tolerance * area);
  for (const ConvexPart& part : geometry.parts)
    for (const FacePlane& f : part.faces) {
      if (f.face == static_cast<Index>(n)) continue;
      EXPECT_TRUE(on_exactly(f.plane, apex));
      if (f.face == none) continue;
      EXPECT_TRUE(on_exactly(f.plane, pyramid.base[f.face]));
      EXPECT_TRUE(on_exactly(f.plane, pyramid.base[(f.face + 1) % n]));
    }
}

// Doubles of clipped cells: some 100 roundings of each of the vertices.
constexpr Real rounding = 1e-12;

TEST(Prism, OfAConvexBaseIsOnePartWithItsFacesInOrder) {
  const PrismShape prism{{{0, 0, 0}, {2, 0, 0}, {3, 2, 0}, {0, 1, 0}}, {0.5, 0, 3}};
  for (const bool reversed : {false, true}) {
    PrismShape turned = prism;
    if (reversed) std::reverse(turned.base.begin(), turned.base.end());
    const ShapeGeometry geometry = geometry_of(turned);
    ASSERT_EQ(geometry.parts.size(), 1u);
    ASSERT_EQ(geometry.parts[0].faces.size(), 6u);
    for (Index f = 0; f < 6; ++f) EXPECT_EQ(geometry.parts[0].faces[f].face, f);
    EXPECT_NEAR(measure_parts(geometry).volume, 3 * 3.5, rounding);
    expect_exact_sides(turned);
  }
}

TEST(Prism, HasTheShoelaceVolumeOnConcaveBases) {
  const Placement oblique{{10, -20, 30}, normalized(Vec3{2, 1, 2}), normalized(Vec3{-1, 2, 0})};
  for (const Polygon2& base : {l_shape, plus_shape, comb(3), comb(12), spiral(2), spiral(4)})
    for (const Placement& placement : {Placement{}, oblique}) {
      expect_prism(base, placement, {0.3, -0.2, 2}, 10 * rounding);
      expect_prism(Polygon2(base.rbegin(), base.rend()), placement, {1, 1, -3}, 10 * rounding);
      expect_exact_sides({placement(base), {0.3, -0.2, 2}});
    }
}

// Hertel and Mehlhorn: at most two diagonals remain at each reflex corner.
TEST(Prism, OfConcaveBasesNeedsFewParts) {
  EXPECT_EQ(geometry_of(PrismShape{Placement{}(l_shape), {0, 0, 1}}).parts.size(), 2u);
  Random random(3);
  for (int i = 0; i < 40; ++i) {
    const Polygon2 base = random_star(4 + i, random);
    const std::size_t n = base.size();
    std::size_t reflex = 0;
    for (std::size_t k = 0; k < n; ++k) {
      const auto &a = base[k], &b = base[(k + 1) % n], &c = base[(k + 2) % n];
      if ((b[0] - a[0]) * (c[1] - b[1]) < (b[1] - a[1]) * (c[0] - b[0])) ++reflex;
    }
    const std::size_t parts = geometry_of(PrismShape{Placement{}(base), {0, 0, 1}}).parts.size();
    EXPECT_LE(parts, 2 * reflex + 1);
    EXPECT_GE(parts, (reflex + 1) / 2 + 1);
  }
}

TEST(Prism, OnRandomConcaveBasesAnywhereIsFilledOnce) {
  Random random(20240607);
  for (int i = 0; i < 60; ++i) {
    const Real reach = std::array{0.0, 1e3, 1e6}[i % 3];
    const Placement placement = random_placement(reach, random);
    const Polygon2 base = random_star(4 + i % 23, random);
    Vec3 extrude = random.uniform(0.5, 3) * random.direction();
    while (std::abs(dot(placement.normal(), extrude)) < 0.3) extrude = 2.0 * random.direction();
    SCOPED_TRACE(testing::Message() << "case " << i);
    // Corners are off by the rounding of their coordinates, against edges of some 0.1 m.
    expect_prism(base, placement, extrude, 100 * rounding + 1e-14 * reach);
    expect_exact_sides({placement(base), extrude});
  }
}

TEST(Prism, KeepsItsSidesApartWhereTheyLieOnOnePlane) {
  // The teeth's gaps are three faces on one plane, and no part holds two of them.
  for (const ConvexPart& part : geometry_of(PrismShape{Placement{}(comb(4)), {0, 0, 1}}).parts)
    for (std::size_t f = 0; f < part.faces.size(); ++f)
      for (std::size_t g = 0; g < f; ++g) {
        const ExactVec3 c = cross(part.faces[f].plane.n, part.faces[g].plane.n);
        const bool parallel = c[0] == 0 && c[1] == 0 && c[2] == 0;
        EXPECT_FALSE(parallel && part.faces[f].inside_above == part.faces[g].inside_above &&
                     dot(part.faces[f].plane.n, part.faces[g].plane.n) > 0);
      }
}

TEST(Prism, MayHaveStraightCorners) {
  expect_prism({{0, 0}, {1, 0}, {2, 0}, {2, 1}, {0, 1}}, {}, {0, 0, 1}, rounding);
  expect_prism({{0, 0}, {1, 0}, {3, 0}, {3, 2}, {2, 2}, {1, 2}, {1, 1}, {0, 1}}, {}, {0, 1, 1},
               rounding);
}

TEST(Pyramid, HasAThirdOfThePrism) {
  const Placement oblique{{10, -20, 30}, normalized(Vec3{2, 1, 2}), normalized(Vec3{-1, 2, 0})};
  for (const Polygon2& base :
       {Polygon2{{0, 0}, {1, 0}, {0, 1}}, l_shape, plus_shape, comb(3), spiral(2)})
    for (const Placement& placement : {Placement{}, oblique}) {
      const Vec3 n = placement.normal();
      expect_pyramid(base, placement, placement.origin + 3.0 * n + Vec3{0.1, 0.2, 0},
                     10 * rounding);
      expect_pyramid(Polygon2(base.rbegin(), base.rend()), placement, placement.origin - 2.0 * n,
                     10 * rounding);
    }
}

TEST(Pyramid, OnRandomConcaveBasesAnywhereIsFilledOnce) {
  Random random(77);
  for (int i = 0; i < 60; ++i) {
    const Real reach = std::array{0.0, 1e3, 1e6}[i % 3];
    const Placement placement = random_placement(reach, random);
    const Vec3 apex = placement.origin + random.uniform(0.5, 3) * placement.normal() +
                      random.uniform(-1, 1) * placement.u;
    SCOPED_TRACE(testing::Message() << "case " << i);
    expect_pyramid(random_star(4 + i % 23, random), placement, apex,
                   100 * rounding + 1e-14 * reach);
  }
}

TEST(PrismAndPyramid, RefuseWhatHasNoVolume) {
  const std::vector<Vec3> square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const std::vector<Vec3> bow_tie{{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}};
  const std::vector<Vec3> line{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  EXPECT_NE(refusal(PrismShape{square, {1, 2, 0}}).find("extrude lies in"), std::string::npos);
  EXPECT_NE(refusal(PrismShape{square, {0, 0, 0}}).find("extrude lies in"), std::string::npos);
  EXPECT_NE(refusal(PyramidShape{square, {5, 2, 0}}).find("apex lies in"), std::string::npos);
  EXPECT_NE(refusal(PrismShape{bow_tie, {0, 0, 1}}).find("cross or touch"), std::string::npos);
  EXPECT_NE(refusal(PyramidShape{bow_tie, {0, 0, 1}}).find("cross or touch"), std::string::npos);
  EXPECT_NE(refusal(PrismShape{line, {0, 0, 1}}).find("collinear"), std::string::npos);
  EXPECT_NE(refusal(PyramidShape{{}, {0, 0, 1}}).find("fewer than 3"), std::string::npos);
}

}  // namespace
}  // namespace rockfold::test
