// Strain and stress at a point. Symmetric tensors are xx yy zz xy yz zx.
#pragma once

#include "kernels/operator/elements/element_kernel.hpp"

namespace rockfold::finite {

/// E = ½ (H + Hᵀ + HᵀH), H row-major.
KOKKOS_INLINE_FUNCTION void green_strain(const Real* h, Real* e) {
  for (int k = 0; k < 6; ++k) {
    const int i = k < 3 ? k : k - 3, j = k < 3 ? k : (k - 2) % 3;
    Real sum = h[3 * i + j] + h[3 * j + i];
    for (int m = 0; m < 3; ++m) sum += h[3 * m + i] * h[3 * m + j];
    e[k] = 0.5 * sum;
  }
}

/// rate = of_v · sym(Fᵀ V) + of_a · (sym(Fᵀ A) + VᵀV): of E's derivatives in time, V = ∇v, A = ∇a.
KOKKOS_INLINE_FUNCTION void strain_rate(const Real* h, const Real* v, const Real* a, Real of_v,
                                        Real of_a, Real* rate) {
  for (int k = 0; k < 6; ++k) {
    const int i = k < 3 ? k : k - 3, j = k < 3 ? k : (k - 2) % 3;
    rate[k] = 0;
    for (int m = 0; m < 3; ++m) {
      const Real fi = h[3 * m + i] + (m == i ? 1 : 0), fj = h[3 * m + j] + (m == j ? 1 : 0);
      rate[k] +=
          0.5 * of_v * (fi * v[3 * m + j] + v[3 * m + i] * fj) +
          of_a * (0.5 * (fi * a[3 * m + j] + a[3 * m + i] * fj) + v[3 * m + i] * v[3 * m + j]);
    }
  }
}

/// s += factor · (λ tr(e) I + 2μ e).
KOKKOS_INLINE_FUNCTION void add_elastic_stress(const solve::Elastic& m, Real factor, const Real* e,
                                               Real* s) {
  const Real volumetric = m.lambda * (e[0] + e[1] + e[2]);
  for (int k = 0; k < 6; ++k) s[k] += factor * ((k < 3 ? volumetric : 0) + 2 * m.mu * e[k]);
}

/// Entry (i, j) of a symmetric tensor.
KOKKOS_INLINE_FUNCTION Real entry(const Real* s, int i, int j) {
  return i == j ? s[i] : i + j == 1 ? s[3] : i + j == 3 ? s[4] : s[5];
}

/// p = (I + H) S, row-major.
KOKKOS_INLINE_FUNCTION void first_stress(const Real* h, const Real* s, Real* p) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      Real sum = entry(s, i, j);
      for (int m = 0; m < 3; ++m) sum += h[3 * i + m] * entry(s, m, j);
      p[3 * i + j] = sum;
    }
}

KOKKOS_INLINE_FUNCTION Real determinant(const Real* f) {
  return f[0] * (f[4] * f[8] - f[5] * f[7]) - f[1] * (f[3] * f[8] - f[5] * f[6]) +
         f[2] * (f[3] * f[7] - f[4] * f[6]);
}

/// F S Fᵀ / det F.
KOKKOS_INLINE_FUNCTION void cauchy_stress(const Real* h, const Real* s, Real* cauchy) {
  Real p[9], f[9];
  first_stress(h, s, p);
  for (int i = 0; i < 9; ++i) f[i] = h[i] + (i % 4 == 0 ? 1 : 0);
  const Real share = 1 / determinant(f);
  for (int k = 0; k < 6; ++k) {
    const int i = k < 3 ? k : k - 3, j = k < 3 ? k : (k - 2) % 3;
    cauchy[k] = 0;
    for (int m = 0; m < 3; ++m) cauchy[k] += share * p[3 * i + m] * f[3 * j + m];
  }
}

/// b = a⁻¹ · scale; returns det a.
KOKKOS_INLINE_FUNCTION Real invert(const Real* a, Real* b) {
  const Real det = determinant(a);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const int r = (j + 1) % 3, s = (j + 2) % 3, t = (i + 1) % 3, u = (i + 2) % 3;
      b[3 * i + j] = (a[3 * r + t] * a[3 * s + u] - a[3 * r + u] * a[3 * s + t]) / det;
    }
  return det;
}

/// The rotation of a polar decomposition, in place: a ← (a + a⁻ᵀ)/2 until it stays (Higham 1986). Left as it is where det a ≤ 0.
KOKKOS_INLINE_FUNCTION bool make_rotation(Real* a) {
  for (int step = 0; step < 50; ++step) {
    Real inverse[9];
    if (!(invert(a, inverse) > 0)) return false;
    Real change = 0;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const Real next = 0.5 * (a[3 * i + j] + inverse[3 * j + i]);
        change = device::math::fmax(change, device::math::fabs(next - a[3 * i + j]));
        inverse[3 * j + i] = next;
      }
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) a[3 * i + j] = inverse[3 * j + i];
    if (change < 1e-14) return true;
  }
  return true;
}

}  // namespace rockfold::finite
