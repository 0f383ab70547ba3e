// Finite strain: what rotates is not strained, forces are the derivative of the energy, the energy–momentum rule conserves.
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "kernels/finite/strained_body.hpp"
#include "kernels/integrate/moments.hpp"
#include "src/base/vector.hpp"
#include "src/space/shape_functions.hpp"
#include "tests/reference/box_covers.hpp"
#include "tests/reference/slivers.hpp"

namespace rockfold {
namespace {

/// Whole lattice cells, oblique, of every kind and order.
CoverArrays whole_cells(LatticeKind kind, int order) {
  CoverArrays a;
  a.order = order;
  a.lattice.kind = kind;
  a.lattice.origin = {3, -2, 11};
  a.lattice.edge = {{{0.5, 0.03, 0.0}, {-0.1, 0.6, 0.05}, {0.04, 0.02, 0.4}}};
  a.lattice.cells = {2, 2, 1};
  std::vector<Index> cover_of(5 * a.lattice.grid(), none);
  for (Index c = 0; c < 4; ++c)
    for (int n = 0; n < a.nodes_per_cell(); ++n) cover_of[a.lattice.cell_node(c, n)] = 0;
  for (Index n = 0; n < static_cast<Index>(cover_of.size()); ++n)
    if (cover_of[n] == 0) {
      cover_of[n] = a.cover_count();
      a.cover_node.push_back(n);
    }
  for (Index c = 0; c < 4; ++c) {
    a.regular_cell.push_back(c);
    a.regular_material.push_back(0);
    a.regular_block.push_back(0);
    for (int n = 0; n < a.nodes_per_cell(); ++n)
      a.regular_cover.push_back(cover_of[a.lattice.cell_node(c, n)]);
  }
  a.piece_begin = a.triangle_begin = a.vertex_begin = {0};
  return a;
}

CoverArrays cut_box(int order) {
  const Lattice lattice =
      reference::turned_lattice({0.11, -0.23, 0.37}, 0.55, 0.3, 0.2, {0.5, 0.6, 0.5}, 1.0);
  CoverArrays a =
      reference::cover_regions(lattice, {reference::box({0.05, 0.02, 0.03}, {1.1, 1.3, 1.2})})
          .arrays;
  a.order = order;
  return a;
}

std::vector<CoverArrays> rocks() {
  std::vector<CoverArrays> result;
  for (const int order : {0, 1, 2}) {
    for (const LatticeKind kind : {LatticeKind::tet5, LatticeKind::tet5_mixed, LatticeKind::tet6,
                                   LatticeKind::tet24, LatticeKind::hex8})
      result.push_back(whole_cells(kind, order));
    result.push_back(cut_box(order));
  }
  return result;
}

const std::vector<ElasticMaterial> stone{{2500, 1e3, 0.25}};

/// A linear field as unknowns: its values at the nodes, and nothing else.
std::vector<Vec3> linear_field(const CoverArrays& a, const Mat3& h, const Vec3& shift = {}) {
  std::vector<Vec3> d(a.unknown_count(), Vec3{});
  for (Index p = 0; p < a.cover_count(); ++p) {
    const Vec3 x = a.lattice.node_position(a.cover_node[p]);
    for (int i = 0; i < 3; ++i) d[p][i] = dot(h[i], x) + shift[i];
  }
  return d;
}

std::vector<Vec3> random_field(const CoverArrays& a, unsigned seed, Real size) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<Real> unit(-size, size);
  std::vector<Vec3> d(a.unknown_count());
  for (Vec3& v : d) v = {unit(random), unit(random), unit(random)};
  return d;
}

Real work(const std::vector<Vec3>& f, const std::vector<Vec3>& d) {
  Real sum = 0;
  for (std::size_t i = 0; i < f.size(); ++i) sum += dot(f[i], d[i]);
  return sum;
}

Mat3 rotation(Real angle) {  // about (1, 2, 2)/3, minus the identity
  const Vec3 n{1.0 / 3, 2.0 / 3, 2.0 / 3};
  const Real c = std::cos(angle), s = std::sin(angle);
  Mat3 r{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) r[i][j] = (1 - c) * n[i] * n[j] + (i == j ? c - 1 : 0);
  r[0][1] -= s * n[2], r[1][0] += s * n[2];
  r[1][2] -= s * n[0], r[2][1] += s * n[0];
  r[2][0] -= s * n[1], r[0][2] += s * n[1];
  return r;
}

TEST(FiniteStrain, WeightsSumToTheVolumeOfTheRock) {
  for (const CoverArrays& a : rocks()) {
    const auto& e = a.lattice.edge;
    const Real cells = 4 * dot(e[0], cross(e[1], e[2]));
    EXPECT_NEAR(StrainedBody(a, stone).volume() / (a.cut_count() > 0 ? 1.05 * 1.28 * 1.17 : cells),
                1, 1e-12);
  }
}

TEST(FiniteStrain, ARotationByAnyAngleStrainsNothing) {
  for (const CoverArrays& a : rocks()) {
    StrainedBody b(a, stone);
    for (const Real angle : {0.3, 3.0, 62.8318}) {
      b.deform(linear_field(a, rotation(angle), {100, 200, -300}));
      EXPECT_NEAR(b.strain_energy() / (1e3 * b.volume()), 0, 1e-24);
      // 1e3 Pa on areas of 1 m², positions of 300 m against cells of 0.5 m
      for (const Vec3& f : b.forces()) EXPECT_NEAR(norm(f) / 1e3, 0, 1e-11);
    }
  }
}

TEST(FiniteStrain, OfAUniformStretchHasItsEnergyAndCauchyStress) {
  const Mat3 h{{{0.2, 0.05, 0}, {0, -0.1, 0.03}, {0.02, 0, 0.1}}};
  Mat3 f = h, strain{}, second{}, cauchy{};
  for (int i = 0; i < 3; ++i) f[i][i] += 1;
  Real trace = 0, energy = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      for (int m = 0; m < 3; ++m) strain[i][j] += 0.5 * f[m][i] * f[m][j];
      if (i == j) strain[i][j] -= 0.5, trace += strain[i][j];
    }
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      second[i][j] = 800 * strain[i][j] + (i == j ? 400 * trace : 0);  // λ = μ = 400
      energy += 0.5 * second[i][j] * strain[i][j];
    }
  const Real jacobian = dot(f[0], cross(f[1], f[2]));
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int m = 0; m < 3; ++m)
        for (int n = 0; n < 3; ++n) cauchy[i][j] += f[i][m] * second[m][n] * f[j][n] / jacobian;
  for (const CoverArrays& a : rocks()) {
    StrainedBody b(a, stone);
    b.deform(linear_field(a, h));
    EXPECT_NEAR(b.strain_energy() / (energy * b.volume()), 1, 1e-11);
    for (const auto& s : b.element_stress()) {
      const Real want[6] = {cauchy[0][0], cauchy[1][1], cauchy[2][2],
                            cauchy[0][1], cauchy[1][2], cauchy[2][0]};
      for (int k = 0; k < 6; ++k) EXPECT_NEAR(s[k], want[k], 1e-8);
    }
  }
}

