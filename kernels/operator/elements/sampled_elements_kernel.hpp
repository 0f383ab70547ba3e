// Elements that differ in their functions (CoverArrays::middle): the host evaluates slopes at points, the device takes what it is given.
#pragma once

#include <vector>

#include "kernels/operator/elements/assemble_kernel.hpp"

namespace rockfold::solve {

/// [elements][width][3] the mean of ∂φ_f/∂x over each element, 1/m.
Array<Real> sampled_mean_slopes(const CoverArrays& covers);

/// ∂φ_f/∂x at points, where elements differ in their functions.
struct PointSlopes {
  Array<Real> slope;  ///< [points][width][3] 1/m; empty: functions are polynomials
  std::size_t size = 0;

  KOKKOS_INLINE_FUNCTION const Real* at(Index n) const {
    return size > 0 ? &slope(size * n) : nullptr;
  }
};

/// At points `local` m from the centres of their elements' cells.
PointSlopes sampled_slopes(const CoverArrays& covers, const std::vector<Index>& element,
                           const std::vector<Vec3>& local);

}  // namespace rockfold::solve
