// Cover functions about the middle of the rock that each cover holds, where that is little.
#pragma once

#include "src/arrays/cover_arrays.hpp"

namespace rockfold {

/// Sets CoverArrays::middle and reach where covers have linear functions and no cover holds rock wider than a lattice cell.
///
/// Monomials about nodes, in units of the edges, are all but dependent on rock of size h ≪ 1 there: of quadratic covers with h = 0.15 the
/// least pivots of the stiffness scaled to a unit diagonal are 1e-16, with h = 0.005 they are 1e-20, and rounding decides what becomes of
/// functions that matter. About the middle of a cover's rock the least pivot is 1e-7 in both; the functions span the same space.
void centre_functions(CoverArrays& covers);

}  // namespace rockfold
