// Essential conditions that the unknowns of one cover satisfy by themselves are eliminated: with C their rows, made orthonormal, the solution is
// x = Cᵀ g + y with C y = 0, and A is only ever applied between such y, P A P y = P (b − A Cᵀ g), P = I − CᵀC (Hughes 1987, 1.7: prescribed
// displacements on the right-hand side; here in coordinates of which several functions of a cover may share one). The forces that keep them, the
// multipliers of their points, follow from the residual: no iteration looks for them.
#pragma once

#include "kernels/operator/point_terms_kernel.hpp"
#include "src/arrays/direct_solver.hpp"

namespace rockfold::solve {

/// H pairs of a cover and a component, each with some orthonormal rows over the cover's functions. A row is a combination of fixed points.
struct Elimination {
  Index covers = 0;
  int functions = 0;
  Array<Index> cover, component;  ///< [H]
  Array<Index> begin;             ///< [H+1] rows
  Array<Real> row;                ///< [rows][functions]
  Array<Index> source_begin;      ///< [rows+1]
  Array<Index> source;            ///< fixed point
  Array<Real> factor;             ///< what a row takes of it: C = T N

  Index count() const { return static_cast<Index>(cover.extent(0)); }
  bool any() const { return count() > 0; }
};

/// Of the augmented points whose unknowns all belong to one cover. [n][d] of the result: that component of point n is eliminated. Covers whose
/// points contradict each other, or depend on each other all but exactly, are left to multipliers.
struct EliminationOfPoints {
  Elimination elimination;
  std::vector<Vec3> eliminated;
};
EliminationOfPoints eliminate(const FixedPoints& fixed, Index covers, int functions);

/// v ← P v.
void project(const Elimination& e, const Field& v);

/// A ← P A P + (I − P) D with D each cover's largest diagonal entry of the component, so that A stays as definite as it is between what P allows.
void constrain(const Elimination& e, BlockMatrix& a);

/// `part` ← Cᵀ T prescribed; x ← P x.
void split(const Elimination& e, const Field& prescribed, const Field& x, const Field& part);

/// multiplier ← multiplier + Tᵀ C r: the forces of the points that balance the residual r.
void add_reactions(const Elimination& e, const Field& r, const Field& multiplier);

}  // namespace rockfold::solve
