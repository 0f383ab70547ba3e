#include <cmath>

#include <gtest/gtest.h>

#include "tests/solve/systems/systems.hpp"

namespace rockfold {
namespace {

using reference::Dense;

/// What rounding may leave of a product: some 50 terms of size |A|·|x|, each with 2^-53 and what was lost in A itself, whose
/// entries are sums over up to 24 elements.
constexpr Real rounding = 1e-13;

Real largest_entry(const Dense& a) {
  Real most = 0;
  for (Real e : a.entry) most = std::max(most, std::abs(e));
  return most;
}

void expect_product(const SmallSystem& s, const SystemCoefficients& c) {
  const Dense k = reference::assemble_stiffness(s.covers(), s.materials);
  const Dense m = reference::assemble_mass(s.covers(), s.materials);
  Dense a = reference::combine(c.stiffness, k, c.mass, m);
  a = reference::combine(1, a, c.springs, reference::assemble_springs(s.covers(), s.fixed));
  const auto x = reference::scattered(s.covers().cover_node.size(), 7);
  const auto found = s.make().apply(c, x);
  EXPECT_LE(reference::largest_difference(found, reference::multiply(a, x)),
            rounding * largest_entry(a));
}

TEST(Operator, EqualsDenseAssemblyOnACutLatticeOfTwoMaterials) {
  const SmallSystem s = cut_system();
  const OperatorSize size = s.make().size();
  EXPECT_EQ(size.stencil_rows + size.block_rows, s.covers().cover_count());
  expect_product(s, {1, 0, 0});
  expect_product(s, {0, 1, 0});
  expect_product(s, {0, 0, 1});
  expect_product(s, {0.7, 1.9, 2.3});
}

TEST(Operator, EqualsDenseAssemblyOnAnObliqueLattice) {
  const SmallSystem s = uncut_system(5, 4, 4);
  EXPECT_EQ(s.make().size().stencil_rows, 4 * 3 * 3);
  expect_product(s, {0.7, 1.9, 0});
}

TEST(Operator, StencilRowsEqualBlockRows) {
  const SmallSystem s = uncut_system();
  const SmallSystem t = with_block_rows_alone(s);
  EXPECT_EQ(s.make().size().stencil_rows, 6 * 5 * 4);
  EXPECT_EQ(t.make().size().stencil_rows, 0);
  const auto x = reference::scattered(s.covers().cover_node.size(), 3);
  for (const SystemCoefficients& c : {SystemCoefficients{1, 0, 0}, SystemCoefficients{0, 1, 0}}) {
    const auto y = s.make().apply(c, x);
    EXPECT_LE(reference::largest_difference(y, t.make().apply(c, x)),
              rounding * reference::largest(y));
  }
}

TEST(Operator, GivesATranslationExactlyNoForce) {
  const SmallSystem s = cut_system();
  const std::vector<Vec3> far(s.covers().cover_node.size(), Vec3{1e6 + 0.1, -3.7e5, 12.3});
  EXPECT_EQ(reference::largest(s.make().apply({1, 0, 0}, far)), 0);
}

/// One tetrahedron of an oblique lattice, whole: M = ρV/20 (1 + δ), and a linear field's energy is V·(σ:ε)/2.
TEST(Operator, OfOneTetrahedronEqualsTheClosedForm) {
  SmallSystem s = with_block_rows_alone(uncut_system(1, 1, 1));
  CoverArrays& a = s.covered.arrays;
  const int kept = 4;
  a.element_cell.resize(1);
  a.element_part = {kept};
  a.element_material.resize(1);
  a.element_cover.assign(a.element_cover.begin() + 4 * kept,
                         a.element_cover.begin() + 4 * kept + 4);
  a.piece_begin = {0, 1};
  a.piece_block = {0};
  a.triangle_begin = a.vertex_begin = {0, 4};
  a.triangle_vertex.resize(12);
  a.vertex_xyz.assign(a.vertex_xyz.begin() + 12 * kept, a.vertex_xyz.begin() + 12 * kept + 12);

  const CoverSystem system = s.make();
  // V = |det(edges)| / 6 by hand: edges (.5,.03,0) (-.1,.6,.05) (.04,.02,.4).
  const Real v = (0.5 * (0.6 * 0.4 - 0.05 * 0.02) - 0.03 * (-0.1 * 0.4 - 0.05 * 0.04)) / 6;
  std::vector<Vec3> unit(8);
  unit[a.element_cover[1]] = {0, 1, 0};
  const auto mass = system.apply({0, 1, 0}, unit);
  for (int c = 0; c < 4; ++c)
    EXPECT_NEAR(mass[a.element_cover[c]][1] / (2000 * v / 20 * (c == 1 ? 2 : 1)), 1, 1e-12);

  // E = 1000, ν = 0.25, energy density 0.0105.
  const auto d = reference::sample_at_nodes(a, [](const Vec3& x) {
    return Vec3{1e-3 * (2 * x[0] + x[1] - x[2] / 2), 1e-3 * (x[0] / 2 - x[1] + 1.5 * x[2]),
                1e-3 * (-x[0] + x[1] / 2 + 3 * x[2])};
  });
  const auto force = system.apply({1, 0, 0}, d);
  Real energy = 0;
  for (std::size_t p = 0; p < d.size(); ++p)
    for (int i = 0; i < 3; ++i) energy += 0.5 * d[p][i] * force[p][i];
  // 1e-12: the field is of size 0.03, its differences 1e-3, so 2^-53 grows by 30.
  EXPECT_NEAR(energy / (0.0105 * v), 1, 1e-12);
}

TEST(Operator, BlocksOfAnotherBodyDoNotMeet) {
  const SmallSystem s = cut_system();
  std::vector<Vec3> x(s.covers().cover_node.size());
  for (std::size_t p = 0; p < x.size(); ++p)
    if (s.covered.cover_body[p] == 1) x[p] = {1, 2, 3};
  const auto y = s.make().apply({1, 1, 0}, x);
  for (std::size_t p = 0; p < x.size(); ++p) {
    if (s.covered.cover_body[p] == 1) continue;
    EXPECT_EQ(y[p], (Vec3{0, 0, 0}));
  }
}

}  // namespace
}  // namespace rockfold