TEST(FiniteStrain, ForcesAreTheDerivativeOfTheEnergy) {
  InitialStress initial;
  initial.at = {-30, -20, -50, 5, 3, 1};
  initial.gradient = {-3, -2, -5, 0, 0, 0};
  initial.reference_z = 11;
  initial.any = true;
  for (const CoverArrays& a : rocks()) {
    StrainedBody b(a, stone, initial);
    const auto d = random_field(a, 3, 0.02), v = random_field(a, 4, 1);
    b.deform(d);
    const Real rate = work(b.forces(), v);
    const Real step = 1e-6;
    auto at = [&](Real s) {
      auto moved = d;
      for (std::size_t i = 0; i < d.size(); ++i) moved[i] += s * v[i];
      b.deform(moved);
      return b.strain_energy();
    };
    EXPECT_NEAR((at(step) - at(-step)) / (2 * step) / rate, 1, 1e-6);
  }
}

TEST(FiniteStrain, OfASliverIsThatOfItsStiffnessWhereSmall) {
  for (const LatticeKind kind : {LatticeKind::tet6, LatticeKind::hex8})
    for (const int order : {0, 1, 2}) {
      const Real size = 1e-3, strain = 1e-9;
      const CoverArrays a = reference::corner_of_a_cell(kind, order, size);
      const CoverSystem system(a, piece_moments(a), stone, {});
      const auto scale = reference::stiffness_scale(system, a.unknown_count());
      // Each function by itself strains the rock as much as the others.
      const Real energy = stone[0].young_modulus * strain * strain * std::pow(size, 3);
      auto d = random_field(a, 5, 1);
      for (std::size_t i = 0; i < d.size(); ++i)
        for (int c = 0; c < 3; ++c) d[i][c] *= scale[i][c] * std::sqrt(energy);
      StrainedBody b(a, stone);
      b.deform(d);
      const auto found = b.forces(), expected = system.apply({1, 0, 0}, d);
      Real largest = 0, error = 0;
      for (std::size_t i = 0; i < d.size(); ++i)
        for (int c = 0; c < 3; ++c) {
          largest = std::max(largest, std::abs(scale[i][c] * expected[i][c]));
          error = std::max(error, std::abs(scale[i][c] * (found[i][c] - expected[i][c])));
        }
      EXPECT_LE(error, 1e-6 * largest) << static_cast<int>(kind) << ", order " << order;
    }
}

TEST(FiniteStrain, MiddleRuleDoesTheWorkThatTheEnergyGains) {
  for (const CoverArrays& a : rocks()) {
    StrainedBody b(a, stone);
    const auto from = random_field(a, 5, 0.05), to = random_field(a, 6, 0.05);
    b.deform(from);
    b.keep();
    const Real before = b.strain_energy();
    b.deform(to);
    auto way = to;
    for (std::size_t i = 0; i < way.size(); ++i) way[i] -= from[i];
    EXPECT_NEAR(work(b.forces(true), way) / (b.strain_energy() - before), 1, 1e-10);
  }
}

TEST(FiniteStrain, ViscosityResistsStrainButNotRotation) {
  for (const CoverArrays& a : rocks()) {
    StrainedBody b(a, stone);
    b.deform(linear_field(a, rotation(0.1)));
    b.keep();
    b.deform(linear_field(a, rotation(0.4)));
    for (const Vec3& f : b.forces(false, 10)) EXPECT_NEAR(norm(f) / 1e3, 0, 1e-11);
    const auto d = random_field(a, 8, 0.01);
    b.deform(std::vector<Vec3>(d.size(), Vec3{}));
    b.keep();
    b.deform(d);
    EXPECT_GT(work(b.forces(false, 10), d), 5 * work(b.forces(), d));
  }
}

}  // namespace
}  // namespace rockfold
