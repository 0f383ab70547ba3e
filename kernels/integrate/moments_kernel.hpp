// Exact integration of monomials over a body from its boundary triangles.
//
// A body is the signed sum of the tetrahedra (o, v1, v2, v3) over its triangles, o any point: here the body's own first
// vertex, so that nothing cancels far from the origin; the result is then shifted. With V the signed volume,
//
//   ∫ x^a y^b z^c dV = 6V · a! b! c! / (a+b+c+3)! · H[a,b,c],
//   Σ H[a,b,c] s^a t^b u^c = Π_k 1 / (1 − (x_k s + y_k t + z_k u)),       k over the three vertices,
//
// which follows from ∫ λ1^p λ2^q λ3^r dV = 6V p! q! r! / (p+q+r+3)! (cases A). Dividing a power series by
// 1 − (x s + y t + z u) is one sweep of three multiply-adds a monomial: no sums over multi-indices.
#pragma once

#include "kernels/device/device_kernel.hpp"
#include "kernels/integrate/moments.hpp"

namespace rockfold::integrate {

/// The number of monomials up to a degree.
KOKKOS_INLINE_FUNCTION constexpr int count_to(int degree) {
  return (degree + 1) * (degree + 2) * (degree + 3) / 6;
}

/// monomial_index for the device.
KOKKOS_INLINE_FUNCTION constexpr int index_of(int a, int b, int c) {
  return (a + b + c) * (a + b + c + 1) * (a + b + c + 2) / 6 + (b + c) * (b + c + 1) / 2 + c;
}

/// η^m up to a degree into m[count_to(degree)].
KOKKOS_INLINE_FUNCTION void fill_monomials(const Real* eta, int degree, Real* m) {
  m[0] = 1;
  for (int n = 1, at = 1, below = 0; n <= degree; ++n) {
    // Those of degree n: η_0 times all of degree n − 1, then η_1 times the last n of these, then η_2 times the very last.
    const int before = at - below;
    for (int i = 0; i < before; ++i) m[at + i] = eta[0] * m[below + i];
    for (int i = 0; i < n; ++i) m[at + before + i] = eta[1] * m[below + before - n + i];
    m[at + before + n] = eta[2] * m[below + before - 1];
    below = at;
    at += before + n + 1;
  }
}

/// h becomes h / (1 − (v·(s,t,u))): ascending degrees, in place.
template <int Degree>
KOKKOS_INLINE_FUNCTION void divide_by_vertex(Real* h, const Real* v) {
  for (int degree = 1; degree <= Degree; ++degree)
    for (int a = degree; a >= 0; --a)
      for (int b = degree - a; b >= 0; --b) {
        const int c = degree - a - b;
        Real sum = 0;
        if (a > 0) sum += v[0] * h[index_of(a - 1, b, c)];
        if (b > 0) sum += v[1] * h[index_of(a, b - 1, c)];
        if (c > 0) sum += v[2] * h[index_of(a, b, c - 1)];
        h[index_of(a, b, c)] += sum;
      }
}

KOKKOS_INLINE_FUNCTION Real triple_product(const Real* a, const Real* b, const Real* c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
         a[2] * (b[0] * c[1] - b[1] * c[0]);
}

KOKKOS_INLINE_FUNCTION constexpr Real factorial(int n) {
  Real product = 1;
  for (int k = 2; k <= n; ++k) product *= k;
  return product;
}

/// What the triangles of one body add up to, about the point `about`.
template <int Degree>
struct BodyIntegral {
  Real sum[count_to(Degree)];
  Real absolute_volume;  ///< Σ |V| of the tetrahedra: what rounding of `sum` is measured against

  KOKKOS_INLINE_FUNCTION BodyIntegral() : absolute_volume(0) {
    for (int m = 0; m < count_to(Degree); ++m) sum[m] = 0;
  }

  /// Adds the tetrahedron (0, v1, v2, v3), the vertices relative to `about`.
  KOKKOS_INLINE_FUNCTION void add(const Real (*v)[3]) {
    const Real six_volume = triple_product(v[0], v[1], v[2]);
    absolute_volume += device::math::fabs(six_volume) / 6;
    Real h[count_to(Degree)];
    h[0] = six_volume;
    for (int m = 1; m < count_to(Degree); ++m) h[m] = 0;
    for (int k = 0; k < 3; ++k) divide_by_vertex<Degree>(h, v[k]);
    for (int m = 0; m < count_to(Degree); ++m) sum[m] += h[m];
  }

  /// The factor a! b! c! / (a+b+c+3)! that all tetrahedra share.
  KOKKOS_INLINE_FUNCTION void finish() {
    for (int degree = 0; degree <= Degree; ++degree)
      for (int a = degree; a >= 0; --a)
        for (int b = degree - a; b >= 0; --b) {
          const int c = degree - a - b;
          sum[index_of(a, b, c)] *=
              factorial(a) * factorial(b) * factorial(c) / factorial(degree + 3);
        }
  }

  /// From moments about `about` to moments about the origin: x^n = (ξ + o)^n, one axis after the other.
  KOKKOS_INLINE_FUNCTION void shift(const Real* about) {
    for (int axis = 0; axis < 3; ++axis) shift_axis(axis, about[axis]);
  }

  KOKKOS_INLINE_FUNCTION void shift_axis(int axis, Real by) {
    // Repeated Horner sweeps: after n of them the entries of degree ≥ n along the axis have their binomials.
    for (int sweep = 1; sweep <= Degree; ++sweep)
      for (int degree = Degree; degree >= sweep; --degree)
        for (int a = degree; a >= 0; --a)
          for (int b = degree - a; b >= 0; --b) {
            const int c = degree - a - b;
            const int along = axis == 0 ? a : (axis == 1 ? b : c);
            if (along < sweep) continue;
            const int below = axis == 0   ? index_of(a - 1, b, c)
                              : axis == 1 ? index_of(a, b - 1, c)
                                          : index_of(a, b, c - 1);
            sum[index_of(a, b, c)] += by * sum[below];
          }
  }
};

/// Integrates the body of triangles [begin, end) about its first vertex; `about` is that vertex.
template <int Degree, class Triangles, class Vertices>
KOKKOS_INLINE_FUNCTION BodyIntegral<Degree> integrate_body(Index begin, Index end,
                                                           const Triangles& triangle_vertex,
                                                           const Vertices& xyz, Real* about) {
  BodyIntegral<Degree> body;
  for (int d = 0; d < 3; ++d) about[d] = begin < end ? xyz(3 * triangle_vertex(3 * begin) + d) : 0;
  for (Index t = begin; t < end; ++t) {
    Real v[3][3];
    for (int k = 0; k < 3; ++k)
      for (int d = 0; d < 3; ++d) v[k][d] = xyz(3 * triangle_vertex(3 * t + k) + d) - about[d];
    body.add(v);
  }
  body.finish();
  return body;
}

/// Rounding of a piece's volume in units of (size of the lattice cell)³: its vertices' coordinates, below one cell in size, are
/// rounded to 2⁻⁵³ each, and a piece has some tens of triangles.
inline constexpr Real volume_rounding = 1e-14;
/// The volume, in the same unit, that a piece gets whose own drowns in that rounding. As small as the thinnest slivers
/// that do not: below, it would only lose digits.
inline constexpr Real volume_floor = 1e-20;

}  // namespace rockfold::integrate
