// part_functions.hpp on the device.
#pragma once

#include "kernels/device/device_kernel.hpp"
#include "kernels/integrate/moments_kernel.hpp"
#include "kernels/operator/elements/part_functions.hpp"

namespace rockfold::solve {

using device::Array;

/// Of φ_ak: hexahedra with covers of order 2, or less.
inline constexpr int most_degree = 5;
inline constexpr int most_terms = integrate::count_to(most_degree);
inline constexpr int most_slope_terms = integrate::count_to(most_degree - 1);

/// A part is numbered form · parts + part, its function k of node a as f = a · functions + k < width.
struct PartTable {
  int forms = 1, parts = 0, nodes = 0, cell_nodes = 0, functions = 0;
  int width = 0;  ///< nodes · functions
  int degree = 0, terms = 0, slope_terms = 0, moments = 0;
  int weight_degree = 0, polynomial_degree = 0;
  Real share = 1;
  Real reciprocal[3][3] = {};  ///< gradients of η, 1/m
  Array<Index> node;           ///< [forms·parts][nodes]
  Array<Real> value;           ///< [forms·parts][width][terms]
  Array<Real> slope;           ///< [forms·parts][width][3][slope_terms]
  Array<Real> moment;          ///< [forms·parts][moments]
  Array<Real> place;           ///< [forms·parts][nodes][3]
  Array<Real> weight;          ///< [forms·parts][nodes][count_to(weight_degree)]
  Array<Real> polynomial;      ///< [functions][count_to(polynomial_degree)] about the node
  Array<Index> sum_index;      ///< [terms][terms] where the product of two monomials stands

  KOKKOS_INLINE_FUNCTION const Real* values(int part, int f) const {
    return &value((static_cast<std::size_t>(part) * width + f) * terms);
  }
  KOKKOS_INLINE_FUNCTION const Real* slopes(int part, int f, int axis) const {
    return &slope(((static_cast<std::size_t>(part) * width + f) * 3 + axis) * slope_terms);
  }
  KOKKOS_INLINE_FUNCTION const Real* whole(int part) const {
    return &moment(static_cast<std::size_t>(part) * moments);
  }
  KOKKOS_INLINE_FUNCTION int cell_node(int part, int a) const { return node(part * nodes + a); }
};

/// The coefficients of a function and of its slopes.
struct FunctionTerms {
  const Real* value;     ///< [terms]
  const Real* slope[3];  ///< [slope_terms]
};

KOKKOS_INLINE_FUNCTION FunctionTerms function_terms(const PartTable& table, int part, int f) {
  return {table.values(part, f),
          {table.slopes(part, f, 0), table.slopes(part, f, 1), table.slopes(part, f, 2)}};
}

PartTable make_part_table(const LatticeFunctions& functions);

using integrate::fill_monomials;

KOKKOS_INLINE_FUNCTION Real dot_terms(const Real* a, const Real* b, int terms) {
  Real sum = 0;
  for (int i = 0; i < terms; ++i) sum += a[i] * b[i];
  return sum;
}

/// value[f] = φ_f(η); f < width.
KOKKOS_INLINE_FUNCTION void part_values(const PartTable& table, int part, const Real* eta,
                                        Real* value) {
  Real m[most_terms];
  fill_monomials(eta, table.degree, m);
  for (int f = 0; f < table.width; ++f) value[f] = dot_terms(table.values(part, f), m, table.terms);
}

/// gradient[f][d] = ∂φ_f/∂x_d at η, 1/m.
KOKKOS_INLINE_FUNCTION void part_gradients(const PartTable& table, int part, const Real* eta,
                                           Real (*gradient)[3]) {
  Real m[most_slope_terms];
  fill_monomials(eta, table.degree > 0 ? table.degree - 1 : 0, m);
  for (int f = 0; f < table.width; ++f)
    for (int d = 0; d < 3; ++d)
      gradient[f][d] = dot_terms(table.slopes(part, f, d), m, table.slope_terms);
}

/// gradient[f][d] = mean of ∂φ_f/∂x_d over a body with the given moments (m³).
KOKKOS_INLINE_FUNCTION void mean_gradients(const PartTable& table, int part, const Real* moments,
                                           Real (*gradient)[3]) {
  for (int f = 0; f < table.width; ++f)
    for (int d = 0; d < 3; ++d)
      gradient[f][d] = dot_terms(table.slopes(part, f, d), moments, table.slope_terms) / moments[0];
}

}  // namespace rockfold::solve
