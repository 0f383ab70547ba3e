// Elements whose functions are known at points alone: those of covers with a local series (src/arrays/local_series.hpp). No virtual function
// runs on a device, so that the host evaluates all functions at the points of elements; the device integrates what it is given.
#pragma once

#include "kernels/operator/assemble_kernel.hpp"

namespace rockfold::solve {

/// Adds stiffness and mass of all elements to rows, all of them block rows, that are zero to start with. Throws Error(analysis) where a
/// function is no finite number, naming the place.
///
/// Exactness: see LocalSeries::degree. Cost: some 200 points a tetrahedron at degree 10, at each 5 · width² products, width the functions of
/// an element.
void assemble_sampled(const DeviceBlocks& block, const ElementTable& table,
                      const CoverArrays& covers);

/// [elements][width][3] the mean of ∂φ_f/∂x over each element, 1/m.
Array<Real> sampled_mean_slopes(const CoverArrays& covers);

/// ∂φ_f/∂x at points, where covers have a local series.
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
