// Points and weights over elements of any shape.
#include "kernels/finite/quadrature.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "kernels/finite/point_rule.hpp"
#include "kernels/integrate/moments.hpp"
#include "src/base/gauss.hpp"
#include "src/base/vector.hpp"
#include "tests/reference/box_covers.hpp"

namespace rockfold::finite {
namespace {

Real monomial(const Vec3& x, int a, int b, int c) {
  return std::pow(x[0], a) * std::pow(x[1], b) * std::pow(x[2], c);
}

Real integral(const std::vector<RockPoint>& rule, int a, int b, int c) {
  Real sum = 0;
  for (const RockPoint& p : rule) sum += p.weight * monomial(p.eta, a, b, c);
  return sum;
}

Real factorial(int n) {
  return std::tgamma(n + 1.0);
}

TEST(Gauss, PointsAreExactToTwiceTheirNumber) {
  for (int power = 0; power <= 2; ++power)
    for (int n = 1; n <= 8; ++n)
      for (int m = 0; m < 2 * n; ++m) {
        Real sum = 0;
        for (const auto& [x, weight] : gauss_points(n, power)) sum += weight * std::pow(x, m);
        EXPECT_NEAR(sum * factorial(m + power + 1) / (factorial(m) * factorial(power)), 1, 1e-12)
            << power << " " << n << " " << m;
      }
}

/// Points without order in a box, many of them on a plane and on a line: what tells polynomials apart is not found at once.
std::vector<RockPoint> scattered(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<Real> place(-0.5, 0.5), weight(1e-6, 1);
  std::vector<RockPoint> rule;
  for (std::size_t i = 0; i < count; ++i) {
    const Real x = place(random), y = place(random), z = place(random);
    rule.push_back({{x, i % 3 == 0 ? x : y, i % 2 == 0 ? x : z}, std::pow(weight(random), 4)});
  }
  return rule;
}

TEST(PointRule, ReducedHasFewPositiveWeightsAndTheSameIntegrals) {
  for (const int degree : {1, 2, 4, 6, 8})
    for (const std::size_t count : {40U, 400U, 1500U}) {
      std::vector<RockPoint> all = scattered(count, 7 * degree + static_cast<unsigned>(count));
      if (count == 400U)  // in a plane, where polynomials are not all different
        for (RockPoint& p : all) p.eta[2] = 0.3 * p.eta[0] - 0.1 * p.eta[1];
      const std::vector<RockPoint> few = reduce(all, degree);
      const std::size_t most = (degree + 1) * (degree + 2) * (degree + 3) / 6;
      EXPECT_LE(few.size(), std::min(most, count));
      const Real volume = integral(all, 0, 0, 0);
      for (const RockPoint& p : few) EXPECT_GE(p.weight, 0);
      for (int a = 0; a <= degree; ++a)
        for (int b = 0; a + b <= degree; ++b)
          for (int c = 0; a + b + c <= degree; ++c)
            EXPECT_NEAR(integral(few, a, b, c), integral(all, a, b, c), 1e-12 * volume)
                << degree << " " << count;
    }
}

TEST(Quadrature, OfCutElementsHasPositiveWeightsAndTheirMoments) {
  for (const LatticeKind kind : {LatticeKind::tet5, LatticeKind::tet6, LatticeKind::hex8})
    for (const int order : {0, 1, 2}) {
      Lattice lattice =
          reference::turned_lattice({0.11, -0.23, 0.37}, 0.55, 0.3, 0.2, {0.5, 0.6, 0.5}, 1.0);
      lattice.kind = kind;
      CoverArrays a =
          reference::cover_regions(lattice, {reference::box({0.05, 0.02, 0.03}, {1.1, 1.3, 1.2})})
              .arrays;
      a.order = order;
      const PieceMoments moments = piece_moments(a);
      const Quadrature rule = make_quadrature(a, moments);
      const int degree = 2 * (order + (kind == LatticeKind::hex8 ? 3 : 1) - 1);
      const std::size_t terms = moments.local.size() / a.piece_block.size();
      const Index whole = a.parts_per_cell() * a.regular_count();
      ASSERT_GT(a.cut_count(), 20);
      for (Index e = 0; e < a.cut_count(); ++e) {
        const Real* weight = &rule.weight[static_cast<std::size_t>(whole + e) * rule.points];
        const Vec3* place =
            &rule.place[static_cast<std::size_t>(rule.kind[whole + e]) * rule.points];
        Real volume = 0;
        for (Index q = a.piece_begin[e]; q < a.piece_begin[e + 1]; ++q) volume += moments.volume[q];
        for (int q = 0; q < rule.points; ++q) EXPECT_GE(weight[q], 0);
        for (int x = 0; x <= degree; ++x)
          for (int y = 0; x + y <= degree; ++y)
            for (int z = 0; x + y + z <= degree; ++z) {
              Real exact = 0, sum = 0;
              for (Index q = a.piece_begin[e]; q < a.piece_begin[e + 1]; ++q)
                exact += moments.local[terms * q + monomial_index(x, y, z)];
              for (int q = 0; q < rule.points; ++q) sum += weight[q] * monomial(place[q], x, y, z);
              EXPECT_NEAR(sum, exact, 1e-13 * volume) << e << ": " << x << y << z;
            }
      }
    }
}

}  // namespace
}  // namespace rockfold::finite
