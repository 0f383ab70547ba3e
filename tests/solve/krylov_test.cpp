// Krylov methods against a dense solve (Gauss with the largest pivots).
#include "kernels/krylov/krylov.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace rockfold {
namespace {

using Matrix = std::vector<std::vector<Real>>;  // by rows
using Vector = std::vector<Real>;

Vector flat(const std::vector<Vec3>& x) {
  Vector y;
  for (const Vec3& v : x) y.insert(y.end(), v.begin(), v.end());
  return y;
}
std::vector<Vec3> threes(const Vector& x) {
  std::vector<Vec3> y(x.size() / 3);
  for (std::size_t i = 0; i < x.size(); ++i) y[i / 3][i % 3] = x[i];
  return y;
}
Vector times(const Matrix& a, const Vector& x) {
  Vector y(x.size(), 0);
  for (std::size_t i = 0; i < x.size(); ++i)
    for (std::size_t j = 0; j < x.size(); ++j) y[i] += a[i][j] * x[j];
  return y;
}
HostApply product(const Matrix& a) {
  return [a](const std::vector<Vec3>& x, std::vector<Vec3>& y) { y = threes(times(a, flat(x))); };
}

Vector solve_densely(Matrix a, Vector b) {
  const std::size_t n = b.size();
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t p = k;
    for (std::size_t i = k; i < n; ++i)
      if (std::abs(a[i][k]) > std::abs(a[p][k])) p = i;
    std::swap(a[k], a[p]);
    std::swap(b[k], b[p]);
    for (std::size_t i = k + 1; i < n; ++i) {
      const Real share = a[i][k] / a[k][k];
      for (std::size_t j = k; j < n; ++j) a[i][j] -= share * a[k][j];
      b[i] -= share * b[k];
    }
  }
  for (std::size_t k = n; k-- > 0;) {
    for (std::size_t j = k + 1; j < n; ++j) b[k] -= a[k][j] * b[j];
    b[k] /= a[k][k];
  }
  return b;
}

Real norm(const Vector& x) {
  Real sum = 0;
  for (Real v : x) sum += v * v;
  return std::sqrt(sum);
}
Real distance(Vector x, const Vector& y) {
  for (std::size_t i = 0; i < x.size(); ++i) x[i] -= y[i];
  return norm(x);
}

/// A bar of n points of mass 1 in a time step of 1, joined by springs of 1 to 1000 and held at one end; `slip` couples each force across to
/// what presses its neighbour, as friction does that slides.
Matrix sliding_bar(std::mt19937& random, std::size_t n, Real slip) {
  std::uniform_real_distribution<Real> exponent(0, 3), sign(-1, 1);
  Matrix a(3 * n, Vector(3 * n, 0));
  for (std::size_t i = 0; i < n; ++i)
    for (int d = 0; d < 3; ++d) {
      const std::size_t here = 3 * i + d;
      const Real k = std::pow(10, exponent(random));
      a[here][here] += 1 + k;
      if (i == 0) continue;
      const std::size_t before = here - 3;
      a[before][before] += k;
      a[here][before] -= k;
      a[before][here] -= k;
      a[here][before + (d == 0 ? 2 : -d)] += slip * k * sign(random);
    }
  return a;
}

HostApply diagonal_inverse(const Matrix& a) {
  return [a](const std::vector<Vec3>& r, std::vector<Vec3>& z) {
    z = r;
    for (std::size_t i = 0; i < r.size(); ++i)
      for (int d = 0; d < 3; ++d) z[i][d] /= a[3 * i + d][3 * i + d];
  };
}

TEST(Bicgstab, EqualsADenseSolveOfUnsymmetricSystems) {
  std::mt19937 random(5);
  Index with = 0, without = 0;  // iterations, and a preconditioner
  for (int model = 0; model < 50; ++model) {
    const std::size_t n = 2 + model;
    const Matrix a = sliding_bar(random, n, 0.3);
    Vector b(3 * n);
    for (Real& v : b) v = std::uniform_real_distribution<Real>(-1, 1)(random);
    const Vector expected = solve_densely(a, b);
    for (const bool preconditioned : {false, true}) {
      std::vector<Vec3> x(n);
      const KrylovReport report = solve_krylov(KrylovMethod::bicgstab, product(a),
                                               preconditioned ? diagonal_inverse(a) : HostApply(),
                                               threes(b), x, 1e-10, 20000);
      EXPECT_TRUE(report.converged) << n << ", residual " << report.residual;
      EXPECT_LE(distance(times(a, flat(x)), b), 1.01e-10 * norm(b));
      EXPECT_LE(distance(flat(x), expected), 1e-6 * norm(expected)) << n;
      (preconditioned ? with : without) += report.iterations;
    }
  }
  EXPECT_LT(2 * with, without);
}

TEST(Bicgstab, SolvesSymmetricSystemsAsConjugateGradientsDo) {
  std::mt19937 random(6);
  const std::size_t n = 40;
  const Matrix a = sliding_bar(random, n, 0);
  Vector b(3 * n, 1);
  std::vector<Vec3> by_gradients(n), by_bicgstab(n);
  const HostApply inverse = diagonal_inverse(a);
  EXPECT_TRUE(solve_krylov(KrylovMethod::conjugate_gradients, product(a), inverse, threes(b),
                           by_gradients, 1e-12, 2000)
                  .converged);
  EXPECT_TRUE(
      solve_krylov(KrylovMethod::bicgstab, product(a), inverse, threes(b), by_bicgstab, 1e-12, 2000)
          .converged);
  EXPECT_LE(distance(flat(by_gradients), flat(by_bicgstab)), 1e-8 * norm(flat(by_gradients)));
}

TEST(Bicgstab, GoesOnWhereTheShadowSaysNothing) {
  // (r̂, A r) = 0 at the first step: a plain start breaks down.
  const Matrix a{{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}};
  std::vector<Vec3> x{{0.1, 0.2, 0.3}};
  const KrylovReport report =
      solve_krylov(KrylovMethod::bicgstab, product(a), {}, {{1, 2, 3}}, x, 1e-12, 100);
  EXPECT_TRUE(report.converged);
  EXPECT_NEAR(x[0][0], -2, 1e-10);
  EXPECT_NEAR(x[0][1], 1, 1e-10);
}

TEST(Bicgstab, SaysThatASingularSystemHasNoAnswer) {
  const Matrix a{{1, 0, 0}, {0, 1, 0}, {0, 0, 0}};
  std::vector<Vec3> x(1);
  const KrylovReport report =
      solve_krylov(KrylovMethod::bicgstab, product(a), {}, {{1, 1, 1}}, x, 1e-10, 100);
  EXPECT_FALSE(report.converged);
}

TEST(Krylov, OfNoLoadIsRest) {
  for (const auto method : {KrylovMethod::conjugate_gradients, KrylovMethod::bicgstab}) {
    std::vector<Vec3> x{{1, 2, 3}};
    const Matrix one{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    EXPECT_TRUE(solve_krylov(method, product(one), {}, {{0, 0, 0}}, x, 1e-8, 10).converged);
    EXPECT_EQ(x[0], (Vec3{0, 0, 0}));
  }
}

}  // namespace
}  // namespace rockfold
