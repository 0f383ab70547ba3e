// Stiffness and mass of a tetrahedron's manifold element of order 0 (thesis 4.2).
//
// Inside one tetrahedron the weight of corner a is N_a(x) = constant_a + gradient_a · x, x from the lattice cell's centre. The
// displacement is Σ_a N_a d_a, its gradient constant, and over an element of volume V, first moments S and second moments T
//
//   K_ab = V (λ g_a g_bᵀ + μ g_b g_aᵀ + μ (g_a·g_b) I)         (V Bᵀ D B, isotropic D)
//   M_ab = ρ (c_a c_b V + (c_a g_b + c_b g_a)·S + g_aᵀ T g_b)    (∫ ρ N_a N_b dV, exact)
#pragma once

#include "kernels/device/device_kernel.hpp"
#include "src/arrays/cover_arrays.hpp"
#include "src/arrays/element_arrays.hpp"

namespace rockfold::solve {

/// The six tetrahedra of every lattice cell.
struct TetTable {
  int corner[6][4];
  Real gradient[6][4][3];  ///< 1/m
  Real constant[6][4];     ///< value at the centre of the lattice cell
  Real volume;             ///< m³ of one whole tetrahedron
};
TetTable make_tet_table(const Lattice& lattice);

struct Elastic {
  Real lambda, mu, density;
};
Elastic make_elastic(const ElasticMaterial& material);
std::vector<Elastic> make_elastic(const std::vector<ElasticMaterial>& materials);

/// k[3·i + j] += K_ab.
KOKKOS_INLINE_FUNCTION void add_stiffness(const Elastic& m, Real volume, const Real* ga,
                                          const Real* gb, Real* k) {
  const Real shear = m.mu * (ga[0] * gb[0] + ga[1] * gb[1] + ga[2] * gb[2]);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      k[3 * i + j] +=
          volume * (m.lambda * ga[i] * gb[j] + m.mu * gb[i] * ga[j] + (i == j ? shear : 0));
}

/// moments: volume, first x y z, second xx yy zz xy yz zx.
KOKKOS_INLINE_FUNCTION Real mass_entry(Real density, const Real* moments, Real ca, const Real* ga,
                                       Real cb, const Real* gb) {
  const Real* s = moments + 1;
  const Real* t = moments + 4;
  Real linear = 0;
  for (int d = 0; d < 3; ++d) linear += (ca * gb[d] + cb * ga[d]) * s[d];
  const Real square = ga[0] * (t[0] * gb[0] + t[3] * gb[1] + t[5] * gb[2]) +
                      ga[1] * (t[3] * gb[0] + t[1] * gb[1] + t[4] * gb[2]) +
                      ga[2] * (t[5] * gb[0] + t[4] * gb[1] + t[2] * gb[2]);
  return density * (ca * cb * moments[0] + linear + square);
}

/// Stress (xx yy zz xy yz zx) of an element whose corners move by d[a].
KOKKOS_INLINE_FUNCTION void element_stress(const Elastic& m, const Real (*gradient)[3],
                                           const Real (*d)[3], Real* stress) {
  Real h[3][3] =
      {};  // displacement gradient; differences to corner 0: a translation leaves no stress
  for (int a = 1; a < 4; ++a)
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) h[i][j] += (d[a][i] - d[0][i]) * gradient[a][j];
  const Real pressure = m.lambda * (h[0][0] + h[1][1] + h[2][2]);
  for (int i = 0; i < 3; ++i) stress[i] = pressure + 2 * m.mu * h[i][i];
  stress[3] = m.mu * (h[0][1] + h[1][0]);
  stress[4] = m.mu * (h[1][2] + h[2][1]);
  stress[5] = m.mu * (h[2][0] + h[0][2]);
}

}  // namespace rockfold::solve
