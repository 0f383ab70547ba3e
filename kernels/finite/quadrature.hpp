// Points and weights at which polynomials over a manifold element of any shape are integrated exactly.
//
// An element may be any union of convex polyhedra inside its part of a lattice cell. Whole elements share the points of their
// part. A cut element has points of its own inside it: products of Gauss's points in the tetrahedra of its pieces, of which as few are kept
// as there are monomials (point_rule.hpp). All weights are positive, zero where fewer points do.
#pragma once

#include <vector>

#include "src/arrays/cover_arrays.hpp"
#include "src/arrays/element_arrays.hpp"

namespace rockfold::finite {

/// Splits of a lattice have up to two forms (tet5); "kind" f·parts + t is part t of form f. The cut elements' kinds follow, one
/// each; where slopes are constant there are none of these. The rule is exact for the strain energy of small strain.
struct Quadrature {
  int kinds = 0;
  int points = 0;  ///< Q of each element
  int functions =
      0;  ///< of an element: nodes of a part · functions of a cover, node-major: a·n + k
  std::vector<Vec3> place;     ///< [kinds][Q] η
  std::vector<Vec3> gradient;  ///< [kinds][Q][functions] ∇φ, 1/m
  std::vector<int> kind;       ///< [elements] in the numbering of CoverArrays
  std::vector<Real> weight;    ///< [elements][Q] m³ of rock that the element stands for
};

/// `moments`: of degree moment_degree(covers) or more.
Quadrature make_quadrature(const CoverArrays& covers, const PieceMoments& moments);

}  // namespace rockfold::finite
