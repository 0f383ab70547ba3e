#include "kernels/precondition/inverses_kernel.hpp"

namespace rockfold::solve {
namespace {

using device::Sums;

// A device lambda may not stand in a host one: hence functions with names.

void apply_blocks(const Blocks& b, const Array<Real>& partial, const Field& r, const Field& z,
                  const Array<Real>& energy) {
  device::sum_then<1>(
      "rockfold::solve::block_jacobi", static_cast<Index>(r.extent(0)), partial,
      KOKKOS_LAMBDA(const Index p, Sums<1>& sum) {
        const Real x = r(p, 0), y = r(p, 1), w = r(p, 2);
        z(p, 0) = b(p, 0) * x + b(p, 3) * y + b(p, 5) * w;
        z(p, 1) = b(p, 3) * x + b(p, 1) * y + b(p, 4) * w;
        z(p, 2) = b(p, 5) * x + b(p, 4) * y + b(p, 2) * w;
        sum.value[0] += x * z(p, 0) + y * z(p, 1) + w * z(p, 2);
      },
      KOKKOS_LAMBDA(const Sums<1>& sum) { energy(0) = sum.value[0]; });
}

void apply_cover_blocks(const CoverBlocks& m, const Array<Real>& partial, const Field& r,
                        const Field& z, const Array<Real>& energy) {
  device::sum_then<1>(
      "rockfold::solve::cover_block_jacobi", m.covers, partial,
      KOKKOS_LAMBDA(const Index p, Sums<1>& sum) {
        Real of_cover[most_block_width], answer[most_block_width];
        for (int e = 0; e < m.width(); ++e) of_cover[e] = r(e / 3 * m.covers + p, e % 3);
        precondition_cover(m, p, of_cover, answer);
        for (int e = 0; e < m.width(); ++e) {
          z(e / 3 * m.covers + p, e % 3) = answer[e];
          sum.value[0] += of_cover[e] * answer[e];
        }
      },
      KOKKOS_LAMBDA(const Sums<1>& sum) { energy(0) = sum.value[0]; });
}

/// Scaled to unit norm and back: the cycle runs in single precision. `square` = ‖r‖².
void apply_cycle(const Multigrid& grid, const Array<Real>& square, const Field& r, const Field& z) {
  precondition(grid, r, square);
  const auto x = grid.levels[0].x;
  const Real scale = grid.scale;
  device::for_each(
      "rockfold::solve::answer_of_cycle", static_cast<Index>(r.extent(0)),
      KOKKOS_LAMBDA(const Index p) {
        const Real share = device::math::sqrt(square(0)) / scale;
        for (int d = 0; d < 3; ++d) z(p, d) = share * x(p, d);
      });
}

}  // namespace

ApplyInverse of_blocks(const Blocks& inverse, const KrylovWork& work) {
  return
      [inverse, partial = work.partial](const Field& r, const Field& z, const Array<Real>& energy) {
        apply_blocks(inverse, partial, r, z, energy);
      };
}

ApplyInverse of_cover_blocks(const CoverBlocks& blocks, const KrylovWork& work) {
  return
      [blocks, partial = work.partial](const Field& r, const Field& z, const Array<Real>& energy) {
        apply_cover_blocks(blocks, partial, r, z, energy);
      };
}

ApplyInverse of_multigrid(const Multigrid& grid, const KrylovWork& work) {
  return [&grid, work](const Field& r, const Field& z, const Array<Real>& energy) {
    dot_on_device(work, r, r, energy);
    apply_cycle(grid, energy, r, z);
    dot_on_device(work, r, z, energy);
  };
}

ApplyInverse of_cover_grid(const CoverGrid& grid, const Apply& a, const KrylovWork& work) {
  return [&grid, a, work](const Field& r, const Field& z, const Array<Real>& energy) {
    precondition(grid, a, r, z);
    dot_on_device(work, r, z, energy);
  };
}

ApplyInverse of_factors(const Factors& factors, const KrylovWork& work) {
  return [&factors, work](const Field& r, const Field& z, const Array<Real>& energy) {
    precondition(factors, r, z);
    dot_on_device(work, r, z, energy);
  };
}

}  // namespace rockfold::solve
