// Contacts on the levels of multigrid: Σ Nᵀ D N of all contact points as block rows beside the matrix of each level, Galerkin's products below
// the finest. A joint has many points in each cell, which would act on every level anew: their sum has blocks for the covers near
// the joint alone, a quarter of them on each coarser level.
//
// What a joint separates stays separate in the matrices of all levels; contacts couple it. On the coarsest level they join its parts, which
// are then solved together by their factors.
#pragma once

#include <vector>

#include "kernels/operator/point_terms_kernel.hpp"
#include "kernels/precondition/levels/coarsest_factors_kernel.hpp"
#include "kernels/precondition/levels/cover_matrix_kernel.hpp"

namespace rockfold::solve {

/// Rows of covers on which contacts act; those of other covers are empty.
struct ContactRows {
  CoverMatrix a;
  Array<Index> row;  ///< [T] covers on which they act, ascending

  KOKKOS_INLINE_FUNCTION bool any() const { return row.extent(0) > 0; }
};

/// Which coarse covers a finer one is interpolated from: see CoarseCovers.
struct Parents {
  std::vector<Index> begin, parent;
  Index coarse = 0;  ///< how many of them there are
};

struct ContactLevels {
  bool found = false;              ///< the rows are those of the present points
  std::vector<ContactRows> level;  ///< finest first
  CoarsestFactors coarsest;        ///< where there are any

  bool any() const { return found && level[0].any(); }
};

/// Where blocks stand, from the points. `parents`: of the covers of each level but the last.
void find_rows(ContactLevels& contacts, const PointTerms& terms, Index covers, int functions,
               const std::vector<Parents>& parents);

/// scale · Σ Nᵀ D N with the symmetric tangents.
void sum_points(const ContactRows& contacts, const PointTerms& terms, Real scale = 1);

/// Pᵀ A P.
template <class Transfer>
void multiply(const ContactRows& fine, Transfer transfer, const ContactRows& to) {
  const MatrixRows rows{fine.a};
  const ContactRows coarse = to;
  const int width = coarse.a.width();
  device::for_each(
      "rockfold::solve::contact_products", static_cast<Index>(coarse.row.extent(0)),
      KOKKOS_LAMBDA(const Index t) { multiply_row(rows, transfer, coarse.a, coarse.row(t)); },
      width * width);
}

/// The blocks of covers with themselves, of one function, added to d.
void add_diagonal(const ContactRows& contacts, const Blocks& d);

/// y += sign · A x, in single or double precision.
template <class Vector>
void add_contacts(const ContactRows& contacts, int sign, const Vector& x, const Vector& y) {
  const ContactRows c = contacts;
  device::for_each(
      "rockfold::solve::add_contacts", static_cast<Index>(c.row.extent(0)),
      KOKKOS_LAMBDA(const Index t) {
        const Index p = c.row(t);
        const int width = c.a.width();
        Real sum[most_block_width] = {}, u[most_block_width];
        const Real* v = &c.a.value(static_cast<std::size_t>(c.a.begin(p)) * width * width);
        for (Index k = c.a.begin(p); k < c.a.begin(p + 1); ++k, v += width * width) {
          for (int e = 0; e < width; ++e) u[e] = x(e / 3 * c.a.covers + c.a.column(k), e % 3);
#ifdef ROCKFOLD_ON_GPU
          for (int e = 0; e < width; ++e)
            for (int r = 0; r < width; ++r) sum[r] += v[e * width + r] * u[e];
#else
          block_add(width, v, u, sum);
#endif
        }
        for (int r = 0; r < width; ++r) y(r / 3 * c.a.covers + p, r % 3) += sign * sum[r];
      },
      16);
}

}  // namespace rockfold::solve
