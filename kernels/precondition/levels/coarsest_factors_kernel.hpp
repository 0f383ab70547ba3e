// The factors of a coarsest level whose parts contacts join, on the host. Its unknowns are 3n · cover + 3k + d.
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "kernels/operator/point_terms_kernel.hpp"
#include "kernels/precondition/levels/cover_matrix_kernel.hpp"
#include "src/system/sparse_cholesky.hpp"

namespace rockfold::solve {

/// A matrix of covers while it is put together: its blocks in the order in which they were first met.
struct HostBlocks {
  Index covers = 0;
  int width = 3;  ///< 3n
  std::vector<Index> row, column;
  std::vector<Real> value;  ///< [blocks][width of the column][width of the row]
  std::unordered_map<std::int64_t, std::size_t>
      known;  ///< where the block of a row and a column is

  std::size_t size() const { return static_cast<std::size_t>(width) * width; }
  /// Zero at first; good until the next.
  Real* at(Index p, Index q);
};
void add_rows(HostBlocks& to, const CoverMatrix& a);

/// Tangents as xx yy zz xy yz zx, of whatever precision.
template <class Tangents>
std::vector<std::array<Real, 6>> tangents_on_host(Index count, const Tangents& tangents) {
  std::vector<std::array<Real, 6>> result(count);
  const auto host = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), tangents);
  for (Index n = 0; n < count; ++n)
    for (int m = 0; m < 6; ++m) result[n][m] = host(n, m);
  return result;
}
/// Nᵀ D N of points that act on few covers each.
void add_points(HostBlocks& to, const DevicePoints& points,
                const std::vector<std::array<Real, 6>>& tangent);

struct CoarsestFactors {
  std::vector<Index> begin, column;  ///< of the matrix, by unknowns
  SparseCholesky factors;
  mutable std::vector<Real> x;  ///< work space
};

/// `shift`: how much of its diagonal is added. Parts that nothing holds are free to move: see SparseCholesky's negligible pivots.
void factorise(CoarsestFactors& coarsest, const HostBlocks& a, Real shift, Real negligible);

/// x = A⁻¹ r, by unknowns k · covers + p.
template <class Vector>
void solve_coarsest(const CoarsestFactors& coarsest, int functions, const Vector& r,
                    const Vector& x) {
  const auto host = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), r);
  const Index unknowns = static_cast<Index>(host.extent(0)), covers = unknowns / functions;
  const auto place = [&](Index u) { return 3 * (u % covers * functions + u / covers); };
  for (Index u = 0; u < unknowns; ++u)
    for (int d = 0; d < 3; ++d) coarsest.x[place(u) + d] = host(u, d);
  Real* const all = coarsest.x.data();
  coarsest.factors.solve(&all, 1);
  const auto answer = Kokkos::create_mirror_view(Kokkos::HostSpace(), x);
  using Value = typename Vector::non_const_value_type;
  for (Index u = 0; u < unknowns; ++u)
    for (int d = 0; d < 3; ++d) answer(u, d) = static_cast<Value>(coarsest.x[place(u) + d]);
  Kokkos::deep_copy(x, answer);
}

}  // namespace rockfold::solve
