// Patch tests: a box on a lattice that none of its faces meets, loaded as a polynomial displacement asks, takes that displacement.
// Covers of order p on cells reproduce polynomials of degree p + 1, on a block those of degree p.
#include <gtest/gtest.h>

#include "tests/solve/systems/polynomial_field.hpp"
#include "tests/solve/systems/spaces.hpp"
#include "tests/solve/systems/systems.hpp"

namespace rockfold {
namespace {

const Vec3 low{0.05, 0.02, 0.03}, high{1.1, 0.95, 0.9};

/// The box, held at four points that move as the field says.
SmallSystem loaded_box(const Space& space, const Lattice& lattice, const PolynomialField& field) {
  SmallSystem s;
  s.covered = reference::cover_regions(lattice, {reference::box(low, high)});
  s.covered.arrays.order = space.order;
  s.materials = {{2000, 1e3, 0.25}};
  s.fixed = reference::fix(
      s.covered, {{0.1, 0.1, 0.1}, {1.0, 0.1, 0.2}, {0.2, 0.9, 0.1}, {0.6, 0.5, 0.8}},
      [&](const Vec3& x) { return field.at(x); }, 1e3, false);
  return s;
}

void expect_field(const SmallSystem& s, const PolynomialField& field, Real tolerance) {
  const auto load = field.load(s.covers(), s.materials[0], low, high);
  std::vector<Vec3> x(load.size());
  CoverSystem system = s.make();
  const SolveReport report = system.solve({1, 0, 1}, load, x, {1e-12, 20000});
  EXPECT_TRUE(report.converged) << report.residual << " after " << report.iterations;
  testing::Test::RecordProperty("iterations", report.iterations);
  const std::vector<Vec3> points{{0.07, 0.9, 0.88}, {0.5, 0.5, 0.5}, {1.05, 0.03, 0.85},
                                 {0.3, 0.7, 0.2},   {0.9, 0.8, 0.4}, {0.06, 0.03, 0.04}};
  const MaterialPoints at = reference::locate(s.covered, points);
  for (std::size_t n = 0; n < points.size(); ++n) {
    Vec3 u{};
    for (Index i = at.begin[n]; i < at.begin[n + 1]; ++i) u += at.weight[i] * x[at.unknown[i]];
    EXPECT_LE(norm(u - field.at(points[n])), tolerance * norm(field.at(points[n])))
        << "point " << n << ", " << report.iterations << " iterations";
  }
}

class Patch : public testing::TestWithParam<Space> {};
class LongPatch : public testing::TestWithParam<Space> {};
INSTANTIATE_TEST_SUITE_P(Cut, Patch, testing::ValuesIn(spaces(true)), space_name);
INSTANTIATE_TEST_SUITE_P(Cut, LongPatch, testing::ValuesIn(spaces(true)), space_name);

TEST_P(Patch, IsReproducedOnACutLattice) {
  const Space space = GetParam();
  const bool block = space.kind == LatticeKind::block;
  const PolynomialField field = PolynomialField::of_degree(block ? space.order : space.order + 1);
  // Hexahedra whose corners alone are filled are nearly dependent: at order 2 no solve gets to the tolerance where they are as small
  // as a turned lattice makes them. There the faces cut through the middle of cells instead.
  const bool turned = space.kind != LatticeKind::hex8 || space.order < 2;
  Lattice lattice = reference::turned_lattice({0.11, -0.23, 0.37}, 0.6, turned ? 0.3 : 0,
                                              turned ? 0.2 : 0, {0.57, 0.5, 0.46}, 0.9);
  lattice.kind = space.kind;
  if (block) {
    lattice.cells = {0, 0, 0};
    lattice.block_origin = {{0.5, 0.5, 0.4}};
  }
  expect_field(loaded_box(space, lattice, field), field, 1e-8);
}

/// Lattice planes 1e-9 of a cell inside the faces: covers outside hold nothing but slivers.
TEST_P(LongPatch, IsReproducedBesideSlivers) {
  const Space space = GetParam();
  if (space.kind == LatticeKind::block) GTEST_SKIP() << "a block has no slivers";
  const PolynomialField field = PolynomialField::of_degree(space.order + 1);
  Lattice lattice;
  lattice.kind = space.kind;
  const Real thin = 1e-9;
  lattice.edge = {{{0.525, 0, 0}, {0, 0.465, 0}, {0, 0, 0.435}}};
  lattice.cells = {4, 4, 4};
  for (int d = 0; d < 3; ++d) lattice.origin[d] = low[d] + (thin - 1) * lattice.edge[d][d];
  const SmallSystem s = loaded_box(space, lattice, field);
  ASSERT_GT(s.covers().cut_count(), 0);
  expect_field(s, field, 1e-6);
}

}  // namespace
}  // namespace rockfold
