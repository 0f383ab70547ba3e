// Few points with weights that are not negative, at which polynomials over an element are integrated exactly.
//
// Weights below zero would be shorter to find (one linear system for any points), but forces integrated with them have tangents
// that are not positive as soon as the strain is no polynomial of low degree: Newton's method then fails.
#pragma once

#include <vector>

#include "src/space/element_points.hpp"

namespace rockfold::finite {

/// As many of the given points as there are monomials up to the degree, or fewer, with weights that integrate those as before
/// (Tchakaloff's theorem): none is negative. Work: points · monomials².
/// Source: Carathéodory's theorem by exchange of points, as the simplex method does it (Davis, Math. Comp. 21 (1967) 578).
std::vector<RockPoint> reduce(const std::vector<RockPoint>& points, int degree);

}  // namespace rockfold::finite
