// Stresses of elements on the device (xx yy zz xy yz zx) under the displacement d of the covers.
#pragma once

#include "kernels/operator/elements/element_table_kernel.hpp"
#include "src/space/shape_functions.hpp"

namespace rockfold::motion {

using device::Array;
using device::Field;

inline constexpr int most_width = 8 * most_functions;  ///< functions of a part

/// The mean over element e.
KOKKOS_INLINE_FUNCTION void stress_of_element(const solve::ElementTable& table, const Field& d,
                                              Index e, Real* stress) {
  Real gradient[most_width][3], h[3][3];
  if (table.mean_slope.extent(0) > 0) {
    const int width = table.parts.nodes * table.functions;
    const Real* mean = &table.mean_slope(3 * static_cast<std::size_t>(width) * e);
    for (int f = 0; f < width; ++f)
      for (int i = 0; i < 3; ++i) gradient[f][i] = mean[3 * f + i];
  } else {
    solve::mean_gradients(table.parts, table.part(e), table.moments(e), gradient);
  }
  solve::displacement_gradient(table, e, gradient, d, h);
  solve::elastic_stress(table.elastic(table.material(e)), h, stress);
}

/// ∂u/∂x at a point x m from the centre of the element's lattice cell. `slope`: what sampled_slopes says of the element's functions there,
/// or null: they are polynomials.
KOKKOS_INLINE_FUNCTION void gradient_at(const solve::ElementTable& table, const Field& d, Index e,
                                        const Real* x, const Real* slope, Real (*h)[3]) {
  Real gradient[most_width][3];
  if (slope != nullptr) {
    for (int f = 0; f < table.parts.nodes * table.functions; ++f)
      for (int i = 0; i < 3; ++i) gradient[f][i] = slope[3 * f + i];
  } else {
    const auto& r = table.parts.reciprocal;
    Real eta[3];
    for (int i = 0; i < 3; ++i) eta[i] = r[i][0] * x[0] + r[i][1] * x[1] + r[i][2] * x[2];
    solve::part_gradients(table.parts, table.part(e), eta, gradient);
  }
  solve::displacement_gradient(table, e, gradient, d, h);
}

/// At such a point.
KOKKOS_INLINE_FUNCTION void stress_at(const solve::ElementTable& table, const Field& d, Index e,
                                      const Real* x, const Real* slope, Real* stress) {
  Real h[3][3];
  gradient_at(table, d, e, x, slope, h);
  solve::elastic_stress(table.elastic(table.material(e)), h, stress);
}

}  // namespace rockfold::motion
