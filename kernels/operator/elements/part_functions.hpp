// The functions of the parts of a lattice cell as polynomials: what every integral over an element is made of.
//
// In a part the displacement is Σ_ak φ_ak d_ak with φ_ak(η) = N_a(η) m_k(η − η_a), η the place in units of the cell's edges from
// its centre. All φ_ak are polynomials in η, the same in every cell of a lattice: their coefficients are kept here, and those of
// their gradients in metres. A polynomial of degree D has count_to(D) coefficients, η^(a,b,c) at monomial_index(a, b, c).
#pragma once

#include <array>
#include <vector>

#include "src/arrays/cover_arrays.hpp"

namespace rockfold {

/// The functions m_k(ξ) of a cover, ξ from its node in units of the edges; m_0 = 1.
///
/// Polynomials, so that all integrals are exact and the same in all whole cells.
struct CoverPolynomials {
  int degree = 0;
  std::vector<std::vector<Real>> function;  ///< [functions][count_to(degree)]

  int functions() const { return static_cast<int>(function.size()); }
};

/// The monomials of shape_functions.hpp.
CoverPolynomials cover_polynomials(int order);

/// One part of one form of the split.
struct PartFunctions {
  std::vector<int> node;     ///< [nodes] into the cell's nodes
  std::vector<Vec3> place;   ///< [nodes] η_a
  std::vector<Real> weight;  ///< [nodes][count_to(weight_degree)] of N_a
  std::vector<Real> value;   ///< [nodes][functions][terms] of φ_ak
  std::vector<Real> slope;   ///< [nodes][functions][3][slope_terms] of ∂φ_ak/∂x_d, 1/m
  std::vector<Real>
      moment;  ///< [count_to(2·degree)] share · ∫ η^m dV over the whole part, m³; zero for a block
};

/// All parts of a lattice: those of form 0, then those of form 1 (only tet5 has two: even, odd).
struct LatticeFunctions {
  int forms = 1;
  int parts = 0;  ///< of a form
  int nodes = 0;  ///< of a part
  int cell_nodes = 0;
  int functions = 0;      ///< of a cover
  int degree = 0;         ///< of φ_ak
  int weight_degree = 0;  ///< of N_a
  CoverPolynomials polynomials;
  Real share = 1;     ///< see CellSplit
  Mat3 reciprocal{};  ///< gradients of η, 1/m
  std::vector<PartFunctions> part;

  int terms() const;
  int slope_terms() const;
  /// Of the moments that stiffness and mass need.
  int moment_degree() const { return 2 * degree; }
  /// φ_ak(η), [nodes·functions]; `of` counts through the parts of all forms.
  std::vector<Real> values(int of, const Vec3& eta) const;
  /// ∂φ_ak/∂x at η, 1/m.
  std::vector<Vec3> gradients(int of, const Vec3& eta) const;
};

LatticeFunctions lattice_functions(const Lattice& lattice, int order);
LatticeFunctions lattice_functions(const CoverArrays& covers);

}  // namespace rockfold
