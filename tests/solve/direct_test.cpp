// Factors as the preconditioner, with a dense factorisation in the place of the host's sparse one.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/solve/systems/systems.hpp"

namespace rockfold {
namespace {

/// What the stand-in was asked.
struct Asked {
  int analysed = 0, factorised = 0, solved = 0;
};

/// Cholesky's method for the dense matrix, scaled to a unit diagonal, the largest pivot first.
class DenseSolver : public DirectSolver {
 public:
  DenseSolver(Asked& asked, bool fits, Real spoiled)
      : asked_(asked), fits_(fits), spoiled_(spoiled) {}

  bool analyse(const BlockMatrix& /*a*/) override {
    ++asked_.analysed;
    return fits_;
  }
  double operations() const override { return 1e30; }
  double entries() const override { return 1e15; }
  bool factorise(const BlockMatrix& a, Real least_pivot) override {
    ++asked_.factorised;
    std::vector<Real> left = scaled(a);
    const std::size_t n = scale_.size();
    std::vector<bool> done(n, false);
    pivot_.clear();
    column_.clear();
    for (std::size_t step = 0; step < n; ++step) {
      std::size_t p = n;
      for (std::size_t i = 0; i < n; ++i)
        if (!done[i] && (p == n || left[i * n + i] > left[p * n + p])) p = i;
      if (!(left[p * n + p] > least_pivot)) break;
      done[p] = true;
      const Real root = std::sqrt(left[p * n + p]);
      std::vector<Real> column(n, 0);
      for (std::size_t i = 0; i < n; ++i)
        if (!done[i]) column[i] = left[p * n + i] / root;
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; column[i] != 0 && j < n; ++j)
          left[i * n + j] -= column[i] * column[j];
      column[p] = root;
      pivot_.push_back(p);
      column_.push_back(std::move(column));
    }
    return true;
  }
  void solve(std::vector<Real>& r) override {
    ++asked_.solved;
    std::vector<Real> z(r.size(), 0), y(pivot_.size());
    for (std::size_t i = 0; i < r.size(); ++i) r[i] *= scale_[i];
    for (std::size_t k = 0; k < pivot_.size(); ++k) {
      y[k] = r[pivot_[k]] / column_[k][pivot_[k]];
      for (std::size_t i = 0; i < r.size(); ++i) r[i] -= column_[k][i] * y[k];
    }
    for (std::size_t k = pivot_.size(); k-- > 0;) {
      for (std::size_t i = 0; i < z.size(); ++i) y[k] -= column_[k][i] * z[i];
      z[pivot_[k]] = y[k] / column_[k][pivot_[k]];
    }
    for (std::size_t i = 0; i < r.size(); ++i) r[i] = z[i] * scale_[i];
  }

 private:
  std::vector<Real> scaled(const BlockMatrix& a) {
    const std::size_t w = a.width, n = a.rows() * w;
    std::vector<Real> dense(n * n, 0);
    for (Index i = 0; i < a.rows(); ++i)
      for (Index m = a.begin[i]; m < a.begin[i + 1]; ++m)
        for (std::size_t e = 0; e < w; ++e)
          for (std::size_t d = 0; d < w; ++d)
            dense[(i * w + d) * n + a.column[m] * w + e] = a.value[(m * w + e) * w + d];
    scale_.assign(n, 0);
    for (std::size_t i = 0; i < n; ++i) scale_[i] = 1 / std::sqrt(dense[i * n + i]);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j)
        dense[i * n + j] *= scale_[i] * scale_[j] * (i == j ? 1 + spoiled_ : 1);
    return dense;
  }

  Asked& asked_;
  bool fits_;
  Real spoiled_;
  std::vector<Real> scale_;
  std::vector<std::size_t> pivot_;
  std::vector<std::vector<Real>> column_;
};

MakeDirectSolver dense_solver(Asked& asked, bool fits = true, Real spoiled = 0) {
  return [&asked, fits, spoiled] { return std::make_unique<DenseSolver>(asked, fits, spoiled); };
}

CoverSystem make(const SmallSystem& s, Preconditioner preconditioner,
                 const MakeDirectSolver& direct) {
  return CoverSystem(s.covers(), piece_moments(s.covers()), s.materials, s.fixed, preconditioner,
                     direct);
}

/// A cut system at rest at one end, and forces as mass would have them.
struct Loaded {
  SmallSystem s;
  std::vector<Vec3> b;
};
Loaded loaded(LatticeKind kind, int order, Real spacing = 0.55) {
  Loaded l{cut_system(kind, order, spacing), {}};
  for (Vec3& v : l.s.fixed.value) v = {0, 0, 0};
  const CoverSystem system = l.s.make();
  l.b = system.apply({0, 1, 0}, reference::scattered(system.unknowns(), 3));
  return l;
}

constexpr SystemCoefficients some_mass{1, 3, 1};  // holds the second body

