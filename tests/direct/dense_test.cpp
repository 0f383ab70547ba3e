#include "host/direct/dense.hpp"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "host/direct/pivoted_cholesky.hpp"

namespace rockfold::host {
namespace {

using Matrix = Eigen::MatrixXd;

Index stride(const Matrix& a) {
  return static_cast<Index>(a.outerStride());
}

/// Sizes about those of tiles, blocks and chunks.
constexpr Index sizes[] = {1, 5, 8, 13, 64, 97, 200}, depths[] = {0, 1, 31, 256, 300};

TEST(DenseProducts, AreTakenOff) {
  for (const Index rows : sizes)
    for (const Index columns : sizes)
      for (const Index depth : depths) {
        const Matrix a = Matrix::Random(rows + 3, depth), b = Matrix::Random(columns + 1, depth);
        const Matrix before = Matrix::Random(rows + 2, columns);
        Matrix c = before;
        take_off_product(rows, columns, depth, a.data(), stride(a), b.data(), stride(b), c.data(),
                         stride(c));
        Matrix expected = before;
        if (depth > 0) expected.topRows(rows) -= a.topRows(rows) * b.topRows(columns).transpose();
        EXPECT_LE((c - expected).lpNorm<Eigen::Infinity>(), 1e-12)
            << rows << ' ' << columns << ' ' << depth;
        EXPECT_EQ(c.bottomRows(2), before.bottomRows(2));
      }
}

TEST(DenseProducts, OfAMatrixWithItselfFillTheLowerHalf) {
  for (const Index n : sizes)
    for (const Index depth : depths) {
      const Matrix a = Matrix::Random(n, depth), before = Matrix::Random(n, n);
      Matrix c = before;
      take_off_square(n, depth, a.data(), stride(a), c.data(), stride(c));
      Matrix expected = before;
      if (depth > 0) expected -= a * a.transpose();
      EXPECT_LE(Matrix((c - expected).triangularView<Eigen::Lower>()).lpNorm<Eigen::Infinity>(),
                1e-12)
          << n << ' ' << depth;
    }
}

TEST(DenseProducts, DivideByATriangle) {
  for (const Index rows : sizes)
    for (const Index n : sizes) {
      Matrix lower = Matrix::Random(n, n);
      lower.diagonal().array() += static_cast<Real>(n);
      const Matrix known = Matrix::Random(rows, n);
      Matrix b = known;
      divide_by_transpose(rows, n, lower.data(), stride(lower), b.data(), stride(b));
      const Matrix back = b * Matrix(lower.triangularView<Eigen::Lower>()).transpose();
      EXPECT_LE((back - known).lpNorm<Eigen::Infinity>(), 1e-12) << rows << ' ' << n;
    }
}

TEST(PivotedCholesky, GivesFactorsOfAnySize) {
  for (const Index n : sizes) {
    const Matrix f = Matrix::Random(n, n + 2), whole = f * f.transpose();
    Matrix a = whole;
    std::vector<Index> order;
    ASSERT_EQ(pivoted_cholesky(a.data(), n, n, 1e-12, order), n);
    const Matrix l = a.triangularView<Eigen::Lower>();
    EXPECT_LE((l * l.transpose() - Matrix(whole(order, order))).norm(), 1e-12 * whole.norm()) << n;
  }
}

}  // namespace
}  // namespace rockfold::host
