// Multigrid over the lattice as a preconditioner: z = B r, one V-cycle with Chebyshev smoothing of degree 2 over the diagonal
// blocks before and after, symmetric and positive (Saad, Iterative Methods, 12.3; Adams, Brezina, Hu & Tuminaro 2003).
// Coarse levels follow the rock's topology (coarse_covers.hpp) and are Galerkin products of the finest one. All of it is in single
// precision, the residual scaled to unit norm first; nothing goes to the host.
#pragma once

#include <vector>

#include "kernels/precondition/levels/dense_parts_kernel.hpp"
#include "kernels/precondition/levels/level_kernel.hpp"

namespace rockfold::solve {

struct GridLevel {
  LevelMatrix a;
  PointRows
      points;  ///< of the terms, as the level sees them: with the weights of functions 0 alone
  SingleInverse inverse;
  Real largest = 0;  ///< eigenvalue of D⁻¹A, with a margin
  SingleField x, r, d, step;
  // coarse levels
  CoarseRows structure;
  Interpolation from;  ///< to the next finer level
};

struct Multigrid {
  Field lent;                     ///< of another, see make_multigrid
  std::vector<GridLevel> levels;  ///< finest first; two at least
  DenseParts coarsest;  ///< empty where the last level's parts are too large: smoothed only
  Real scale = 1;       ///< what all values are divided by
  std::vector<Parents> parents;  ///< of the covers of each level but the last
  ContactLevels contacts;
};

/// Levels without values, from topology; none for a lattice that has no coarser one. `points`: those of the terms. `lent`: [P] a
/// vector of the caller's in whose memory d and step of the finest level lie, in single precision: whatever it held is lost in
/// set_values and precondition, and what is written to it in between does not matter.
Multigrid make_multigrid(const CoverArrays& covers, const Operator& op,
                         const MaterialPoints& points, const Field& lent);

/// For αK + βM, the terms and the contacts: its inverted diagonal blocks, and its largest diagonal entry. Then come the values.
void set_inverse(Multigrid& grid, const Blocks& inverse, Real scale);
void set_values(Multigrid& grid, const Operator& op, const PointTerms& terms,
                const PointTerms& contacts, const Combination& c);

/// levels[0].x = scale / ‖r‖ · B r, with ‖r‖² = squared_norm(0) on the device.
void precondition(const Multigrid& grid, const Field& r, const Array<Real>& squared_norm);

}  // namespace rockfold::solve
