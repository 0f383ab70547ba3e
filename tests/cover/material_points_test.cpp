// Points of the material: where loads, monitors, block vertices and fixed points are in the covers.
#include <cmath>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "host/cover/lattice/piece_index.hpp"
#include "src/base/error.hpp"
#include "tests/cover/covers.hpp"

namespace rockfold::test {
namespace {

/// A linear field sampled at the covers' nodes.
Vec3 linear(const Vec3& x) {
  return {1 + 2 * x[0] - x[1] + 0.5 * x[2], -3 + x[0] + 4 * x[2], 0.25 * x[1] - x[2]};
}

Vec3 interpolated(const CoverArrays& a, const MaterialPoints& points, std::size_t n) {
  Vec3 u{};
  for (int c = 0; c < 4; ++c) {
    const Index p = points.unknown[points.begin[n] + c];
    u += points.weight[points.begin[n] + c] *
         linear(a.lattice.node_position(a.lattice.node_ijk(a.cover_node[p])));
  }
  return u;
}

Model jointed_box() {
  Model model = box_model({0, 0, 0}, {5, 4, 3});
  add_joint(model, DipOrientation{35, 110}, {2, 2, 1.5});
  add_joint(model, DipOrientation{80, 10}, {2, 2, 1.5});
  return model;
}

TEST(MaterialPoints, ReproduceLinearFieldsAnywhereInTheRock) {
  CoverSpec spec = spacing(0.7);
  spec.directions = {{{0, 0}, {90, 30}, {90, 120}}};
  const Covered c = cover(jointed_box(), spec);
  std::mt19937 random(7);
  std::uniform_real_distribution<Real> unit(0, 1);
  std::vector<Vec3> x;
  for (int i = 0; i < 200; ++i) x.push_back({5 * unit(random), 4 * unit(random), 3 * unit(random)});
  const MaterialPoints points = locate_points(c.covering, x);
  for (std::size_t n = 0; n < x.size(); ++n) {
    ASSERT_NE(points.element[n], none);
    const Vec3 u = interpolated(c.arrays(), points, n);
    // Fields of size 30, a dozen operations.
    for (int d = 0; d < 3; ++d) EXPECT_NEAR(u[d], linear(x[n])[d], 1e-13);
    Real sum = 0;
    for (Index i = points.begin[n]; i < points.begin[n + 1]; ++i) {
      sum += points.weight[i];
      EXPECT_GT(points.weight[i], -1e-8);
    }
    EXPECT_NEAR(sum, 1, 1e-14);
  }
}

TEST(MaterialPoints, OutsideTheRockAreNotFound) {
  const Covered c = cover(jointed_box(), spacing(0.7));
  const MaterialPoints points =
      locate_points(c.covering, {{-0.1, 1, 1}, {2, 2, 3.001}, {900, 0, 0}});
  for (std::size_t n = 0; n < points.size(); ++n) EXPECT_EQ(points.element[n], none);
}

TEST(MaterialPoints, OnAJointBelongToTheLowerBlock) {
  Model model = box_model({0, 0, 0}, {4, 4, 4});
  add_joint(model, Vec3{0, 0, 1}, {0, 0, 2.2});
  const Covered c = cover(model, spacing(1));
  const MaterialPoints points = locate_points(c.covering, {{1.1, 1.2, 2.2}});
  const Index e = points.element[0] - 6 * c.arrays().regular_count();
  ASSERT_GE(e, 0);
  EXPECT_EQ(c.arrays().piece_block[c.arrays().piece_begin[e]], 0);
}

TEST(MaterialPoints, OfBlockVerticesMoveWithTheirOwnBlock) {
  const Covered c = cover(jointed_box(), spacing(0.7));
  const BlockArrays& blocks = c.blocks.arrays;
  const MaterialPoints points = locate_block_vertices(c.covering, blocks);
  ASSERT_EQ(points.size(), blocks.vertex.size());
  // Each block is given its own translation: every vertex must move with it.
  const CoverArrays& a = c.arrays();
  std::vector<Real> cover_block(a.cover_count(), -1);
  for (Index e = 0; e < a.cut_count(); ++e)
    for (int k = 0; k < 4; ++k)
      cover_block[a.element_cover[4 * e + k]] = a.piece_block[a.piece_begin[e]];
  for (Index r = 0; r < a.regular_count(); ++r)
    for (int k = 0; k < 8; ++k) cover_block[a.regular_cover[8 * r + k]] = a.regular_block[r];
  for (Index b = 0; b < blocks.block_count(); ++b)
    for (Index v = blocks.vertex_begin[b]; v < blocks.vertex_begin[b + 1]; ++v) {
      ASSERT_NE(points.element[v], none);
      for (int k = 0; k < 4; ++k) EXPECT_EQ(cover_block[points.unknown[points.begin[v] + k]], b);
    }
}

Covered fixed_box(const Region& where, std::array<bool, 3> components = {true, true, true}) {
  Model model = jointed_box();
  Fixed fixed;
  fixed.where = where;
  fixed.components = components;
  fixed.value = {0, 0, -0.25};
  model.fixed.push_back(fixed);
  return cover(model, spacing(0.7));
}

/// The sum over a row's weights times a linear function at the nodes of the unknowns (order 0).
Real applied(const CoverArrays& a, const MaterialPoints& points, std::size_t n, int axis) {
  Real sum = 0;
  for (Index i = points.begin[n]; i < points.begin[n + 1]; ++i)
    sum += points.weight[i] *
           (axis < 0 ? 1 : a.lattice.node_position(a.cover_node[points.unknown[i]])[axis]);
  return sum;
}

TEST(FixedPoints, OnAFaceShareItsAreaSoThatLinearFunctionsIntegrateExactly) {
  // Means of the face's patches share its area; moments of them vanish for a translation.
  const Covered c = fixed_box(FaceRegion{0, {4}}, {false, true, true});
  const FixedPoints f = fixed_points(c.blocks.cutting, c.covering, c.model);
  const Real per_area = 10 * 30e9 / 0.7;
  Real area = 0, moment_x = 0, moment_y = 0;
  for (std::size_t n = 0; n < f.points.size(); ++n) {
    EXPECT_EQ(f.component[n], (std::array<std::uint8_t, 3>{0, 1, 1}));
    EXPECT_EQ(f.condition[n], 0);
    EXPECT_NEAR(applied(c.arrays(), f.points, n, 2), 0, 1e-13);
    if (std::abs(applied(c.arrays(), f.points, n, -1)) < 1e-12) {
      EXPECT_EQ(f.value[n], Vec3{});
      continue;
    }
    EXPECT_NEAR(applied(c.arrays(), f.points, n, -1), 1, 1e-12);
    EXPECT_EQ(f.value[n], (Vec3{0, 0, -0.25}));
    area += f.stiffness[n] / per_area;
    moment_x += f.stiffness[n] / per_area * applied(c.arrays(), f.points, n, 0);
    moment_y += f.stiffness[n] / per_area * applied(c.arrays(), f.points, n, 1);
  }
  EXPECT_NEAR(area, 20, 20e-12);
  EXPECT_NEAR(moment_x, 50, 50e-12);
  EXPECT_NEAR(moment_y, 40, 50e-12);
}

TEST(FixedPoints, OnAFaceOfLatticeNodesAreThoseNodes) {
  Model model = box_model({0, 0, 0}, {3, 3, 3});
  Fixed fixed;
  fixed.where = FaceRegion{0, {4}};
  model.fixed.push_back(fixed);
  CoverSpec spec = spacing(1);
  spec.origin = Vec3{0, 0, 0};
  const Covered c = cover(model, spec);
  const FixedPoints f = fixed_points(c.blocks.cutting, c.covering, c.model);
  std::set<Index> held;
  for (std::size_t n = 0; n < f.points.size(); ++n)
    for (Index i = f.points.begin[n]; i < f.points.begin[n + 1]; ++i)
      if (f.points.weight[i] != 0) {
        EXPECT_NEAR(f.points.weight[i], 1, 1e-12);
        held.insert(f.points.unknown[i]);
      }
  EXPECT_EQ(held.size(), 16u);
}

TEST(FixedPoints, OnACutFaceAreFewerThanTheCoversThere) {
  Model model = box_model({0, 0, 0}, {10, 10, 5});
  Fixed fixed;
  fixed.where = FaceRegion{0, {4}};
  model.fixed.push_back(fixed);
  const Covered c = cover(model, spacing(0.8));
  const FixedPoints f = fixed_points(c.blocks.cutting, c.covering, c.model);
  // A lattice plane has some (10/0.8 + 1)² = 182 nodes; polynomials of degree 1 on 5 × 5 patches are 75 rows.
  EXPECT_EQ(f.points.size(), 75u);
}

TEST(FixedPoints, OfAWholeBlockAreAllOfItsUnknowns) {
  const Covered c = fixed_box(BlockRegion{{0.1, 0.1, 0.1}});
  const FixedPoints f = fixed_points(c.blocks.cutting, c.covering, c.model);
  for (std::size_t n = 0; n < f.points.size(); ++n) {
    ASSERT_EQ(f.points.begin[n + 1] - f.points.begin[n], 1);
    EXPECT_EQ(f.points.weight[f.points.begin[n]], 1);
  }
}

TEST(FixedPoints, OfEachKindOfRegionLieInIt) {
  const Vec3 unit_z{0, 0, 1};
  for (const Region& where : std::initializer_list<Region>{
           BoxRegion{{0, 0, 0}, {1, 1, 1}}, PlaneRegion{{0, 0, 3}, unit_z, 1e-9},
           BlockRegion{{0.1, 0.1, 0.1}}, PointRegion{{2.5, 2, 1}}}) {
    const Covered c = fixed_box(where);
    const FixedPoints f = fixed_points(c.blocks.cutting, c.covering, c.model);
    ASSERT_GT(f.points.size(), 0u);
    for (std::size_t n = 0; n < f.points.size(); ++n) {
      const bool mean = applied(c.arrays(), f.points, n, -1) > 0.5;
      // Elements wholly in the box are held by the nodes of their covers, at most a spacing away.
      for (int d = 0; std::holds_alternative<BoxRegion>(where) && d < 3; ++d) {
        EXPECT_LE(applied(c.arrays(), f.points, n, d), 1.7 + 1e-12);
      }
      if (std::holds_alternative<PlaneRegion>(where)) {
        EXPECT_NEAR(applied(c.arrays(), f.points, n, 2), mean ? 3 : 0, 2e-9);
      }
      EXPECT_GT(f.stiffness[n], 0);
    }
  }
}

TEST(FixedPoints, OfARegionWithoutRockAreAnErrorThatNamesTheEntry) {
  const Covered c = fixed_box(BoxRegion{{10, 10, 10}, {11, 11, 11}});
  try {
    fixed_points(c.blocks.cutting, c.covering, c.model);
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::model);
    EXPECT_EQ(e.diagnostics().front().place.key, "fixed[1].where");
  }
}

}  // namespace
}  // namespace rockfold::test
