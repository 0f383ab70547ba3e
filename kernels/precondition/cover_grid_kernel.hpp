// Multigrid for covers with several functions as a preconditioner: z = B r, one W-cycle with Chebyshev smoothing of degree 2 over the
// blocks of whole covers before and after, symmetric and positive.
//
// Functions of covers are nearly dependent. With linear weights Σ_a N_a(x) (x − x_a) = 0: functions ξ whose coefficients g_a vary slowly
// do next to nothing, Σ N_a g_a·(x − x_a) are bubbles of (g_a − g_b)·(x_a − x_b) on the edges. Their energy is that of a truss of its own, as
// smooth as elasticity, and no correction by constant functions reaches it. So all functions have coarse ones, interpolated by themselves, as if
// each were a displacement. At order 2 the functions ξξ, G = a symmetric matrix, do the same as g_a = G x_a: a coarse G carries along
// g_a = G (x_a − x_A), so that what is nothing on the coarse level stays nothing on the finer one.
//
// Levels, places and weights are those of coarse_covers.hpp; their matrices are Galerkin's products. Terms stay beside them, by rows Nₗ = N P,
// and contacts as matrices of their own.
#pragma once

#include <vector>

#include "kernels/krylov/krylov_work_kernel.hpp"
#include "kernels/precondition/levels/contact_levels_kernel.hpp"
#include "src/system/coarse_covers.hpp"

namespace rockfold::solve {

struct CoverLevel {
  PointTerms terms;  ///< N P, the tangents those of the finest level
  CoverBlocks blocks;
  Real largest = 0;  ///< eigenvalue of D⁻¹A, with a margin
  Field x, r, d, q;
  // coarse levels
  Field load, first;  ///< kept over the second cycle
  CoverMatrix a;
  CoverTransfer from;
};

/// Connected parts of the coarsest level that are solved by their inverses.
struct CoverParts {
  Array<Index> begin, member;  ///< [parts+1], covers of each part
  Array<Index> part, at;       ///< [P] of each cover, and its place among the members
  Array<std::int64_t> first;   ///< [parts] of the inverse, 3n·members squared
  Array<Real> inverse, scale;  ///< scale: [P][3n]

  bool any() const { return part.extent(0) > 0; }
};

struct CoverGrid {
  std::vector<CoverLevel> levels;  ///< finest first; two at least, or none
  CoverParts coarsest;             ///< empty where its parts are too large: smoothed only
  std::vector<Parents> parents;    ///< of the covers of each level but the last
  ContactLevels contacts;          ///< those of the finest level are part of what `a` below applies
};

/// Levels without values, from topology; none for a lattice that has no coarser one.
CoverGrid make_cover_grid(const CoverArrays& covers, const MaterialPoints& points);

/// Values for A = αK + βM, the terms and the contacts. `a` applies it; `blocks`: those of its covers.
void set_values(CoverGrid& grid, const Apply& a, const KrylovWork& work, const Operator& op,
                const CoverBlocks& blocks, const PointTerms& terms, const PointTerms& contacts,
                const Combination& c);

/// z = B r.
void precondition(const CoverGrid& grid, const Apply& a, const Field& r, const Field& z);

// cover_matrix.cpp

/// y = A x.
void apply(const CoverMatrix& a, const Field& x, const Field& y);

/// Pᵀ A P of the operator's rows, and of a coarse level's.
void multiply(const Operator& op, const Combination& c, const CoverTransfer& p,
              const CoverMatrix& to);
void multiply(const CoverMatrix& fine, const CoverTransfer& p, const CoverMatrix& to);

/// The blocks of covers with themselves, with terms and contacts, inverted.
void set_values(const CoverBlocks& blocks, const CoverMatrix& a, const PointTerms& terms,
                const ContactRows& contacts);

/// coarse = Pᵀ fine.
void restrict_functions(const CoverTransfer& p, int functions, const Field& fine,
                        const Field& coarse);
/// d = P coarse; x += d.
void add_correction(const CoverTransfer& p, int functions, const Field& coarse, const Field& d,
                    const Field& x);

// cover_parts.cpp

/// Parts (the smallest cover of each) and room for their inverses.
CoverParts make_cover_parts(const std::vector<Index>& part, int functions);
void invert_parts(const CoverMatrix& a, const PointTerms& terms, const CoverParts& parts);
/// Of the coarsest level where contacts join its parts.
void factorise(CoarsestFactors& coarsest, const CoverMatrix& a, const PointTerms& terms,
               const ContactRows& contacts);
/// x = A⁻¹ r.
void solve_parts(const CoverParts& parts, int functions, const Field& r, const Field& x);

}  // namespace rockfold::solve