TEST(DirectWay, TakesAFewIterationsOnCoversOfAnyOrder) {
  for (LatticeKind kind : {LatticeKind::tet6, LatticeKind::hex8})
    for (int order : {0, 1, 2}) {
      const Loaded l = loaded(kind, order, 1.5);
      Asked asked;
      CoverSystem system = make(l.s, Preconditioner::direct, dense_solver(asked));
      SolveOptions options;
      options.tolerance = 1e-10;
      std::vector<Vec3> x(l.b.size());
      const SolveReport report = system.solve(some_mass, l.b, x, options);
      EXPECT_TRUE(report.converged);
      EXPECT_EQ(report.preconditioner, Preconditioner::direct);
      EXPECT_LE(report.iterations, 10) << static_cast<int>(kind) << ", order " << order;
      // Whatever the preconditioner, the residual is that of the operator.
      std::vector<Vec3> left = system.apply(some_mass, x);
      for (std::size_t i = 0; i < left.size(); ++i)
        for (int d = 0; d < 3; ++d) left[i][d] -= l.b[i][d];
      EXPECT_LE(reference::largest(left), 1e-8 * reference::largest(l.b));
    }
}

TEST(DirectWay, EqualsADirectSolutionWithSpringsInTheMatrix) {
  const Loaded l = loaded(LatticeKind::tet6, 0);
  const auto dense = reference::combine(
      1,
      reference::combine(1, reference::assemble_stiffness(l.s.covers(), l.s.materials), 3,
                         reference::assemble_mass(l.s.covers(), l.s.materials)),
      1, reference::assemble_springs(l.s.covers(), l.s.fixed));
  const auto expected = reference::solve(dense, l.b);
  Asked asked;
  SolveOptions options;
  options.tolerance = 1e-12;
  std::vector<Vec3> x(l.b.size());
  const SolveReport report =
      make(l.s, Preconditioner::direct, dense_solver(asked)).solve(some_mass, l.b, x, options);
  EXPECT_LE(report.iterations, 4);
  EXPECT_LE(reference::largest_difference(x, expected), 1e-7 * reference::largest(expected));
}

TEST(DirectWay, FactorsThatAreNotQuiteTheMatrixGiveTheSameAnswer) {
  const Loaded l = loaded(LatticeKind::tet6, 0);
  Asked exact, off;
  SolveOptions options;
  options.tolerance = 1e-11;
  std::vector<Vec3> expected(l.b.size()), x(l.b.size());
  make(l.s, Preconditioner::direct, dense_solver(exact)).solve(some_mass, l.b, expected, options);
  const SolveReport report = make(l.s, Preconditioner::direct, dense_solver(off, true, 1e-3))
                                 .solve(some_mass, l.b, x, options);
  EXPECT_TRUE(report.converged);
  EXPECT_EQ(report.preconditioner, Preconditioner::direct);
  EXPECT_GT(off.solved, exact.solved);
  EXPECT_LE(reference::largest_difference(x, expected), 1e-6 * reference::largest(expected));
}

TEST(DirectWay, ComesInWhereBlocksTakeLong) {
  const Loaded l = loaded(LatticeKind::tet6, 2, 1.5);
  Asked asked;
  CoverSystem system = make(l.s, Preconditioner::automatic, dense_solver(asked));
  SolveOptions options;
  options.tolerance = 1e-11;
  std::vector<Vec3> x(l.b.size());
  const SolveReport first = system.solve(some_mass, l.b, x, options);
  EXPECT_TRUE(first.converged);
  EXPECT_EQ(first.preconditioner, Preconditioner::direct);
  EXPECT_GE(first.iterations, 200);
  EXPECT_EQ(first.fallbacks, 1);
  // The limit is paid once: solves of matrices like it begin with the factors.
  const std::vector<Vec3> expected = x;
  std::fill(x.begin(), x.end(), Vec3{});
  const SolveReport second = system.solve(some_mass, l.b, x, options);
  EXPECT_LE(second.iterations, 3);
  EXPECT_EQ(second.fallbacks, 0);
  EXPECT_LE(reference::largest_difference(x, expected), 1e-7 * reference::largest(expected));
}

TEST(DirectWay, LeavesWhatIsTooLargeToTheOthers) {
  const Loaded l = loaded(LatticeKind::tet6, 1);
  Asked asked;
  std::vector<Vec3> x(l.b.size()), expected(l.b.size());
  CoverSystem without = make(l.s, Preconditioner::automatic, {}),
              with = make(l.s, Preconditioner::direct, dense_solver(asked, false));
  const SolveReport plain = without.solve(some_mass, l.b, expected);
  for (int again = 0; again < 2; ++again) {
    std::fill(x.begin(), x.end(), Vec3{});
    const SolveReport report = with.solve(some_mass, l.b, x);
    EXPECT_TRUE(report.converged);
    EXPECT_NE(report.preconditioner, Preconditioner::direct);
    if (again == 0) {
      EXPECT_EQ(report.iterations, plain.iterations);
      EXPECT_EQ(x, expected);
    }
  }
  EXPECT_EQ(asked.analysed, 1);
  EXPECT_EQ(asked.factorised, 0);
}

}  // namespace
}  // namespace rockfold
