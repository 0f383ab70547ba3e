// Stiffness and mass of manifold elements (thesis 4.2), exact for every lattice and order.
//
// With φ_f the functions of an element's part (part_functions.hpp) and S_ij = ∫ ∂_i φ_f ∂_j φ_g dV over the element
//
//   K_fg[i][j] = λ S_ij + μ S_ji + μ δ_ij Σ_d S_dd     (∫ BᵀDB, isotropic D)
//   M_fg       = ρ ∫ φ_f φ_g dV
//
// Both integrals are sums over products of the polynomials' coefficients with the element's moments.
#pragma once

#include "kernels/operator/elements/part_table_kernel.hpp"
#include "src/arrays/element_arrays.hpp"

namespace rockfold::solve {

struct Elastic {
  Real lambda, mu, density;
};
Elastic make_elastic(const ElasticMaterial& material);
std::vector<Elastic> make_elastic(const std::vector<ElasticMaterial>& materials);

/// A coupling of two functions: block of 9 of stiffness, row by row, and mass.
inline constexpr int entry_size = 10;

/// entry[10] = S_fg, ∫ φ_f φ_g dV becomes K_fg, M_fg.
KOKKOS_INLINE_FUNCTION void elastic_entry(const Elastic& m, Real* entry) {
  Real s[9];
  for (int i = 0; i < 9; ++i) s[i] = entry[i];
  const Real shear = m.mu * (s[0] + s[4] + s[8]);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      entry[3 * i + j] = m.lambda * s[3 * i + j] + m.mu * s[3 * j + i] + (i == j ? shear : 0);
  entry[9] *= m.density;
}

/// One row of an element's matrices: function f with the moments folded in, so that a coupling is a few dot products.
struct ElementRow {
  Real slope[3][most_slope_terms];  ///< Σ_m (coefficients of ∂_i φ_f)_m · moment(m + n)
  Real value[most_terms];           ///< Σ_m (coefficients of φ_f)_m · moment(m + n)

  KOKKOS_INLINE_FUNCTION ElementRow(const PartTable& table, const FunctionTerms& f,
                                    const Real* moments) {
    const int terms = table.terms, slope_terms = table.slope_terms;
    for (int n = 0; n < terms; ++n) {
      const Index* sum = &table.sum_index(n * terms);
      value[n] = 0;
      for (int m = 0; m < terms; ++m) value[n] += f.value[m] * moments[sum[m]];
      if (n >= slope_terms) continue;
      for (int i = 0; i < 3; ++i) {
        slope[i][n] = 0;
        for (int m = 0; m < slope_terms; ++m) slope[i][n] += f.slope[i][m] * moments[sum[m]];
      }
    }
  }

  /// entry[10] = K_fg, M_fg.
  KOKKOS_INLINE_FUNCTION void couple(const PartTable& table, const FunctionTerms& g,
                                     const Elastic& m, Real* entry) const {
    Real s[3][3];
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) s[i][j] = dot_terms(slope[i], g.slope[j], table.slope_terms);
    const Real shear = m.mu * (s[0][0] + s[1][1] + s[2][2]);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        entry[3 * i + j] = m.lambda * s[i][j] + m.mu * s[j][i] + (i == j ? shear : 0);
    entry[9] = m.density * dot_terms(value, g.value, table.terms);
  }
};

/// Stress (xx yy zz xy yz zx) of a displacement gradient h[i][j] = ∂u_i/∂x_j.
KOKKOS_INLINE_FUNCTION void elastic_stress(const Elastic& m, const Real (*h)[3], Real* stress) {
  const Real pressure = m.lambda * (h[0][0] + h[1][1] + h[2][2]);
  for (int i = 0; i < 3; ++i) stress[i] = pressure + 2 * m.mu * h[i][i];
  stress[3] = m.mu * (h[0][1] + h[1][0]);
  stress[4] = m.mu * (h[1][2] + h[2][1]);
  stress[5] = m.mu * (h[2][0] + h[0][2]);
}

}  // namespace rockfold::solve
