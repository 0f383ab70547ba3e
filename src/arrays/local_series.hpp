// Functions of a cover beside its polynomials: "locally defined series" (thesis 4.1.2 b, Eq. 4-1: f_ij of cover i). See docs/local_series.md.
#pragma once

#include "src/base/types.hpp"

namespace rockfold {

/// A function of position at a point.
struct FunctionValue {
  Real value = 0;
  Vec3 gradient{};  ///< 1/m
};

/// Where the functions of a cover are asked for: a point of the rock that the cover holds; of a face that is held, also points of it
/// up to two spacings from the node.
struct SeriesPoint {
  Index cover =
      none;  ///< physical cover: the two sides of a joint have covers of their own about one node
  Vec3 node{};  ///< m, the node of the cover
  Vec3 x{};     ///< m
  Vec3 xi{};    ///< x − node in units of the lattice's edges
};

/// Functions that every cover carries beside the polynomials of its order. Derive from it and hand it over in CoverSpec::series (or in
/// CoverArrays::series, before anything is made of the covers).
///
/// With n functions f_k the displacement of cover i becomes U_i = Σ_j m_j(ξ) d_ij + Σ_k f_ik(x) d_ik, m_j the monomials of its order,
/// and each d_ik three unknowns more; Σ_i N_i U_i is the displacement as ever.
///
/// Elements are integrated at points inside them, all with positive weights, so that whatever the functions are the matrices are
/// symmetric and not negative: see degree().
class LocalSeries {
 public:
  LocalSeries() = default;
  LocalSeries(const LocalSeries&) = delete;
  LocalSeries& operator=(const LocalSeries&) = delete;
  virtual ~LocalSeries() = default;

  /// n ≥ 1, the same for all covers; with the monomials at most `most_functions`.
  virtual int functions() const = 0;

  /// function[k] = f_ik and its gradient at a point, k < functions(). The array comes zeroed, so that a cover which is to have none is left
  /// alone: its unknowns then stay at rest. Called from several threads at once; must not throw. A function may jump only where the rock
  /// does (across joints); f_ik should be of the order of 1 and independent of the monomials and of each other, or the
  /// solver takes longer.
  virtual void evaluate(const SeriesPoint& at, FunctionValue* function) const = 0;

  /// Of the polynomials that are integrated exactly: over each tetrahedron that elements are made of (a whole part of a cell, or the
  /// tetrahedra of a convex piece), and over each triangle of a loaded face. Stiffness takes products of two gradients, so what is
  /// left out are the terms of Taylor's series of such products beyond this degree: for functions that vary over a length L in
  /// elements of size h about (h/2L)^(degree+1) / (degree+1)!. A cell's hexahedron is exact to this degree in each direction.
  /// A tetrahedron has (degree/2 + 1)³ points. Under large kinematics elements hold their state at fewer: kernels/finite/quadrature.hpp.
  virtual int degree() const { return 10; }
};

}  // namespace rockfold
