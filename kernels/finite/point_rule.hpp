// Points with weights that are not negative, at which polynomials over a solid are integrated exactly.
//
// Weights below zero would be shorter to find (one linear system for any points), but forces integrated with them have tangents
// that are not positive as soon as the strain is no polynomial of low degree: Newton's method then fails.
#pragma once

#include <vector>

#include "src/base/types.hpp"

namespace rockfold::finite {

struct PointRule {
  std::vector<Vec3> point;
  std::vector<Real> weight;

  std::size_t size() const { return weight.size(); }
  void add(const Vec3& x, Real w) {
    point.push_back(x);
    weight.push_back(w);
  }
};

/// Of the tetrahedron 0 ≤ x, y, z, x + y + z ≤ 1, its volume taken as 1: products of Gauss & Jacobi's points, collapsed
/// (Stroud 1971, 2.4).
PointRule tetrahedron_rule(int degree);

/// Of the cell −1/2 … 1/2 in all three directions, volume 1: products of Gauss & Legendre's points.
PointRule cell_rule(int degree);

/// A rule of at most as many of the given points as there are monomials up to the degree, that integrates those as they do; weights
/// not negative (Tchakaloff's theorem). Points lie within −1/2 … 1/2. Work: points · monomials².
/// Source: Carathéodory's theorem by exchange of points, as the simplex method does it (Davis, Math. Comp. 21 (1967) 578).
PointRule reduce(const PointRule& rule, int degree);

}  // namespace rockfold::finite
