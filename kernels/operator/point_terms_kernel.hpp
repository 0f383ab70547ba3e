// Terms: what acts on the rock at points beside its own stiffness and mass, y += Σ Nᵀ D N x. N are the weights of a point, D its
// 3×3 tangent. Supports and dashpots are terms, symmetric, of points that stay; each writes the tangents of a range of points of its own,
// the solver and all preconditioners know their sum alone. Contacts are a list of their own, whose points change.
#pragma once

#include "kernels/operator/operator_kernel.hpp"
#include "kernels/operator/point_rows_kernel.hpp"

namespace rockfold::solve {

/// (n, c): 3×3 row-major.
using Tangents = Kokkos::View<Real* [9], Kokkos::LayoutLeft, device::Memory>;

/// Points of a group act on each other too: point k of it by −a_k W_kl (a_l · x_l). Products alone know that, preconditioners the
/// points' own tangents, which hold −a_k W_kk a_kᵀ.
struct Couplings {
  Index first = 0, points = 0;  ///< of the list
  Array<Index> begin;           ///< [groups+1] the first point of each, from `first`
  Index groups = 0;
  Array<Index> matrix;  ///< [groups+1] where W of each begins, row-major
  Array<Real> value;    ///< W
  Field lead;           ///< [points] a

  bool any() const { return groups > 0; }
};

struct PointTerms : PointRows {
  Blocks tangent;  ///< [N] N/m: D as xx yy zz xy yz zx …
  Tangents
      whole;  ///< … or, where D need not be symmetric (products take it, preconditioners a `tangent` like it); else empty
  Couplings couplings;
  Field force;  ///< [N] work space
};
/// Without tangents yet.
PointTerms make_point_terms(const MaterialPoints& points, Index unknowns);

/// Where entry (i, j) of a symmetric 3×3 stands among xx yy zz xy yz zx.
KOKKOS_INLINE_FUNCTION int symmetric_entry(int i, int j) {
  return i == j ? i : i + j == 1 ? 3 : i + j == 3 ? 4 : 5;
}

/// The points of all terms in one list: those of the first, then those of the next.
void append_points(MaterialPoints& to, const MaterialPoints& from);

/// y += Nᵀ D N x, of the points from `first` on.
void apply_terms(const PointTerms& terms, const Field& x, const Field& y, Index first = 0);

/// The diagonal blocks of Nᵀ D N, of the points from `first` on, added to d.
void add_terms_diagonal(const PointTerms& terms, const Blocks& d, Index first = 0);

}  // namespace rockfold::solve
