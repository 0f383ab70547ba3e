// Rock that is a speck in its lattice cell: stiffness to the last digits of what is there.
#include "tests/reference/slivers.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "kernels/integrate/moments.hpp"
#include "tests/reference/dense_system.hpp"

namespace rockfold {
namespace {

const std::vector<ElasticMaterial> stone{{2500, 1e9, 0.25}};

/// S K S, S such that its diagonal is 1.
reference::Dense scaled_stiffness(const CoverArrays& covers) {
  const CoverSystem system(covers, piece_moments(covers), stone, {});
  const Index n = covers.unknown_count();
  const auto scale = reference::stiffness_scale(system, n);
  reference::Dense k(3 * static_cast<std::size_t>(n));
  for (Index j = 0; j < n; ++j)
    for (int d = 0; d < 3; ++d) {
      std::vector<Vec3> x(n, Vec3{});
      x[j][d] = scale[j][d];
      const auto y = system.apply({1, 0, 0}, x);
      for (Index i = 0; i < n; ++i)
        for (int e = 0; e < 3; ++e) k(3 * i + e, 3 * j + d) = scale[i][e] * y[i][e];
    }
  return k;
}

/// Whether all eigenvalues are above −shift: whether Cholesky's pivots of A + shift stay positive.
bool positive_but_for(reference::Dense a, Real shift) {
  for (std::size_t j = 0; j < a.n; ++j) {
    a(j, j) += shift;
    for (std::size_t k = 0; k < j; ++k) a(j, j) -= a(j, k) * a(j, k);
    if (!(a(j, j) > 0)) return false;
    const Real root = std::sqrt(a(j, j));
    a(j, j) = root;
    for (std::size_t i = j + 1; i < a.n; ++i) {
      for (std::size_t k = 0; k < j; ++k) a(i, j) -= a(i, k) * a(j, k);
      a(i, j) /= root;
    }
  }
  return true;
}

TEST(Slivers, HaveAStiffnessThatIsPositiveButForRounding) {
  for (const LatticeKind kind :
       {LatticeKind::tet5, LatticeKind::tet6, LatticeKind::tet24, LatticeKind::hex8})
    for (const int order : {0, 1, 2})
      for (const Real size : {1e-2, 1e-4})
        EXPECT_TRUE(positive_but_for(
            scaled_stiffness(reference::corner_of_a_cell(kind, order, size)), 1e-11))
            << static_cast<int>(kind) << ", order " << order << ", size " << size;
}

}  // namespace
}  // namespace rockfold
