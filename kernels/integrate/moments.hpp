// Integrals of monomials over bodies given by their boundary triangles, by exact simplex integration (thesis 4.2.3).
#pragma once

#include <vector>

#include "src/arrays/cover_arrays.hpp"
#include "src/arrays/element_arrays.hpp"

namespace rockfold {

/// Up to which degree moments are needed for stiffness and mass of the covers' order: twice that of weight times cover function.
int moment_degree(const CoverArrays& covers);

/// Moments of each piece about the centre of its lattice cell, up to `degree` (even, at least 2, at most 10).
///
/// Throws Error(analysis) naming the first piece whose triangles run inside out or hold a NaN. A piece so thin that its
/// volume drowns in the rounding of its vertices is no error: it gets the volume at which rounding ends (see
/// moments_kernel.hpp), at its vertices' centroid, so that the covers which only it holds still move with the rock.
PieceMoments piece_moments(const CoverArrays& covers, int degree);
PieceMoments piece_moments(const CoverArrays& covers);

/// Closed surfaces, one after the other. Example: one tetrahedron is triangle_begin = {0, 4}.
struct ClosedSurfaces {
  std::vector<Index> triangle_begin;   ///< [S+1]
  std::vector<Index> triangle_vertex;  ///< [T][3] counter-clockwise seen from outside
  std::vector<Real> vertex_xyz;        ///< [V][3] m
};

inline constexpr int max_degree = 6;
/// Monomials x^a y^b z^c with a + b + c ≤ max_degree.
inline constexpr int monomial_count = (max_degree + 1) * (max_degree + 2) * (max_degree + 3) / 6;

/// Where x^a y^b z^c stands: by total degree, then by descending a, then by descending b.
constexpr int monomial_index(int a, int b, int c) {
  const int degree = a + b + c, rest = b + c;
  return degree * (degree + 1) * (degree + 2) / 6 + rest * (rest + 1) / 2 + c;
}

/// ∫ x^a y^b z^c dV over each body, [S][monomial_count], about the origin of the coordinates.
std::vector<Real> integrate_monomials(const ClosedSurfaces& surfaces);

}  // namespace rockfold
